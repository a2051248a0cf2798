"""Lines of compiled C: which instruction stands where in its source.

Source: DWARF Debugging Information Format, version 4, section 6.2 (line number information). In
WebAssembly an address counts from the start of the content of the code section.
"""

from __future__ import annotations

import posixpath
from bisect import bisect_right
from typing import TYPE_CHECKING, NamedTuple

from plcsim.machine.reader import Reader

if TYPE_CHECKING:
    from collections.abc import Iterator

_VERSION = 4

# standard opcodes
_EXTENDED, _COPY, _ADVANCE, _ADVANCE_LINE, _SET_FILE = range(5)
_CONST_ADD, _FIXED_ADVANCE = 8, 9
# extended opcodes
_END_SEQUENCE, _SET_ADDRESS = 1, 2


class LineRow(NamedTuple):
    """From ``address`` on, up to the next row, the code belongs to a line; 0 is none."""

    address: int
    file: str
    line: int


class LineTable:
    """All rows of a module, in order of their addresses."""

    def __init__(self, rows: list[LineRow]) -> None:
        self._rows = sorted(rows, key=lambda row: (row.address, row.line > 0))
        self._addresses = [row.address for row in self._rows]

    def location(self, address: int) -> str:
        """Return "file:line" of the code at an address, "" where it has none."""
        index = bisect_right(self._addresses, address) - 1
        row = self._rows[index] if index >= 0 else None
        return f"{row.file}:{row.line}" if row is not None and row.line else ""


def read_line_table(section: bytes) -> LineTable:
    """Read the section ``.debug_line``; what is of another version is left out.

    Raises:
        MachineError: it ends in the middle of something.
    """
    rows: list[LineRow] = []
    reader = Reader(section)
    while reader.more:
        length = _u32(reader)
        end = reader.offset + length
        if _u16(reader) == _VERSION:
            rows += _Program(section, reader.offset, end).rows()
        reader.offset = end
    return LineTable(rows)


def _u16(reader: Reader) -> int:
    return int.from_bytes(reader.bytes(2), "little")


def _u32(reader: Reader) -> int:
    return int.from_bytes(reader.bytes(4), "little")


class _Program:
    """The line number program of one compiled file."""

    def __init__(self, section: bytes, place: int, end: int) -> None:
        reader = self._reader = Reader(section, place, end)
        header = _u32(reader)
        start = reader.offset + header
        self._minimum = reader.byte()
        reader.byte()  # operations per instruction: one
        reader.byte()  # whether lines are statements by default: all count here
        base = reader.byte()
        self._line_base = base - 256 if base > 127 else base
        self._line_range = reader.byte() or 1
        self._opcode_base = reader.byte()
        self._lengths = [reader.byte() for _ in range(self._opcode_base - 1)]
        self._files = self._read_files()
        self._address, self._file, self._line = 0, 1, 1
        reader.offset = start

    def _read_files(self) -> list[str]:
        reader = self._reader
        folders, files = [""], [""]
        while folder := _string(reader):
            folders.append(folder)
        while name := _string(reader):
            index = reader.uleb()
            reader.uleb(), reader.uleb()  # time and length
            files.append(posixpath.join(folders[index] if index < len(folders) else "", name))
        return files

    def rows(self) -> Iterator[LineRow]:
        """Run the program."""
        while self._reader.more:
            code = self._reader.byte()
            if code >= self._opcode_base:
                code -= self._opcode_base
                self._address += code // self._line_range * self._minimum
                self._line += self._line_base + code % self._line_range
                yield self._row()
            elif code == _EXTENDED:
                yield from self._extended()
            elif code == _COPY:
                yield self._row()
            else:
                self._standard(code)

    def _extended(self) -> Iterator[LineRow]:
        reader = self._reader
        end = reader.uleb() + reader.offset
        kind = reader.byte()
        if kind == _SET_ADDRESS:
            self._address = int.from_bytes(reader.bytes(end - reader.offset), "little")
        elif kind == _END_SEQUENCE:
            yield LineRow(self._address, "", 0)
            self._address, self._file, self._line = 0, 1, 1
        reader.offset = end

    def _standard(self, code: int) -> None:
        reader = self._reader
        if code == _ADVANCE:
            self._address += reader.uleb() * self._minimum
        elif code == _ADVANCE_LINE:
            self._line += reader.sleb()
        elif code == _SET_FILE:
            self._file = reader.uleb()
        elif code == _CONST_ADD:
            self._address += (255 - self._opcode_base) // self._line_range * self._minimum
        elif code == _FIXED_ADVANCE:
            self._address += _u16(reader)
        else:
            for _ in range(self._lengths[code - 1]):
                reader.uleb()

    def _row(self) -> LineRow:
        name = self._files[self._file] if self._file < len(self._files) else ""
        return LineRow(self._address, name, self._line)


def _string(reader: Reader) -> str:
    out = bytearray()
    while byte := reader.byte():
        out.append(byte)
    return out.decode("utf-8", "replace")
