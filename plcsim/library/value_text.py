"""Plain values as text, and text as values: one notation for tables, files, diagrams."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.duration import parse_duration_ns
from st_types.types.derived import (
    EnumerationType,
    StringType,
    WStringType,
)
from st_types.types.elementary import TIME, ElementaryType, Kind

if TYPE_CHECKING:
    from st_types.types.elementary import DataType

_BOOLS: Final = {"TRUE": True, "FALSE": False, "1": True, "0": False}


def text_of(data_type: DataType[Any], value: object) -> str:
    """Return a plain value as text: TRUE or FALSE, the name of an enumeration's value, a number."""
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(data_type, EnumerationType):
        return next((n for n, v in data_type.values.items() if v == value), str(value))
    if isinstance(value, float):
        return _real(value) if data_type.size == 4 else repr(value)
    if isinstance(value, str):
        return value
    return str(value)


def _real(value: float) -> str:
    """Return the shortest text that gives a 32-bit REAL back; 9 digits always do."""
    data = struct.pack("<f", value)
    texts = (f"{value:.{digits}g}" for digits in (6, 7, 8, 9))
    return next((t for t in texts if struct.pack("<f", float(t)) == data), repr(value))


def value_of(data_type: DataType[Any], text: str) -> object:
    """Return the plain value that ``text`` stands for.

    TIME is a number of milliseconds or a duration such as ``250ms``.

    Raises:
        ValueError: the text is no value of the type.
    """
    if isinstance(data_type, StringType | WStringType):
        return text
    if isinstance(data_type, EnumerationType) and text in data_type.values:
        return data_type.values[text]
    if isinstance(data_type, ElementaryType) and data_type.kind is Kind.BOOL:
        if text.upper() not in _BOOLS:
            raise ValueError(f"{text!r} is not TRUE or FALSE")
        return _BOOLS[text.upper()]
    if isinstance(data_type, ElementaryType) and data_type.kind is Kind.REAL:
        return float(text)
    return _integer(data_type, text)


def _integer(data_type: DataType[Any], text: str) -> int:
    if data_type is TIME and text[-1:].isalpha():
        milliseconds, rest = divmod(parse_duration_ns(text), 1_000_000)
        if rest:
            raise ValueError(f"{text!r} is not a whole number of milliseconds")
        return milliseconds
    try:
        return int(text.replace("_", "").removeprefix("16#"), 16 if "16#" in text else 10)
    except ValueError:
        raise ValueError(f"{text!r} is not a {data_type}") from None
