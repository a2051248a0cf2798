"""Reads of many registers or bits, as plans that are made once for each range asked for.

Most registers hold the very bytes of a variable, so a read is one gather of bytes out of a copy of
the snapshot; the others are converted one by one and laid over it.
"""

from __future__ import annotations

from operator import itemgetter
from typing import TYPE_CHECKING, NamedTuple, Protocol

from plcsim.modbus.map import status_block
from plcsim.modbus.map.conversion import to_registers, wire_order
from plcsim.modbus.map.errors import IllegalAddress
from plcsim.modbus.map.point import Area, Point

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

PLANS_KEPT = 256
"""Plans remembered; a master asks for the same few ranges again and again."""

_DIGITS = bytes([0x30]) + bytes([0x31]) * 255


class MappedSnapshots(Protocol):
    """Where snapshots come from (`plcsim.shared_image.ImageReader`)."""

    @property
    def latest(self) -> int:
        """Number of the latest snapshot."""

    def copy(self, start: int, end: int) -> tuple[int, bytes]:
        """Return a snapshot's number and some of its bytes."""


class _Patch(NamedTuple):
    """A point that is converted: where its variable lies in the copy, which bytes go where."""

    point: Point
    start: int
    first: int
    end: int
    at: int


class _Bit(NamedTuple):
    """A BOOL in a register: where it lies in the copy, which bit of which byte it is."""

    start: int
    at: int
    mask: int


class _Plan:
    """How one range is read; keeps the last answer, for as long as its snapshot is the latest."""

    __slots__ = ("answer", "bits", "end", "gather", "number", "patches", "start")

    def __init__(
        self,
        start: int,
        end: int,
        indices: Sequence[int],
        patches: Sequence[_Patch],
        bits: Sequence[_Bit],
    ) -> None:
        self.start = start
        self.end = end
        self.gather: Callable[[bytes], tuple[int, ...]] = itemgetter(*indices, 0)
        self.patches = patches
        self.bits = bits
        self.number = 0
        self.answer = b""


class Reads:
    """All reads of one map.

    Args:
        points: of the map.
        offset_of: gives the offset of a variable in a snapshot from its PLC address and size.
        strict_holes: a range that touches an address without a tag is refused; otherwise such an
            address reads as 0 between the first and the last tag of its area.
    """

    def __init__(
        self,
        points: Sequence[Point],
        offset_of: Callable[[int, int], int],
        *,
        strict_holes: bool = False,
    ) -> None:
        self._offset_of = offset_of
        self._strict = strict_holes
        self._plans: dict[tuple[Area, int, int], _Plan] = {}
        self._by_address: dict[Area, dict[int, list[Point]]] = {area: {} for area in Area}
        for point in points:
            addresses = self._by_address[Area(point.area)]
            for address in range(point.offset, point.offset + point.registers):
                addresses.setdefault(address, []).append(point)
        self._ranges = {
            area: range(min(used), max(used) + 1) if used else range(0)
            for area, used in self._by_address.items()
        }

    def check(self, area: Area, address: int, count: int) -> None:
        """Raise IllegalAddress unless the range can be read."""
        if _in_block(area, address, count):
            return
        last = address + count - 1
        mapped = self._ranges[area]
        if address not in mapped or last not in mapped or _touches_block(area, address, last):
            raise IllegalAddress(f"{area.value} {address}..{last} is outside the map")
        used = self._by_address[area]
        if self._strict and any(a not in used for a in range(address, last + 1)):
            raise IllegalAddress(f"{area.value} {address}..{last} has addresses without a tag")

    def read(
        self,
        area: Area,
        address: int,
        count: int,
        snapshots: MappedSnapshots,
        status: Callable[[], status_block.ControllerStatus],
    ) -> bytes:
        """Return registers as on the wire, or bits packed, the first in the lowest bit.

        Raises:
            IllegalAddress: the range cannot be read.
            ImageError: there is no snapshot.
        """
        plan = self._plans.get((area, address, count))
        if plan is None:
            self.check(area, address, count)
            if _in_block(area, address, count):
                start = 2 * (address - status_block.FIRST)
                return status_block.registers(status())[start : start + 2 * count]
            plan = self._remember(area, address, count)
        if plan.number == snapshots.latest and plan.number:
            return plan.answer
        number, data = snapshots.copy(plan.start, plan.end)
        answer = _gathered(plan, b"\0" + data)
        if not area.has_registers:
            answer = _packed_bits(answer)
        plan.number, plan.answer = number, answer
        return answer

    def _remember(self, area: Area, address: int, count: int) -> _Plan:
        if len(self._plans) >= PLANS_KEPT:
            self._plans.pop(next(iter(self._plans)))
        plan = self._plans[area, address, count] = self._plan(area, address, count)
        return plan

    def _points(self, area: Area, address: int, count: int) -> Iterator[Point]:
        """Iterate over the points in a range, each once."""
        used = self._by_address[area]
        seen = {id(p): p for a in range(address, address + count) for p in used.get(a, ())}
        return (point for point in seen.values() if point.access != "wo")

    def _plan(self, area: Area, address: int, count: int) -> _Plan:
        points = list(self._points(area, address, count))
        offsets = {id(p): self._offset_of(p.address, p.size) for p in points}
        start = min(offsets.values(), default=0)
        end = max((offsets[id(p)] + p.size for p in points), default=0)
        width = 2 if area.has_registers else 1
        indices = [0] * (width * count)
        patches: list[_Patch] = []
        bits: list[_Bit] = []
        for point in points:
            at = 1 + offsets[id(point)] - start
            first = width * (point.offset - address)
            if not area.has_registers:
                indices[first] = at
            elif point.bit >= 0:
                bits.append(_Bit(at, first + (point.bit < 8), 1 << point.bit % 8))
            elif point.is_plain:
                for i, index in enumerate(wire_order(point.size, point.order)):
                    if 0 <= first + i < len(indices):
                        indices[first + i] = at + point.size - 1 - index
            else:
                skip = max(0, -first)
                stop = min(2 * point.registers, len(indices) - first)
                patches.append(_Patch(point, at, skip, stop, first + skip))
        return _Plan(start, end, indices, patches, bits)


def _in_block(area: Area, address: int, count: int) -> bool:
    """Return True for a range of the status block."""
    end = status_block.FIRST + status_block.COUNT
    inside = address >= status_block.FIRST and address + count <= end
    return area is Area.INPUT_REGISTERS and inside


def _touches_block(area: Area, address: int, last: int) -> bool:
    """Return True for a range that lies in the status block in part; it would read as 0 there."""
    end = status_block.FIRST + status_block.COUNT
    return area is Area.INPUT_REGISTERS and address < end and last >= status_block.FIRST


def _gathered(plan: _Plan, data: bytes) -> bytes:
    """Return the bytes of a plan; ``data`` starts with a zero for what has no tag."""
    answer = bytes(plan.gather(data)[:-1])
    if not plan.patches and not plan.bits:
        return answer
    patched = bytearray(answer)
    for point, start, first, end, at in plan.patches:
        wire = to_registers(point, data[start : start + point.size])
        patched[at : at + end - first] = wire[first:end]
    for source, at, mask in plan.bits:
        if data[source]:
            patched[at] |= mask
    return bytes(patched)


def _packed_bits(bits: bytes) -> bytes:
    """Return one bit for each byte that is not 0, the first in the lowest bit of the first byte."""
    number = int(bits[::-1].translate(_DIGITS), 2)
    return number.to_bytes(-(-len(bits) // 8), "little")
