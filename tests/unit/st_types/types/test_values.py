import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types import (
    ARRAY,
    BOOL,
    BYTE,
    DATE_AND_TIME,
    DINT,
    INT,
    LREAL,
    LWORD,
    REAL,
    STRING,
    TIME,
    UINT,
    USINT,
    WSTRING,
    DataType,
    ValueRangeError,
)
from st_types.types.derived import (
    AliasType,
    EnumerationType,
    Member,
    ReferenceType,
    StructType,
    SubrangeType,
    resolve_alias,
)
from st_types.types.values import (
    decode,
    decode_wstring,
    encode,
    encode_string,
    encode_wstring,
    initial_image,
)

from ..random_types import any_types, typed_bytes, typed_values

MODE = EnumerationType("Mode", {"OFF": 3, "ON": 7})
LOW = SubrangeType("Low", USINT, 2, 9)
AXIS = StructType("Axis", [Member("on", BOOL, True), Member("speed", INT, -2)])
CELL = StructType("Cell", [Member("axes", ARRAY(AXIS, (1, 2))), Member("name", STRING(3), "a")])


@pytest.mark.parametrize(
    ("data_type", "value", "data"),
    [
        (BOOL, True, "01"),
        (BOOL, False, "00"),
        (INT, -2, "feff"),
        (UINT, 0x1234, "3412"),
        (LWORD, 1, "0100000000000000"),
        (TIME, -1, "ffffffff"),
        (DATE_AND_TIME, 2**32 - 1, "ffffffff"),
        (REAL, 1.5, "0000c03f"),
        (LREAL, -2.0, "00000000000000c0"),
        (REAL, -0.0, "00000080"),
        (STRING(4), "ab", "6162000000"),
        (STRING(2), "\xe9\xff", "e9ff00"),
        (WSTRING(2), "a\u20ac", "6100ac200000"),
        (MODE, 7, "07000000"),
        (LOW, 9, "09"),
        (ReferenceType(INT), 0x1000, "00100000"),
        (AliasType("Speed", INT, 5), 1, "0100"),
        (ARRAY(INT, (1, 2)), [1, 2], "01000200"),
        (ARRAY(INT, (1, 2)), [True, 2], "01000200"),
        (ARRAY(BOOL, (1, 3)), [True, 0, True], "010001"),
        (ARRAY(BOOL, (1, 3)), [True, False, True], "010001"),
        (ARRAY(REAL, (1, 2)), [1, -0.5], "0000803f000000bf"),
        (ARRAY(BYTE, (1, 2), (0, 1)), [1, 2, 3, 4], "01020304"),
        (AXIS, {"on": False, "speed": 1}, "00000100"),
    ],
    ids=str,
)
def test_bytes_of_a_value(data_type, value, data):
    assert encode(data_type, value).hex() == data
    assert decode(data_type, bytes.fromhex(data)) == value


@pytest.mark.parametrize(
    ("data_type", "initial"),
    [
        (BOOL, False),
        (DINT, 0),
        (REAL, 0.0),
        (STRING(5), ""),
        (WSTRING(5), ""),
        (MODE, 3),
        (LOW, 2),
        (SubrangeType("High", INT, -9, -2), -2),
        (SubrangeType("Both", INT, -9, 2), 0),
        (ReferenceType(INT), 0),
        (AliasType("Speed", INT, 5), 5),
        (AliasType("Outer", AliasType("Inner", INT, 5)), 5),
        (ARRAY(AliasType("Speed", INT, 5), (1, 2)), [5, 5]),
        (AXIS, {"on": True, "speed": -2}),
        (CELL, {"axes": [{"on": True, "speed": -2}] * 2, "name": "a"}),
    ],
    ids=str,
)
def test_initial_value(data_type, initial):
    assert decode(data_type, initial_image(data_type)) == initial


@pytest.mark.parametrize(
    ("data_type", "given_value", "stored"),
    [
        (BOOL, 1, True),
        (REAL, 2, 2.0),
        (STRING(3), "abcdef", "abc"),
        (STRING(3), b"ab\0c", "ab"),
        (WSTRING(2), "abc", "ab"),
        (WSTRING(2), "a\0c", "a"),
        (MODE, "ON", 7),
        (MODE, 99, 99),
        (ARRAY(INT, (1, 3)), [1], [1, 0, 0]),
        (ARRAY(INT, (1, 3)), range(3), [0, 1, 2]),
        (ARRAY(USINT, (0, 2)), b"ab", [97, 98, 0]),
        (ARRAY(AXIS, (1, 1)), [{"speed": 1}], [{"on": True, "speed": 1}]),
        (ARRAY(AXIS, (1, 1)), [], [{"on": True, "speed": -2}]),
        (AXIS, {"speed": 4}, {"on": True, "speed": 4}),
        (CELL, {"name": "x"}, {"axes": [{"on": True, "speed": -2}] * 2, "name": "x"}),
    ],
    ids=str,
)
def test_other_ways_to_give_a_value(data_type, given_value, stored):
    assert decode(data_type, encode(data_type, given_value)) == stored


@pytest.mark.parametrize(
    ("data_type", "value", "message"),
    [
        (BOOL, 2, "2 is not a BOOL."),
        (BOOL, "x", "'x' is not a BOOL."),
        (UINT, 65536, "65536 is outside 0..65535 of UINT."),
        (INT, -32769, "-32769 is outside -32768..32767 of INT."),
        (INT, 1.0, "1.0 is not a INT."),
        (LOW, 10, "10 is outside 2..9 of USINT."),
        (REAL, "1", "'1' is not a REAL."),
        (REAL, 1e39, "1e+39 is too large for a REAL."),
        (MODE, "IDLE", "IDLE is not a value of Mode."),
        (MODE, 2**31, "2147483648 is outside -2147483648..2147483647 of DINT."),
        (ReferenceType(INT), -1, "-1 is outside 0..4294967295 of UDINT."),
        (STRING(3), 5, "5 is not a STRING[3]."),
        (STRING(3), "\u20ac", "STRING cannot hold '\u20ac': one byte a character (Latin-1)."),
        (WSTRING(3), b"a", "b'a' is not a WSTRING[3]."),
        (ARRAY(INT, (1, 2)), [1, 2, 3], "3 values are too many for ARRAY[1..2] OF INT."),
        (ARRAY(INT, (1, 2)), "ab", "'ab' is not a list of values for ARRAY[1..2] OF INT."),
        (ARRAY(INT, (1, 2)), 5, "5 is not a list of values for ARRAY[1..2] OF INT."),
        (ARRAY(INT, (1, 2)), [0, 1.5], "[1]: 1.5 is not a INT."),
        (ARRAY(INT, (1, 2)), [0, 40_000], "[1]: 40000 is outside -32768..32767 of INT."),
        (ARRAY(BOOL, (1, 2)), [True, 2], "[1]: 2 is not a BOOL."),
        (ARRAY(REAL, (1, 2)), [0, 1e39], "[1]: 1e+39 is too large for a REAL."),
        (AXIS, [1], "[1] is not a mapping of members of Axis."),
        (AXIS, {"torque": 1}, "Axis has no member torque."),
        (CELL, {"axes": [{}, {"speed": 40000}]}, ".axes[1].speed: 40000 is outside -32768..32767"),
    ],
    ids=str,
)
def test_a_value_that_does_not_fit_says_where(data_type, value, message):
    with pytest.raises(ValueRangeError) as caught:
        encode(data_type, value)
    assert str(caught.value).startswith(message)


def test_a_type_without_values_is_refused():
    with pytest.raises(TypeError, match=r"VOID has no values\."):
        encode(DataType("VOID", 0, 1), None)
    with pytest.raises(TypeError, match=r"VOID has no values\."):
        decode(DataType("VOID", 0, 1), b"")


def test_nan_survives():
    assert math.isnan(decode(REAL, encode(REAL, math.nan)))


def test_any_byte_but_0_reads_as_true():
    assert decode(BOOL, b"\x80") is True


def test_a_string_without_terminator_ends_with_its_variable():
    assert decode(STRING(2), b"abc") == "abc"
    assert decode(WSTRING(1), "ab".encode("utf-16-le")) == "ab"


def test_gaps_of_a_struct_are_zero():
    assert encode(AXIS, {"on": True, "speed": -1}) == b"\1\0\xff\xff"


@given(typed_values(any_types))
def test_values_survive_bytes(typed):
    data_type, value = typed
    image = encode(data_type, value)
    assert len(image) == data_type.size
    assert decode(data_type, image) == value


@given(typed_bytes(any_types))
def test_any_bytes_decode_and_integers_give_the_same_bytes_again(typed):
    data_type, image = typed
    value = decode(data_type, image)
    if type(value) is int and not isinstance(resolve_alias(data_type), SubrangeType):
        assert encode(data_type, value) == image


@given(st.text(st.characters(max_codepoint=255)), st.integers(1, 20))
def test_a_string_is_cut_to_its_length_then_at_its_first_nul(text, length):
    expected = text[:length].split("\0")[0]
    assert encode_string(text, length) == expected.encode("latin-1")
    assert encode_string(text.encode("latin-1"), length) == expected.encode("latin-1")


@given(st.text(), st.integers(1, 20))
def test_a_wstring_is_cut_to_units_of_16_bits(text, length):
    data = encode_wstring(text, length)
    whole = text.split("\0")[0].encode("utf-16-le")
    assert data == whole[: 2 * length]
    assert decode_wstring(data + b"\0\0").encode("utf-16-le", "surrogatepass") == data


@given(st.lists(st.integers(0, 65535)))
def test_any_units_decode_to_a_wstring_up_to_the_first_0(units):
    end = units.index(0) if 0 in units else len(units)
    text = decode_wstring(struct.pack(f"<{len(units)}H", *units))
    assert text.encode("utf-16-le", "surrogatepass") == struct.pack(f"<{end}H", *units[:end])
