"""Kinds of data types, and what comes of two of them.

Automation Studio compiles to C: an operation has the type that both operands go into, and what is
computed is C's ``int`` or ``unsigned long``, so nothing is cut to 16 or 8 bits before it is stored.
Which type that is still decides the sign of comparisons, divisions and shifts.
"""

from __future__ import annotations

from enum import IntEnum
from itertools import product
from typing import TYPE_CHECKING, Any, Final

from st_types.types.derived import (
    AliasType,
    ArrayType,
    EnumerationType,
    ReferenceType,
    StringType,
    StructType,
    SubrangeType,
    WStringType,
)
from st_types.types.elementary import (
    ALL_ELEMENTARY,
    BOOL,
    DATE,
    DATE_AND_TIME,
    DINT,
    INT,
    LDATE,
    LDATE_AND_TIME,
    LINT,
    LREAL,
    LTIME,
    LTIME_OF_DAY,
    REAL,
    SINT,
    TIME,
    TIME_OF_DAY,
    UDINT,
    USINT,
    DataType,
    ElementaryType,
)
from st_types.types.elementary import Kind as Meaning

if TYPE_CHECKING:
    from collections.abc import Mapping

Type = DataType[Any]

ANY_INT: Final = ElementaryType[int]("ANY_INT", 4, "i", Meaning.SIGNED)
"""A whole number without a type of its own: it takes that of the other operand."""

ANY_REAL: Final = ElementaryType[float]("ANY_REAL", 8, "d", Meaning.REAL)
"""A number with a point: a double of C, as Automation Studio writes it out."""

VOID: Final = DataType[None]("nothing", 0, 1)
"""The type of what has no value, and of what was reported already."""


class TypeKind(IntEnum):
    """What can be done with a type."""

    BOOL = 1
    INTEGER = 2
    """Also the bit strings BYTE, WORD, DWORD and LWORD, and enumerations."""
    REAL = 3
    TIME = 4
    DATE = 5
    STRING = 6
    WSTRING = 7
    STRUCT = 8
    ARRAY = 9
    REFERENCE = 10
    VOID = 11


NUMBERS: Final = frozenset([TypeKind.INTEGER, TypeKind.REAL])
COUNTS: Final = frozenset([TypeKind.INTEGER, TypeKind.TIME, TypeKind.DATE])
"""Kinds that are whole numbers in memory."""

_KINDS_OF_MEANING = {
    Meaning.BOOL: TypeKind.BOOL,
    Meaning.SIGNED: TypeKind.INTEGER,
    Meaning.UNSIGNED: TypeKind.INTEGER,
    Meaning.BITS: TypeKind.INTEGER,
    Meaning.REAL: TypeKind.REAL,
    Meaning.DURATION: TypeKind.TIME,
    Meaning.DATE: TypeKind.DATE,
}
_ELEMENTARY_KINDS: Final[Mapping[Type, TypeKind]] = {
    data_type: _KINDS_OF_MEANING[data_type.kind]
    for data_type in (*ALL_ELEMENTARY.values(), ANY_INT, ANY_REAL)
}
_KINDS_OF_CLASS: Final[tuple[tuple[type, TypeKind], ...]] = (
    (EnumerationType, TypeKind.INTEGER),
    (StringType, TypeKind.STRING),
    (WStringType, TypeKind.WSTRING),
    (StructType, TypeKind.STRUCT),
    (ArrayType, TypeKind.ARRAY),
    (ReferenceType, TypeKind.REFERENCE),
)


def kind_of(data_type: Type) -> TypeKind:
    """Return the kind of a plain type (see `plain`)."""
    kind = _ELEMENTARY_KINDS.get(data_type)
    if kind is not None:
        return kind
    for each, kind in _KINDS_OF_CLASS:
        if isinstance(data_type, each):
            return kind
    return TypeKind.VOID


def plain(data_type: Type) -> Type:
    """Return the type behind aliases and subranges: what operations go by."""
    while True:
        if isinstance(data_type, AliasType):
            data_type = data_type.target
        elif isinstance(data_type, SubrangeType):
            data_type = data_type.base
        else:
            return data_type


def number_type(data_type: Type) -> ElementaryType[Any]:
    """Return the elementary type of a number or a time; that of an enumeration is its base."""
    if isinstance(data_type, EnumerationType):
        return data_type.base
    return data_type if isinstance(data_type, ElementaryType) else DINT


_SIGNED_BY_SIZE = {1: SINT, 2: INT, 4: DINT, 8: LINT}


def _common_integer(a: ElementaryType[Any], b: ElementaryType[Any]) -> ElementaryType[Any]:
    """Return the smallest type that holds both; UDINT with a signed type is UDINT, as in C."""
    if (a.minimum < 0) == (b.minimum < 0):
        return a if a.size >= b.size else b
    signed, unsigned = (a, b) if a.minimum < 0 else (b, a)
    if signed.size > unsigned.size:
        return signed
    return _SIGNED_BY_SIZE[2 * unsigned.size] if unsigned.size < 4 else unsigned


def _common_number(a: ElementaryType[Any], b: ElementaryType[Any]) -> ElementaryType[Any]:
    a, b = (USINT if t is BOOL else t for t in (a, b))
    if a is ANY_INT:
        return b
    if b is ANY_INT:
        return a
    reals = [t for t in (a, b) if t.kind is Meaning.REAL]
    if not reals:
        return _common_integer(a, b)
    for wanted in (LREAL, REAL):
        if wanted in reals:
            return wanted
    return ANY_REAL


def _number_types() -> list[ElementaryType[Any]]:
    kinds = (*NUMBERS, TypeKind.BOOL)
    found = [t for t, kind in _ELEMENTARY_KINDS.items() if kind in kinds]
    return [t for t in found if isinstance(t, ElementaryType)]


_COMMON: Final[Mapping[tuple[Type, Type], ElementaryType[Any]]] = {
    (a, b): _common_number(a, b) for a, b in product(_number_types(), repeat=2)
}


def common_number(a: Type, b: Type) -> ElementaryType[Any]:
    """Return the type of an operation on two numbers.

    An enumeration counts as its base, a BOOL as the byte that it is.
    """
    found = _COMMON.get((a, b))
    return found if found is not None else _COMMON[number_type(a), number_type(b)]


def is_unsigned(data_type: Type) -> bool:
    """Return True for a type of whole numbers without negative ones."""
    return isinstance(data_type, ElementaryType) and data_type.minimum == 0


class Fit(IntEnum):
    """How a value goes into a variable of another type."""

    EXACT = 0
    """Every value of the one is a value of the other."""
    NARROWED = 1
    """By itself, but not every value fits."""
    NEVER = 2
    """Not without a conversion function."""


def _elementary_fit(source: ElementaryType[Any], target: ElementaryType[Any]) -> Fit:
    from_kind, to_kind = _ELEMENTARY_KINDS[source], _ELEMENTARY_KINDS[target]
    if source is target or (from_kind is TypeKind.BOOL and to_kind in NUMBERS):
        return Fit.EXACT
    if from_kind is TypeKind.BOOL and to_kind is TypeKind.TIME:
        return Fit.NARROWED
    if source is ANY_INT and to_kind is not TypeKind.BOOL:
        return Fit.EXACT  # of a constant, its value is looked at
    if from_kind is TypeKind.INTEGER and to_kind is TypeKind.REAL:
        return Fit.EXACT
    if from_kind is TypeKind.REAL and to_kind is TypeKind.REAL:
        return Fit.NARROWED if source is LREAL else Fit.EXACT
    if from_kind is TypeKind.INTEGER and to_kind is TypeKind.INTEGER:
        holds = target.minimum <= source.minimum and source.maximum <= target.maximum
        return Fit.EXACT if holds else Fit.NARROWED
    if from_kind in COUNTS and to_kind in COUNTS and source.size == target.size == 4:
        return Fit.NARROWED
    return Fit.NEVER


_FITS: Final[Mapping[tuple[Type, Type], Fit]] = {
    (a, b): _elementary_fit(a, b)
    for a, b in product(_ELEMENTARY_KINDS, _ELEMENTARY_KINDS)
    if isinstance(a, ElementaryType) and isinstance(b, ElementaryType)
}


def elementary_fit(source: Type, target: Type) -> Fit | None:
    """Return how a value of one elementary type goes into another, None for other types.

    An enumeration counts as its base; `plcsim.program.structured_text.check.fits` has constants.
    """
    found = _FITS.get((source, target))
    if found is None and (
        isinstance(source, EnumerationType) or isinstance(target, EnumerationType)
    ):
        return _FITS.get((_as_number(source), _as_number(target)))
    return found


def _as_number(data_type: Type) -> Type:
    return data_type.base if isinstance(data_type, EnumerationType) else data_type


DATES: Final = frozenset([DATE, TIME_OF_DAY, DATE_AND_TIME, LDATE, LTIME_OF_DAY, LDATE_AND_TIME])

__all__ = [
    "ANY_INT",
    "ANY_REAL",
    "BOOL",
    "COUNTS",
    "DATES",
    "DINT",
    "LINT",
    "LTIME",
    "NUMBERS",
    "TIME",
    "UDINT",
    "VOID",
    "Fit",
    "Type",
    "TypeKind",
    "common_number",
    "elementary_fit",
    "is_unsigned",
    "kind_of",
    "number_type",
    "plain",
]
