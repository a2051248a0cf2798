"""From rows to points: each tag is found, defaults are filled in, overlaps are refused."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.errors import TagError
from plcsim.modbus.map import status_block
from plcsim.modbus.map.errors import TagMapError
from plcsim.modbus.map.point import (
    ADDRESSES,
    KINDS,
    MOST_READ,
    MOST_WRITTEN,
    REGISTERS,
    Area,
    MapRow,
    Point,
)
from st_types.types.derived import (
    EnumerationType,
    ReferenceType,
    StringType,
    SubrangeType,
    resolve_alias,
)
from st_types.types.elementary import INTEGER_RANGES, ElementaryType, Kind

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path
    from typing import Any

    from plcsim.core.tag import Tag
    from st_types.types.elementary import DataType

_Taken = dict[tuple[Area, int], list[tuple[int, MapRow]]]
"""The bits of each register that rows cover, as masks."""

_DEFAULT_KINDS: Final = {"b": "h", "B": "H"}


def code_of(data_type: DataType[Any]) -> str | None:
    """Return the format character of a variable, "s" for a STRING, None where there is none."""
    match resolve_alias(data_type):
        case ElementaryType(kind=Kind.BOOL):
            return "?"
        case ElementaryType(code=code):
            return code
        case SubrangeType(base=base) | EnumerationType(base=base):
            return base.code
        case ReferenceType():
            return "I"
        case StringType():
            return "s"
    return None


def resolve(
    rows: Iterable[MapRow], find: Callable[[str], Tag], file: Path, order: str
) -> list[Point]:
    """Return the points of a map, in the order of the rows.

    Args:
        rows: of the map.
        find: gives the tag of a path, or raises TagError.
        file: named in errors.
        order: of rows that give none.

    Raises:
        TagMapError: a row does not fit its variable, or two rows overlap; the lines are named.
    """
    taken: _Taken = {}
    points = []
    for row in rows:
        try:
            point = _point(row, find(row.tag), order)
            _take(row, point, taken)
        except (TagError, ValueError) as err:
            location = f"{file}:{row.line}" if row.line else str(file)
            raise TagMapError(f"{location}: {row.tag}: {err}") from None
        points.append(point)
    return points


def _point(row: MapRow, tag: Tag, order: str) -> Point:
    code = code_of(tag.data_type)
    if code is None:
        raise ValueError(f"a variable of type {tag.data_type} cannot lie in registers")
    kind = KINDS[row.type] if row.type else _DEFAULT_KINDS.get(code, code)
    _check_kind(row, code, kind)
    _check_range(row, tag.data_type, code, kind)
    low, high = _limits(row, tag.data_type)
    point = Point(
        tag=tag.path,
        area=row.area.value,
        offset=row.offset,
        registers=_registers(row, kind, tag.data_type),
        bit=-1 if row.bit is None else row.bit,
        kind=kind,
        order=row.order or order,
        access=_access(row, is_constant=tag.is_constant),
        address=tag.address,
        code=code,
        size=tag.data_type.size,
        scale=row.scale,
        offset_eu=row.offset_eu,
        minimum=low,
        maximum=high,
        partial=row.partial,
        values=_values(tag.data_type),
    )
    _check_place(row, point)
    return point


def _check_kind(row: MapRow, code: str, kind: str) -> None:
    """Raise ValueError where the type on the wire is of another kind than the variable."""
    if (kind == "s") != (code == "s"):
        raise ValueError("a STRING needs the type string, and nothing else has it")
    if not row.area.has_registers and (kind != "?" or code != "?"):
        raise ValueError(f"only a BOOL can lie in area {row.area.value}")
    if row.bit is not None and (not row.area.has_registers or kind != "?" or code != "?"):
        raise ValueError("only a BOOL in a register has a bit")
    if kind == "?" and code != "?":
        raise ValueError("the type bool is for a BOOL only")
    is_limited = row.minimum is not None or row.maximum is not None
    if (_is_scaled(row) or is_limited) and code in "?s":
        raise ValueError("scale, offset_eu, min and max are for numbers")


def _is_scaled(row: MapRow) -> bool:
    return (row.scale, row.offset_eu) != (1.0, 0.0)


def _check_range(row: MapRow, data_type: DataType[Any], code: str, kind: str) -> None:
    """Raise ValueError where values of the variable would be cut on the wire."""
    if _is_scaled(row) or kind in "s?fd":
        return
    if code in "fd":
        raise ValueError("a REAL or LREAL on an integer type needs a scale")
    if kind.lower() == code.lower():  # the same bits, signed or not
        return
    low, high = _range_of(data_type, code)
    least, most = INTEGER_RANGES[kind]
    if low < least or high > most:
        raise ValueError(
            f"the type holds {least} to {most}, the variable {low} to {high}; give another type "
            "or a scale"
        )


def _range_of(data_type: DataType[Any], code: str) -> tuple[int, int]:
    """Return the smallest and the largest value of a variable of whole numbers."""
    match resolve_alias(data_type):
        case SubrangeType(minimum=low, maximum=high):
            return low, high
        case EnumerationType(values=values):
            return min(values.values()), max(values.values())
    return INTEGER_RANGES[code]


def _values(data_type: DataType[Any]) -> tuple[int, ...]:
    """Return the values of an enumeration, () for any other type."""
    resolved = resolve_alias(data_type)
    return tuple(resolved.values.values()) if isinstance(resolved, EnumerationType) else ()


def _limits(row: MapRow, data_type: DataType[Any]) -> tuple[float | None, float | None]:
    """Return the limits of the row and of a subrange, the narrower ones."""
    low, high = row.minimum, row.maximum
    resolved = resolve_alias(data_type)
    if isinstance(resolved, SubrangeType):
        low = resolved.minimum if low is None else max(low, resolved.minimum)
        high = resolved.maximum if high is None else min(high, resolved.maximum)
    if low is not None and high is not None and low > high:
        raise ValueError("min is above max")
    return low, high


def _registers(row: MapRow, kind: str, data_type: DataType[Any]) -> int:
    if kind != "s":
        if row.length not in (0, REGISTERS[kind]):
            raise ValueError(f"length is for strings; this type has {REGISTERS[kind]} registers")
        return REGISTERS[kind]
    most = MOST_WRITTEN if _access(row) != "ro" else MOST_READ
    if row.length > most:
        raise ValueError(f"no request writes more than {most} registers; give a shorter length")
    return row.length or min(most, -(-(data_type.size - 1) // 2))


def _access(row: MapRow, *, is_constant: bool = False) -> str:
    may_write = row.area.is_writable and not is_constant
    access = row.access or ("rw" if may_write else "ro")
    if access != "ro" and is_constant:
        raise ValueError("a CONSTANT cannot be written; give access ro")
    if access != "ro" and not row.area.is_writable:
        raise ValueError(f"area {row.area.value} cannot be written; give access ro")
    return access


def _check_place(row: MapRow, point: Point) -> None:
    end = point.offset + point.registers
    if end > ADDRESSES:
        raise ValueError(f"{point.registers} registers from {point.offset} do not fit below 65536")
    block = range(status_block.FIRST, status_block.FIRST + status_block.COUNT)
    if row.area is Area.INPUT_REGISTERS and point.offset < block.stop and end > block.start:
        raise ValueError(f"input registers {block.start} to {block.stop - 1} hold the status block")
    if point.partial and not (point.is_plain and not point.is_limited):
        raise ValueError("partial is for tags without scale and limits, of the variable's own type")


def _take(row: MapRow, point: Point, taken: _Taken) -> None:
    """Note the bits of every register that a row covers; a bit of two rows is an overlap."""
    bits = 0xFFFF if point.bit < 0 else 1 << point.bit
    for register in range(point.offset, point.offset + point.registers):
        claims = taken.setdefault((row.area, register), [])
        for claimed, other in claims:
            if bits & claimed and not (row.alias or other.alias):
                where = f"line {other.line}" if other.line else "the lock file"
                raise ValueError(
                    f"overlaps {other.tag} ({where}) at {row.area.value} {register}; "
                    "give one of them alias 1 if that is meant"
                )
        claims.append((bits, row))
