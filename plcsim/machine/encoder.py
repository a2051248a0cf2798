"""Writes WebAssembly modules: what a compiler has appended to bytearrays becomes one binary.

A compiler appends the instructions of a function (`plcsim.machine.opcodes`) to a bytearray; nothing
here makes an object per instruction. Indices of imports, functions and types are given out when
they are asked for, so calls can be written before their targets have bodies.

There are no data sections: who loads a module puts its data into PLC memory, where addresses are
checked.

Source: WebAssembly Core Specification 2.0, chapter 5 (binary format) and appendix 7.4 (names).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from plcsim.machine.opcodes import END, FUNCREF, I32, I32_CONST

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_FUNCTION, _TABLE, _MEMORY, _GLOBAL = range(4)  # kinds of imports and exports (5.5.5, 5.5.10)
_HEADER = b"\0asm\x01\0\0\0"
_FUNCTION_TYPE = b"\x60"


def uleb(value: int) -> bytes:
    """Return a number from 0 as unsigned LEB128: an index, a size, an offset."""
    if value < 0x80:
        return _ONE_BYTE[value]
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value)
    return bytes(out)


def sleb(value: int) -> bytes:
    """Return a number as signed LEB128: what follows i32.const and i64.const.

    An i32 must be given in -2**31..2**31-1, an i64 in -2**63..2**63-1.
    """
    if -0x40 <= value < 0x40:
        return _ONE_BYTE[value & 0x7F]
    out = bytearray()
    while not -0x40 <= value < 0x40:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value & 0x7F)
    return bytes(out)


_ONE_BYTE = [bytes([value]) for value in range(0x80)]


def memarg(offset: int = 0, alignment: int = 0) -> bytes:
    """Return what follows a load or a store.

    Args:
        offset: bytes that are added to the address, without a wrap at 2**32.
        alignment: a promise, as a power of two, at most that of the width; changes no result.
    """
    return _ONE_BYTE[alignment] + uleb(offset)


def f32(value: float) -> bytes:
    """Return what follows f32.const; a value beyond the range of REAL becomes an infinity."""
    try:
        return struct.pack("<f", value)
    except OverflowError:
        return struct.pack("<f", float("inf") if value > 0 else float("-inf"))


def f64(value: float) -> bytes:
    """Return what follows f64.const."""
    return struct.pack("<d", value)


def name(text: str) -> bytes:
    """Return a name: its length in bytes, then UTF-8."""
    data = text.encode()
    return uleb(len(data)) + data


def vector(items: Sequence[bytes]) -> bytes:
    """Return a vector: the number of items, then the items."""
    return uleb(len(items)) + b"".join(items)


def locals_of(types: bytes) -> bytes:
    """Return the declaration of locals, one byte per local, as runs of equal types (5.5.13)."""
    runs: list[bytes] = []
    start = 0
    for end in range(1, len(types) + 1):
        if end == len(types) or types[end] != types[start]:
            runs.append(uleb(end - start) + types[start:end][:1])
            start = end
    return vector(runs)


class Signature(NamedTuple):
    """The type of a function; one byte per parameter and result (`plcsim.machine.opcodes.I32`)."""

    params: bytes = b""
    results: bytes = b""


class EncodedModule(NamedTuple):
    """An encoded module.

    Attributes:
        wasm: the binary.
        starts: for each function with a body, by its place after the imported ones, the offset in
            ``wasm`` of its first instruction; frames of faults hold such offsets.
    """

    wasm: bytes
    starts: list[int]


@dataclass(slots=True)
class _Body:
    name: str
    type_index: int
    code: bytes | bytearray | None = None
    locals: bytes = b""


class ModuleWriter:
    """A module under construction.

    Imports come first: the indices of imported functions, globals and tables precede those of the
    module's own.

    Args:
        name: shown in the frames of faults; "" leaves names out altogether.
    """

    def __init__(self, name: str = "") -> None:
        self._name = name
        self._types: dict[Signature, int] = {}
        self._imports: list[bytes] = []
        self._imported_functions: list[str] = []
        self._imported_globals = 0
        self._imported_tables = 0
        self._bodies: list[_Body] = []
        self._tables: list[bytes] = []
        self._memories: list[bytes] = []
        self._globals: list[bytes] = []
        self._exports: list[bytes] = []
        self._elements: list[bytes] = []
        self._custom: list[bytes] = []

    def type_index(self, signature: Signature) -> int:
        """Return the index of a function type, for call_indirect."""
        return self._types.setdefault(signature, len(self._types))

    # what it imports

    def import_function(self, module: str, field: str, signature: Signature) -> int:
        """Import a function and return its index.

        Raises:
            ValueError: a function of the module's own has its index already.
        """
        if self._bodies:
            raise ValueError(f"{module}.{field}: imports come before the module's own functions")
        self._import(module, field, _FUNCTION, uleb(self.type_index(signature)))
        self._imported_functions.append(field)
        return len(self._imported_functions) - 1

    def import_memory(self, module: str, field: str, pages: int = 0) -> None:
        """Import the memory.

        Args:
            module: first part of its name.
            field: second part.
            pages: of 64 KiB that it must have at least; accesses are checked anyway.
        """
        self._import(module, field, _MEMORY, b"\0" + uleb(pages))

    def import_table(self, module: str, field: str, minimum: int = 0) -> int:
        """Import a table of functions and return its index."""
        self._import(module, field, _TABLE, bytes([FUNCREF, 0]) + uleb(minimum))
        self._imported_tables += 1
        return self._imported_tables - 1

    def import_global(self, module: str, field: str, kind: int, *, mutable: bool = False) -> int:
        """Import a global variable of a value type and return its index."""
        self._import(module, field, _GLOBAL, bytes([kind, mutable]))
        self._imported_globals += 1
        return self._imported_globals - 1

    def _import(self, module: str, field: str, kind: int, what: bytes) -> None:
        self._imports.append(name(module) + name(field) + _ONE_BYTE[kind] + what)

    # what it defines

    def function(self, signature: Signature, name: str = "") -> int:
        """Announce a function and return its index; `body` is to follow."""
        self._bodies.append(_Body(name, self.type_index(signature)))
        return len(self._imported_functions) + len(self._bodies) - 1

    def body(self, index: int, code: bytes | bytearray, locals_: bytes = b"") -> None:
        """Give a function its instructions.

        Args:
            index: of the function.
            code: the instructions, without the END of the body.
            locals_: one value type per local, the parameters not among them.
        """
        body = self._bodies[index - len(self._imported_functions)]
        body.code = code
        body.locals = locals_

    def table(self, minimum: int, maximum: int | None = None) -> int:
        """Define a table of functions and return its index."""
        self._tables.append(bytes([FUNCREF]) + _limits(minimum, maximum))
        return self._imported_tables + len(self._tables) - 1

    def memory(self, pages: int, maximum: int | None = None) -> None:
        """Define the memory, in pages of 64 KiB."""
        self._memories.append(_limits(pages, maximum))

    def global_(self, kind: int, initial: bytes, *, mutable: bool = True) -> int:
        """Define a global variable; ``initial`` is a constant instruction. Return its index."""
        self._globals.append(bytes([kind, mutable]) + initial + END)
        return self._imported_globals + len(self._globals) - 1

    def elements(self, offset: int, functions: Iterable[int], table: int = 0) -> None:
        """Fill a table from ``offset`` with functions."""
        items = vector([uleb(index) for index in functions])
        head = b"\x00" if table == 0 else b"\x02" + uleb(table)
        kind = b"" if table == 0 else b"\x00"
        self._elements.append(head + I32_CONST + sleb(offset) + END + kind + items)

    def export_function(self, field: str, index: int) -> None:
        """Export a function."""
        self._exports.append(name(field) + _ONE_BYTE[_FUNCTION] + uleb(index))

    def export_memory(self, field: str) -> None:
        """Export the memory."""
        self._exports.append(name(field) + _ONE_BYTE[_MEMORY] + b"\0")

    def export_table(self, field: str, index: int = 0) -> None:
        """Export a table."""
        self._exports.append(name(field) + _ONE_BYTE[_TABLE] + uleb(index))

    def export_global(self, field: str, index: int) -> None:
        """Export a global variable."""
        self._exports.append(name(field) + _ONE_BYTE[_GLOBAL] + uleb(index))

    def custom(self, title: str, content: bytes) -> None:
        """Append a custom section."""
        self._custom.append(_section(0, name(title) + content))

    def encode(self) -> EncodedModule:
        """Return the binary.

        Raises:
            ValueError: a function has no body.
        """
        code, starts = self._code()
        types = [_type(signature) for signature in self._types]
        before = b"".join(
            [
                _HEADER,
                _vector_section(1, types),
                _vector_section(2, self._imports),
                _vector_section(3, [uleb(body.type_index) for body in self._bodies]),
                _vector_section(4, self._tables),
                _vector_section(5, self._memories),
                _vector_section(6, self._globals),
                _vector_section(7, self._exports),
                _vector_section(9, self._elements),
            ]
        )
        head = b"\x0a" + uleb(len(code)) if code else b""
        after = [self._names(), *self._custom]
        base = len(before) + len(head)
        wasm = b"".join([before, head, code, *after])
        return EncodedModule(wasm, [base + start for start in starts])

    def _code(self) -> tuple[bytes, list[int]]:
        """Return the content of the code section, and where in it each body's code begins."""
        if not self._bodies:
            return b"", []
        out = bytearray(uleb(len(self._bodies)))
        starts = []
        for body in self._bodies:
            if body.code is None:
                raise ValueError(f"function {body.name!r} of module {self._name!r} has no body")
            locals_ = locals_of(body.locals)
            out += uleb(len(locals_) + len(body.code) + 1)
            out += locals_
            starts.append(len(out))
            out += body.code
            out += END
        return bytes(out), starts

    def _names(self) -> bytes:
        """Return the name section: the module's and those of all functions."""
        if not self._name:
            return b""
        functions = [*self._imported_functions, *(body.name for body in self._bodies)]
        pairs = [uleb(i) + name(text) for i, text in enumerate(functions) if text]
        content = _section(0, name(self._name)) + _section(1, vector(pairs))
        return _section(0, name("name") + content)


def _type(signature: Signature) -> bytes:
    params, results = signature
    return _FUNCTION_TYPE + uleb(len(params)) + params + uleb(len(results)) + results


def _limits(minimum: int, maximum: int | None) -> bytes:
    if maximum is None:
        return b"\0" + uleb(minimum)
    return b"\1" + uleb(minimum) + uleb(maximum)


def _section(number: int, content: bytes) -> bytes:
    return _ONE_BYTE[number] + uleb(len(content)) + content


def _vector_section(number: int, items: Sequence[bytes]) -> bytes:
    return _section(number, vector(items)) if items else b""


NO_ARGUMENTS = Signature()
"""() -> ()"""

ONE_ADDRESS = Signature(bytes([I32]))
"""(i32) -> (): a block, with the address of its data."""
