"""Addresses without a tags.csv: every variable gets one, and keeps it for ever.

The lock file remembers each address that was ever given. A variable that is new, or whose type has
changed, gets the next free one; one that has gone leaves a hole.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.tag import Tag, leaves
from plcsim.modbus.map.csv_file import read_file, write_rows
from plcsim.modbus.map.errors import TagMapError
from plcsim.modbus.map.point import ADDRESSES, KINDS, MOST_WRITTEN, REGISTERS, Area, MapRow, Point
from plcsim.modbus.map.resolve import code_of
from st_types.types.derived import StringType, resolve_alias

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path


LOCK_FILE: Final = "tags.lock"
_HEADING = "# Addresses given by plcsim; keep this file, so that they never change.\n"
_TYPES = {code: name for name, code in KINDS.items()}
_WIDER = {"b": "h", "B": "H"}


def all_tags(areas: Sequence[Tag]) -> Iterator[Tag]:
    """Iterate over all variables, every element of arrays, no function blocks.

    Args:
        areas: of a controller.
    """
    for area in areas:
        yield from leaves(area, blocks=False)


def locked_rows(folder: Path) -> list[MapRow]:
    """Return the rows of the lock file of a project, none where there is no such file.

    Raises:
        TagMapError: the file is damaged.
    """
    file = folder / LOCK_FILE
    try:
        return [_locked(row, file) for row in read_file(file)]
    except FileNotFoundError:
        return []


def _locked(row: MapRow, file: Path) -> MapRow:
    kind = KINDS.get(row.type)
    if kind is None or (kind == "s" and not row.length):
        missing = "length" if kind else "type"
        raise TagMapError(f"{file}:{row.line}: {row.tag}: has no {missing}; the file is damaged")
    return MapRow(row.tag, row.area, row.offset, type=row.type, length=row.length)


def write_lock(folder: Path, rows: Iterable[MapRow]) -> None:
    """Write the lock file, whole or not at all.

    Raises:
        TagMapError: it cannot be written.
    """
    file = folder / LOCK_FILE
    fresh = file.with_suffix(".new")
    try:
        fresh.write_text(_HEADING + write_rows(rows), "utf-8")
        fresh.replace(file)
    except OSError as err:
        raise TagMapError(f"{file}: cannot be written: {err}") from None


def give_addresses(
    tags: Iterable[Tag], fixed: Sequence[Point], locked: Sequence[MapRow]
) -> tuple[list[MapRow], list[MapRow]]:
    """Return the rows of all tags, and the rows of the new lock file.

    Args:
        tags: the variables; those of types that no register can hold are left out.
        fixed: points of tags.csv; their variables get no second address.
        locked: rows of the lock file.

    Raises:
        TagMapError: there are more variables than addresses.
    """
    named = {point.tag.upper() for point in fixed}
    known = {(row.tag.upper(), row.type, row.length): row for row in locked}
    free = {area: _first_free(area, fixed, locked) for area in Area}
    rows: list[MapRow] = []
    given: list[MapRow] = []
    for tag in tags:
        wanted = _wanted(tag)
        if wanted is None or tag.path.upper() in named:
            continue
        area, kind, length = wanted
        row = known.get((tag.path.upper(), kind, length))
        if row is None:
            row = MapRow(tag.path, area, free[area], type=kind, length=length)
            free[area] += _size(row)
            if free[area] > ADDRESSES:
                raise TagMapError(f"{tag.path}: area {area.value} has no address left")
            given.append(row)
        rows.append(row)
    return rows, [*locked, *given]


def _wanted(tag: Tag) -> tuple[Area, str, int] | None:
    """Return area, type and length of a variable, None where no register can hold it."""
    code = code_of(tag.data_type)
    if code is None:
        return None
    if code == "?":
        return Area.COILS, "bool", 0
    data_type = resolve_alias(tag.data_type)
    length = 0
    if isinstance(data_type, StringType):
        length = min(MOST_WRITTEN, -(-data_type.length // 2))
    return Area.HOLDING_REGISTERS, _TYPES[_WIDER.get(code, code)], length


def _size(row: MapRow) -> int:
    return row.length or REGISTERS[KINDS[row.type]]


def _first_free(area: Area, fixed: Sequence[Point], locked: Sequence[MapRow]) -> int:
    """Return the first address behind all others of an area."""
    ends = [point.offset + point.registers for point in fixed if point.area == area.value]
    ends += [row.offset + _size(row) for row in locked if row.area is area]
    return max(ends, default=0)
