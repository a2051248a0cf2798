"""Values as text of Structured Text."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types import (
    ARRAY,
    BOOL,
    CHAR,
    DATE,
    DATE_AND_TIME,
    DINT,
    LDATE,
    LDATE_AND_TIME,
    LREAL,
    LTIME,
    LTIME_OF_DAY,
    REAL,
    STRING,
    TIME,
    TIME_OF_DAY,
    UINT,
    WCHAR,
    WSTRING,
)
from st_types.syntax.literals import parse_literal
from st_types.types.derived import AliasType, EnumerationType, Member, StructType, SubrangeType
from st_types.types.values import decode, encode
from st_types.writers.value_text import duration_text, value_text

MODE = EnumerationType("Mode", {"OFF": 0, "AUTO": 2})
POINT = StructType(
    "Point", [Member("x", REAL), Member("mode", MODE), Member("many", ARRAY(UINT, (0, 4)))]
)


@pytest.mark.parametrize(
    ("data_type", "value", "text"),
    [
        (BOOL, True, "TRUE"),
        (BOOL, False, "FALSE"),
        (DINT, -7, "-7"),
        (SubrangeType("Percent", DINT, 0, 100), 7, "7"),
        (REAL, decode(REAL, encode(REAL, 0.1)), "0.1"),
        (REAL, 3.0, "3.0"),
        (LREAL, 0.1, "0.1"),
        (LREAL, 1e300, "1e+300"),
        (LREAL, math.inf, "inf"),
        (TIME, 1500, "T#1s500ms"),
        (TIME, -61_000, "T#-1m1s"),
        (TIME, 0, "T#0ms"),
        (TIME, 90_061_001, "T#1d1h1m1s1ms"),
        (DATE, 1_704_067_200, "D#2024-01-01"),
        (DATE_AND_TIME, 1_704_067_199, "DT#2023-12-31-23:59:59"),
        (TIME_OF_DAY, 3_723_004, "TOD#01:02:03.004"),
        (TIME_OF_DAY, 3_723_000, "TOD#01:02:03"),
        (CHAR, ord("x"), "'x'"),
        (CHAR, 0, "0"),
        (WCHAR, 0x20AC, '"\u20ac"'),
        (LTIME, 93_784_005_006_007, "LTIME#1d2h3m4s5ms6us7ns"),
        (LTIME, -1, "LTIME#-1ns"),
        (LTIME, 0, "LTIME#0ms"),
        (LDATE, 1_582_934_400_000_000_000, "LD#2020-02-29"),
        (LTIME_OF_DAY, 45_015_123_456_789, "LTOD#12:30:15.123456789"),
        (LDATE_AND_TIME, 1_582_979_415_500_000_000, "LDT#2020-02-29-12:30:15.5"),
        (MODE, 2, "AUTO"),
        (MODE, 7, "7"),
        (AliasType("Alias", MODE), 0, "OFF"),
        (STRING(9), "it's $5", "'it$'s $$5'"),
        (WSTRING(9), "ä\n", '"ä$000A"'),
        (ARRAY(UINT, (0, 5)), [1, 2, 2, 2, 3, 3], "[1, 3(2), 2(3)]"),
        (POINT, {"x": 0.5, "mode": 2, "many": [0] * 5}, "(x := 0.5, mode := AUTO, many := [5(0)])"),
    ],
)
def test_values_are_written_as_in_structured_text(data_type, value, text):
    assert value_text(data_type, value) == text


@given(st.integers(-(2**31), 2**31 - 1))
def test_a_duration_is_read_as_it_was_written(ms):
    assert parse_literal(duration_text(ms)).value == ms


@given(st.floats(width=32, allow_nan=False, allow_infinity=False))
def test_a_real_is_read_as_it_was_written(value):
    text = value_text(REAL, value)
    assert encode(REAL, float(text)) == encode(REAL, value)
    assert len(text) <= len(repr(value)) + 2
