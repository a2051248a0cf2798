"""Types by name against the sums and bytes that genmsg and genpy gave (tests/data/ros1)."""

import csv
from pathlib import Path

import pytest

from crosnode.errors import DefinitionError, MessageTypeError, UnknownTypeError
from crosnode.messages import MessageType, MessageTypes
from crosnode.messages.packages import SHARE

DATA = Path(__file__).parents[3] / "data" / "ros1"
TYPES = MessageTypes([DATA / "packages"])
KNOWN = list(csv.DictReader((DATA / "md5.tsv").read_text("utf-8").splitlines(), delimiter="\t"))


@pytest.mark.parametrize("row", KNOWN, ids=lambda row: row["type"])
def test_md5_of_known_types(row: dict[str, str]) -> None:
    find = TYPES.service if row["kind"] == "srv" else TYPES.message
    assert find(row["type"]).md5sum == row["md5sum"]


@pytest.mark.parametrize(
    ("name", "md5sum"),
    [
        ("geometry_msgs/Twist", "9f195f881246fdfa2798d1d3eebca84a"),
        ("actionlib_msgs/GoalStatus", "d388f9b87b3c471f784434d671988d4a"),
        ("control_msgs/FollowJointTrajectoryAction", "bc4f9b743838566551c0390c65f1a248"),
        ("control_msgs/JointTrajectoryControllerState", "10817c60c2486ef6b33e97dcd87f4474"),
        ("tf/tfMessage", "94810edda583a504dfda3829e70d7eec"),
        ("roscpp_tutorials/TwoIntsRequest", "36d09b846be0b371c5f190354dd3153e"),
    ],
)
def test_md5_of_others(name: str, md5sum: str) -> None:
    assert TYPES.message(name).md5sum == md5sum


@pytest.mark.parametrize(
    ("name", "md5sum"),
    [
        ("roscpp_tutorials/TwoInts", "6a2e34150c00229791cc89ff309fff21"),
        ("rospy_tutorials/AddTwoInts", "6a2e34150c00229791cc89ff309fff21"),
        ("std_srvs/Trigger", "937c9679a518e3a18d831e57125ea522"),
    ],
)
def test_md5_of_services(name: str, md5sum: str) -> None:
    assert TYPES.service(name).md5sum == md5sum


def common_types(suffix: str) -> list[str]:
    return sorted(f"{file.parts[-3]}/{file.stem}" for file in SHARE.glob(f"*/{suffix}/*.{suffix}"))


def test_every_common_type_compiles_and_comes_back() -> None:
    """Default messages of all types are encoded and decoded, services and actions included."""
    types: list[MessageType] = [TYPES.message(name) for name in common_types("msg")]
    services = [TYPES.service(name) for name in common_types("srv")]
    types += [half for service in services for half in (service.request, service.response)]
    types += [TYPES.message(name + "Action") for name in common_types("action")]
    for message_type in types:
        message = message_type.new()
        assert message_type.decode(message_type.encode(message)) == message


def test_new_with_values() -> None:
    string = TYPES.message("std_msgs/String")
    assert bytes(string.encode(string.new(data="hello"))) == b"\x05\0\0\0hello"
    with pytest.raises(TypeError, match="text"):
        string.new(text="hello")


def test_names_with_folder() -> None:
    assert TYPES.message("std_msgs/msg/String") is TYPES.message("std_msgs/String")
    assert TYPES.service("std_srvs/srv/Empty") is TYPES.service("std_srvs/Empty")


def test_constants() -> None:
    constants = TYPES.message("sensor_msgs/NavSatStatus").constants
    assert constants["STATUS_NO_FIX"] == -1
    assert constants["SERVICE_GALILEO"] == 8


SEPARATOR = "=" * 80


def test_full_text_has_each_dependency_once_depth_first() -> None:
    types = MessageTypes()
    types.define("p/Leaf", "int32 x # leaf\n")
    types.define("p/Node", "Leaf leaf")
    types.define("p/Tree", "Node node\nHeader header\nLeaf[2] leaves\nNode other\n")
    assert types.message("p/Tree").full_text == (
        "Node node\nHeader header\nLeaf[2] leaves\nNode other\n\n"
        f"{SEPARATOR}\nMSG: p/Node\nLeaf leaf\n"
        f"{SEPARATOR}\nMSG: p/Leaf\nint32 x # leaf\n\n"
        f"{SEPARATOR}\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
    )


@pytest.mark.parametrize("name", ["sensor_msgs/Imu", "std_msgs/Empty", "nav_msgs/GetMapAction"])
def test_full_text_defines_the_type_anew(name: str) -> None:
    message_type = TYPES.message(name)
    again = MessageTypes().define(name, message_type.full_text)
    assert again.md5sum == message_type.md5sum
    assert again.full_text == message_type.full_text


def test_service_full_text() -> None:
    text = TYPES.service("nav_msgs/SetMap").full_text
    assert text.startswith("nav_msgs/OccupancyGrid map\ngeometry_msgs/PoseWithCovarianceStamped")
    assert "\n---\nbool success\n" in text
    assert text.count("MSG: geometry_msgs/Pose\n") == 1


def test_header_array() -> None:
    types = MessageTypes()
    own = types.define("own/Header", "int32 x")
    assert (
        types.define("p/Type", "Header[] h").md5sum
        == types.define("q/Type", "std_msgs/Header[2] h").md5sum
    )
    assert types.define("own/Type", "Header[] h").definition.fields[0].base == own.name


def test_define_before_folders() -> None:
    types = MessageTypes()
    types.define("std_msgs/String", "int32 data")
    assert types.message("std_msgs/String").fields[0].base == "int32"


def test_define_twice() -> None:
    types = MessageTypes()
    types.define("p/Type", "int32 x\nint32 A=1")
    assert types.define("p/Type", "int32 x # as before\nint32 A=1").fields[0].name == "x"
    for other in ("int32 y\nint32 A=1", "int32 x\nint32 A=2"):
        with pytest.raises(MessageTypeError, match="p/Type is known already"):
            types.define("p/Type", other)


def test_user_packages_come_first(tmp_path: Path) -> None:
    (tmp_path / "std_msgs").mkdir()
    (tmp_path / "std_msgs" / "String.msg").write_text("int32 other", encoding="utf-8")
    assert MessageTypes([tmp_path]).message("std_msgs/String").fields[0].name == "other"


def test_unknown() -> None:
    with pytest.raises(UnknownTypeError, match=r"^No message type std_msgs/None\.$"):
        TYPES.message("std_msgs/None")
    with pytest.raises(UnknownTypeError, match="No service type std_msgs/String"):
        TYPES.service("std_msgs/String")
    with pytest.raises(UnknownTypeError, match=r"p/Type\.x: No message type none/Name\."):
        MessageTypes().define("p/Type", "none/Name x")
    for name in ("std_srvs/Request", "std_srvs/NoneRequest", "nav_msgs/Goal"):
        with pytest.raises(UnknownTypeError):
            TYPES.message(name)


def test_type_that_contains_itself() -> None:
    types = MessageTypes()
    types._defined["p/B"] = "A[] a"
    with pytest.raises(DefinitionError, match="p/A contains itself"):
        types.define("p/A", "B b")


def test_many_paths_to_one_type_are_walked_once() -> None:
    """Two fields on each of forty levels are a million million paths."""
    types = MessageTypes()
    types.define("p/L0", "int32 x")
    for level in range(1, 41):
        types.define(f"p/L{level}", f"L{level - 1} a\nL{level - 1} b")
    assert types.message("p/L40").full_text.count("MSG: ") == 40
