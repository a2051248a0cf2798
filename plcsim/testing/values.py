"""Values of tags, for tables, CSV files and diagrams."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from plcsim.core.memory import FIRST
from plcsim.core.tag import leaves
from plcsim.testing.errors import PlcTestError
from st_types.types.derived import (
    SubrangeType,
)
from st_types.types.elementary import ElementaryType, Kind
from st_types.types.values import decode

if TYPE_CHECKING:
    from plcsim.core.tag import Tag, TagTable
    from st_types.types.elementary import DataType

__tracebackhide__ = True

MOST_LEAVES = 256
"""A STRUCT or ARRAY with more elements than this is not recorded as a whole."""


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
