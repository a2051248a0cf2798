"""Literals of IEC 61131-3: the text of a token to a typed value, and a value to text.

TIME and TIME_OF_DAY are whole milliseconds, DATE and DATE_AND_TIME seconds since 1970-01-01, as the
controller stores them; finer parts of a time are cut off, as the controller cuts them.
"""

from __future__ import annotations

import math
import re
from calendar import timegm
from datetime import date
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

from st_types.errors import ValueRangeError
from st_types.types.elementary import ALL_ELEMENTARY, CHARACTERS, TIME

MAX_DIGITS = 400
"""Longest number that is read; the largest LREAL has 309 digits before its point."""


class Constant(NamedTuple):
    """A typed value.

    Attributes:
        type_name: ``INT``, ``TIME``, ``STRING``, ...; ``ANY_INT`` and ``ANY_REAL`` for numbers
            without a type of their own.
        value: int, float, bool or str.
    """

    type_name: str
    value: int | float | bool | str


class LiteralError(ValueError):
    """The text is not a literal; the message says why."""


_SHORT_NAMES = {
    "T": "TIME",
    "D": "DATE",
    "DT": "DATE_AND_TIME",
    "TOD": "TIME_OF_DAY",
    "LT": "LTIME",
    "LD": "LDATE",
    "LDT": "LDATE_AND_TIME",
    "LTOD": "LTIME_OF_DAY",
}
_REALS = ("REAL", "LREAL")
_STRINGS = ("STRING", "WSTRING")
TYPED_PREFIXES = frozenset([*ALL_ELEMENTARY, "T", "D", "LT", "LD", *_STRINGS])
"""What may stand before ``#`` in a literal, in capitals; anything else names an enumeration."""

_BOOLS = {"TRUE": True, "FALSE": False, "1": True, "0": False}


@lru_cache(maxsize=4096)
def parse_literal(text: str) -> Constant:
    """Return the value of the literal ``text``.

    Raises:
        LiteralError: it is malformed.
    """
    if text[0] in "'\"":
        return Constant("STRING" if text[0] == "'" else "WSTRING", _string(text))
    prefix, mark, body = text.partition("#")
    if text.upper() in ("TRUE", "FALSE"):
        return Constant("BOOL", _BOOLS[text.upper()])
    if not mark or prefix.isdigit():
        return _number(text)
    return _typed(_SHORT_NAMES.get(prefix.upper(), prefix.upper()), body)


def _typed(type_name: str, body: str) -> Constant:
    if type_name in _PARSERS:
        return Constant(type_name, _PARSERS[type_name](body))
    if type_name in CHARACTERS and body[:1] in ("'", '"'):
        text = _string(body)
        if len(text) != 1:
            raise LiteralError(f"{body} is not one character")
        return Constant(type_name, ord(text))
    if type_name in _STRINGS and body[:1] in ("'", '"'):
        return Constant(type_name, _string(body))
    if type_name == "BOOL":
        if body.upper() not in _BOOLS:
            raise LiteralError(f"{body} is not a BOOL; TRUE or FALSE was expected")
        return Constant(type_name, _BOOLS[body.upper()])
    value = _number(body).value
    return Constant(type_name, float(value) if type_name in _REALS else value)


_NUMBER = re.compile(r"([+-]?)(?:(\d+)#)?(.*)", re.DOTALL)
_REAL = re.compile(r"(?:[\d_]+\.?[\d_]*|\.\d[\d_]*)(?:[eE][+-]?\d+)?")


def _number(text: str) -> Constant:
    match = _NUMBER.fullmatch(text)
    assert match is not None
    sign, base, digits = match.groups()
    if len(digits) > MAX_DIGITS:
        raise LiteralError(f"a number of {len(digits)} digits is too long")
    if base:
        value = _based(int(base) if len(base) < 3 else 0, base, digits)
        return Constant("ANY_INT", -value if sign == "-" else value)
    digits = digits.replace("_", "")
    if digits.isdecimal():
        return Constant("ANY_INT", int(sign + digits))
    if _REAL.fullmatch(digits) is None:
        raise LiteralError(f"{text} is not a number")
    real = float(sign + digits)
    if math.isinf(real):
        raise LiteralError(f"{text} is larger than any number")
    return Constant("ANY_REAL", real)


def _based(base: int, base_text: str, digits: str) -> int:
    if base not in (2, 8, 16):
        raise LiteralError(f"{base_text} is no base; 2, 8 or 16 was expected")
    try:
        return int(digits.replace("_", ""), base)
    except ValueError:
        raise LiteralError(f"{digits} is not a number of base {base}") from None


_ESCAPES = {
    "'": re.compile(r"\$([0-9A-Fa-f]{2}|.)", re.DOTALL),
    '"': re.compile(r"\$([0-9A-Fa-f]{4}|.)", re.DOTALL),
}
_ESCAPED = {"L": "\n", "N": "\n", "P": "\f", "R": "\r", "T": "\t"}


def _string(text: str) -> str:
    quote = text[0]
    if len(text) < 2 or text[-1] != quote:
        raise LiteralError(f"the string is not closed; {quote} was expected before the line ends")
    body = text[1:-1]
    return _ESCAPES[quote].sub(_unescape, body) if "$" in body else body


def _unescape(match: re.Match[str]) -> str:
    code: str = match.group(1)
    if len(code) > 1:
        return chr(int(code, 16))
    return _ESCAPED.get(code.upper(), code)


def string_literal(value: str, *, wide: bool = False) -> str:
    """Return ``value`` as a literal, with ``$`` escapes where they are needed."""
    quote = '"' if wide else "'"
    return quote + "".join(_escape(c, quote) for c in value) + quote


def _escape(character: str, quote: str) -> str:
    if character in ("$", quote):
        return "$" + character
    if character.isprintable() or ord(character) > (0xFF if quote == "'" else 0xFFFF):
        return character
    return f"${ord(character):02X}" if quote == "'" else f"${ord(character):04X}"


_NS_PER_MS = 1_000_000
_NS_PER_S = 1_000_000_000
_MS_BY_UNIT = {
    "d": Fraction(86_400_000),
    "h": Fraction(3_600_000),
    "m": Fraction(60_000),
    "s": Fraction(1000),
    "ms": Fraction(1),
    "us": Fraction(1, 1000),
    "ns": Fraction(1, 1_000_000),
}
_PART = re.compile(r"(\d+(?:\.\d+)?)(d|h|ms|m|s|us|ns)", re.IGNORECASE)
_DURATION = re.compile(rf"([+-]?)((?:{_PART.pattern})+|0+)", re.IGNORECASE)


def _duration_ms(body: str) -> int:
    return _duration(body, 1)


def _duration_ns(body: str) -> int:
    return _duration(body, _NS_PER_MS)


def _duration(body: str, units_per_ms: int) -> int:
    match = _DURATION.fullmatch(body.replace("_", ""))
    if match is None or len(body) > MAX_DIGITS:
        raise LiteralError(
            f"T#{body[:40]} is no duration; one such as T#1h30m or T#1.5s was expected"
        )
    parts = _PART.findall(match.group(2))
    ms = sum(Fraction(number) * _MS_BY_UNIT[unit.lower()] for number, unit in parts)
    total = int(ms * units_per_ms)
    return -total if match.group(1) == "-" else total


@lru_cache(maxsize=4096)
def T(text: str) -> int:  # noqa: N802  # as the literal begins
    """Return the milliseconds of a TIME literal, ``T("3s")`` or ``T("1h30m")``.

    Args:
        text: what stands behind ``T#`` in Structured Text; ``T#`` may stand before it.

    Raises:
        ValueRangeError: it is no duration, or none that a TIME can hold.
    """
    if not isinstance(text, str):
        raise ValueRangeError(f'T({text!r}): a text with a unit was expected, such as T("3s").')
    try:
        value = _duration_ms(re.sub(r"^(T|TIME)#", "", text.strip(), flags=re.IGNORECASE))
    except LiteralError:
        raise ValueRangeError(
            f'T({text[:MAX_DIGITS]!r}): a duration was expected, such as T("3s") or T("1h30m").'
        ) from None
    if not TIME.minimum <= value <= TIME.maximum:
        raise ValueRangeError(f"T({text!r}): a TIME holds 24 days 20 h 31 min at most.")
    return value


_DATE = re.compile(r"(\d{4})-(\d{1,2})-(\d{1,2})")
_CLOCK = re.compile(r"(\d{1,2}):(\d{1,2})(?::(\d{1,2})(\.\d{1,9})?)?")


def _date_s(body: str) -> int:
    match = _DATE.fullmatch(body)
    if match is None:
        raise LiteralError(f"{body[:40]} is no date; one such as 2024-12-31 was expected")
    try:
        day = date(*map(int, match.groups()))
    except ValueError as err:
        raise LiteralError(f"{body} is no date: {err}") from None
    return timegm(day.timetuple())


def _time_of_day_ms(body: str) -> int:
    return _time_of_day_ns(body) // _NS_PER_MS


def _time_of_day_ns(body: str) -> int:
    match = _CLOCK.fullmatch(body)
    if match is None:
        raise LiteralError(f"{body[:40]} is no time of day; one such as 23:59:59 was expected")
    hour, minute, second = (int(part or 0) for part in match.groups()[:3])
    if hour > 23 or minute > 59 or second > 59:
        raise LiteralError(f"{body} is no time of day; the last is 23:59:59.999")
    seconds = (hour * 60 + minute) * 60 + second
    return seconds * _NS_PER_S + int(Fraction("0" + (match.group(4) or ".0")) * _NS_PER_S)


def _date_ns(body: str) -> int:
    return _date_s(body) * _NS_PER_S


def _date_and_time_s(body: str) -> int:
    return _date_and_time_ns(body) // _NS_PER_S


def _date_and_time_ns(body: str) -> int:
    day, _, clock = body.rpartition("-") if body.count("-") == 3 else (body, "", "")
    return _date_ns(day) + (_time_of_day_ns(clock) if clock else 0)


_PARSERS = {
    "TIME": _duration_ms,
    "DATE": _date_s,
    "TIME_OF_DAY": _time_of_day_ms,
    "DATE_AND_TIME": _date_and_time_s,
    "LTIME": _duration_ns,
    "LDATE": _date_ns,
    "LTIME_OF_DAY": _time_of_day_ns,
    "LDATE_AND_TIME": _date_and_time_ns,
}
