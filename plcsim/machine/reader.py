"""Reads the outer structure of WebAssembly modules: sections, numbers, names.

What a compiler of C hands over is looked into here before it is compiled.

Source: WebAssembly Core Specification 2.0, chapter 5 (binary format).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from plcsim.machine.errors import MachineError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

HEADER = b"\0asm\x01\0\0\0"
CUSTOM, TYPES, IMPORTS, FUNCTIONS, TABLES, MEMORIES, GLOBALS, EXPORTS = range(8)
START, ELEMENTS, CODE, DATA, DATA_COUNT = range(8, 13)
"""Numbers of sections."""


class Reader:
    """Reads values from an offset in bytes on; the offset moves on with each.

    Raises:
        MachineError: from any method, where the bytes end too early or make no sense.
    """

    __slots__ = ("_data", "end", "offset")

    def __init__(self, data: bytes, offset: int = 0, end: int | None = None) -> None:
        self._data = data
        self.offset = offset
        self.end = len(data) if end is None else min(end, len(data))

    @property
    def more(self) -> bool:
        """Whether there is something left."""
        return self.offset < self.end

    def byte(self) -> int:
        """Read one byte."""
        if self.offset >= self.end:
            raise MachineError("the module ends in the middle of something")
        self.offset += 1
        return self._data[self.offset - 1]

    def bytes(self, count: int) -> bytes:
        """Read some bytes."""
        if count > self.end - self.offset:
            raise MachineError("the module ends in the middle of something")
        self.offset += count
        return self._data[self.offset - count : self.offset]

    def uleb(self) -> int:
        """Read an unsigned LEB128 number of at most 64 bits."""
        value = 0
        for shift in range(0, 70, 7):
            byte = self.byte()
            value |= (byte & 0x7F) << shift
            if byte < 0x80:
                return value
        raise MachineError("a number in the module is too long")

    def sleb(self) -> int:
        """Read a signed LEB128 number of at most 64 bits."""
        start = self.offset
        value = self.uleb()
        bits = 7 * (self.offset - start)
        return value - (1 << bits) if value >> (bits - 1) else value

    def name(self) -> str:
        """Read a name."""
        return self.bytes(self.uleb()).decode("utf-8", "replace")


class ModuleSection(NamedTuple):
    """A section of a module.

    Attributes:
        number: `CUSTOM` and so on.
        name: of a custom section, "" of others.
        start: offset of its content in the module.
        end: offset behind it.
    """

    number: int
    name: str
    start: int
    end: int


def sections(wasm: bytes) -> Iterator[ModuleSection]:
    """Yield the sections of a module.

    Raises:
        MachineError: it is no module.
    """
    if not wasm.startswith(HEADER):
        raise MachineError("this is no WebAssembly module of version 1")
    reader = Reader(wasm, len(HEADER))
    while reader.more:
        number, size = reader.byte(), reader.uleb()
        start = reader.offset
        reader.bytes(size)
        inner = Reader(wasm, start, start + size)
        name = inner.name() if number == CUSTOM else ""
        yield ModuleSection(number, name, inner.offset, start + size)


class ModuleImport(NamedTuple):
    """An import of a module.

    Attributes:
        module: first part of its name.
        name: second part.
        kind: 0 a function, 1 a table, 2 a memory, 3 a global variable.
        type: index of the type of a function, value type of a variable.
        mutable: of a variable.
        start: offset of the entry in the module.
        end: offset behind it.
    """

    module: str
    name: str
    kind: int
    type: int
    mutable: bool
    start: int
    end: int


FUNCTION, TABLE, MEMORY, GLOBAL = range(4)
"""Kinds of imports and exports in the binary format."""


def imports(wasm: bytes, section: ModuleSection) -> Iterator[ModuleImport]:
    """Yield the entries of an import section."""
    reader = Reader(wasm, section.start, section.end)
    for _ in range(reader.uleb()):
        start = reader.offset
        module, name, kind = reader.name(), reader.name(), reader.byte()
        type_, mutable = 0, False
        if kind == FUNCTION:
            type_ = reader.uleb()
        elif kind == GLOBAL:
            type_, mutable = reader.byte(), bool(reader.byte())
        elif kind in (TABLE, MEMORY):
            _skip_limits(reader, kind)
        else:
            raise MachineError(f"import {module}.{name} is of the unknown kind {kind}")
        yield ModuleImport(module, name, kind, type_, mutable, start, reader.offset)


def _skip_limits(reader: Reader, kind: int) -> None:
    if kind == TABLE:
        reader.byte()
    flags = reader.uleb()
    reader.uleb()
    if flags & 1:
        reader.uleb()


def function_types(wasm: bytes, section: ModuleSection) -> Iterator[tuple[bytes, bytes]]:
    """Yield parameters and results of each type of a type section, one byte for each value.

    Raises:
        MachineError: it is none of a function.
    """
    reader = Reader(wasm, section.start, section.end)
    for _ in range(reader.uleb()):
        if reader.byte() != _FUNCTION_TYPE:
            raise MachineError("a module has a type that is none of a function")
        yield reader.bytes(reader.uleb()), reader.bytes(reader.uleb())


_FUNCTION_TYPE = 0x60


def exports(wasm: bytes, section: ModuleSection) -> Iterator[tuple[str, int, int]]:
    """Yield name, kind and index of each export."""
    reader = Reader(wasm, section.start, section.end)
    for _ in range(reader.uleb()):
        yield reader.name(), reader.byte(), reader.uleb()


_I32_CONST, _GLOBAL_GET, _I32_ADD, _I32_SUB, _END = 0x41, 0x23, 0x6A, 0x6B, 0x0B


def constant(reader: Reader, variables: Mapping[int, int]) -> int:
    """Read a constant expression of type i32 and return its value, unsigned.

    Args:
        reader: at the expression.
        variables: values of the global variables that it may name.
    """
    stack: list[int] = []
    while (code := reader.byte()) != _END:
        if code == _I32_CONST:
            stack.append(reader.sleb())
        elif code == _GLOBAL_GET and (index := reader.uleb()) in variables:
            stack.append(variables[index])
        elif code in (_I32_ADD, _I32_SUB) and len(stack) > 1:
            right, left = stack.pop(), stack.pop()
            stack.append(left + right if code == _I32_ADD else left - right)
        else:
            raise MachineError("a module has a constant that cannot be worked out")
    if len(stack) != 1:
        raise MachineError("a module has a constant that cannot be worked out")
    return stack[0] & 0xFFFF_FFFF
