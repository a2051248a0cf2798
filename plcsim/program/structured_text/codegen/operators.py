"""The operators, widths and value types of the intermediate representation as instructions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, get_args

from plcsim.machine import opcodes
from plcsim.program.structured_text import ir

if TYPE_CHECKING:
    from collections.abc import Mapping

VALUE_TYPES: Final[Mapping[ir.ValueType, int]] = {
    "i32": opcodes.I32,
    "i64": opcodes.I64,
    "f32": opcodes.F32,
    "f64": opcodes.F64,
}

LOAD: Final[Mapping[ir.Width, bytes]] = {
    "s8": opcodes.I32_LOAD8_S,
    "u8": opcodes.I32_LOAD8_U,
    "s16": opcodes.I32_LOAD16_S,
    "u16": opcodes.I32_LOAD16_U,
    "w32": opcodes.I32_LOAD,
    "w64": opcodes.I64_LOAD,
    "f32": opcodes.F32_LOAD,
    "f64": opcodes.F64_LOAD,
}

STORE: Final[Mapping[ir.Width, bytes]] = {
    "s8": opcodes.I32_STORE8,
    "u8": opcodes.I32_STORE8,
    "s16": opcodes.I32_STORE16,
    "u16": opcodes.I32_STORE16,
    "w32": opcodes.I32_STORE,
    "w64": opcodes.I64_STORE,
    "f32": opcodes.F32_STORE,
    "f64": opcodes.F64_STORE,
}

NARROW: Final[Mapping[ir.Width, bytes]] = {
    "s8": opcodes.I32_EXTEND8_S,
    "u8": opcodes.I32_CONST + b"\xff\x01" + opcodes.I32_AND,
    "s16": opcodes.I32_EXTEND16_S,
    "u16": opcodes.I32_CONST + b"\xff\xff\x03" + opcodes.I32_AND,
}
"""What makes of an i32 the value that a load finds after a store of this width."""


def _table(operators: tuple[str, ...]) -> dict[tuple[str, str], bytes]:
    """Return the instruction of each type and operator that WebAssembly has together."""
    names = {(t, o): f"{t}_{o}".upper() for t in VALUE_TYPES for o in operators}
    return {key: vars(opcodes)[name] for key, name in names.items() if hasattr(opcodes, name)}


OPERATORS: Final[Mapping[tuple[str, str], bytes]] = _table(
    get_args(ir.UnaryOperator) + get_args(ir.BinaryOperator)
)
"""By type and operator, those of `ir.Unary` and `ir.Binary`."""

COMPARISONS: Final[Mapping[tuple[str, str], bytes]] = _table(get_args(ir.CompareOperator))
"""By the type of the operands and operator."""

CONVERSIONS: Final[Mapping[tuple[str, str], bytes]] = _table(get_args(ir.ConvertOperator))
"""By the type of the result and operator; the truncations trap where `ir.Convert` must not."""
