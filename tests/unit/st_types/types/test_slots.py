import ctypes
from enum import IntEnum

import pytest
from hypothesis import given

from st_types import ARRAY, BOOL, ENUM, INT, LREAL, STRING, UINT, WSTRING, DataType, ValueRangeError
from st_types.types.derived import (
    AliasType,
    ArrayType,
    EnumerationType,
    ReferenceType,
    StructType,
    SubrangeType,
    resolve_alias,
)
from st_types.types.slots import slot_of

from ..random_types import any_types


class Color(IntEnum):
    RED = 1
    GREEN = 5


@pytest.mark.parametrize(
    ("data_type", "c_type"),
    [
        (BOOL, ctypes.c_bool),
        (INT, ctypes.c_int16),
        (LREAL, ctypes.c_double),
        (SubrangeType("Part", UINT, 1, 2), ctypes.c_uint16),
        (ReferenceType(INT), ctypes.c_uint32),
        (EnumerationType("Mode", {"ON": 1}), ctypes.c_int32),
        (AliasType("Speed", AliasType("Inner", INT)), ctypes.c_int16),
    ],
    ids=str,
)
def test_what_c_converts_by_itself_has_no_conversion(data_type, c_type):
    assert slot_of(data_type) == (c_type, None, None)


@pytest.mark.parametrize(
    "data_type", [StructType("Empty", []), ARRAY(INT, (1, 2)), AliasType("A", ARRAY(INT, (1, 2)))]
)
def test_what_is_a_view_has_no_slot(data_type):
    assert slot_of(data_type) is None


def test_an_enumeration_reads_as_its_member_and_an_unknown_value_as_a_number():
    slot = slot_of(ENUM(Color))
    assert slot.load(5) is Color.GREEN
    assert slot.load(6) == 6
    assert (slot.store(Color.GREEN), slot.store(6)) == (5, 6)


@pytest.mark.parametrize("value", [2.7, "5", "GREEN", None])
def test_an_enumeration_takes_only_integers(value):
    with pytest.raises(TypeError):
        slot_of(ENUM(Color)).store(value)


def test_strings_convert_to_text_of_their_length():
    slot = slot_of(STRING(3))
    assert ctypes.sizeof(slot.ctype) == 4
    assert (slot.load(b"\xe9"), slot.store("abcd"), slot.store(b"a\0b")) == ("\xe9", b"abc", b"a")
    slot = slot_of(WSTRING(3))
    assert ctypes.sizeof(slot.ctype) == 8
    assert slot.load(slot.store("ab\u20acd")) == "ab\u20ac"


@pytest.mark.parametrize(
    ("data_type", "value", "message"),
    [
        (STRING(3), 5, "5 is not a STRING."),
        (STRING(3), None, "None is not a STRING."),
        (WSTRING(3), 5, "5 is not a WSTRING."),
        (WSTRING(3), b"a", "b'a' is not a WSTRING."),
    ],
)
def test_a_string_takes_only_text(data_type, value, message):
    with pytest.raises(ValueRangeError) as caught:
        slot_of(data_type).store(value)
    assert str(caught.value) == message


def test_a_type_without_values_is_refused():
    with pytest.raises(TypeError, match=r"VOID cannot be stored\."):
        slot_of(DataType("VOID", 0, 1))


@given(any_types)
def test_a_slot_is_as_large_as_its_type(data_type):
    slot = slot_of(data_type)
    if slot is None:
        assert isinstance(resolve_alias(data_type), ArrayType | StructType)
    else:
        assert ctypes.sizeof(slot.ctype) == data_type.size
