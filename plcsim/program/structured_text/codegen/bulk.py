"""CopyBytes and FillBytes: a few bytes by single accesses, more by helpers.

The instructions of WebAssembly for this are not used: a page that is not valid would end the
process instead of the program.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.machine import opcodes
from plcsim.machine.encoder import memarg, sleb, uleb
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.accesses import roots_of
from plcsim.program.structured_text.codegen.expressions import emit

if TYPE_CHECKING:
    from plcsim.program.structured_text.codegen.body import FunctionWriter

MOST_INLINE: Final = 64
"""Bytes that are moved by single accesses."""

_STEPS: Final = (
    (8, opcodes.I64_LOAD, opcodes.I64_STORE),
    (4, opcodes.I32_LOAD, opcodes.I32_STORE),
    (2, opcodes.I32_LOAD16_U, opcodes.I32_STORE16),
    (1, opcodes.I32_LOAD8_U, opcodes.I32_STORE8),
)

Step = tuple[int, bytes, bytes]
"""Offset of an access, its load and its store."""


def _steps(count: int) -> list[Step]:
    """Return the accesses that cover some bytes."""
    found: list[Step] = []
    offset = 0
    for size, load, store in _STEPS:
        while count - offset >= size:
            found.append((offset, load, store))
            offset += size
    return found


def copy_bytes(body: FunctionWriter, node: ir.CopyBytes) -> None:
    """Append a copy."""
    count = _inline_count(node.count)
    if count is None:
        _call(body, "rt.copy", node.target, node.source, node.count)
    else:
        _copy_inline(body, node, count)
    body.copies.forget_roots(roots_of(node.target))


def fill_bytes(body: FunctionWriter, node: ir.FillBytes) -> None:
    """Append a fill."""
    count = _inline_count(node.count)
    if count is None or type(node.value) is not ir.Const:
        _call(body, "rt.fill", node.target, node.value, node.count)
    else:
        _fill_inline(body, node.target, int(node.value.value) & 0xFF, count)
    body.copies.forget_roots(roots_of(node.target))


def _inline_count(count: ir.Expression) -> int | None:
    if type(count) is ir.Const and 0 <= count.value <= MOST_INLINE:
        return int(count.value)
    return None


def _call(body: FunctionWriter, helper: str, *arguments: ir.Expression) -> None:
    for argument in arguments:
        emit(body, argument)
    body.code += opcodes.CALL + uleb(body.indices[helper])


def _copy_inline(body: FunctionWriter, node: ir.CopyBytes, count: int) -> None:
    """Append all loads, then all stores: the parts may overlap."""
    emit(body, node.target)
    emit(body, node.source)
    target, source = (uleb(body.scratch(opcodes.I32, slot)) for slot in (0, 1))
    body.code += opcodes.LOCAL_SET + source + opcodes.LOCAL_SET + target
    steps = _steps(count)
    for offset, load, _ in steps:
        body.code += opcodes.LOCAL_GET + target + opcodes.LOCAL_GET + source + load + memarg(offset)
    for offset, _, store in reversed(steps):
        body.code += store + memarg(offset)


def _fill_inline(body: FunctionWriter, address: ir.Expression, value: int, count: int) -> None:
    emit(body, address)
    target = uleb(body.scratch(opcodes.I32))
    body.code += opcodes.LOCAL_SET + target
    number = int.from_bytes(bytes([value]) * 8, "little", signed=True)
    for offset, load, store in _steps(count):
        body.code += opcodes.LOCAL_GET + target
        if load == opcodes.I64_LOAD:
            body.code += opcodes.I64_CONST + sleb(number)
        else:
            body.code += opcodes.I32_CONST + sleb(number >> 32)
        body.code += store + memarg(offset)
