"""From the instructions of a module back to its source: for faults, costs and coverage."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING, NamedTuple

from plcsim.machine.encoder import uleb

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.program.structured_text import ir


class InstructionLocation(NamedTuple):
    """Where an instruction comes from.

    Attributes:
        function: name of the unit, action, block or function.
        kind: of the function.
        file: path of its source.
        line: from 1.
        trap: why the program ends there by intent, such as "budget"; "" elsewhere.
    """

    function: str
    kind: ir.FunctionKind
    file: str
    line: int
    trap: str = ""


class FunctionLines(NamedTuple):
    """The lines of one function.

    Attributes:
        name: of the function.
        kind: of the function.
        file: path of its source.
        line: where it begins.
        start: offset in the module of its first instruction.
        end: offset behind its last one.
        steps: pairs of numbers as `pack` writes them: bytes from the last change of line, from
            ``start`` at first, and lines from the last line, from ``line`` at first.
    """

    name: str
    kind: ir.FunctionKind
    file: str
    line: int
    start: int
    end: int
    steps: bytes

    def changes(self) -> Iterator[tuple[int, int]]:
        """Yield (offset in the module, line) wherever the line changes, ascending."""
        numbers = _unpack(self.steps)
        offset, line = self.start, self.line
        for distance in numbers:
            offset += distance
            line += _unzigzag(next(numbers))
            yield offset, line

    def line_at(self, offset: int) -> int:
        """Return the line of the instruction at an offset in the module."""
        found = self.line
        for start, line in self.changes():
            if start > offset:
                break
            found = line
        return found


def pack(changes: Sequence[tuple[int, int]], line: int) -> bytes:
    """Return (position in the code, line) pairs in the form of `FunctionLines.steps`."""
    out = bytearray()
    position = 0
    for next_position, next_line in changes:
        out += uleb(next_position - position) + uleb(_zigzag(next_line - line))
        position, line = next_position, next_line
    return bytes(out)


def _zigzag(number: int) -> int:
    return number * 2 if number >= 0 else -number * 2 - 1


def _unzigzag(number: int) -> int:
    return -(number + 1 >> 1) if number & 1 else number >> 1


def _unpack(data: bytes) -> Iterator[int]:
    number = shift = 0
    for byte in data:
        number |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            yield number
            number = shift = 0


class ModuleLines:
    """Lines of all functions of a module.

    Args:
        functions: ascending by start.
        traps: why the program ends, by the offset in the module of the instruction that does it.
    """

    def __init__(self, functions: Sequence[FunctionLines], traps: dict[int, str]) -> None:
        self.functions = functions
        self.traps = traps
        self._starts = [function.start for function in functions]

    def find(self, offset: int) -> InstructionLocation | None:
        """Return where an instruction comes from; None for one of no function's."""
        place = bisect_right(self._starts, offset) - 1
        function = self.functions[place] if place >= 0 else None
        if function is None or offset >= function.end:
            return None
        line = function.line_at(offset)
        trap = self.traps.get(offset, "")
        return InstructionLocation(function.name, function.kind, function.file, line, trap)
