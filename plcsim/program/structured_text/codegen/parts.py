"""Bodies with very many calls are cut into functions.

Cranelift takes time and memory with the square of the calls in one function: 8,000 comparisons of
strings in one body took 3 s and 700 MB. Parts of a few hundred calls take both in proportion. What
runs once in a cycle loses nothing by it; a loop stays in one piece.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.accesses import nodes_of

if TYPE_CHECKING:
    from collections.abc import Sequence

MOST_CALLS: Final = 400
"""Calls in one function, from which on it is cut."""

CALLS_OF_PART: Final = 200
CALLS_OF_ARM: Final = 4
"""Calls from which on an arm of a large choice is a part."""

_NOT_TWICE: Final = (ir.Call, ir.StatementExpression, ir.Local)
_KINDS: Final = frozenset(["unit", "action", "block"])


def parts_of(function: ir.Function) -> list[ir.Function]:
    """Return a function, and behind it the parts that it calls where it was too large."""
    if function.kind not in _KINDS or _calls(function.body) <= MOST_CALLS:
        return [function]
    cutter = _Cutter(function)
    body = cutter.cut(function.body, CALLS_OF_PART)
    return [replace(function, body=body), *cutter.parts]


@dataclass(slots=True)
class _Cutter:
    function: ir.Function
    parts: list[ir.Function] = field(default_factory=list)
    _uses: Counter[int] = field(init=False)

    def __post_init__(self) -> None:
        self._uses = _locals(self.function.body)

    def cut(self, statements: Sequence[ir.Statement], least: int) -> list[ir.Statement]:
        """Return statements of which runs with ``least`` calls or more are calls of parts."""
        found: list[ir.Statement] = []
        run: list[ir.Statement] = []
        calls = 0
        for statement in statements:
            each, count = statement, _calls([statement])
            if count > CALLS_OF_PART:
                each = self._cut_inside(statement)
                count = _calls([each])
            run.append(each)
            calls += count
            if calls >= least:
                found += self._moved(run)
                run, calls = [], 0
        return found + run

    def _cut_inside(self, node: ir.Statement) -> ir.Statement:
        if isinstance(node, ir.If):
            arms = [replace(arm, body=self.cut(arm.body, CALLS_OF_ARM)) for arm in node.arms]
            return replace(node, arms=arms, other=self.cut(node.other, CALLS_OF_ARM))
        if isinstance(node, ir.Switch):
            cases = [replace(case, body=self.cut(case.body, CALLS_OF_ARM)) for case in node.cases]
            cases = self._grouped(replace(node, cases=cases, other=()))
            return replace(node, cases=cases, other=self.cut(node.other, CALLS_OF_ARM))
        return node

    def _grouped(self, node: ir.Switch) -> list[ir.Case]:
        """Return the cases of a choice, those of many small arms as parts that choose again."""
        if any(type(each) in _NOT_TWICE for each in nodes_of([node.selector])):
            return list(node.cases)
        found: list[ir.Case] = []
        group: list[ir.Case] = []
        calls = 0
        for case in node.cases:
            group.append(case)
            calls += _calls(case.body)
            if calls >= CALLS_OF_PART and len(group) > 1:
                found += self._chosen_again(replace(node, cases=group))
                group, calls = [], 0
        return found + group

    def _chosen_again(self, node: ir.Switch) -> Sequence[ir.Case]:
        moved = self._moved([node])
        if moved[0] is node:
            return node.cases
        ranges = [each for case in node.cases for each in case.ranges]
        return [ir.Case(node.cases[0].line, ranges, moved)]

    def _moved(self, run: Sequence[ir.Statement]) -> Sequence[ir.Statement]:
        """Return the call of a part that holds some statements, themselves where none can."""
        if not self._can_move(run):
            return run
        function, line = self.function, run[0].line
        name = f"{function.name} (part {len(self.parts) + 1})"
        part = replace(function, name=name, kind="action", body=run, line=line, exported=False)
        self.parts.append(part)
        this = [ir.Local("i32", 0)] if function.parameters else []
        return [ir.Evaluate(line, ir.Call(None, name, this))]

    def _can_move(self, run: Sequence[ir.Statement]) -> bool:
        """Return whether some statements leave nothing behind but what lies in memory."""
        labels: set[int] = set()
        targets: set[int] = set()
        for node in nodes_of(run):
            if type(node) is ir.Return:
                return False
            if type(node) in (ir.Block, ir.Loop):
                labels.add(node.label)
            elif type(node) in (ir.Break, ir.Continue):
                targets.add(node.label)
        first = len(self.function.parameters)
        uses = _locals(run)
        own = all(uses[index] == self._uses[index] for index in uses if index >= first)
        return own and targets <= labels and not (first and _sets_this(run))


def _calls(statements: Sequence[ir.Statement]) -> int:
    return sum(type(node) is ir.Call for node in nodes_of(statements))


def _locals(statements: Sequence[ir.Statement]) -> Counter[int]:
    """Count where each local is named."""
    return Counter(
        node.index for node in nodes_of(statements) if type(node) in (ir.Local, ir.SetLocal)
    )


def _sets_this(statements: Sequence[ir.Statement]) -> bool:
    return any(type(node) is ir.SetLocal and node.index == 0 for node in nodes_of(statements))
