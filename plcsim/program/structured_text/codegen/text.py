"""The code of a module as text: which instructions each line of its source became."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.machine import opcodes
from plcsim.machine.wat import wat

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.program.structured_text.codegen.object_code import ObjectCode


def text_of(code: ObjectCode) -> Iterator[str]:
    """Yield the lines of a module as text.

    Comments tell where a line of the source begins, and which variable an address is of: its
    segment, and how many bytes from its start.
    """
    notes = _Notes(code)
    return wat(code.wasm, notes.at)


class _Notes:
    """Comments of the instructions, asked for in order."""

    def __init__(self, code: ObjectCode) -> None:
        self._wasm = code.wasm
        self._lines = code.lines
        self._file, self._line = "", 0
        self._places = {
            position: f"{code.segments[segment].name}+{offset}"
            for position, segment, offset in code.rows()
        }

    def at(self, offset: int) -> str:
        """Return the comment of the instruction at an offset of the module."""
        return "  ".join(filter(None, (self._address(offset), self._new_line(offset))))

    def _address(self, offset: int) -> str:
        """Return the place in an instruction: behind its opcode, or behind its alignment."""
        opcode = self._wasm[offset : offset + 1]
        if opcode == opcodes.I32_CONST:
            return self._places.get(offset + 1, "")
        if opcodes.I32_LOAD <= opcode <= opcodes.I64_STORE32:
            return self._places.get(offset + 2, "")
        return ""

    def _new_line(self, offset: int) -> str:
        """Return the line of an instruction where it is another than that of the one before."""
        found = self._lines.find(offset)
        if found is None or (found.file, found.line) == (self._file, self._line):
            return ""
        told = "line " if found.file == self._file else f"{found.file}:"
        self._file, self._line = found.file, found.line
        return f"{told}{found.line}"
