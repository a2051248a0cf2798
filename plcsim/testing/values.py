"""Values of tags as text, and text as values: one notation for tables, CSV files and diagrams."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

from plcsim.core.duration import parse_duration_ns
from plcsim.core.memory import FIRST
from plcsim.core.tag import leaves
from plcsim.testing.errors import PlcTestError
from st_types.types.derived import (
    EnumerationType,
    StringType,
    SubrangeType,
    WStringType,
)
from st_types.types.elementary import TIME, ElementaryType, Kind
from st_types.types.values import decode

if TYPE_CHECKING:
    from plcsim.core.tag import Tag, TagTable
    from st_types.types.elementary import DataType

__tracebackhide__ = True

MOST_LEAVES = 256
"""A STRUCT or ARRAY with more elements than this is not recorded as a whole."""

_BOOLS = {"TRUE": True, "FALSE": False, "1": True, "0": False}


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


def printable(text: str) -> str:
    """Return a text with a dot for each character that is none, such as a line break."""
    return "".join(c if c.isprintable() else "·" for c in text)


def value_in(image: bytes, tag: Tag) -> object:
    """Return the value of a tag in a copy of the memory from `FIRST`."""
    start = tag.address - FIRST
    return decode(tag.data_type, image[start : start + tag.data_type.size])


def is_number(data_type: DataType[Any]) -> bool:
    """Whether values can be drawn as a curve."""
    elementary = isinstance(data_type, ElementaryType) and data_type.kind is not Kind.BOOL
    return elementary or isinstance(data_type, SubrangeType)


def leaves_of(tags: TagTable, path: str) -> list[Tag]:
    """Return the tags of elementary types at or below ``path``.

    Raises:
        TagError: there is no such tag.
        PlcTestError: there are more than `MOST_LEAVES`.
    """
    found: list[Tag] = []
    for leaf in leaves(tags.find(path)):
        if len(found) == MOST_LEAVES:
            raise PlcTestError(f"{path} has more than {MOST_LEAVES} elements; name some of them")
        found.append(leaf)
    return found
