"""A row of the tag map, and the point it becomes once its variable is found."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from enum import Enum
from typing import Any, Final


class Area(Enum):
    """The four areas of Modbus; values as in tags.csv."""

    COILS = "co"
    DISCRETE_INPUTS = "di"
    INPUT_REGISTERS = "ir"
    HOLDING_REGISTERS = "hr"

    @property
    def has_registers(self) -> bool:
        """True for the areas of 16-bit registers, False for those of bits."""
        return self in (Area.INPUT_REGISTERS, Area.HOLDING_REGISTERS)

    @property
    def is_writable(self) -> bool:
        """True for the areas that have function codes to write them."""
        return self in (Area.COILS, Area.HOLDING_REGISTERS)

    @property
    def digit(self) -> int:
        """The digit in front of Modicon addresses."""
        return {"co": 0, "di": 1, "ir": 3, "hr": 4}[self.value]


ADDRESSES: Final = 65536
"""In each area."""

KINDS: Final[dict[str, str]] = {
    "bool": "?",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float32": "f",
    "float64": "d",
    "string": "s",
}
"""Types of the map with the format character of their value."""

REGISTERS: Final = {"h": 1, "H": 1, "?": 1, "i": 2, "I": 2, "f": 2, "q": 4, "Q": 4, "d": 4}
MOST_READ, MOST_WRITTEN = 125, 123
"""Registers of one request (MODBUS Application Protocol V1.1b3, 6.3, 6.12)."""

ORDERS: Final = ("ABCD", "CDAB", "BADC", "DCBA")
"""Order of the bytes on the wire; for 64 bits CDAB means the low word first throughout."""

ACCESSES: Final = ("ro", "rw", "wo")


@dataclass(frozen=True)
class MapRow:
    """A row of tags.csv, its fields checked one by one; None and "" mean the default.

    Attributes:
        tag: path of the variable.
        area: where it lies.
        offset: of the protocol, from 0.
        bit: of the register, None for the whole register.
        type: a key of `KINDS`, "" for what suits the variable.
        length: registers of a string, 0 for what suits the variable.
        order: one of `ORDERS`, "" for the default of the file.
        access: one of `ACCESSES`, "" for what the area allows.
        scale: engineering units for a raw value of 1.
        offset_eu: engineering units at a raw value of 0.
        minimum: of a written value, in engineering units.
        maximum: likewise.
        alias: may lie where another tag lies.
        partial: a write to some of its registers is allowed.
        line: of the file, 0 for an automatic address.
    """

    tag: str
    area: Area
    offset: int
    bit: int | None = None
    type: str = ""
    length: int = 0
    order: str = ""
    access: str = ""
    scale: float = 1.0
    offset_eu: float = 0.0
    unit: str = ""
    minimum: float | None = None
    maximum: float | None = None
    alias: bool = False
    partial: bool = False
    group: str = ""
    iec: str = ""
    description: str = ""
    line: int = 0


@dataclass(frozen=True)
class Point:
    """A tag at its address, all defaults filled in.

    Attributes:
        tag: path of the variable.
        area: value of `Area`.
        offset: of the protocol, from 0.
        registers: how many it takes; 1 in the areas of bits.
        bit: of the register, -1 for the whole.
        kind: format character of the value on the wire.
        order: one of `ORDERS`.
        access: one of `ACCESSES`.
        address: PLC address of the variable.
        code: format character of the variable, "s" for a STRING.
        size: bytes of the variable.
        scale: engineering units for a raw value of 1.
        offset_eu: engineering units at a raw value of 0.
        minimum: of a written value, in engineering units; None for what the variable can hold.
        maximum: likewise.
        partial: a write to some of its registers is allowed.
        values: of an enumeration, the only ones that may be written; () for any.
    """

    tag: str
    area: str
    offset: int
    registers: int
    bit: int
    kind: str
    order: str
    access: str
    address: int
    code: str
    size: int
    scale: float = 1.0
    offset_eu: float = 0.0
    minimum: float | None = None
    maximum: float | None = None
    partial: bool = False
    values: tuple[int, ...] = ()

    @property
    def is_writable(self) -> bool:
        """True where a master may write it."""
        return self.access != "ro"

    @property
    def is_scaled(self) -> bool:
        """True where the value on the wire is not the variable's own."""
        return (self.scale, self.offset_eu) != (1.0, 0.0)

    @property
    def is_limited(self) -> bool:
        """True where not every value that the registers hold may be written."""
        return self.minimum is not None or self.maximum is not None or bool(self.values)

    @property
    def is_plain(self) -> bool:
        """True where the registers hold the very bytes of the variable."""
        same = self.size == 2 * self.registers and self.bit < 0
        floats = (self.kind in "fd", self.code in "fd")
        return same and not self.is_scaled and self.code not in "s?" and floats[0] == floats[1]

    def to_json(self) -> dict[str, Any]:
        """Return the point as JSON's types."""
        return asdict(self)


def point_from(values: dict[str, Any]) -> Point:
    """Return the point of `Point.to_json`."""
    return Point(**{**values, "values": tuple(values["values"])})
