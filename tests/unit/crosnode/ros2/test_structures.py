"""Structures of Cyclone DDS against the bytes that rosbags writes, and back."""

from typing import Any

import pytest

from crosnode.messages import Duration, MessageTypes, Time

pytest.importorskip("cyclonedds")

from rosbags.typesys import Stores, get_typestore

from crosnode.ros2.structures import Structures

TYPES = MessageTypes()


def joint_state() -> Any:
    header = TYPES.message("std_msgs/Header").new(seq=7, stamp=Time(5, 6), frame_id="base")
    return TYPES.message("sensor_msgs/JointState").new(
        header=header, name=["one", "zwei ü"], position=[1.5, -2.5], velocity=[], effort=[3.0]
    )


def trajectory() -> Any:
    point = TYPES.message("trajectory_msgs/JointTrajectoryPoint").new(
        positions=[1.0], time_from_start=Duration(1, 500)
    )
    return TYPES.message("trajectory_msgs/JointTrajectory").new(joint_names=["a"], points=[point])


MESSAGES = [
    ("std_msgs/Float64", TYPES.message("std_msgs/Float64").new(data=2.25)),
    ("std_msgs/Bool", TYPES.message("std_msgs/Bool").new(data=True)),
    ("std_msgs/Byte", TYPES.message("std_msgs/Byte").new(data=-3)),
    ("std_msgs/Empty", TYPES.message("std_msgs/Empty").new()),
    ("sensor_msgs/JointState", joint_state()),
    ("trajectory_msgs/JointTrajectory", trajectory()),
    (
        "geometry_msgs/PoseWithCovariance",
        TYPES.message("geometry_msgs/PoseWithCovariance").new(
            covariance=list(map(float, range(36)))
        ),
    ),
]


def by_rosbags(name: str, data: bytes) -> Any:
    store = get_typestore(Stores.ROS2_HUMBLE)
    return store, store.deserialize_cdr(data, name.replace("/", "/msg/"))


@pytest.mark.parametrize(("name", "message"), MESSAGES, ids=lambda each: type(each).__name__)
def test_bytes_are_those_of_rosbags_and_messages_come_back(name: str, message: Any) -> None:
    structures = Structures(TYPES)
    made = structures.to_structure(name, message)
    data = made.serialize()
    store, read = by_rosbags(name, data)
    assert bytes(store.serialize_cdr(read, name.replace("/", "/msg/"))) == data
    back = structures.to_message(name, structures.structure(name).deserialize(data))
    if name == "sensor_msgs/JointState":
        message.header.seq = 0  # ROS 2 has none
    assert TYPES.message(name).encode(back) == TYPES.message(name).encode(message)


def test_what_rosbags_reads_is_what_was_meant() -> None:
    structures = Structures(TYPES)
    data = structures.to_structure("sensor_msgs/JointState", joint_state()).serialize()
    _, read = by_rosbags("sensor_msgs/JointState", data)
    assert (read.header.stamp.sec, read.header.stamp.nanosec) == (5, 6)
    assert (read.header.frame_id, read.name) == ("base", ["one", "zwei ü"])
    assert read.position.tolist() == [1.5, -2.5]


def test_a_time_before_1970_is_0_in_ros_1() -> None:
    structures = Structures(TYPES)
    kind = structures.structure("builtin_interfaces/Time")
    assert structures.to_message("builtin_interfaces/Time", kind(-5, 7)) == Time(0, 7)
