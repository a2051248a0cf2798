"""Which types are the same in ROS 1 and ROS 2."""

from pathlib import Path

import pytest

from crosnode.errors import DefinitionError, UnknownTypeError
from crosnode.messages import MessageTypes

pytest.importorskip("rosbags")
from crosnode.ros2.shapes import FILLER, Ros2Field, Shapes


def test_time_and_header_are_as_in_ros_2() -> None:
    shapes = Shapes(MessageTypes())
    assert shapes.fields("std_msgs/Header") == (
        Ros2Field("stamp", "builtin_interfaces/Time"),
        Ros2Field("frame_id", "string"),
    )
    assert shapes.fields("builtin_interfaces/Time") == (
        Ros2Field("sec", "int32"),
        Ros2Field("nanosec", "uint32"),
    )
    assert [each.name for each in shapes.fields("std_msgs/Empty")] == [FILLER]


@pytest.mark.parametrize(
    "name",
    [
        "std_msgs/Float64",
        "std_msgs/Byte",
        "sensor_msgs/JointState",
        "geometry_msgs/PoseWithCovariance",
        "trajectory_msgs/JointTrajectory",
        "tf2_msgs/TFMessage",
        "nav_msgs/Path",
        "sensor_msgs/Image",
        "diagnostic_msgs/DiagnosticArray",
    ],
)
def test_types_that_are_the_same(name: str) -> None:
    assert Shapes(MessageTypes()).fields(name)


@pytest.mark.parametrize("name", ["visualization_msgs/Marker", "sensor_msgs/CameraInfo"])
def test_a_type_that_is_another_one_is_refused(name: str) -> None:
    with pytest.raises(DefinitionError, match=f"{name} is another type in ROS 2, with the fields"):
        Shapes(MessageTypes()).fields(name)


def test_a_package_of_the_user_is_taken_as_it_is(tmp_path: Path) -> None:
    folder = tmp_path / "cell" / "msg"
    folder.mkdir(parents=True)
    (folder / "Part.msg").write_text("std_msgs/Header header\nint32[3] size\ntime[] seen\n")
    assert Shapes(MessageTypes([tmp_path])).fields("cell/Part") == (
        Ros2Field("header", "std_msgs/Header"),
        Ros2Field("size", "int32", is_array=True, length=3),
        Ros2Field("seen", "builtin_interfaces/Time", is_array=True),
    )
    with pytest.raises(UnknownTypeError):
        Shapes(MessageTypes([tmp_path])).fields("cell/Nothing")
