"""Values from text: what people type, and what value_text has written."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types import (
    ARRAY,
    BOOL,
    BYTE,
    DINT,
    INT,
    LREAL,
    REAL,
    STRING,
    TIME,
    UINT,
    WSTRING,
    ValueRangeError,
)
from st_types.resolve.value_text import value_from
from st_types.types.derived import AliasType, EnumerationType, Member, StructType, SubrangeType
from st_types.types.values import decode, encode
from st_types.writers.value_text import value_text

MODE = EnumerationType("Mode", {"OFF": 0, "AUTO": 2})
PERCENT = SubrangeType("Percent", INT, 0, 100)
POINT = StructType("Point", [Member("x", REAL), Member("mode", MODE)])
LINE = StructType("Line", [Member("a", POINT), Member("b", POINT)])


@pytest.mark.parametrize(
    ("data_type", "text", "value"),
    [
        (BOOL, "TRUE", True),
        (BOOL, "false", False),
        (BOOL, "1", True),
        (INT, " -7 ", -7),
        (INT, "2 * (3 + 4)", 14),
        (BYTE, "16#FF", 255),
        (UINT, "2#1010_0001", 161),
        (PERCENT, "100", 100),
        (REAL, "1", 1.0),
        (REAL, "-2.5e3", -2500.0),
        (LREAL, "0.1", 0.1),
        (TIME, "T#1s500ms", 1500),
        (TIME, "1m30s", 90_000),
        (TIME, "1500", 1500),
        (MODE, "AUTO", 2),
        (MODE, "Mode#AUTO", 2),
        (MODE, "Mode.OFF", 0),
        (MODE, "2", 2),
        (AliasType("Alias", MODE), "auto", 2),
        (STRING(9), "hello", "hello"),
        (STRING(9), "'it$'s'", "it's"),
        (STRING(9), "", ""),
        (WSTRING(9), '"ä"', "ä"),
        (ARRAY(UINT, (0, 5)), "[1, 3(2), 2(3)]", [1, 2, 2, 2, 3, 3]),
        (POINT, "(x := 0.5, mode := AUTO)", {"x": 0.5, "mode": 2}),
        (LINE, "(a := (x := 1, mode := 0), b := (x := 2, mode := AUTO))",
         {"a": {"x": 1.0, "mode": 0}, "b": {"x": 2.0, "mode": 2}}),
    ],
)  # fmt: skip
def test_text_is_taken_as_structured_text_means_it(data_type, text, value):
    assert value_from(data_type, text) == value


@pytest.mark.parametrize(
    ("data_type", "text", "why"),
    [
        (INT, "", "''"),
        (INT, "40000", "40000"),
        (UINT, "-1", "-1"),
        (INT, "1 2", "2 is too much"),
        (INT, "speed", "speed"),
        (INT, "1.5", "1.5"),
        (INT, "'text'", "text"),
        (INT, "1/0", "zero"),
        (BOOL, "2", "2"),
        (BOOL, "maybe", "maybe"),
        (PERCENT, "101", r"101 is outside 0\.\.100 of Percent"),
        (REAL, "1e400", "larger"),
        (TIME, "3 weeks", "3 weeks"),
        (MODE, "ON", "there are OFF, AUTO"),
        (STRING(3), "hello", "5 characters are too many"),
        (STRING(3), "'hello'", "holds 3"),
        (STRING(3), "'hel", "not closed"),
        (POINT, "(x := 0.5)", "the member mode of Point is missing"),
        (LINE, "(a := (x := 1), b := (x := 1, mode := 0))", "the member mode of Point is missing"),
        (POINT, "(x := 1, mode := 0, z := 3)", "z"),
        (POINT, "5", "not a value of Point"),
        (ARRAY(UINT, (0, 1)), "[1, 2, 3]", "too many"),
        (ARRAY(UINT, (0, 1)), "[1, 2", "expected"),
    ],
)
def test_what_is_no_value_of_the_type_says_why(data_type, text, why):
    with pytest.raises(ValueRangeError, match=why):
        value_from(data_type, text)


SOME = st.sampled_from([BOOL, INT, REAL, TIME, MODE, STRING(5), LINE, ARRAY(POINT, (0, 2))])


@given(st.text(max_size=40), SOME)
def test_any_text_is_a_value_or_an_error(text, data_type):
    try:
        value = value_from(data_type, text)
    except ValueRangeError:
        return
    encode(data_type, value)


def data_of(data_type):
    return st.binary(min_size=data_type.size, max_size=data_type.size)


types = st.sampled_from(
    [BOOL, INT, DINT, REAL, LREAL, TIME, MODE, LINE, ARRAY(INT, (0, 4)), ARRAY(REAL, (0, 2))]
)


@given(types.flatmap(lambda t: st.tuples(st.just(t), data_of(t))))
def test_what_was_written_is_read(pair):
    data_type, data = pair
    value = decode(data_type, data)
    text = value_text(data_type, value)
    if "nan" in text or "inf" in text:  # which no literal says
        return
    assert encode(data_type, value_from(data_type, text)) == encode(data_type, value)
