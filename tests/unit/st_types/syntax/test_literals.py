from datetime import UTC, datetime, timedelta

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types import T
from st_types.errors import ValueRangeError
from st_types.syntax.literals import Constant, LiteralError, parse_literal, string_literal


@pytest.mark.parametrize(
    ("text", "type_name", "value"),
    [
        ("0", "ANY_INT", 0),
        ("1_000", "ANY_INT", 1000),
        ("007", "ANY_INT", 7),
        ("16#ff", "ANY_INT", 255),
        ("2#1010_0001", "ANY_INT", 161),
        ("8#17", "ANY_INT", 15),
        ("1.5", "ANY_REAL", 1.5),
        ("1.", "ANY_REAL", 1.0),
        (".5E1", "ANY_REAL", 5.0),
        ("1E-3", "ANY_REAL", 0.001),
        ("TRUE", "BOOL", True),
        ("false", "BOOL", False),
        ("BOOL#1", "BOOL", True),
        ("INT#-5", "INT", -5),
        ("byte#16#FF", "BYTE", 255),
        ("SINT#-2#11", "SINT", -3),
        ("REAL#2", "REAL", 2.0),
        ("LREAL#1.5e3", "LREAL", 1500.0),
        ("CHAR#'$N'", "CHAR", 10),
        ('WCHAR#"\u20ac"', "WCHAR", 0x20AC),
        ("CHAR#65", "CHAR", 65),
        ("T#0", "TIME", 0),
        ("T#1d2h3m4s5ms", "TIME", 93_784_005),
        ("t#-1.5s", "TIME", -1500),
        ("TIME#1h_30m", "TIME", 5_400_000),
        ("T#1500us", "TIME", 1),
        ("D#1970-01-02", "DATE", 86_400),
        ("date#2024-2-29", "DATE", 1_709_164_800),
        ("TOD#00:00", "TIME_OF_DAY", 0),
        ("TIME_OF_DAY#23:59:59.999", "TIME_OF_DAY", 86_399_999),
        ("DT#1970-01-01-00:00:01", "DATE_AND_TIME", 1),
        ("DT#2038-01-19-03:14:07.9", "DATE_AND_TIME", 2**31 - 1),
        ("DATE_AND_TIME#2000-01-01", "DATE_AND_TIME", 946_684_800),
        ("''", "STRING", ""),
        ("'it$'s $$5'", "STRING", "it's $5"),
        ("'$r$n$T$41$e9'", "STRING", "\r\n\tA\xe9"),
        ("'$q'", "STRING", "q"),
        ("'say \"x\"'", "STRING", 'say "x"'),
        ('"$00e9$""', "WSTRING", 'é"'),
        ("STRING#'x'", "STRING", "x"),
    ],
)
def test_values(text: str, type_name: str, value: object) -> None:
    constant = parse_literal(text)
    assert constant == Constant(type_name, value)
    assert type(constant.value) is type(value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("2#12", "12 is not a number of base 2"),
        ("16#G", "G is not a number of base 16"),
        ("7#1", "7 is no base"),
        ("123456#1", "123456 is no base"),
        ("INT#TRUE", "TRUE is not a number"),
        ("BOOL#7", "7 is not a BOOL"),
        ("T#5x", "no duration"),
        ("CHAR#'ab'", "'ab' is not one character"),
        ('WCHAR#""', "is not one character"),
        ("T#", "no duration"),
        ("D#2023-02-29", "day is out of range|no date"),
        ("D#12", "no date"),
        ("TOD#24:00:00", "no time of day; the last is"),
        ("TOD#12", "no time of day"),
        ("DT#2000-01-01-12:61:00", "no time of day"),
        ("'open", "not closed"),
        ("'", "not closed"),
        ("1E400", "1E400 is larger than any number"),
        ("9" * 5000, "5000 digits is too long"),
        ("T#" + "1h" * 5000, "no duration"),
    ],
)
def test_malformed_literals(text: str, message: str) -> None:
    with pytest.raises(LiteralError, match=message):
        parse_literal(text)


@given(st.text(alphabet="0123456789abdehmnsTDOILNRF#._:-+'\"$ ", min_size=1, max_size=30))
def test_any_text_is_a_literal_or_a_literal_error(text: str) -> None:
    try:
        constant = parse_literal(text)
    except LiteralError:
        return
    assert isinstance(constant.value, bool | int | float | str)


@given(st.text(alphabet=st.characters(max_codepoint=255)))
def test_strings_round_trip(value: str) -> None:
    assert parse_literal(string_literal(value)).value == value


@given(st.text(alphabet=st.characters(max_codepoint=0xFFFF)))
def test_wide_strings_round_trip(value: str) -> None:
    constant = parse_literal(string_literal(value, wide=True))
    assert constant == Constant("WSTRING", value)


@given(st.integers(0, 2**31 - 1))
def test_durations_are_milliseconds(value: int) -> None:
    parts = timedelta(milliseconds=value)
    text = f"T#{parts.days}d{parts.seconds}s{parts.microseconds // 1000}ms"
    assert parse_literal(text).value == value


@given(st.integers(0, 2**32 - 1))
def test_dates_are_seconds_of_unix_time(seconds: int) -> None:
    moment = datetime.fromtimestamp(seconds, UTC)
    assert parse_literal(f"DT#{moment:%Y-%m-%d-%H:%M:%S}").value == seconds


@pytest.mark.parametrize(
    ("text", "milliseconds"),
    [("3s", 3000), ("T#1h30m", 5_400_000), ("time#1.5s", 1500), ("-20ms", -20), (" 0 ", 0)],
)
def test_a_time_for_python_programs(text, milliseconds):
    assert T(text) == milliseconds


@pytest.mark.parametrize(
    "text", ["", "3", "3 s", "x", "T#", "2.s", 3, None, "25d", "-25d", "9" * 500]
)
def test_what_is_no_time_is_told(text):
    with pytest.raises(ValueRangeError, match=r"^T\("):
        T(text)
