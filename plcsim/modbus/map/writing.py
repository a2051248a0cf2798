"""Writes of registers and bits, turned into commands: whole, or refused."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from plcsim.modbus.map.conversion import from_registers, wire_order
from plcsim.modbus.map.errors import IllegalAddress, IllegalValue
from plcsim.modbus.map.point import Area, Point
from plcsim.shared_image.command import Mask, StoreCommand, merged

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.shared_image.command import Operation


class MapWrite(NamedTuple):
    """A request, turned into stores.

    Attributes:
        operations: what is stored; adjoining stores are one.
        points: the tags that are written, each once.
    """

    operations: Sequence[Operation]
    points: Sequence[Point]


class Writes:
    """All writes of one map.

    Args:
        points: of the map.
    """

    def __init__(self, points: Sequence[Point]) -> None:
        self._coils: dict[int, list[Point]] = {}
        self._registers: dict[int, list[Point]] = {}
        by_area = {Area.COILS.value: self._coils, Area.HOLDING_REGISTERS.value: self._registers}
        for point in points:
            used = by_area.get(point.area, {})
            for address in range(point.offset, point.offset + point.registers):
                used.setdefault(address, []).append(point)

    def coils(self, address: int, bits: Sequence[bool]) -> MapWrite:
        """Return what writes coils.

        Raises:
            IllegalAddress: one of them has no tag, or cannot be written.
        """
        operations: list[Operation] = []
        points: list[Point] = []
        for coil, bit in enumerate(bits, address):
            for point in _writable(self._coils, coil):
                points.append(point)
                operations.append(StoreCommand(point.address, b"\1" if bit else b"\0"))
        return MapWrite(merged(operations), points)

    def registers(self, address: int, data: bytes) -> MapWrite:
        """Return what writes holding registers.

        Args:
            address: of the first register.
            data: as on the wire, two bytes for each register.

        Raises:
            IllegalAddress: one of them has no tag, cannot be written, or is part of a tag of which
                not all registers are written.
            IllegalValue: a tag cannot take its value.
        """
        operations: list[Operation] = []
        end = address + len(data) // 2
        points: dict[int, Point] = {}
        for register in range(address, end):
            for point in _writable(self._registers, register):
                if id(point) not in points:
                    points[id(point)] = point
                    operations.extend(_stores(point, address, end, data))
        return MapWrite(merged(operations), list(points.values()))

    def mask(self, address: int, and_mask: int, or_mask: int) -> MapWrite:
        """Return what function 22 does; the scan itself reads and changes the register.

        Raises:
            IllegalAddress: the register holds neither bits nor a word of its own.
        """
        operations: list[Operation] = []
        points = _writable(self._registers, address)
        for point in points:
            if point.bit >= 0:
                if not and_mask >> point.bit & 1:
                    operations.append(
                        StoreCommand(point.address, bytes([or_mask >> point.bit & 1]))
                    )
                continue
            if not point.is_plain or point.registers != 1 or point.is_limited:
                raise IllegalAddress(f"{point.tag} is not a plain word")
            swapped = point.order in ("BADC", "DCBA")
            operations.append(
                Mask(
                    point.address,
                    _swapped(and_mask) if swapped else and_mask,
                    _swapped(or_mask) if swapped else or_mask,
                )
            )
        return MapWrite(merged(operations), points)


def _writable(used: dict[int, list[Point]], address: int) -> list[Point]:
    points = used.get(address)
    if not points:
        raise IllegalAddress(f"nothing to write at {address}")
    for point in points:
        if not point.is_writable:
            raise IllegalAddress(f"{point.tag} is read-only")
    return points


def _stores(point: Point, address: int, end: int, data: bytes) -> Iterator[StoreCommand]:
    """Iterate over the stores for the part of ``data`` that belongs to a point."""
    first = 2 * (point.offset - address)
    if point.bit >= 0:
        word = int.from_bytes(data[first : first + 2], "big")
        yield StoreCommand(point.address, bytes([word >> point.bit & 1]))
    elif first >= 0 and point.offset + point.registers <= end:
        yield StoreCommand(
            point.address, from_registers(point, data[first : first + 2 * point.registers])
        )
    elif point.partial:
        order = enumerate(wire_order(point.size, point.order))
        part = {index: data[first + i] for i, index in order if 0 <= first + i < len(data)}
        _check_exponent(point, part)
        for index, value in part.items():
            yield StoreCommand(point.address + point.size - 1 - index, bytes([value]))
    else:
        raise IllegalAddress(f"only part of {point.tag} is written")


def _check_exponent(point: Point, part: dict[int, int]) -> None:
    """Raise IllegalValue where a part of a REAL or LREAL makes it NaN or infinity.

    All bits of the exponent lie in its highest register (IEEE 754), which is written whole: no
    other part can.

    Args:
        point: the tag.
        part: bytes by their index in the big-endian value.
    """
    if point.kind not in "fd" or 0 not in part:
        return
    mask = 0x7F80 if point.size == 4 else 0x7FF0
    if (part[0] << 8 | part[1]) & mask == mask:
        raise IllegalValue(f"{point.tag}: a number that is not finite")


def _swapped(word: int) -> int:
    return (word & 0xFF) << 8 | word >> 8
