"""Where the members of a type lie, as rows of a table."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple

from st_types.types.paths import parts

if TYPE_CHECKING:
    from collections.abc import Iterator

    from st_types.types.elementary import DataType


class LayoutRow(NamedTuple):
    """A member: its offset and its size in bytes, its path from the variable, its type."""

    offset: int
    size: int
    path: str
    data_type: DataType[object]


def layout_rows(data_type: DataType[object]) -> Iterator[LayoutRow]:
    """Yield the members of a STRUCT or a data block in the order of their offsets.

    The members of STRUCTs inside it follow theirs; of an ARRAY of STRUCTs those of the first
    element. A type without members has no rows.
    """
    found = [part for part in parts(data_type, elements=False) if part.path[-1:] not in ("", "]")]
    for part in sorted(found, key=attrgetter("offset")):
        yield LayoutRow(part.offset, part.data_type.size, part.path, part.declared)
