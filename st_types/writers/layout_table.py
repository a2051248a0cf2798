"""Where the members of a type lie, as rows of a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from st_types.types.derived import ArrayType, StructType, resolve_alias

if TYPE_CHECKING:
    from collections.abc import Iterator

    from st_types.types.elementary import DataType


class Row(NamedTuple):
    """A member: its offset and its size in bytes, its path from the variable, its type."""

    offset: int
    size: int
    path: str
    data_type: DataType[object]


def layout_rows(data_type: DataType[object]) -> Iterator[Row]:
    """Yield the members of a STRUCT or a data block in the order of their offsets.

    The members of STRUCTs inside it follow theirs; of an ARRAY of STRUCTs those of the first
    element. A type without members has no rows.
    """
    return _rows(data_type, 0, "")


def _rows(declared: DataType[object], start: int, prefix: str) -> Iterator[Row]:
    data_type = resolve_alias(declared)
    if isinstance(data_type, ArrayType):
        first = ", ".join(str(low) for low, _ in data_type.bounds)
        yield from _rows(data_type.element, start, f"{prefix}[{first}]")
    elif isinstance(data_type, StructType):
        pairs = zip(data_type.offsets, data_type.members, strict=True)
        for offset, member in sorted(pairs, key=lambda pair: pair[0]):
            path = f"{prefix}.{member.name}" if prefix else member.name
            yield Row(start + offset, member.data_type.size, path, member.data_type)
            yield from _rows(member.data_type, start + offset, path)
