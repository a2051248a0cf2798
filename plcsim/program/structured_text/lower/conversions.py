"""Conversions between values of the stack, as C makes them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.ir import (
    Binary,
    Compare,
    Const,
    Convert,
    Expression,
    IfExpression,
)
from plcsim.program.structured_text.lower.memory import width_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.program.structured_text import ir
    from plcsim.program.structured_text.check.kinds import Type

_RANKS: Final[Mapping[ir.ValueType, int]] = {"i32": 0, "i64": 1, "f32": 2, "f64": 3}


def common_type(a: ir.ValueType, b: ir.ValueType) -> ir.ValueType:
    """Return the type in which C calculates with two values."""
    return a if _RANKS[a] >= _RANKS[b] else b


def to_type(value: Expression, wanted: ir.ValueType, *, unsigned: bool) -> Expression:
    """Return ``value`` in a type that can hold it, or the low bits of a larger integer.

    Args:
        value: of any type.
        wanted: not an integer type where ``value`` is REAL or LREAL.
        unsigned: ``value`` is an unsigned integer of its full width.
    """
    given = value.type
    if given == wanted or given is None:
        return value
    if isinstance(value, Const):
        return Const(wanted, _constant(value, wanted, unsigned=unsigned))
    if wanted == "i32":
        return Convert("i32", "wrap_i64", value)
    if wanted == "i64":
        return Convert("i64", "extend_i32_u" if unsigned else "extend_i32_s", value)
    if given in ("f32", "f64"):
        return Convert(wanted, "promote_f32" if wanted == "f64" else "demote_f64", value)
    if given == "i32":
        return Convert(wanted, "convert_i32_u" if unsigned else "convert_i32_s", value)
    return Convert(wanted, "convert_i64_u" if unsigned else "convert_i64_s", value)


def _constant(value: Const, wanted: ir.ValueType, *, unsigned: bool) -> int | float:
    number = value.value
    if wanted in ("f32", "f64"):
        if isinstance(number, int):
            number = as_integer(number, value.type, unsigned=unsigned)
        return float(number)
    return int(number)


def as_integer(number: int, value_type: ir.ValueType, *, unsigned: bool) -> int:
    """Return the number that the bits of an i32 or i64 stand for."""
    bits = 32 if value_type == "i32" else 64
    number &= (1 << bits) - 1
    return number if unsigned or number < 1 << bits - 1 else number - (1 << bits)


_NARROW_SIGNED: Final[Mapping[ir.Width, ir.ConvertOperator]] = {
    "s8": "extend8_s",
    "s16": "extend16_s",
}
_MASKS: Final[Mapping[ir.Width, int]] = {"u8": 0xFF, "u16": 0xFFFF}


def narrowed(value: Expression, target: Type) -> Expression:
    """Return an i32 cut to the width of ``target`` and extended again, as a C cast does."""
    width = width_of(target)
    if width in _MASKS:
        if isinstance(value, Const):
            return Const("i32", int(value.value) & _MASKS[width])
        return Binary("i32", "and", value, Const("i32", _MASKS[width]))
    if width not in _NARROW_SIGNED:
        return value
    if isinstance(value, Const):
        bits = 8 if width == "s8" else 16
        number = int(value.value) & (1 << bits) - 1
        return Const("i32", number - (1 << bits) if number >> bits - 1 else number)
    return Convert("i32", _NARROW_SIGNED[width], value)


def truth(value: Expression) -> Expression:
    """Return 1 where ``value`` is not 0, else 0."""
    if isinstance(value, Compare):
        return value
    assert value.type is not None
    return Compare(value.type, "ne", value, zero(value.type))


def zero(value_type: ir.ValueType) -> Const:
    """Return 0 of a type."""
    return Const(value_type, 0.0 if value_type in ("f32", "f64") else 0)


def negated(condition: Expression) -> Expression:
    """Return 1 where ``condition`` is 0, else 0."""
    assert condition.type is not None
    return Compare(condition.type, "eq", condition, zero(condition.type))


def rounded(value: Expression) -> Expression:
    """Return an LREAL with half of 1 added away from zero: what is cut off next is rounded."""
    half = Const("f64", 0.5)
    return IfExpression(
        "f64",
        Compare("f64", "ge", value, Const("f64", 0.0)),
        Binary("f64", "add", value, half),
        Binary("f64", "sub", value, half),
    )


def truncated(value: Expression, target: Type) -> Expression:
    """Return an f64 cut to an integer of ``target``, as gcc does it on Intel.

    Signed types up to 32 bits, and unsigned ones below, go through an int; UDINT and the 64-bit
    types through a long long, ULINT by its upper half too.
    """
    width = width_of(target)
    if width == "w64":
        unsigned = getattr(target, "minimum", -1) == 0
        return _to_unsigned_64(value) if unsigned else Convert("i64", "trunc_f64_s", value)
    if width == "w32" and getattr(target, "minimum", -1) == 0:
        return Convert("i32", "wrap_i64", Convert("i64", "trunc_f64_s", value))
    return narrowed(Convert("i32", "trunc_f64_s", value), target)


def _to_unsigned_64(value: Expression) -> Expression:
    half = Const("f64", float(1 << 63))
    return IfExpression(
        "i64",
        Compare("f64", "lt", value, half),
        Convert("i64", "trunc_f64_s", value),
        Binary(
            "i64",
            "xor",
            Convert("i64", "trunc_f64_s", Binary("f64", "sub", value, half)),
            Const("i64", -(1 << 63)),
        ),
    )
