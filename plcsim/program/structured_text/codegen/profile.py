"""What the counters of a module tell: how often lines ran, what they cost, which way they went."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    import numpy.typing as npt

Counts: TypeAlias = "npt.NDArray[np.int64]"
"""Values of the counters of a module."""


class LineCost(NamedTuple):
    """What one pass over a counter costs on one line.

    Attributes:
        counter: number of the counter.
        file: number of the file.
        line: line in the file.
        cost: instructions; 0 where it has only such as the machine does not count.
        is_entry: it is the entry of a function, and no statement.
    """

    counter: int
    file: int
    line: int
    cost: int
    is_entry: bool = False


class Arc(NamedTuple):
    """A way from a condition to what follows.

    Attributes:
        counter: number of the counter that counts it.
        file: number of the file.
        line: of the condition.
        target: line that follows; below 0 the function that begins in that line is left.
    """

    counter: int
    file: int
    line: int
    target: int


class Profile:
    """The counters of a module.

    Args:
        files: paths of the sources.
        counters: how many there are.
        costs: what each costs on which lines.
        arcs: ways that counters stand for.
    """

    def __init__(
        self, files: Sequence[str], counters: int, costs: Sequence[LineCost], arcs: Sequence[Arc]
    ) -> None:
        self.files = files
        self.counters = counters
        self.costs = costs
        self.arcs = arcs

    def lines(self, file: int) -> set[int]:
        """Return the lines of a file that have statements."""
        return {c.line for c in self.costs if c.file == file and not c.is_entry}

    def lines_run(self, file: int, counts: Counts) -> set[int]:
        """Return the lines of a file that have run."""
        rows = (c for c in self.costs if c.file == file and not c.is_entry)
        return {c.line for c in rows if counts[c.counter]}

    def ways(self, file: int) -> set[tuple[int, int]]:
        """Return the ways of a file, from a condition's line to the next."""
        return {(a.line, a.target) for a in self.arcs if a.file == file}

    def ways_gone(self, file: int, counts: Counts) -> set[tuple[int, int]]:
        """Return the ways of a file that were gone."""
        rows = (a for a in self.arcs if a.file == file)
        return {(a.line, a.target) for a in rows if counts[a.counter]}

    def cost_of_lines(self, counts: Counts) -> dict[tuple[str, int], int]:
        """Return the instructions that each line has cost, by path and line."""
        found: dict[tuple[str, int], int] = {}
        for counter, file, line, cost, _ in self.costs:
            spent = int(counts[counter]) * cost
            if spent:
                key = self.files[file], line
                found[key] = found.get(key, 0) + spent
        return found
