import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types.errors import DeclarationError
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text
from st_types.syntax.printer import print_item
from st_types.types.derived import StructType, resolve_alias
from st_types.types.elementary import ELEMENTARY
from st_types.types.values import encode
from st_types.writers.ros import PRIMITIVES, Limits, structs_from_ros

from ..checked import checked

DEFINITIONS = {
    ("sensor_msgs/JointState", "msg"): (
        "# state of joints\nHeader header\n\nstring[] name\nfloat64[] position # rad (*or m*)\n"
        "float64[] velocity\r\nfloat64[] effort\n"
    ),
    ("std_msgs/Header", "msg"): "uint32 seq\ntime stamp\nstring frame_id # no slash\n",
    ("x/All", "msg"): (
        "".join(f"{name} f{number}\n" for number, name in enumerate(PRIMITIVES))
        + "uint8[16] raw\nduration d\nPoint[2] p\nstring S = text # not a comment\n"
        "float32 RATE=-1.5e-3\nint8 LOW = -5 # lowest\nbool YES=True\nuint8 A=1\n"
    ),
    ("x/Point", "msg"): "float32 x\nfloat32 X\nfloat32[] x_length\n",
    ("x/Add", "srv"): "int64 a\nint64 b\n---\nint64 sum\n",
    ("x/Trigger", "srv"): "---\nbool success\nstring message",
    ("x/Loop", "msg"): "Other o\n",
    ("x/Other", "msg"): "Loop[] loops\n",
    ("x/Broken", "msg"): "int32 a\nint32 b c\n",
    ("x/Endless", "msg"): f"int32[{'9' * 5000}] a\n",
    ("x/Missing", "msg"): "y/Nothing n\n",
}


def read(name: str, kind: str) -> str | None:
    return DEFINITIONS.get((name, kind))


def text_of(name: str, limits: Limits | None = None) -> str:
    found = structs_from_ros(name, read, limits)
    return print_item(found.types) + print_item(found.constants)


def table_of(name: str, limits: Limits | None = None) -> Scope:
    file = parse_text(text_of(name, limits))
    table = checked([file], strict=True)
    file.diagnostics.raise_errors()
    return table


def test_joint_state() -> None:
    name = "STRING[sensor_msgs_JointState_name_LENGTH]"
    assert (
        text_of("sensor_msgs/JointState", Limits(array=6, string=20))
        == f"""\
TYPE
	ros_time : STRUCT
		sec : UDINT;
		nsec : UDINT;
	END_STRUCT;
	std_msgs_Header : STRUCT
		seq : UDINT;
		stamp : ros_time;
		frame_id : STRING[std_msgs_Header_frame_id_LENGTH]; (*no slash*)
	END_STRUCT;
	sensor_msgs_JointState : STRUCT
		header : std_msgs_Header;
		name : ARRAY[0..sensor_msgs_JointState_name_MAX] OF {name};
		name_length : UDINT; (*valid elements*)
		position : ARRAY[0..sensor_msgs_JointState_position_MAX] OF LREAL; (*rad (*or m* )*)
		position_length : UDINT; (*valid elements*)
		velocity : ARRAY[0..sensor_msgs_JointState_velocity_MAX] OF LREAL;
		velocity_length : UDINT; (*valid elements*)
		effort : ARRAY[0..sensor_msgs_JointState_effort_MAX] OF LREAL;
		effort_length : UDINT; (*valid elements*)
	END_STRUCT;
END_TYPE
VAR CONSTANT
	std_msgs_Header_frame_id_LENGTH : UDINT := 20; (*characters*)
	sensor_msgs_JointState_name_LENGTH : UDINT := 20; (*characters*)
	sensor_msgs_JointState_name_MAX : UDINT := 5; (*highest index*)
	sensor_msgs_JointState_position_MAX : UDINT := 5; (*highest index*)
	sensor_msgs_JointState_velocity_MAX : UDINT := 5; (*highest index*)
	sensor_msgs_JointState_effort_MAX : UDINT := 5; (*highest index*)
END_VAR
"""
    )


def test_the_bounds_lay_the_struct_out() -> None:
    small, large = (table_of("sensor_msgs/JointState", Limits(n, 20)) for n in (1, 6))
    first, second = (t.find_type("sensor_msgs_JointState") for t in (small, large))
    assert first is not None
    assert second is not None
    assert first.size == 36 + 24 + 4 + 3 * (1 * 8 + 4)
    assert second.size == 36 + 128 + 4 + 3 * (6 * 8 + 4)


def test_every_primitive_and_constants() -> None:
    table = table_of("x/All")
    found = table.find_type("x_All")
    assert isinstance(found, StructType)
    types = [str(resolve_alias(m.data_type)) for m in found.members]
    assert types[: len(PRIMITIVES)] == list(PRIMITIVES.values())
    assert types[len(PRIMITIVES) :] == [
        *["ARRAY[0..15] OF USINT", "ros_duration", "ARRAY[0..1] OF x_Point"],
    ]
    assert set(PRIMITIVES.values()) <= set(ELEMENTARY)
    values = {v.name: v.initial for v in table.variables if not v.name.endswith("_MAX")}
    assert values == {
        "x_All_S": "text # not a comment",
        "x_All_RATE": -1.5e-3,
        "x_All_LOW": -5,
        "x_All_YES": True,
        "x_All_A": 1,
    }


def test_names_that_differ_in_case_only() -> None:
    found = table_of("x/Point").find_type("x_Point")
    assert isinstance(found, StructType)
    assert [m.name for m in found.members] == ["x", "X_", "x_length", "x_length_length"]


@pytest.mark.parametrize(
    ("service", "names"),
    [
        ("x/Add", {"x_AddRequest": ["a", "b"], "x_AddResponse": ["sum"]}),
        ("x/Trigger", {"x_TriggerRequest": [], "x_TriggerResponse": ["success", "message"]}),
    ],
)
def test_services(service: str, names: dict[str, list[str]]) -> None:
    table = table_of(service)
    for name, expected in names.items():
        found = table.find_type(name)
        assert isinstance(found, StructType)
        assert [m.name for m in found.members] == expected


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("x/Loop", r"x/Loop contains itself: x/Loop -> x/Other -> x/Loop"),
        ("x/Broken", r"x/Broken, line 2: 'int32 b c' is no field and no constant"),
        ("x/Endless", r"x/Endless, line 1: 'int32\[9+\] a' is no field and no constant"),
        ("x/Missing", "x/Missing: no message is called y/Nothing"),
        ("x/Absent", "no message and no service is called x/Absent"),
        ("JointState", "'JointState' is no type name; pkg/Type was expected"),
    ],
)
def test_errors(name: str, message: str) -> None:
    with pytest.raises(DeclarationError, match=message):
        structs_from_ros(name, read)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("int8 A=x", "'x' is no value of int8"),
        ("float32 A=inf", "'inf' is no value of float32"),
        ("bool A=2", "'2' is no value of bool"),
        ("time A=2", "'2' is no value of time"),
        ("int8[0] a", "an ARRAY cannot have 0 elements"),
        ("int8[99999999999] a", "an ARRAY cannot have 99999999999 elements"),
    ],
)
def test_errors_in_a_line(text: str, message: str) -> None:
    with pytest.raises(DeclarationError, match=message):
        structs_from_ros("x/A", lambda name, kind: text if (name, kind) == ("x/A", "msg") else None)


def test_deep_nesting_is_an_error() -> None:
    def endless(name: str, kind: str) -> str | None:
        return f"{name}x field" if kind == "msg" else None

    with pytest.raises(DeclarationError, match="contains itself"):
        structs_from_ros("p/A", endless)


WORDS = [
    "int8",
    "uint8[]",
    "string",
    "string[3]",
    "p/A",
    "Header",
    "time",
    "x",
    "X",
    "=",
    "5",
    "#",
    "\n",
]


@given(st.lists(st.sampled_from(WORDS), max_size=20).map(" ".join) | st.text(max_size=40))
def test_any_text_is_converted_or_refused(text: str) -> None:
    def any_message(name: str, _kind: str) -> str | None:
        return {"p/B": text, "p/A": "int8 a", "std_msgs/Header": "time stamp"}.get(name)

    try:
        found = structs_from_ros("p/B", any_message)
    except DeclarationError:
        return
    table = checked(
        [parse_text(print_item(found.types) + print_item(found.constants))], strict=True
    )
    data_type = table.find_type("p_B")
    if data_type is not None:  # a constant may be out of the range of its type
        assert len(encode(data_type, None)) == data_type.size
