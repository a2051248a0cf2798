"""Writes a WebAssembly module as text, which wasmtime's own assembler takes.

Source: WebAssembly Core Specification 2.0, chapters 5 (binary format) and 6 (text format).
"""

from __future__ import annotations

import math
import struct
from typing import TYPE_CHECKING, Final

from plcsim.machine import opcodes, reader
from plcsim.machine.errors import MachineError
from plcsim.machine.reader import Reader

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

_VALUE_TYPES: Final = {
    opcodes.I32: "i32",
    opcodes.I64: "i64",
    opcodes.F32: "f32",
    opcodes.F64: "f64",
    opcodes.FUNCREF: "funcref",
}
_DOTTED: Final = frozenset(["i32", "i64", "f32", "f64", "local", "global", "memory"])


def _mnemonic(name: str) -> str:
    first, _, rest = name.lower().partition("_")
    return f"{first}.{rest}" if first in _DOTTED else name.lower()


_NAMES: Final = {
    value: _mnemonic(name)
    for name, value in vars(opcodes).items()
    if name.isupper() and isinstance(value, bytes) and name != "EMPTY"
}
_OPENING: Final = frozenset([opcodes.BLOCK, opcodes.LOOP, opcodes.IF])
_INDEXED: Final = frozenset(
    [
        *(opcodes.BR, opcodes.BR_IF, opcodes.CALL),
        *(opcodes.LOCAL_GET, opcodes.LOCAL_SET, opcodes.LOCAL_TEE),
        *(opcodes.GLOBAL_GET, opcodes.GLOBAL_SET),
    ]
)


class _Signature:
    """A type of functions."""

    def __init__(self, parameters: Sequence[str], results: Sequence[str]) -> None:
        self.parameters = parameters
        self.results = results

    def __str__(self) -> str:
        words = (("param", self.parameters), ("result", self.results))
        return "".join(f" ({word} {' '.join(types)})" for word, types in words if types)


def wat(wasm: bytes, note: Callable[[int], str] = lambda _offset: "") -> Iterator[str]:
    """Yield the lines of a module as text.

    Sections of data and of elements, which our compilers do not write, are left out.

    Args:
        wasm: the module.
        note: gives a comment for the instruction at an offset of the module, "" for none.

    Raises:
        MachineError: it is no module, or has instructions that our compilers do not write.
    """
    yield "(module"
    types: list[_Signature] = []
    functions: list[int] = []
    names: dict[int, str] = {}
    imported = 0
    for section in reader.sections(wasm):
        source = Reader(wasm, section.start, section.end)
        if section.number == reader.TYPES:
            types = [_signature(source) for _ in range(source.uleb())]
        elif section.number == reader.IMPORTS:
            for each in reader.imports(wasm, section):
                yield f"  {_import(each, types, imported)}"
                imported += each.kind == reader.FUNCTION
        elif section.number == reader.FUNCTIONS:
            functions = [source.uleb() for _ in range(source.uleb())]
        elif section.number == reader.EXPORTS:
            for name, kind, index in reader.exports(wasm, section):
                if kind == reader.FUNCTION:
                    names[index] = name
        elif section.number == reader.CODE:
            for place in range(source.uleb()):
                index, size = imported + place, source.uleb()
                body = Reader(wasm, source.offset, source.offset + size)
                yield from _function(body, index, types[functions[place]], names.get(index), note)
                source.bytes(size)
    yield ")"


def _signature(source: Reader) -> _Signature:
    source.byte()  # 0x60
    return _Signature(_types(source), _types(source))


def _types(source: Reader) -> list[str]:
    return [_VALUE_TYPES[source.byte()] for _ in range(source.uleb())]


def _import(each: reader.ModuleImport, types: Sequence[_Signature], number: int) -> str:
    what = {reader.TABLE: "(table 0 funcref)", reader.MEMORY: "(memory 0)"}.get(each.kind, "")
    if each.kind == reader.FUNCTION:
        what = f"(func (;{number};){types[each.type]})"
    elif each.kind == reader.GLOBAL:
        what = f"(global {_global(each)})"
    return f'(import "{each.module}" "{each.name}" {what})'


def _global(each: reader.ModuleImport) -> str:
    kind = _VALUE_TYPES[each.type]
    return f"(mut {kind})" if each.mutable else kind


def _function(
    body: Reader,
    index: int,
    signature: _Signature,
    name: str | None,
    note: Callable[[int], str],
) -> Iterator[str]:
    exported = "" if name is None else f' (export "{name}")'
    yield f"  (func (;{index};){exported}{signature}"
    for _ in range(body.uleb()):
        count, kind = body.uleb(), _VALUE_TYPES[body.byte()]
        yield f"    (local{f' {kind}' * count})"
    depth = 2
    while body.offset < body.end - 1:
        comment = note(body.offset)
        opcode, text = _instruction(body)
        depth -= opcode in (opcodes.END, opcodes.ELSE)
        yield f"{'  ' * depth}{text}{f'  ;; {comment}' if comment else ''}"
        depth += opcode in _OPENING or opcode == opcodes.ELSE
    yield "  )"


def _instruction(body: Reader) -> tuple[bytes, str]:
    opcode = bytes([body.byte()])
    name = _NAMES.get(opcode)
    if name is None:
        raise MachineError(f"an instruction {opcode.hex()} that no compiler here writes")
    operands = _operands(opcode, body)
    return opcode, f"{name} {operands}" if operands else name


def _operands(opcode: bytes, body: Reader) -> str:
    if opcode in _OPENING:
        kind = body.byte()
        return "" if bytes([kind]) == opcodes.EMPTY else f"(result {_VALUE_TYPES[kind]})"
    if opcode in _INDEXED:
        return str(body.uleb())
    if opcodes.I32_LOAD <= opcode <= opcodes.I64_STORE32:
        alignment, offset = body.uleb(), body.uleb()
        return f"offset={offset} align={1 << alignment}"
    if opcode in (opcodes.I32_CONST, opcodes.I64_CONST):
        return str(body.sleb())
    if opcode in (opcodes.F32_CONST, opcodes.F64_CONST):
        return _real(body, wide=opcode == opcodes.F64_CONST)
    if opcode == opcodes.BR_TABLE:
        return " ".join(str(body.uleb()) for _ in range(body.uleb() + 1))
    if opcode == opcodes.CALL_INDIRECT:
        kind, table = body.uleb(), body.uleb()
        return f"{table} (type {kind})"
    if opcode in (opcodes.MEMORY_SIZE, opcodes.MEMORY_GROW):
        body.byte()
    return ""


def _real(body: Reader, *, wide: bool) -> str:
    """Return a number with a point so that it is read back with the same bits."""
    data = body.bytes(8 if wide else 4)
    value = float(struct.unpack("<d" if wide else "<f", data)[0])
    if math.isnan(value):
        (bits,) = struct.unpack("<Q" if wide else "<I", data)
        top = 52 if wide else 23
        sign = "-" if bits >> (63 if wide else 31) else ""
        return f"{sign}nan:0x{bits & ((1 << top) - 1):x}"
    return str(value) if math.isinf(value) else value.hex()
