"""Types of operations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.check.fits import as_character
from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    ANY_REAL,
    BOOL,
    COUNTS,
    DATES,
    DINT,
    LINT,
    LTIME,
    NUMBERS,
    TIME,
    UDINT,
    TypeKind,
    common_number,
    is_unsigned,
    kind_of,
    number_type,
)
from plcsim.program.structured_text.check.typed import Binary, Compare, Constant, Unary
from st_types.types.elementary import DATE, DATE_AND_TIME, INT, LREAL, REAL, SINT

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Value

COMPARISONS: Final = frozenset(["=", "<>", "<", ">", "<=", ">="])
CALCULABLE: Final = NUMBERS | {TypeKind.BOOL}
"""Kinds that calculations take; a BOOL counts as 0 or 1."""

_IN_SECONDS: Final = (DATE, DATE_AND_TIME)
_MS_PER_S: Final = 1000
_TIMES: Final = frozenset([TypeKind.TIME, TypeKind.DATE])
_SHORT = ("AND_THEN", "OR_ELSE")
LOGIC: Final = frozenset(["AND", "OR", "XOR", "AND_THEN", "OR_ELSE"])


def takes(operator: str, data_type: Type) -> bool:
    """Return whether ``-`` or ``NOT`` takes a type."""
    kind = kind_of(data_type)
    if operator == "NOT":
        return kind is TypeKind.BOOL or kind is TypeKind.INTEGER
    return kind in (TypeKind.INTEGER, TypeKind.REAL, TypeKind.TIME)


def folded(operator: str, value: Constant) -> Constant | None:
    """Return ``-`` or ``NOT`` of a number or a BOOL that is written there, else None."""
    number = value.value
    if isinstance(number, str):
        return None
    if operator == "-" and not isinstance(number, bool):
        return Constant(value.type, -number)
    if operator == "NOT" and value.type is BOOL:
        return Constant(BOOL, not number)
    return None


def folded_pair(operator: str, left: Value, right: Value) -> Constant | None:
    """Return the result of two whole numbers without a type, as one more; else None."""
    if not (isinstance(left, Constant) and isinstance(right, Constant)):
        return None
    if left.type is not ANY_INT or right.type is not ANY_INT or operator not in _FOLDED:
        return None
    a, b = int(left.value), int(right.value)
    if b == 0 and operator in ("/", "MOD"):
        return Constant(ANY_INT, 0) if operator == "MOD" else None
    number = _FOLDED[operator](a, b)
    return Constant(ANY_INT, number) if abs(number) < 1 << 63 else None


def _quotient(a: int, b: int) -> int:
    return a // b if (a < 0) == (b < 0) else -(-a // b)


_FOLDED: Final[dict[str, Callable[[int, int], int]]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": _quotient,
    "MOD": lambda a, b: a - b * _quotient(a, b),
}


def negation(value: Value) -> Value | None:
    """Return NOT of a value, None if its type has none."""
    found = folded("NOT", value) if isinstance(value, Constant) else None
    if found is None and takes("NOT", value.type):
        return Unary(value.type, "NOT", value)
    return found


def widened(left: Value, right: Value) -> tuple[Value, Value]:
    """Return operands of which a number without a type has one where it does not fit the other's.

    Standard files have it so, for there a result keeps the width of its type.
    """
    return _widened(left, right), _widened(right, left)


def _widened(value: Value, other: Value) -> Value:
    if not isinstance(value, Constant) or value.type is not ANY_INT or other.type is ANY_INT:
        return value
    if kind_of(other.type) is not TypeKind.INTEGER:
        return value
    number, data_type = int(value.value), number_type(other.type)
    if data_type.minimum <= number <= data_type.maximum:
        return value
    found = next((t for t in _SIGNED if t.minimum <= number <= t.maximum), None)
    return value if found is None else Constant(found, number)


_SIGNED: Final = (SINT, INT, DINT, LINT)


def operation(operator: str, left: Value, right: Value) -> Value | None:
    """Return an operation on two values, None if there is none for their types."""
    left, right = as_character(left, right.type), as_character(right, left.type)
    if operator in COMPARISONS:
        operands = compared_type(left, right)
        return None if operands is None else Compare(BOOL, operator, operands, left, right)
    constant = folded_pair(operator, left, right)
    if constant is not None:
        return constant
    data_type = (
        _logic_type(left, right) if operator in LOGIC else _number_type(operator, left, right)
    )
    if data_type is None or (operator in _SHORT and data_type is not BOOL):
        return None
    return Binary(data_type, operator, left, right)


def dated(operator: str, left: Value, right: Value) -> Value | None:
    """Return a sum or a difference with a DATE or a DT, None for any other operation.

    These count seconds and a TIME milliseconds, which standard files need not know; Automation
    Studio takes the numbers as they are.
    """
    thousand = Constant(ANY_INT, _MS_PER_S)
    if operator == "+" and left.type is TIME:
        left, right = right, left
    if operator not in ("+", "-") or left.type not in _IN_SECONDS:
        return None
    if right.type is TIME:
        return Binary(left.type, operator, left, Binary(TIME, "/", right, thousand))
    if operator == "-" and right.type is left.type:
        return Binary(TIME, "*", Binary(TIME, "-", left, right), thousand)
    return None


def compared_type(left: Value, right: Value) -> Type | None:
    """Return the type in which two values are compared, None if they cannot be."""
    a, b = left.type, right.type
    kind, other = kind_of(a), kind_of(b)
    if kind in _TIMES and other in _TIMES and a.size != b.size:
        return None  # they count in other units
    if kind is other and kind not in NUMBERS:
        return None if kind in (TypeKind.STRUCT, TypeKind.ARRAY, TypeKind.VOID) else a
    if kind in CALCULABLE and other in CALCULABLE:
        is_truth = TypeKind.BOOL in (kind, other) and (
            _is_truth_value(left) or _is_truth_value(right)
        )
        return BOOL if is_truth else common_number(a, b)
    if kind in COUNTS and other in COUNTS:
        return b if kind is TypeKind.INTEGER else a
    if TypeKind.REFERENCE in (kind, other) and TypeKind.INTEGER in (kind, other):
        return UDINT
    return None


def _is_truth_value(value: Value) -> bool:
    return isinstance(value, Constant) and value.type is ANY_INT and value.value in (0, 1)


def _logic_type(left: Value, right: Value) -> Type | None:
    kind, other = kind_of(left.type), kind_of(right.type)
    if kind is TypeKind.BOOL and other is TypeKind.BOOL:
        return BOOL
    if kind is TypeKind.INTEGER and other is TypeKind.INTEGER:
        return common_number(left.type, right.type)
    if kind in CALCULABLE and other in CALCULABLE and TypeKind.REAL not in (kind, other):
        is_truth = _is_truth_value(left) or _is_truth_value(right)
        return BOOL if is_truth else common_number(left.type, right.type)
    return None


def _number_type(operator: str, left: Value, right: Value) -> Type | None:
    a, b = left.type, right.type
    kind, other = kind_of(a), kind_of(b)
    if kind is TypeKind.BOOL and other is TypeKind.BOOL:
        return None
    if operator == "**":
        return _power_type(a, b) if kind in NUMBERS and other in NUMBERS else None
    if kind in CALCULABLE and other in CALCULABLE:
        found = common_number(a, b)
        return None if operator == "MOD" and kind_of(found) is TypeKind.REAL else found
    if TypeKind.REFERENCE in (kind, other) and TypeKind.INTEGER in (kind, other):
        return UDINT if operator in ("+", "-") else None
    if kind in (TypeKind.TIME, TypeKind.DATE) or other in (TypeKind.TIME, TypeKind.DATE):
        return _time_type(operator, a, b)
    if kind is TypeKind.REFERENCE and other is TypeKind.REFERENCE and operator == "-":
        return DINT
    return None


def _power_type(base: Type, exponent: Type) -> Type:
    if LREAL in (base, exponent):
        return LREAL
    return REAL if REAL in (base, exponent) else ANY_REAL


def _time_type(operator: str, a: Type, b: Type) -> Type | None:
    """Return the type of an operation with a TIME or a date: whole numbers, as in C."""
    kinds = kind_of(a), kind_of(b)
    times = [t for t, kind in zip((a, b), kinds, strict=True) if kind in _TIMES]
    is_long = times[0].size > TIME.size
    if any(t.size != times[0].size for t in times):
        return None  # they count in other units
    duration = LTIME if is_long else TIME
    if any(kind not in (*COUNTS, TypeKind.REAL) for kind in kinds):
        return None
    if operator in ("*", "/", "MOD"):
        if kinds == (TypeKind.TIME, TypeKind.TIME):
            return (LINT if is_long else DINT) if operator == "/" else duration
        return duration if TypeKind.DATE not in kinds else None
    if operator not in ("+", "-") or TypeKind.REAL in kinds:
        return None
    if kinds == (TypeKind.DATE, TypeKind.DATE):
        return duration if operator == "-" and a is b else None
    return next(t for t in (a, b) if t in DATES) if TypeKind.DATE in kinds else duration


def mixes_signs(value: Value) -> bool:
    """Return True for a comparison of a signed and an unsigned number as unsigned ones."""
    if not isinstance(value, Compare) or not is_unsigned(value.operands):
        return False
    sides = (value.left, value.right)
    if kind_of(value.operands) is not TypeKind.INTEGER:
        return False
    return any(
        side.type is not ANY_INT
        and not isinstance(side, Constant)
        and kind_of(side.type) is TypeKind.INTEGER
        and not is_unsigned(number_type(side.type))
        for side in sides
    )
