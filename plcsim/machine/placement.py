"""Gives a position-independent module its place in memory.

What it imports as variables becomes constants, which compiled code is faster with, and its code
polls the budget, which no compiler of C does. Its initial values are taken out, as the machine has
it.

Source: WebAssembly Core Specification 2.0, chapter 5; Tool Conventions, "Dynamic linking".
"""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.memory import SYSTEM_AREA
from plcsim.core.system_area import BUDGET
from plcsim.machine import opcodes as op
from plcsim.machine.encoder import memarg, sleb, uleb
from plcsim.machine.encoder import name as text
from plcsim.machine.errors import MachineError
from plcsim.machine.reader import (
    CODE,
    CUSTOM,
    DATA,
    DATA_COUNT,
    ELEMENTS,
    EXPORTS,
    FUNCTION,
    GLOBAL,
    GLOBALS,
    HEADER,
    IMPORTS,
    Reader,
    constant,
    exports,
)
from plcsim.machine.shared_module import ADDRESSES, FUNCTION_INDICES, MEMORY_BASE, TABLE_BASE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.machine.reader import ModuleImport, ModuleSection
    from plcsim.machine.shared_module import SharedModule

_MODULE_NAME, _FUNCTION_NAMES = 0, 1  # subsections of names (appendix 7.4.1)

POLL = (
    op.I32_CONST + sleb(SYSTEM_AREA) + op.I32_LOAD + memarg(8 * BUDGET)
    + op.IF + op.EMPTY + op.UNREACHABLE + op.END
)  # fmt: skip
"""The end of a program that shall end: the low word of the budget is 0 as long as it may run."""


class Placement(NamedTuple):
    """Where everything lies that a module asks for.

    Attributes:
        memory: address of its data.
        table: index of its first entry in the table of functions.
        addresses: of variables, by name.
        pointers: indices of functions in the table, by name.
    """

    memory: int
    table: int
    addresses: Mapping[str, int]
    pointers: Mapping[str, int]

    def value_of(self, wanted: ModuleImport) -> int | None:
        """Return what an imported variable stands for, None where it stays an import.

        Raises:
            KeyError: nothing is known of it.
        """
        name = wanted.module, wanted.name
        if name == MEMORY_BASE:
            return self.memory
        if name == TABLE_BASE:
            return self.table
        if wanted.module == ADDRESSES:
            return self.addresses[wanted.name]
        if wanted.module == FUNCTION_INDICES:
            return self.pointers[wanted.name]
        return None


class PlacedModule(NamedTuple):
    """A module for one place in memory.

    Attributes:
        wasm: the binary, without data.
        anchors: pairs of an offset in ``wasm`` and in the module as it was linked; from there to
            the next pair both run alike.
    """

    wasm: bytes
    anchors: list[tuple[int, int]]

    def linked_offset(self, offset: int) -> int:
        """Return where an instruction of ``wasm`` stands in the module as it was linked."""
        index = max(bisect_right(self.anchors, (offset, 1 << 62)) - 1, 0)
        new, old = self.anchors[index] if self.anchors else (0, 0)
        return offset - new + old


def place(module: SharedModule, placement: Placement, name: str) -> PlacedModule:
    """Return a module with constants for what it imports as variables, and with polls.

    Args:
        module: as it was linked.
        placement: where everything lies.
        name: of the placed module, in the frames of faults.

    Raises:
        MachineError: it holds what PLC programs must not.
        KeyError: something that it asks for is not in ``placement``.
    """
    return _Placer(module, placement, name).placed()


def initial_values(module: SharedModule, placement: Placement) -> list[tuple[int, bytes]]:
    """Return address and content of the data of a module; what is not among it is 0.

    Raises:
        MachineError: it has data without an address.
    """
    constants = _constants(module, placement)
    found: list[tuple[int, bytes]] = []
    for section in module.sections:
        if section.number == DATA:
            reader = Reader(module.wasm, section.start, section.end)
            for _ in range(reader.uleb()):
                if reader.uleb() != 0:
                    raise MachineError("a module has data without an address")
                found.append((constant(reader, constants), reader.bytes(reader.uleb())))
    return found


def _constants(module: SharedModule, placement: Placement) -> dict[int, int]:
    """Return the values of the imported variables that have become constants, by index."""
    variables = [i for i in module.imports if i.kind == GLOBAL]
    values = [placement.value_of(variable) for variable in variables]
    return {i: value for i, value in enumerate(values) if value is not None}


class _Placer:
    def __init__(self, module: SharedModule, placement: Placement, name: str) -> None:
        self._module = module
        self._name = name
        self._constants = _constants(module, placement)
        count = sum(i.kind == GLOBAL for i in module.imports)
        kept = [i for i in range(count) if i not in self._constants]
        self._indices = {old: new for new, old in enumerate(kept)}
        self._shift = count - len(kept)
        self._imported = count

    def placed(self) -> PlacedModule:
        out = bytearray(HEADER)
        anchors: list[tuple[int, int]] = []
        for section in self._module.sections:
            if section.number == CODE:
                content, anchors = self._code(section)
                out += bytes([CODE]) + uleb(len(content))
                anchors = [(new + len(out), old) for new, old in anchors]
                out += content
            elif section.number not in (DATA, DATA_COUNT):
                out += self._other(section)
        return PlacedModule(bytes(out), anchors)

    def _other(self, section: ModuleSection) -> bytes:
        """Return a section without code or data, changed where it speaks of variables."""
        wasm, number = self._module.wasm, section.number
        if number == CUSTOM:
            if section.name != "name":
                return b""
            content = self._names(section)
        elif number == IMPORTS:
            content = self._imports()
        elif number == GLOBALS:
            content = self._globals(section)
        elif number == EXPORTS:
            content = self._exports(section)
        elif number == ELEMENTS:
            content = self._elements(section)
        else:
            content = wasm[section.start : section.end]
        return bytes([number]) + uleb(len(content)) + content

    def _names(self, section: ModuleSection) -> bytes:
        """Return the names of the module and its functions, without those of variables."""
        title = text(self._name)
        content = text("name") + bytes([_MODULE_NAME]) + uleb(len(title)) + title
        reader = Reader(self._module.wasm, section.start, section.end)
        while reader.more:
            kind = reader.byte()
            part = reader.bytes(reader.uleb())
            if kind == _FUNCTION_NAMES:
                content += bytes([kind]) + uleb(len(part)) + part
        return content

    def _imports(self) -> bytes:
        kept, variable = [], -1
        for entry in self._module.imports:
            variable += entry.kind == GLOBAL
            if entry.kind != GLOBAL or variable not in self._constants:
                kept.append(self._module.wasm[entry.start : entry.end])
        return uleb(len(kept)) + b"".join(kept)

    def _globals(self, section: ModuleSection) -> bytes:
        reader = Reader(self._module.wasm, section.start, section.end)
        count = reader.uleb()
        out = bytearray(uleb(count))
        for _ in range(count):
            kind, mutable = reader.byte(), reader.byte()
            if kind != op.I32:
                raise MachineError("a module has a global variable that is not an i32")
            value = constant(reader, self._constants)
            out += bytes([kind, mutable]) + _i32_const(value) + op.END
        return bytes(out)

    def _exports(self, section: ModuleSection) -> bytes:
        wasm = self._module.wasm
        kept = [
            text(name) + bytes([kind]) + uleb(index)
            for name, kind, index in exports(wasm, section)
            if kind == FUNCTION
        ]
        return uleb(len(kept)) + b"".join(kept)

    def _elements(self, section: ModuleSection) -> bytes:
        wasm = self._module.wasm
        reader = Reader(wasm, section.start, section.end)
        count = reader.uleb()
        out = bytearray(uleb(count))
        for _ in range(count):
            if reader.uleb() != 0:
                raise MachineError("a module fills the table of functions in an unknown way")
            out += b"\0" + _i32_const(constant(reader, self._constants)) + op.END
            start = reader.offset
            for _ in range(reader.uleb()):
                reader.uleb()
            out += wasm[start : reader.offset]
        return bytes(out)

    def _code(self, section: ModuleSection) -> tuple[bytes, list[tuple[int, int]]]:
        """Return the content of the code section, and anchors relative to it."""
        reader = Reader(self._module.wasm, section.start, section.end)
        count = reader.uleb()
        out = bytearray(uleb(count))
        anchors: list[tuple[int, int]] = []
        for _ in range(count):
            size = reader.uleb()
            start = reader.offset
            reader.bytes(size)
            body = _Body(self._module.wasm, start, start + size, self)
            out += uleb(len(body.out))
            anchors += [(new + len(out), old) for new, old in body.anchors]
            out += body.out
        return bytes(out), anchors

    def rewritten(self, head: bytes, number: int) -> bytes:
        """Return an instruction as it reads from now on.

        Args:
            head: the instruction without its last number.
            number: of a global variable, or of a table.
        """
        if head[0] == _CALL_INDIRECT:
            if number:
                raise MachineError("a module has more than one table of functions")
            return head + b"\0"
        if number in self._constants:
            if head[0] != _GET:
                raise MachineError("a module sets a variable that stands for an address")
            return _i32_const(self._constants[number])
        if number >= self._imported:
            return head + uleb(number - self._shift)
        return head + uleb(self._indices[number])


def _i32_const(value: int) -> bytes:
    return op.I32_CONST + sleb((value ^ 0x8000_0000) - 0x8000_0000)


# What follows each instruction.
_NOTHING, _NUMBER, _NUMBERS, _TARGETS, _F32, _F64, _BLOCK, _MORE, _UNKNOWN = range(9)

_FOLLOWS = [_UNKNOWN] * 256
for _code in (*range(0x45, 0xC5), 0x00, 0x01, 0x05, 0x0B, 0x0F, 0x1A, 0x1B):
    _FOLLOWS[_code] = _NOTHING
for _code in (0x0C, 0x0D, 0x10, *range(0x20, 0x25), 0x3F, 0x40, 0x41, 0x42):
    _FOLLOWS[_code] = _NUMBER
for _code in (0x11, *range(0x28, 0x3F)):
    _FOLLOWS[_code] = _NUMBERS
for _code in (0x02, 0x03, 0x04):
    _FOLLOWS[_code] = _BLOCK
_FOLLOWS[0x0E], _FOLLOWS[0x43], _FOLLOWS[0x44], _FOLLOWS[0xFC] = _TARGETS, _F32, _F64, _MORE

_LOOP, _CALL, _CALL_INDIRECT = op.LOOP[0], op.CALL[0], op.CALL_INDIRECT[0]
_GET, _SET = op.GLOBAL_GET[0], op.GLOBAL_SET[0]
_TRUNCATIONS = 8  # 0xFC 0 to 7; what is above are bulk memory and tables


class _Body:
    """One function, walked through once; what does not change is copied in one piece.

    Attributes:
        out: the function as it reads from now on, without its size.
        anchors: relative to ``out``.
    """

    def __init__(self, wasm: bytes, start: int, end: int, placer: _Placer) -> None:
        reader = Reader(wasm, start, end)
        for _ in range(reader.uleb()):
            reader.uleb()
            reader.byte()
        self.out = bytearray(wasm[start : reader.offset])
        self.anchors: list[tuple[int, int]] = []
        changes, calls = _changes(wasm, reader.offset, end, placer)
        if calls:
            changes.insert(0, (reader.offset, reader.offset, POLL))
        copied = reader.offset
        self.anchors.append((len(self.out), copied))
        for place_, behind, by in changes:
            self.out += wasm[copied:place_]
            self.out += by
            copied = behind
            self.anchors.append((len(self.out), copied))
        self.out += wasm[copied:end]


def _changes(
    wasm: bytes, place_: int, end: int, placer: _Placer
) -> tuple[list[tuple[int, int, bytes]], bool]:
    """Return what is to be replaced, as (from, to, by what), and whether there are calls."""
    changes: list[tuple[int, int, bytes]] = []
    calls = False
    follows = _FOLLOWS
    try:
        while place_ < end:
            start, code = place_, wasm[place_]
            place_ += 1
            kind = follows[code]
            if kind == _NOTHING:
                continue
            if kind > _NUMBERS:
                place_ = _behind(wasm, place_, kind)
                if code == _LOOP:
                    changes.append((place_, place_, POLL))
                continue
            last = place_
            while wasm[place_] > 0x7F:
                place_ += 1
            place_ += 1
            if kind == _NUMBERS:
                last = place_
                while wasm[place_] > 0x7F:
                    place_ += 1
                place_ += 1
            if code in (_CALL, _CALL_INDIRECT):
                calls = True
            if code in (_GET, _SET, _CALL_INDIRECT):
                number = Reader(wasm, last, place_).uleb()
                changes.append((start, place_, placer.rewritten(wasm[start:last], number)))
    except IndexError:
        raise MachineError("a function ends in the middle of an instruction") from None
    if place_ != end:
        raise MachineError("a function ends in the middle of an instruction")
    return changes, calls


def _behind(wasm: bytes, place_: int, kind: int) -> int:
    """Return the place behind what follows one of the rarer instructions."""
    reader = Reader(wasm, place_)
    if kind == _BLOCK:
        reader.uleb()
    elif kind == _TARGETS:
        for _ in range(reader.uleb() + 1):
            reader.uleb()
    elif kind in (_F32, _F64):
        reader.bytes(4 if kind == _F32 else 8)
    elif kind != _MORE or reader.uleb() >= _TRUNCATIONS:
        raise MachineError(f"instruction {wasm[place_ - 1]:#04x} is none that PLC programs may use")
    return reader.offset
