"""Counters compiled into a program: for costs by line, and for coverage of lines and branches.

A counter stands at the start of each sequence of instructions that runs as a whole, and on each of
the two ways from a condition of the source. Counters are global variables of the module, so the PLC
memory is the same with and without them. What is measured is the code that runs without counters:
the cost of a line is that of its instructions there.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from typing import TYPE_CHECKING, Final

from plcsim.machine import opcodes
from plcsim.machine.encoder import sleb, uleb
from plcsim.program.structured_text.codegen.decode import FREE, Instruction, instructions, number_at
from plcsim.program.structured_text.codegen.flow import Flow
from plcsim.program.structured_text.codegen.profile import Arc, LineCost

if TYPE_CHECKING:
    from plcsim.program.structured_text.codegen.body import FunctionWriter

OVERHEAD: Final = 0
"""Global variable that sums up the instructions that counting has cost; the counters follow it."""

_PASS: Final = 8
"""Instructions of one pass over a counter."""

_BLOCK, _LOOP, _IF, _ELSE, _END, _BR_IF = (
    code[0]
    for code in (
        opcodes.BLOCK,
        opcodes.LOOP,
        opcodes.IF,
        opcodes.ELSE,
        opcodes.END,
        opcodes.BR_IF,
    )
)


def _add(variable: int, value: int) -> bytes:
    number = uleb(variable)
    addition = opcodes.I64_CONST + sleb(value) + opcodes.I64_ADD
    return opcodes.GLOBAL_GET + number + addition + opcodes.GLOBAL_SET + number


class Instrument:
    """Puts counters into the functions of a module, one after another.

    Args:
        first: number of the global variable that is the first counter, `OVERHEAD`.

    Attributes:
        counters: how many there are.
        costs: see `plcsim.program.structured_text.codegen.profile.Profile`.
        arcs: likewise.
    """

    def __init__(self, first: int = 0) -> None:
        self.first = first
        self.counters = 0
        self.costs: list[LineCost] = []
        self.arcs: list[Arc] = []

    def add(self, body: FunctionWriter, file: int) -> None:
        """Put counters into the code of a function; all positions that it notes move along.

        Args:
            body: the function.
            file: number of its file.
        """
        counted = _Counted(body, self, file)
        counted.write()
        body.code = counted.code
        move = counted.moved
        body.holes[::3] = [move(position) for position in body.holes[::3]]
        body.lines = [(move(position), line) for position, line in body.lines]
        body.traps = [(move(position), reason) for position, reason in body.traps]

    def counter(self) -> int:
        """Return the number of a new counter."""
        self.counters += 1
        return self.counters - 1


class _Counted:
    """One function while it gets its counters."""

    def __init__(self, body: FunctionWriter, instrument: Instrument, file: int) -> None:
        self.code = bytearray()
        self._body = body
        self._instrument = instrument
        self._file = file
        self._sequence = list(instructions(body.code))
        self._flow = Flow(self._sequence, body)
        self._old: list[int] = []
        self._new: list[int] = []
        self._counter = -1  # where the next instruction that is one needs a new counter
        self._open: list[tuple[int, bool]] = []  # line of the condition, if any, and ELSE was seen
        self._traps = {position for position, _ in body.traps}
        self._spent: Counter[tuple[int, int, bool]] = Counter()

    def moved(self, position: int) -> int:
        """Return where an instruction, or something in it, is now."""
        place = bisect_right(self._old, position) - 1
        return position - self._old[place] + self._new[place] if place >= 0 else position

    def write(self) -> None:
        """Write the code with counters."""
        self._begin()
        self._spent[self._counter, self._body.function.line, True] += 1  # the entry itself
        for index, instruction in enumerate(self._sequence):
            self._instruction(index, instruction)
        for (counter, line, is_entry), cost in self._spent.items():
            self._instrument.costs.append(LineCost(counter, self._file, line, cost, is_entry))

    def _begin(self, more: int = 0) -> None:
        """Have a new counter count from here on; it costs ``more`` than a pass."""
        self._counter = self._instrument.counter()
        overhead = self._instrument.first + OVERHEAD
        self.code += _add(overhead + 1 + self._counter, 1) + _add(overhead, _PASS + more)

    def _copy(self, instruction: Instruction) -> None:
        self._old.append(instruction.start)
        self._new.append(len(self.code))
        self.code += self._body.code[instruction.start : instruction.end]

    def _instruction(self, index: int, instruction: Instruction) -> None:
        opcode = instruction.opcode
        if opcode in (_BLOCK, _LOOP, _ELSE, _END):
            self._structure(index, instruction)
            return
        if self._counter < 0:
            self._begin()
        self._spend(index, instruction)
        condition = self._body.conditions.get(instruction.start)
        if opcode == _BR_IF and condition:
            self._branch(index, instruction, *condition)
            return
        self._copy(instruction)
        if opcode == _IF:
            self._if(index, instruction, condition)
        elif opcode == _BR_IF:
            self._counter = -1

    def _spend(self, index: int, instruction: Instruction) -> None:
        line = self._flow.line_at(index)
        is_entry = self._flow.is_entry(index)
        self._spent[self._counter, line, is_entry] += instruction.opcode not in FREE

    def _structure(self, index: int, instruction: Instruction) -> None:
        opcode = instruction.opcode
        if opcode == _END and self._open:
            line, had_else = self._open.pop()
            if line and not had_else:
                self.code += opcodes.ELSE
                self._way(line, self._flow.after(index))
        self._copy(instruction)
        if opcode == _ELSE:
            line, _ = self._open.pop()
            self._open.append((line, True))
            if line:
                self._way(line, self._flow.after(index))
                return
        elif opcode != _END:
            self._open.append((0, False))
        if opcode != _BLOCK:
            self._counter = -1
        line = self._body.cases.get(instruction.end, 0) if opcode == _END else 0
        if line:
            self._way(line, self._flow.after(index))

    def _if(self, index: int, instruction: Instruction, condition: tuple[int, int] | None) -> None:
        line = condition[0] if condition else 0
        self._open.append((line, False))
        if line:
            self._way(line, self._flow.after(index))
        elif instruction.start not in self._traps:
            self._counter = -1

    def _branch(self, index: int, instruction: Instruction, line: int, leaves: int) -> None:
        """Write a conditional branch as an IF with a branch in it, to count both ways."""
        depth = number_at(self._body.code, instruction.start + 1)
        target = self._flow.target(index)
        self._old.append(instruction.start)
        self._new.append(len(self.code))
        self.code += opcodes.IF + opcodes.EMPTY
        self._way(line, leaves or target, more=1)  # it takes two instructions instead of one
        if leaves:
            self._spent[self._counter, leaves, False] += 0
        self.code += opcodes.BR + uleb(depth + 1) + opcodes.END
        self._way(line, self._flow.after(index))

    def _way(self, line: int, target: int, more: int = 0) -> None:
        """Count a way from a condition from here on."""
        self._begin(more)
        self._instrument.arcs.append(Arc(self._counter, self._file, line, target))
