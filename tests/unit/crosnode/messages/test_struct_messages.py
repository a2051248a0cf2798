import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import DefinitionError
from crosnode.messages import MessageTypes
from crosnode.messages.definition import parse_message
from crosnode.messages.struct_declarations import (
    PRIMITIVES,
    TIMES,
    print_constants,
    print_types,
    struct_declarations,
)
from crosnode.messages.struct_messages import message_name, messages_from_struct
from st_types.syntax.declarations import parse_text
from st_types.types.derived import StructType

from ...st_types.checked import checked


def struct(text: str, name: str) -> StructType[object]:
    found = checked([parse_text(text)], strict=True).find_type(name)
    assert isinstance(found, StructType)
    return found


def test_every_form() -> None:
    data_type = struct(
        "TYPE Robot : STRUCT on : BOOL; a : BYTE; b : WORD; c : DWORD; d : LWORD; e : REAL; low : "
        "USINT(1..9); mode : Mode; name : Text; pose : geometry_msgs_Point; times : ARRAY[0..1] OF "
        "ros_time; values : ARRAY[1..5] OF INT; values_length : UDINT; fixed : ARRAY[-1..1] OF "
        "SINT; fixed_length : UINT; END_STRUCT; Mode : (off, auto := 5); Text : STRING[9]; "
        "geometry_msgs_Point : STRUCT x : LREAL; END_STRUCT; "
        "ros_time : STRUCT sec : UDINT; nsec : UDINT; END_STRUCT; END_TYPE",
        "Robot",
    )
    assert messages_from_struct(data_type, "cell") == {
        "geometry_msgs/Point": "float64 x\n",
        "cell/Robot": (
            "bool on\nuint8 a\nuint16 b\nuint32 c\nuint64 d\nfloat32 e\nuint8 low\nint32 off=0\n"
            "int32 auto=5\nint32 mode\nstring name\ngeometry_msgs/Point pose\ntime[2] times\n"
            "int16[] values\nint8[3] fixed\nuint16 fixed_length\n"
        ),
    }


@pytest.mark.parametrize(
    ("declared", "message"),
    [
        ("TIME", "S.x: TIME has no ROS form"),
        ("WSTRING[3]", r"S.x: WSTRING\[3\] has no ROS form"),
        ("REFERENCE TO INT", "S.x: REFERENCE TO INT has no ROS form"),
        ("ARRAY[0..1, 0..1] OF INT", "S.x: an ARRAY of several dimensions has no ROS form"),
        ("ARRAY[0..1] OF ARRAY[0..1] OF INT", "S.x: .* has no ROS form"),
        ("STRUCT d : DT; END_STRUCT", "S_x.d: DATE_AND_TIME has no ROS form"),
        ("Block", "Block: a function block has no ROS form"),
        ("INT; _y : INT", "S._y: a ROS field cannot have this name"),
    ],
)
def test_what_has_no_ros_form(declared: str, message: str) -> None:
    text = f"TYPE S : STRUCT x : {declared}; END_STRUCT; END_TYPE FUNCTION_BLOCK Block "
    data_type = struct(text + "VAR x : INT; END_VAR END_FUNCTION_BLOCK", "S")
    with pytest.raises(DefinitionError, match=message):
        messages_from_struct(data_type)


def test_names_of_messages() -> None:
    text = "TYPE sensor_msgs_Imu, S : STRUCT END_STRUCT; END_TYPE"
    assert message_name(struct(text, "sensor_msgs_Imu")) == "sensor_msgs/Imu"
    assert message_name(struct(text, "S")) == "plc/S"


bases = st.sampled_from([*PRIMITIVES, *TIMES, "string", "p/Inner"]).filter(
    lambda base: base not in ("byte", "char")  # they come back as int8 and uint8
)
suffixes = st.sampled_from(["", "[]", "[3]"])


@given(st.lists(st.tuples(bases, suffixes), max_size=8))
def test_there_and_back(fields: list[tuple[str, str]]) -> None:
    text = "".join(f"{base}{suffix} f{i}\n" for i, (base, suffix) in enumerate(fields))
    types = MessageTypes()
    types.define("p/Inner", "float32[] x\nstring s\n")
    types.define("p/Outer", text)
    made = struct_declarations(types, ["p/Outer"])
    data_type = struct(print_types(made) + print_constants(made), "p_Outer")
    back = messages_from_struct(data_type)
    again, before = (parse_message("p/Outer", each) for each in (back["p/Outer"], text))
    assert again.fields == before.fields
    assert set(back) == {"p/Outer"} | {"p/Inner" for base, _ in fields if base == "p/Inner"}
