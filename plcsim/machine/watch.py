"""Lets compiled code tell of what it writes, so that somebody can ask who wrote a variable.

Behind every instruction that stores or calls, a module gets a call of one function in the table of
functions; its argument says where in the original module that was. The call is made only while the
cell `WATCH` of the system area is not 0. Whoever is called looks at the bytes himself.

Source: WebAssembly Core Specification 2.0, chapter 5.4 (instructions).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.memory import SYSTEM_AREA
from plcsim.core.system_area import WATCH
from plcsim.machine.encoder import name, sleb, uleb
from plcsim.machine.errors import Frame, MachineError
from plcsim.machine.reader import (
    CODE,
    CUSTOM,
    HEADER,
    IMPORTS,
    TABLE,
    TABLES,
    TYPES,
    Reader,
    imports,
    sections,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.machine.reader import ModuleSection

FLAG: Final = SYSTEM_AREA + 8 * WATCH
_TYPE: Final = b"\x60\x01\x7e\x00"
"""Takes an i64, returns nothing."""

_TABLE_IMPORT: Final = name("env") + name("__indirect_function_table") + b"\x01\x70\x00\x00"

_ONE: Final = (0x02, 0x03, 0x04, 0x0C, 0x0D, 0x10, 0x12, *range(0x20, 0x25), *range(0x3F, 0x43))
_TWO: Final = (0x11, 0x13, *range(0x28, 0x3F))
_NUMBERS: Final = {**dict.fromkeys(_ONE, 1), **dict.fromkeys(_TWO, 2)}
"""LEB128 numbers behind an instruction: types, labels, indices, alignment and offset, constants."""

_BYTES: Final = {0x43: 4, 0x44: 8}
"""Of constants of REAL and LREAL."""

_PLAIN: Final = frozenset((0x00, 0x01, 0x05, 0x0B, 0x0F, 0x1A, 0x1B, *range(0x45, 0xC5)))
_STORES: Final = frozenset(range(0x36, 0x3F))
_CALLS: Final = frozenset((0x10, 0x11))
_SATURATING: Final = range(8)
"""Conversions, behind 0xFC; what else WebAssembly has, the machine has not (`Engine`)."""


class MemoryWatch:
    """What is asked behind each store of the modules of one machine.

    Args:
        look: called with the place.
        entry: of the table of functions, calls `told`.
    """

    def __init__(self, look: Callable[[Frame], None], entry: int) -> None:
        self._look = look
        self._entry = entry
        self._names: list[str] = []

    def instrument(self, wasm: bytes) -> bytes:
        """Return a module that tells of its stores; for errors see `instrument`."""
        self._names.append(_name_of(wasm))
        return instrument(wasm, len(self._names) - 1, self._entry)

    def told(self, place: int) -> None:
        """Take the argument of a call."""
        self._look(Frame(self._names[place >> 32], "", 0, place & 0xFFFF_FFFF))


def _name_of(wasm: bytes) -> str:
    """Return the module's name, "" where it has none."""
    for each in sections(wasm):
        if each.number == CUSTOM and each.name == "name":
            reader = Reader(wasm, each.start, each.end)
            if reader.more and reader.byte() == 0:
                reader.uleb()
                return reader.name()
    return ""


def instrument(wasm: bytes, module: int, entry: int) -> bytes:
    """Return a module that tells of its stores.

    Custom sections are left out, but for the names: their offsets would not be right.

    Args:
        wasm: the module.
        module: its number, in the upper half of the call's argument; below is the offset.
        entry: of the table of functions, takes the call.

    Raises:
        MachineError: it is no module that can be read.
    """
    found = list(sections(wasm))
    contents = {each.number: wasm[each.start : each.end] for each in found if each.number != CUSTOM}
    types = Reader(contents.get(TYPES, b"\0"))
    type_number = types.uleb()
    contents[TYPES] = uleb(type_number + 1) + types.bytes(types.end - types.offset) + _TYPE
    if TABLES not in contents and not _imports_table(wasm, found):
        before = Reader(contents.get(IMPORTS, b"\0"))
        count = before.uleb()
        rest = before.bytes(before.end - before.offset)
        contents[IMPORTS] = uleb(count + 1) + rest + _TABLE_IMPORT
    code = next((each for each in found if each.number == CODE), None)
    if code is not None:
        tell = sleb(entry)
        call = b"\x41" + tell + b"\x11" + uleb(type_number) + b"\0"
        contents[CODE] = _Code(wasm, code, module, call).content()
    made = [HEADER]
    order = (1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 10, 11)  # the count of data comes before the code
    made += [bytes([n]) + uleb(len(contents[n])) + contents[n] for n in order if n in contents]
    for each in found:
        if each.number == CUSTOM and each.name == "name":
            content = name("name") + wasm[each.start : each.end]
            made.append(bytes([CUSTOM]) + uleb(len(content)) + content)
    return b"".join(made)


def _imports_table(wasm: bytes, found: list[ModuleSection]) -> bool:
    section = next((each for each in found if each.number == IMPORTS), None)
    return section is not None and any(each.kind == TABLE for each in imports(wasm, section))


class _Code:
    """Writes a code section anew.

    Args:
        wasm: the module.
        section: its code.
        module: its number.
        call: instructions that call with the number that lies on the stack.
    """

    def __init__(self, wasm: bytes, section: ModuleSection, module: int, call: bytes) -> None:
        self._wasm = wasm
        self._reader = Reader(wasm, section.start, section.end)
        self._module = module
        self._call = call

    def content(self) -> bytes:
        """Return the section."""
        reader = self._reader
        count = reader.uleb()
        bodies = []
        for _ in range(count):
            size = reader.uleb()
            end = reader.offset + size
            body = self._body(end)
            bodies.append(uleb(len(body)) + body)
        return uleb(count) + b"".join(bodies)

    def _body(self, end: int) -> bytes:
        reader, wasm = self._reader, self._wasm
        copied = reader.offset
        for _ in range(reader.uleb()):  # groups of local variables
            reader.uleb()
            reader.byte()
        parts = []
        while reader.offset < end:
            start = reader.offset
            if self._passes_store():
                parts += [wasm[copied : reader.offset], self._tell(start)]
                copied = reader.offset
        parts.append(wasm[copied:end])
        return b"".join(parts)

    def _tell(self, offset: int) -> bytes:
        """Return the call, made only where the flag is set."""
        argument = self._module << 32 | offset
        flag = b"\x41" + sleb(FLAG) + b"\x28\x02\x00"  # i32.const, i32.load
        return flag + b"\x04\x40\x42" + sleb(argument) + self._call + b"\x0b"  # if, i64.const, end

    def _passes_store(self) -> bool:
        """Go behind the next instruction; return whether it stores or calls."""
        reader = self._reader
        code = reader.byte()
        if code == 0x0E:  # br_table
            self._skip_numbers(reader.uleb() + 1)
        elif code in _BYTES:
            reader.bytes(_BYTES[code])
        elif code in _NUMBERS:
            self._skip_numbers(_NUMBERS[code])
        elif code not in _PLAIN and not (code == 0xFC and reader.uleb() in _SATURATING):
            raise MachineError(f"the module has the unknown instruction 16#{code:02X}")
        return code in _STORES or code in _CALLS

    def _skip_numbers(self, count: int) -> None:
        for _ in range(count):
            self._reader.uleb()  # a signed one is as long
