"""Expressions: their instructions leave one value on the stack."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, Final

from plcsim.machine import opcodes
from plcsim.machine.encoder import f32, f64, memarg, sleb, uleb
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.body import NO_OFFSET
from plcsim.program.structured_text.codegen.copies import join
from plcsim.program.structured_text.codegen.operators import (
    COMPARISONS,
    CONVERSIONS,
    LOAD,
    OPERATORS,
    VALUE_TYPES,
)
from plcsim.program.structured_text.codegen.places import Indexed, indexed
from plcsim.program.structured_text.codegen.single import single_calculation, single_comparison

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.program.structured_text.codegen.body import FunctionWriter


@cache
def local_get(index: int) -> bytes:
    """Return the instruction that gives the value of a local."""
    return opcodes.LOCAL_GET + uleb(index)


@cache
def local_tee(index: int) -> bytes:
    """Return the instruction that sets a local and leaves the value."""
    return opcodes.LOCAL_TEE + uleb(index)


Offset = bytes | Indexed
"""What an access adds to the address on the stack: a memory argument, or one with a hole."""


def emit(body: FunctionWriter, expression: ir.Expression) -> None:
    """Append the instructions of an expression.

    Chains of operators, which may be as long as a program, take no depth of Python's stack.
    """
    left_over: list[Any] = [expression]
    while left_over:
        node = left_over.pop()
        kind = type(node)
        if kind is bytes:
            body.code += node
        elif kind is ir.Binary:
            left_over += OPERATORS[node.type, node.operator], node.right, node.left
        elif kind is ir.Compare:
            if node.operands == "f64":
                node = single_comparison(node)
            left_over += COMPARISONS[node.operands, node.operator], node.right, node.left
        elif kind is ir.Unary:
            left_over += OPERATORS[node.type, node.operator], node.operand
        elif kind is ir.Convert and node.operator not in _REAL_OPERAND:
            if node.operator == "demote_f64" and (same := single_calculation(node)) is not node:
                left_over.append(same)
            else:
                left_over += CONVERSIONS[node.type, node.operator], node.operand
        elif kind is ir.Select:
            left_over += opcodes.SELECT, node.condition, node.other, node.then
        else:
            _EMIT[kind](body, node)


def address(body: FunctionWriter, place: ir.Place) -> Offset:
    """Append the instructions of an address; what they leave out is for `access`."""
    base = place.base
    if isinstance(base, ir.Segment):
        body.code += opcodes.I32_CONST
        body.hole(base, place.offset)
        return NO_OFFSET
    found = indexed(place)
    if found is None:
        emit(body, base)
        return memarg(place.offset)
    _emit_terms(body, found.terms)
    return found


def _emit_terms(body: FunctionWriter, terms: list[tuple[ir.Expression, int]]) -> None:
    """Append the sum of an address's terms."""
    if not terms:
        body.code += opcodes.I32_CONST + b"\0"
    for place, (index, factor) in enumerate(terms):
        emit(body, index)
        if factor != 1:
            body.code += i32_const(factor) + opcodes.I32_MUL
        if place:
            body.code += opcodes.I32_ADD


def access(body: FunctionWriter, opcode: bytes, offset: Offset) -> None:
    """Append a load or a store whose address `address` has begun."""
    body.code += opcode
    if isinstance(offset, bytes):
        body.code += offset
    else:
        body.code += b"\0"  # alignment
        body.hole(offset.segment, offset.offset)


def _load(body: FunctionWriter, node: ir.Load) -> None:
    key = body.key_of(node.place, node.width)
    local = body.copies.local_of(key) if key else None
    if local is not None:
        body.code += local_get(local)
        return
    access(body, LOAD[node.width], address(body, node.place))
    local = body.copies.note(key) if key else None
    if local is not None:
        body.code += local_tee(local)


def _address_of(body: FunctionWriter, node: ir.AddressOf) -> None:
    place = node.place
    if isinstance(place.base, ir.Segment):
        body.code += opcodes.I32_CONST
        body.hole(place.base, place.offset)
        return
    emit(body, place.base)
    if place.offset:
        body.code += i32_const(place.offset) + opcodes.I32_ADD


def _local(body: FunctionWriter, node: ir.Local) -> None:
    body.code += local_get(node.index)


def _const(body: FunctionWriter, node: ir.Const) -> None:
    body.code += _CONST[node.type](node.value)


def i32_const(value: int) -> bytes:
    """Return the instruction of an i32, given signed or unsigned."""
    return opcodes.I32_CONST + sleb(_signed(value, 32))


def _signed(value: float, bits: int) -> int:
    number = int(value) & ((1 << bits) - 1)
    return number - (number >> (bits - 1) << bits)


_CONST: Final[Mapping[ir.ValueType, Callable[[float], bytes]]] = {
    "i32": lambda value: opcodes.I32_CONST + sleb(_signed(value, 32)),
    "i64": lambda value: opcodes.I64_CONST + sleb(_signed(value, 64)),
    "f32": lambda value: opcodes.F32_CONST + f32(value),
    "f64": lambda value: opcodes.F64_CONST + f64(value),
}


def _truncate(body: FunctionWriter, node: ir.Convert) -> None:
    """Append a conversion towards zero, to the integer indefinite where the value does not fit.

    The absolute value is compared, so NaN does not fit either; the smallest integer does not, and
    becomes itself.
    """
    emit(body, node.operand)
    real, result = _REAL_OPERAND[node.operator], node.type
    bits = 32 if result == "i32" else 64
    scratch = uleb(body.scratch(VALUE_TYPES[real]))
    body.code += opcodes.LOCAL_TEE + scratch + OPERATORS[real, "abs"]
    body.code += _CONST[real](2.0 ** (bits - 1)) + COMPARISONS[real, "lt"]
    body.code += opcodes.IF + bytes([VALUE_TYPES[result]])
    body.code += opcodes.LOCAL_GET + scratch + CONVERSIONS[result, node.operator]
    body.code += opcodes.ELSE + _CONST[result](1 << (bits - 1)) + opcodes.END


_REAL_OPERAND: Final[Mapping[ir.ConvertOperator, ir.ValueType]] = {
    "trunc_f32_s": "f32",
    "trunc_f64_s": "f64",
}


def _if_expression(body: FunctionWriter, node: ir.IfExpression) -> None:
    emit(body, node.condition)
    start = body.copies.fork()
    body.open(opcodes.IF, bytes([VALUE_TYPES[node.type]]))
    emit(body, node.then)
    then, body.copies.known = body.copies.known, start
    body.code += opcodes.ELSE
    emit(body, node.other)
    body.close()
    body.copies.known = join(then, body.copies.known)


def _call(body: FunctionWriter, node: ir.Call) -> None:
    if node.function == "rt.string_compare":
        _compare_strings(body, node)
        return
    for argument in node.arguments:
        emit(body, argument)
    body.code += opcodes.CALL + uleb(body.indices[node.function])
    body.copies.forget_roots(body.effects.of_call(node))


def _compare_strings(body: FunctionWriter, node: ir.Call) -> None:
    """Append a comparison that calls the helper only where the first characters are the same."""
    left, right, difference = (uleb(body.scratch(opcodes.I32, slot)) for slot in range(3))
    for argument in node.arguments:
        emit(body, argument)
    first = opcodes.I32_LOAD8_U + memarg()
    body.code += opcodes.LOCAL_SET + right + opcodes.LOCAL_TEE + left + first
    body.code += opcodes.LOCAL_GET + right + first + opcodes.I32_SUB + opcodes.LOCAL_TEE
    body.code += difference + opcodes.IF + bytes([opcodes.I32])
    body.code += opcodes.LOCAL_GET + difference + opcodes.ELSE
    body.code += opcodes.LOCAL_GET + left + opcodes.LOCAL_GET + right
    body.code += opcodes.CALL + uleb(body.indices[node.function]) + opcodes.END


def _checked(body: FunctionWriter, node: ir.Checked) -> None:
    emit(body, node.index)
    scratch = uleb(body.scratch(opcodes.I32))
    body.code += opcodes.LOCAL_TEE + scratch
    body.code += i32_const(node.count) + opcodes.I32_GE_U
    body.trap_if("index")
    body.code += opcodes.LOCAL_GET + scratch


def _statement_expression(body: FunctionWriter, node: ir.StatementExpression) -> None:
    body.statements(body, node.statements)
    emit(body, node.value)


_EMIT: Final[Mapping[type, Callable[[FunctionWriter, Any], None]]] = {
    ir.Const: _const,
    ir.Load: _load,
    ir.Local: _local,
    ir.AddressOf: _address_of,
    ir.Convert: _truncate,
    ir.IfExpression: _if_expression,
    ir.Call: _call,
    ir.Checked: _checked,
    ir.StatementExpression: _statement_expression,
}
