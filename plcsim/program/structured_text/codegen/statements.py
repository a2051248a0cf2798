"""Statements: their instructions leave nothing on the stack."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.machine import opcodes
from plcsim.machine.encoder import uleb
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.branches import block, branch, if_
from plcsim.program.structured_text.codegen.bulk import copy_bytes, fill_bytes
from plcsim.program.structured_text.codegen.expressions import access, address, emit, local_tee
from plcsim.program.structured_text.codegen.loops import loop
from plcsim.program.structured_text.codegen.operators import NARROW, STORE
from plcsim.program.structured_text.codegen.switch import switch

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.program.structured_text.codegen.body import FunctionWriter


def statements(body: FunctionWriter, sequence: Sequence[ir.Statement]) -> None:
    """Append the instructions of statements, as far as some path leads to them."""
    for statement in sequence:
        if body.copies.known is None:
            return
        body.mark(statement.line)
        _STATEMENTS[type(statement)](body, statement)


def _store(body: FunctionWriter, node: ir.Store) -> None:
    width = node.width
    offset = address(body, node.place)
    emit(body, node.value)
    key = body.key_of(node.place, width)
    local = body.copies.note(key) if key else None
    if local is not None:
        if width in NARROW and not fits(node.value, width):
            body.code += NARROW[width]
        body.code += local_tee(local)
    access(body, STORE[width], offset)
    if key:
        body.copies.forget_met(key)
    else:
        body.copies.forget_roots((node.place.root,))


def fits(value: ir.Expression, width: ir.Width) -> bool:
    """Tell whether an i32 surely is what a load finds after it was stored."""
    left_over = [value]
    while left_over:
        node = left_over.pop()
        if isinstance(node, ir.Binary) and node.operator in _BITWISE:
            left_over += node.left, node.right
        elif type(node) not in _FITS or not _FITS[type(node)](node, width):
            return False
    return True


_RANGES: Final[Mapping[ir.Width, tuple[int, int]]] = {
    "s8": (-0x80, 0x7F),
    "u8": (0, 0xFF),
    "s16": (-0x8000, 0x7FFF),
    "u16": (0, 0xFFFF),
}
_EXTENSIONS: Final = frozenset({("extend8_s", "s8"), ("extend16_s", "s16")})
_FITS: Final[Mapping[type, Callable[[Any, ir.Width], bool]]] = {
    ir.Load: lambda node, width: node.width == width,
    ir.Compare: lambda _node, _width: True,
    ir.Const: lambda node, width: _RANGES[width][0] <= node.value <= _RANGES[width][1],
    ir.Convert: lambda node, width: (node.operator, width) in _EXTENSIONS,
}
_BITWISE: Final = frozenset({"and", "or", "xor"})


def _set_local(body: FunctionWriter, node: ir.SetLocal) -> None:
    emit(body, node.value)
    body.code += opcodes.LOCAL_SET + uleb(node.index)


def _evaluate(body: FunctionWriter, node: ir.Evaluate) -> None:
    emit(body, node.value)
    if node.value.type is not None:
        body.code += opcodes.DROP


def _return(body: FunctionWriter, node: ir.Return) -> None:
    if node.value is not None:
        emit(body, node.value)
    body.return_()
    body.copies.known = None


_STATEMENTS: Final[Mapping[type, Callable[[FunctionWriter, Any], None]]] = {
    ir.Store: _store,
    ir.SetLocal: _set_local,
    ir.Evaluate: _evaluate,
    ir.If: if_,
    ir.Switch: switch,
    ir.Block: block,
    ir.Loop: loop,
    ir.Break: branch,
    ir.Continue: branch,
    ir.Return: _return,
    ir.CopyBytes: copy_bytes,
    ir.FillBytes: fill_bytes,
}
