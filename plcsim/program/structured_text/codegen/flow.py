"""Where control goes from an instruction of a function, in lines of its source."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING, Final

from plcsim.machine import opcodes
from plcsim.program.structured_text.codegen.decode import number_at

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text.codegen.body import FunctionWriter
    from plcsim.program.structured_text.codegen.decode import Instruction

_BLOCK, _LOOP, _IF, _ELSE, _END, _BR, _BR_IF = (
    code[0]
    for code in (
        opcodes.BLOCK,
        opcodes.LOOP,
        opcodes.IF,
        opcodes.ELSE,
        opcodes.END,
        opcodes.BR,
        opcodes.BR_IF,
    )
)
_STARTS: Final = (_BLOCK, _LOOP, _IF)
_UNREACHABLE: Final = opcodes.UNREACHABLE[0]


class Flow:
    """The ways of control through a function.

    Args:
        sequence: its instructions.
        body: the function, as it was compiled.
    """

    def __init__(self, sequence: Sequence[Instruction], body: FunctionWriter) -> None:
        self._sequence = sequence
        self._code = body.code
        self._polls = body.polls
        self._leaves = body.leaves
        self._entry = body.function.line
        self._positions = [position for position, _ in body.lines]
        self._marked = set(self._positions)
        self._lines = [line for _, line in body.lines]
        self._index_at = {one.start: index for index, one in enumerate(sequence)}
        self._end_of: dict[int, int] = {}  # by the index of a block's start, and of its ELSE
        self._target_of: dict[int, int] = {}
        self._match()

    def _match(self) -> None:
        """Find the END of each block, and where each branch leads."""
        around: list[list[int]] = []
        branches: list[tuple[int, int]] = []
        for index, one in enumerate(self._sequence):
            if one.opcode in _STARTS:
                around.append([index])
            elif one.opcode == _ELSE:
                around[-1].append(index)
            elif one.opcode == _END:
                for part in around.pop():
                    self._end_of[part] = index
            elif one.opcode in (_BR, _BR_IF):
                depth = number_at(self._code, one.start + 1)
                outer = around[-1 - depth][0] if depth < len(around) else -1
                branches.append((index, outer))
        for index, outer in branches:
            self._target_of[index] = self._head_or_end(outer)

    def _head_or_end(self, start: int) -> int:
        """Return where a branch to a block goes on; -1 is the body of the function."""
        if start < 0:
            return len(self._sequence)
        is_loop = self._sequence[start].opcode == _LOOP
        return (start if is_loop else self._end_of[start]) + 1

    def line_at(self, index: int) -> int:
        """Return the line of an instruction."""
        place = bisect_right(self._positions, self._sequence[index].start) - 1
        return self._lines[place]

    def is_entry(self, index: int) -> bool:
        """Tell whether an instruction belongs to the entry of the function, not to a statement."""
        return self._sequence[index].start < self._polls.get(0, 0)

    def after(self, index: int) -> int:
        """Return the line that follows an instruction; the entry's, below 0, where none does."""
        return self._line_from(index + 1)

    def target(self, index: int) -> int:
        """Return the line that follows a branch that is taken, likewise."""
        return self._line_from(self._target_of[index])

    def _line_from(self, index: int) -> int:
        seen = set()
        while index < len(self._sequence) and index not in seen:
            seen.add(index)
            one = self._sequence[index]
            if one.start in self._polls:
                index = self._index_at[self._polls[one.start]]
            elif one.opcode in (_BLOCK, _LOOP, _END):
                index += 1
            elif one.opcode == _ELSE:
                index = self._end_of[index] + 1
            elif one.opcode == _BR and one.start not in self._marked:  # else EXIT, CONTINUE
                index = self._target_of[index]
            elif one.opcode == _UNREACHABLE or one.start in self._leaves:
                break
            else:
                return self.line_at(index)
        return -self._entry
