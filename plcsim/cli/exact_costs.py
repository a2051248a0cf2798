"""What compiled programs cost more or less between two reports, in instructions and by line.

The counts are exact, so one run of each is enough. Reports have lines where they were asked for
(``--plc-lines``). They are compared by their text: what moved because something was put in above it
has not changed.
"""

from __future__ import annotations

from difflib import SequenceMatcher
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

MOST_RANGES = 3
"""Ranges of lines that are told of one program."""

Key = tuple[str, str]
"""Test (all of its repeats) and program."""


class Cost(NamedTuple):
    """Instructions of a program in one test.

    Attributes:
        cycles: how many have run.
        total: instructions of all of them.
        maximum: of the dearest.
        lines: (line, instructions in all cycles, text) of all lines that ran, by file.
    """

    cycles: int
    total: int
    maximum: int
    lines: Mapping[str, Sequence[tuple[int, int, str]]]


class Range(NamedTuple):
    """Lines that cost more or less than before.

    Attributes:
        file: path.
        first: line.
        last: line.
        change: instructions in all cycles.
    """

    file: str
    first: int
    last: int
    change: int

    def __str__(self) -> str:
        lines = f"{self.first} to {self.last}" if self.last > self.first else str(self.first)
        return f"{self.file} line {lines}"


class CostDifference(NamedTuple):
    """One compiled program in one test, in two runs.

    Attributes:
        test: the test without the number of the repeat.
        program: the program.
        before: what it cost.
        after: what it costs now.
        ranges: where, the largest changes first.
        worse: whether a cycle costs so much more that this is an alarm.
    """

    test: str
    program: str
    before: Cost
    after: Cost
    ranges: Sequence[Range]
    worse: bool


def costs_of(tests: Sequence[Mapping[str, Any]]) -> dict[Key, Cost]:
    """Return the costs of all compiled programs of a report, from the first repeat of each test."""
    found: dict[Key, Cost] = {}
    for test in tests:
        common = _lines(test)
        for program in test["programs"]:
            counted = program.get("instructions")
            if counted and test["outcome"] != "skipped":
                lines = common | _lines(program)
                cost = Cost(program["cycles"], counted["total"], counted["maximum"], lines)
                found.setdefault((test["group"], program["name"]), cost)
    return found


def _lines(entry: Mapping[str, Any]) -> dict[str, list[tuple[int, int, str]]]:
    """Return the lines of a program, or those of the libraries in a test."""
    return {
        str(file): [(int(line), int(cost), str(text)) for line, cost, text in rows]
        for file, rows in entry.get("lines", {}).items()
    }


def differences(
    before: Mapping[Key, Cost], after: Mapping[Key, Cost], smallest: float
) -> list[CostDifference]:
    """Return what changed of what both runs have.

    Args:
        before: costs of the one run.
        after: costs of the other.
        smallest: share by which a cycle may cost more without an alarm.
    """
    found = []
    for key in sorted(before.keys() & after.keys()):
        a, b = before[key], after[key]
        if (a.total, a.cycles) != (b.total, b.cycles):
            worse = b.total * a.cycles > a.total * b.cycles * (1 + smallest)
            found.append(CostDifference(*key, a, b, _ranges(a, b), worse))
    return found


def _ranges(before: Cost, after: Cost) -> list[Range]:
    """Return where costs have changed, where both runs know their lines."""
    if not before.lines or not after.lines:
        return []
    found = [
        Range(file, first, last, change)
        for file in sorted({*before.lines, *after.lines})
        for first, last, change in changes(before.lines.get(file, ()), after.lines.get(file, ()))
    ]
    return sorted(found, key=lambda one: -abs(one.change))[:MOST_RANGES]


def changes(
    before: Sequence[tuple[int, int, str]], after: Sequence[tuple[int, int, str]]
) -> list[tuple[int, int, int]]:
    """Return (first line, last line, change) of lines side by side whose cost has changed.

    Args:
        before: (line, cost, text), ascending.
        after: likewise; the lines of the result are its own.
    """
    found: list[tuple[int, int, int]] = []
    is_running = False
    for line, change in _line_changes(before, after):
        if change and is_running:
            first, _, sum_ = found[-1]
            found[-1] = first, line, sum_ + change
        elif change:
            found.append((line, line, change))
        is_running = bool(change)
    return found


def _line_changes(
    before: Sequence[tuple[int, int, str]], after: Sequence[tuple[int, int, str]]
) -> Iterator[tuple[int, int]]:
    """Yield (line, change) for all lines; what is gone stands at the line that follows."""
    texts = [text for *_, text in before], [text for *_, text in after]
    for kind, a, a_end, b, b_end in SequenceMatcher(None, *texts, autojunk=False).get_opcodes():
        if kind == "equal":
            for old, new in zip(before[a:a_end], after[b:b_end], strict=True):
                yield new[0], new[1] - old[1]
            continue
        gone = sum(cost for _, cost, _ in before[a:a_end])
        for line, cost, _ in after[b:b_end]:
            yield line, cost - gone
            gone = 0
        if gone:
            yield (after[b_end][0] if b_end < len(after) else before[a][0]), -gone
