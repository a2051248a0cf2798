from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import CrosnodeError, DefinitionError, MessageTypeError
from crosnode.messages import MessageTypes
from crosnode.messages.struct_declarations import (
    PRIMITIVES,
    Bounds,
    StructDeclaration,
    print_constants,
    print_types,
    struct_declarations,
)
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text
from st_types.types.derived import StructType, resolve_alias
from st_types.types.elementary import ELEMENTARY
from st_types.types.values import encode

from ...st_types.checked import checked

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


@pytest.fixture
def types(tmp_path: Path) -> MessageTypes:
    for (name, kind), text in DEFINITIONS.items():
        file = tmp_path / f"{name}.{kind}"
        file.parent.mkdir(exist_ok=True)
        file.write_bytes(text.encode())
    return MessageTypes([tmp_path])


def printed(found: list[StructDeclaration]) -> str:
    return print_types(found) + print_constants(found)


def text_of(types: MessageTypes, name: str, bounds: Bounds | None = None) -> str:
    return printed(struct_declarations(types, [name], bounds))


def scope_of(types: MessageTypes, name: str, bounds: Bounds | None = None) -> Scope:
    file = parse_text(text_of(types, name, bounds))
    scope = checked([file], strict=True)
    file.diagnostics.raise_errors()
    return scope


def test_joint_state(types: MessageTypes) -> None:
    name = "STRING[sensor_msgs_JointState_name_LENGTH]"
    assert (
        text_of(types, "sensor_msgs/JointState", Bounds(array=6, string=20))
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


def test_the_bounds_lay_the_struct_out(types: MessageTypes) -> None:
    small, large = (scope_of(types, "sensor_msgs/JointState", Bounds(n, 20)) for n in (1, 6))
    first, second = (t.find_type("sensor_msgs_JointState") for t in (small, large))
    assert first is not None
    assert second is not None
    assert first.size == 36 + 24 + 4 + 3 * (1 * 8 + 4)
    assert second.size == 36 + 128 + 4 + 3 * (6 * 8 + 4)


def test_every_primitive_and_constants(types: MessageTypes) -> None:
    table = scope_of(types, "x/All")
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


def test_names_that_differ_in_case_only(types: MessageTypes) -> None:
    found = scope_of(types, "x/Point").find_type("x_Point")
    assert isinstance(found, StructType)
    assert [m.name for m in found.members] == ["x", "X_", "x_length", "x_length_length"]


@pytest.mark.parametrize(
    ("service", "names"),
    [
        ("x/Add", {"x_AddRequest": ["a", "b"], "x_AddResponse": ["sum"]}),
        ("x/Trigger", {"x_TriggerRequest": [], "x_TriggerResponse": ["success", "message"]}),
    ],
)
def test_services(types: MessageTypes, service: str, names: dict[str, list[str]]) -> None:
    table = scope_of(types, service)
    for name, expected in names.items():
        found = table.find_type(name)
        assert isinstance(found, StructType)
        assert [m.name for m in found.members] == expected


def test_an_action_is_seven_messages(types: MessageTypes, tmp_path: Path) -> None:
    (tmp_path / "x" / "Move.action").write_text("float64 to\n---\nbool done\n---\nfloat64 at\n")
    scope = scope_of(types, "x/Move")
    suffixes = ("Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback")
    for suffix in (*suffixes, "Action"):
        assert isinstance(scope.find_type(f"x_Move{suffix}"), StructType)


def test_a_package_whose_folder_has_another_name(tmp_path: Path) -> None:
    folder = tmp_path / "src" / "driver_v2" / "msg"
    folder.mkdir(parents=True)
    (folder.parent / "package.xml").write_text("<package><name>driver</name></package>")
    (folder / "State.msg").write_text("int8 x\n")
    found = struct_declarations(MessageTypes([tmp_path]), ["driver/State"])
    assert [each.name for each in found] == ["driver_State"]


def test_messages_without_fields_and_arrays_of_them(tmp_path: Path) -> None:
    types = MessageTypes()
    types.define("x/Nothing", "# nothing\n")
    types.define("x/Holder", "Nothing one\nNothing[] many\nNothing[2] two\nint8 last\n")
    holder = scope_of(types, "x/Holder").find_type("x_Holder")
    assert isinstance(holder, StructType)
    assert [m.name for m in holder.members] == ["one", "many", "many_length", "two", "last"]


def test_what_several_types_need_is_declared_once(types: MessageTypes) -> None:
    found = struct_declarations(types, ["sensor_msgs/JointState", "std_msgs/Header", "x/Point"])
    names = ["ros_time", "std_msgs_Header", "sensor_msgs_JointState", "x_Point"]
    assert [each.name for each in found] == names
    assert found[1].typ().startswith("TYPE\n\tstd_msgs_Header : STRUCT")
    assert found[1].var() == (
        "VAR CONSTANT\n\tstd_msgs_Header_frame_id_LENGTH : UDINT := 80; (*characters*)\nEND_VAR\n"
    )
    assert found[0].var() == ""


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("x/Loop", "contains itself"),
        ("x/Broken", r"x/Broken, line 2: expected 'type name', got 'int32 b c'"),
        ("x/Endless", r"x/Endless, line 1: "),
        ("x/Missing", "x/Missing.n: No message type y/Nothing"),
        ("x/Absent", "No message, service or action type x/Absent"),
        ("JointState", "'JointState' is not a type name"),
    ],
)
def test_errors(types: MessageTypes, name: str, message: str) -> None:
    with pytest.raises(MessageTypeError, match=message):
        struct_declarations(types, [name])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("float32 A=inf", "x_A_A: inf is no value of a PLC"),
        ("int8[0] a", r"x_A.a: an ARRAY cannot have 0 elements"),
        ("int8 A[]=1", r"x_A: no constant of a PLC can be called 'A\[\]'"),
    ],
)
def test_what_has_no_form_in_a_plc(text: str, message: str) -> None:
    types = MessageTypes()
    types.define("x/A", text)
    with pytest.raises(DefinitionError, match=message):
        struct_declarations(types, ["x/A"])


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
    types = MessageTypes()
    types.define("p/A", "int8 a")
    try:
        types.define("p/B", text)
        found = struct_declarations(types, ["p/B"])
    except CrosnodeError:
        return
    data_type = checked([parse_text(printed(found))], strict=True).find_type("p_B")
    if data_type is not None:  # a constant may be out of the range of its type
        assert len(encode(data_type, None)) == data_type.size
