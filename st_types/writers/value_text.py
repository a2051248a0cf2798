"""Values as they are written in Structured Text: T#1s500ms, Mode#AUTO as AUTO, (x := 1, y := 2).

What `st_types.resolve` reads as an initial value of a type, this writes.
"""

from __future__ import annotations

import math
import struct
from datetime import UTC, datetime
from itertools import groupby
from typing import TYPE_CHECKING, Any

from st_types.syntax.literals import string_literal
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    StringType,
    StructType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import (
    CHARACTER_TYPES,
    DATE,
    DATE_AND_TIME,
    LDATE,
    LDATE_AND_TIME,
    LONG_TIMES,
    LTIME,
    LTIME_OF_DAY,
    TIME,
    TIME_OF_DAY,
    WCHAR,
)

if TYPE_CHECKING:
    from st_types.types.elementary import DataType

_UNITS_MS = (("d", 86_400_000), ("h", 3_600_000), ("m", 60_000), ("s", 1000), ("ms", 1))


def value_text(data_type: DataType[Any], value: Any) -> str:
    """Return a plain value (see `st_types.types.values.decode`) as text.

    Args:
        data_type: of the value.
        value: of that type; a number of an enumeration that has no name stays a number.
    """
    data_type = resolve_alias(data_type)
    match data_type:
        case StructType(members=members):
            parts = (f"{m.name} := {value_text(m.data_type, value[m.name])}" for m in members)
            return f"({', '.join(parts)})"
        case ArrayType(element=element):
            return f"[{', '.join(_elements(element, value))}]"
        case EnumerationType(values=values):
            return next((name for name, number in values.items() if number == value), str(value))
        case StringType():
            return string_literal(value)
        case WStringType():
            return string_literal(value, wide=True)
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, float):
        return _real_text(value, data_type.size)
    if data_type in CHARACTER_TYPES and value:
        return string_literal(chr(value), wide=data_type is WCHAR)
    return _time_text(data_type, value) if data_type in _TIMES else str(value)


def _elements(element: DataType[Any], value: Any) -> list[str]:
    """Return the elements of an ARRAY, those that repeat as ``count(value)``."""
    texts = (value_text(element, each) for each in value)
    counted = ((text, len(list(group))) for text, group in groupby(texts))
    return [text if count == 1 else f"{count}({text})" for text, count in counted]


def _real_text(value: float, size: int) -> str:
    """Return the shortest text that gives the same value back."""
    if not math.isfinite(value):
        return str(value)
    text = repr(value)
    if size == 4:
        data = struct.pack("<f", value)
        texts = (f"{value:.{digits}g}" for digits in range(6, 9))
        text = next((t for t in texts if struct.pack("<f", float(t)) == data), f"{value:.9g}")
    return text if "." in text or "e" in text else f"{text}.0"


_TIMES = (TIME, DATE, TIME_OF_DAY, DATE_AND_TIME, *LONG_TIMES.values())


def _time_text(data_type: DataType[Any], value: int) -> str:
    if data_type.size > TIME.size:
        return _long_time_text(data_type, value)
    if data_type is TIME:
        return duration_text(value)
    if data_type is TIME_OF_DAY:
        seconds, ms = divmod(value, 1000)
        clock = f"{seconds // 3600:02}:{seconds // 60 % 60:02}:{seconds % 60:02}"
        return f"TOD#{clock}.{ms:03}" if ms else f"TOD#{clock}"
    moment = datetime.fromtimestamp(value, UTC)
    if data_type is DATE:
        return f"D#{moment:%Y-%m-%d}"
    return f"DT#{moment:%Y-%m-%d-%H:%M:%S}"


_SHORTENED: dict[DataType[Any], DataType[Any]] = {
    LTIME_OF_DAY: TIME_OF_DAY,
    LDATE: DATE,
    LDATE_AND_TIME: DATE_AND_TIME,
}


def _long_time_text(data_type: DataType[Any], value: int) -> str:
    """Return the text of a count of nanoseconds: that of the short type, and what is below."""
    if data_type is LTIME:
        ms, rest = divmod(abs(value), 1_000_000)
        us, ns = divmod(rest, 1000)
        below = (f"{us}us" if us else "") + (f"{ns}ns" if ns else "")
        text = duration_text(ms)[2:] if ms or not below else ""
        return f"LTIME#{'-' if value < 0 else ''}{text}{below}"
    seconds, rest = divmod(value, 1_000_000_000)
    short = _SHORTENED[data_type]
    unit = 1000 if short is TIME_OF_DAY else 1
    text = _time_text(short, seconds * unit)
    fraction = f".{rest:09}".rstrip("0") if rest and short is not DATE else ""
    return f"L{text}{fraction}"


def duration_text(milliseconds: int) -> str:
    """Return a TIME as text, such as T#1s500ms."""
    rest = abs(milliseconds)
    text = ""
    for unit, size in _UNITS_MS:
        count, rest = divmod(rest, size)
        if count:
            text += f"{count}{unit}"
    return f"T#{'-' if milliseconds < 0 else ''}{text or '0ms'}"
