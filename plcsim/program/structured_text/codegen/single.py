"""Calculations with LREALs that give the same with REALs, which takes fewer instructions.

Constants of a source are LREALs, so ``position > 100.0`` converts a REAL to compare it. Where every
operand is a REAL or a constant that a REAL can hold, the detour changes nothing: each REAL is an
LREAL and has the same order there; and one sum, difference, product or quotient that is rounded to
an LREAL of 53 bits and then to a REAL of 24 is the one that is rounded once, as 53 >= 2 * 24 + 2
(Figueroa, When is double rounding innocuous?, 1995).
"""

from __future__ import annotations

from ctypes import c_float
from typing import Final

from plcsim.program.structured_text import ir

_ROUNDED_ALIKE: Final = frozenset({"add", "sub", "mul", "div"})


def single_of(node: ir.Expression) -> ir.Expression | None:
    """Return the same value as a REAL; None where it is not known to be one."""
    if type(node) is ir.Convert and node.operator == "promote_f32":
        return node.operand
    if type(node) is ir.Const and c_float(node.value).value == node.value:
        return ir.Const("f32", node.value)
    return None


def single_comparison(node: ir.Compare) -> ir.Compare:
    """Return a comparison of REALs in place of one of LREALs, where it is the same."""
    left, right = single_of(node.left), single_of(node.right)
    if left is None or right is None:
        return node
    return ir.Compare("f32", node.operator, left, right)


def single_calculation(node: ir.Convert) -> ir.Expression:
    """Return what a REAL is calculated from in place of ``demote_f64``, where it is the same."""
    inner = node.operand
    if type(inner) is not ir.Binary or inner.operator not in _ROUNDED_ALIKE:
        return node
    left, right = single_of(inner.left), single_of(inner.right)
    if left is None or right is None:
        return node
    return ir.Binary("f32", inner.operator, left, right)
