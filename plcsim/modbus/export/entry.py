"""What every format is made from: the tags with all ways of writing their address."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from plcsim.modbus.map.point import KINDS, Area

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.modbus.map.point import MapRow, Point

_NAMES = {code: name for name, code in KINDS.items()}
_IGNITION = {
    "?": "", "h": "S", "H": "", "i": "I", "I": "UI", "q": "I_64", "Q": "UI_64", "f": "F",
    "d": "D", "s": "S",
}  # fmt: skip


@dataclass(frozen=True)
class ExportEntry:
    """A tag as it is exported."""

    row: MapRow
    point: Point

    @property
    def area(self) -> Area:
        """The area."""
        return Area(self.point.area)

    @property
    def type(self) -> str:
        """The type on the wire, as in tags.csv."""
        return _NAMES[self.point.kind]

    @property
    def one_based(self) -> int:
        """The number of the register or bit where the first one is 1."""
        return self.point.offset + 1

    @property
    def modicon6(self) -> str:
        """Six digits: 400001 is the first holding register."""
        return f"{self.area.digit}{self.one_based:05d}" if self.one_based <= 65536 else ""

    @property
    def modicon5(self) -> str:
        """Five digits, which end at 9999: 40001 is the first holding register."""
        return f"{self.area.digit}{self.one_based:04d}" if self.one_based <= 9999 else ""

    @property
    def ignition(self) -> str:
        """The path of an item in Ignition's Modbus driver, without the device."""
        if not self.area.has_registers:
            return f"{'C' if self.area is Area.COILS else 'DI'}{self.one_based}"
        prefix = "HR" if self.area is Area.HOLDING_REGISTERS else "IR"
        point = self.point
        if point.bit >= 0:
            return f"{prefix}{self.one_based}.{point.bit}"
        if point.kind == "s":
            return f"{prefix}S{self.one_based}:{2 * point.registers}"
        suffix = "" if point.kind == "h" else _IGNITION[point.kind]
        return f"{prefix}{suffix}{self.one_based}"

    @property
    def unique_name(self) -> str:
        """The path with dots and brackets as underscores, with its address where it is an alias."""
        name = "".join(c if c.isalnum() else "_" for c in self.row.tag).rstrip("_")
        return f"{name}_{self.point.area}{self.point.offset}" if self.row.alias else name


@dataclass(frozen=True)
class MapExport:
    """A map to be exported.

    Attributes:
        project: its name.
        host: where the server listens.
        port: likewise.
        entries: the tags.
    """

    project: str
    host: str
    port: int
    entries: Sequence[ExportEntry]

    def of(self, area: Area) -> list[ExportEntry]:
        """Return the tags of an area in the order of their addresses."""
        found = [e for e in self.entries if e.area is area]
        return sorted(found, key=lambda e: (e.point.offset, e.point.bit))

    def blocks(self, area: Area, longest: int = 120) -> list[list[ExportEntry]]:
        """Return the tags of an area in groups that one request can read."""
        blocks: list[list[ExportEntry]] = []
        for entry in self.of(area):
            end = entry.point.offset + entry.point.registers
            if blocks and end - blocks[-1][0].point.offset <= longest:
                blocks[-1].append(entry)
            else:
                blocks.append([entry])
        return blocks


def extent(block: Sequence[ExportEntry]) -> tuple[int, int]:
    """Return the first address of a block and how many follow from it."""
    first = block[0].point.offset
    return first, max(e.point.offset + e.point.registers for e in block) - first
