"""Elementary types of IEC 61131-3 as the 32-bit controller lays them out.

Sizes and alignment are those of the C types that Automation Studio maps them to (plctypes.h, Intel
target): natural alignment, but 4 for the 8-byte types. TIME counts milliseconds, DATE_AND_TIME and
DATE seconds since 1970-01-01, TIME_OF_DAY milliseconds since midnight.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import Final, Generic, TypeVar

V_co = TypeVar("V_co", covariant=True)


class DataType(Generic[V_co]):
    """Any IEC 61131-3 data type; ``V_co`` is the Python type of its values.

    Types are compared by identity: two STRUCTs of one shape are two types.

    Attributes:
        name: as it is written in a declaration.
        size: bytes.
        alignment: bytes.
    """

    __slots__ = ("alignment", "name", "size")

    def __init__(self, name: str, size: int, alignment: int) -> None:
        self.name = name
        self.size = size
        self.alignment = alignment

    def __str__(self) -> str:
        return self.name

    def __repr__(self) -> str:
        return f"<{self.name}>"


INTEGER_RANGES: Final = {
    code: (-(1 << bits - 1) if code.islower() else 0, (1 << bits - code.islower()) - 1)
    for bits, codes in ((8, "bB"), (16, "hH"), (32, "iI"), (64, "qQ"))
    for code in codes
}
"""Smallest and largest integer by the format character of the ``struct`` module."""


class Kind(Enum):
    """What the bytes of an elementary type mean."""

    BOOL = auto()
    SIGNED = auto()
    UNSIGNED = auto()
    BITS = auto()
    REAL = auto()
    DURATION = auto()
    DATE = auto()


class ElementaryType(DataType[V_co]):
    """One elementary type.

    Attributes:
        code: format character of the ``struct`` module.
        kind: what the bytes mean.
        minimum: smallest integer value; 0 for REAL and LREAL, which have no such bound.
        maximum: largest integer value; 0 likewise.
    """

    __slots__ = ("code", "kind", "maximum", "minimum")

    def __init__(self, name: str, size: int, code: str, kind: Kind) -> None:
        super().__init__(name, size, min(size, 4))
        self.code = code
        self.kind = kind
        has_range = kind not in (Kind.BOOL, Kind.REAL)
        self.minimum, self.maximum = INTEGER_RANGES[code] if has_range else (0, kind is Kind.BOOL)

    @property
    def is_integer(self) -> bool:
        """True where values are Python integers, TIME and the date types included."""
        return self.kind not in (Kind.BOOL, Kind.REAL)

    def wrap(self, value: int) -> int:
        """Keep the low bits of ``value``, as a store on the controller does."""
        bits = 8 * self.size
        value &= (1 << bits) - 1
        return value - (1 << bits) if self.minimum < 0 and value > self.maximum else value


BOOL: Final[ElementaryType[bool]] = ElementaryType("BOOL", 1, "B", Kind.BOOL)
SINT: Final[ElementaryType[int]] = ElementaryType("SINT", 1, "b", Kind.SIGNED)
INT: Final[ElementaryType[int]] = ElementaryType("INT", 2, "h", Kind.SIGNED)
DINT: Final[ElementaryType[int]] = ElementaryType("DINT", 4, "i", Kind.SIGNED)
LINT: Final[ElementaryType[int]] = ElementaryType("LINT", 8, "q", Kind.SIGNED)
USINT: Final[ElementaryType[int]] = ElementaryType("USINT", 1, "B", Kind.UNSIGNED)
UINT: Final[ElementaryType[int]] = ElementaryType("UINT", 2, "H", Kind.UNSIGNED)
UDINT: Final[ElementaryType[int]] = ElementaryType("UDINT", 4, "I", Kind.UNSIGNED)
ULINT: Final[ElementaryType[int]] = ElementaryType("ULINT", 8, "Q", Kind.UNSIGNED)
BYTE: Final[ElementaryType[int]] = ElementaryType("BYTE", 1, "B", Kind.BITS)
WORD: Final[ElementaryType[int]] = ElementaryType("WORD", 2, "H", Kind.BITS)
DWORD: Final[ElementaryType[int]] = ElementaryType("DWORD", 4, "I", Kind.BITS)
LWORD: Final[ElementaryType[int]] = ElementaryType("LWORD", 8, "Q", Kind.BITS)
REAL: Final[ElementaryType[float]] = ElementaryType("REAL", 4, "f", Kind.REAL)
LREAL: Final[ElementaryType[float]] = ElementaryType("LREAL", 8, "d", Kind.REAL)
TIME: Final[ElementaryType[int]] = ElementaryType("TIME", 4, "i", Kind.DURATION)
DATE: Final[ElementaryType[int]] = ElementaryType("DATE", 4, "I", Kind.DATE)
TIME_OF_DAY: Final[ElementaryType[int]] = ElementaryType("TIME_OF_DAY", 4, "I", Kind.DATE)
DATE_AND_TIME: Final[ElementaryType[int]] = ElementaryType("DATE_AND_TIME", 4, "I", Kind.DATE)

ELEMENTARY: Final[dict[str, ElementaryType[bool] | ElementaryType[int] | ElementaryType[float]]] = {
    "BOOL": BOOL,
    **{t.name: t for t in (SINT, INT, DINT, LINT, USINT, UINT, UDINT, ULINT)},
    **{t.name: t for t in (BYTE, WORD, DWORD, LWORD, TIME, DATE, TIME_OF_DAY, DATE_AND_TIME)},
    **{t.name: t for t in (REAL, LREAL)},
    "TOD": TIME_OF_DAY,
    "DT": DATE_AND_TIME,
}
"""All elementary types by keyword, short forms included."""

LTIME: Final[ElementaryType[int]] = ElementaryType("LTIME", 8, "q", Kind.DURATION)
LDATE: Final[ElementaryType[int]] = ElementaryType("LDATE", 8, "q", Kind.DATE)
LTIME_OF_DAY: Final[ElementaryType[int]] = ElementaryType("LTIME_OF_DAY", 8, "q", Kind.DATE)
LDATE_AND_TIME: Final[ElementaryType[int]] = ElementaryType("LDATE_AND_TIME", 8, "q", Kind.DATE)

LONG_TIMES: Final[dict[str, ElementaryType[int]]] = {
    **{t.name: t for t in (LTIME, LDATE, LTIME_OF_DAY, LDATE_AND_TIME)},
    "LTOD": LTIME_OF_DAY,
    "LDT": LDATE_AND_TIME,
}
"""Times of IEC 61131-3 edition 3, which Automation Studio does not have, by keyword.

All count nanoseconds, dates from 1970-01-01 on.
"""

CHAR: Final[ElementaryType[int]] = ElementaryType("CHAR", 1, "B", Kind.BITS)
WCHAR: Final[ElementaryType[int]] = ElementaryType("WCHAR", 2, "H", Kind.BITS)

CHARACTERS: Final[dict[str, ElementaryType[int]]] = {t.name: t for t in (CHAR, WCHAR)}
"""Characters of IEC 61131-3 edition 3, which Automation Studio does not have, by keyword.

Their values are codes, so that they count like BYTE and WORD; a text of one character is one.
"""

CHARACTER_TYPES: Final = frozenset(CHARACTERS.values())

ALL_ELEMENTARY: Final = {**ELEMENTARY, **LONG_TIMES, **CHARACTERS}
"""The elementary types of all dialects."""
