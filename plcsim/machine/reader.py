"""Reads the outer structure of WebAssembly modules: sections, numbers, names.

What a compiler of C hands over is looked into here before it is compiled.

Source: WebAssembly Core Specification 2.0, chapter 5 (binary format).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from plcsim.machine.errors import MachineError

if TYPE_CHECKING:
    from collections.abc import Iterator

HEADER = b"\0asm\x01\0\0\0"
CUSTOM, TYPES, IMPORTS, FUNCTIONS, TABLES, MEMORIES, GLOBALS, EXPORTS = range(8)
START, ELEMENTS, CODE, DATA, DATA_COUNT = range(8, 13)
"""Numbers of sections."""


class Reader:
    """Reads values from a place in bytes on; the place moves on with each.

    Raises:
        MachineError: from any method, where the bytes end too early or make no sense.
    """

    __slots__ = ("_data", "end", "place")

    def __init__(self, data: bytes, place: int = 0, end: int | None = None) -> None:
        self._data = data
        self.place = place
        self.end = len(data) if end is None else end

    @property
    def more(self) -> bool:
        """Whether there is something left."""
        return self.place < self.end

    def byte(self) -> int:
        """Read one byte."""
        if self.place >= self.end:
            raise MachineError("the module ends in the middle of something")
        self.place += 1
        return self._data[self.place - 1]

    def bytes(self, count: int) -> bytes:
        """Read some bytes."""
        if count > self.end - self.place:
            raise MachineError("the module ends in the middle of something")
        self.place += count
        return self._data[self.place - count : self.place]

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
        start = self.place
        value = self.uleb()
        bits = 7 * (self.place - start)
        return value - (1 << bits) if value >> (bits - 1) else value

    def name(self) -> str:
        """Read a name."""
        return self.bytes(self.uleb()).decode("utf-8", "replace")


class Section(NamedTuple):
    """A section of a module.

    Attributes:
        number: `CUSTOM` and so on.
        name: of a custom section, "" of others.
        start: place of its content in the module.
        end: place behind it.
    """

    number: int
    name: str
    start: int
    end: int


def sections(wasm: bytes) -> Iterator[Section]:
    """Yield the sections of a module.

    Raises:
        MachineError: it is no module.
    """
    if not wasm.startswith(HEADER):
        raise MachineError("this is no WebAssembly module of version 1")
    reader = Reader(wasm, len(HEADER))
    while reader.more:
        number, size = reader.byte(), reader.uleb()
        start = reader.place
        reader.bytes(size)
        inner = Reader(wasm, start, start + size)
        name = inner.name() if number == CUSTOM else ""
        yield Section(number, name, inner.place, start + size)
