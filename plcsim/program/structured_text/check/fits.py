"""What goes into what by itself: the implicit conversions of assignments and arguments."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    COUNTS,
    Fit,
    TypeKind,
    elementary_fit,
    kind_of,
    number_type,
    plain,
)
from plcsim.program.structured_text.check.typed import Constant
from st_types.types.derived import ArrayType, ReferenceType
from st_types.types.elementary import CHARACTER_TYPES, UDINT

if TYPE_CHECKING:
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Value


def fit(value: Value, target: Type) -> Fit:
    """Return how ``value`` goes into a variable of the plain type ``target``."""
    source = value.type
    if source is target:
        return Fit.EXACT
    if isinstance(value, Constant) and not isinstance(value.value, str):
        return _constant_fit(source, value.value, target)
    found = elementary_fit(source, target)
    return _derived_fit(source, target) if found is None else found


def as_character(value: Value, target: Type) -> Value:
    """Return a text of one character as a CHAR or a WCHAR, any other value as it is."""
    if target not in CHARACTER_TYPES or not isinstance(value, Constant):
        return value
    text = value.value
    return Constant(target, ord(text)) if isinstance(text, str) and len(text) == 1 else value


def _constant_fit(source: Type, value: float, target: Type) -> Fit:
    kind = kind_of(target)
    if kind is TypeKind.BOOL:
        return Fit.EXACT if value in (0, 1) and kind_of(source) is not TypeKind.REAL else Fit.NEVER
    if source is not ANY_INT or kind not in COUNTS:
        found = elementary_fit(source, target)
        return _derived_fit(source, target) if found is None else found
    number = number_type(target)
    if number.minimum <= value <= number.maximum:
        return Fit.EXACT
    bits = 8 * number.size
    return Fit.NARROWED if -(1 << bits - 1) <= value < 1 << bits else Fit.NEVER


def _derived_fit(source: Type, target: Type) -> Fit:
    kind = kind_of(source)
    target_kind = kind_of(target)
    if kind is TypeKind.VOID or target_kind is TypeKind.VOID:
        return Fit.EXACT  # it was reported
    if kind is target_kind:
        if kind in (TypeKind.STRING, TypeKind.WSTRING, TypeKind.REFERENCE):
            return Fit.EXACT
        if kind is TypeKind.ARRAY:
            return Fit.EXACT if are_alike(source, target) else Fit.NEVER
    addresses = (source, target) if kind is TypeKind.REFERENCE else (target, source)
    if isinstance(addresses[0], ReferenceType) and addresses[1] in (UDINT, ANY_INT):
        return Fit.EXACT
    return Fit.NEVER


def are_alike(a: Type, b: Type) -> bool:
    """Return True for one type, and for arrays of one shape with elements that are alike."""
    a, b = plain(a), plain(b)
    if isinstance(a, ArrayType) and isinstance(b, ArrayType):
        sizes = [[high - low for low, high in t.bounds] for t in (a, b)]
        return sizes[0] == sizes[1] and are_alike(a.element, b.element)
    return a is b or (a.size == b.size and a.name == b.name)
