"""Which task class owns which variables.

The outside leaves the variables of a class alone while the class is in the middle of a cycle. What
belongs to no class, such as global variables, is shared: it may change at any time.
"""

from __future__ import annotations

from bisect import bisect_right
from itertools import pairwise
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from plcsim.core.task import TaskClass

SHARED: Final = 1
"""The owner of what belongs to no task class."""


def bit_of(task_class: TaskClass) -> int:
    """Return the bit that stands for a task class in a set of owners."""
    return 1 << task_class.number


def bits_of(classes: Iterable[TaskClass]) -> int:
    """Return a set of owners, as bits."""
    bits = 0
    for task_class in classes:
        bits |= 1 << task_class.number
    return bits


class Owners:
    """The owners of all variables of a controller.

    Args:
        classes: its task classes; the variables of all their tasks lie in one memory.
    """

    def __init__(self, classes: Sequence[TaskClass]) -> None:
        areas = sorted(
            (task.variables.address, task.variables.data_type.size, bit_of(task_class))
            for task_class in classes
            for task in task_class.tasks
        )
        self._starts = [address for address, _, _ in areas]
        self._ends = [address + size for address, size, _ in areas]
        self._bits = [bit for _, _, bit in areas]
        self.all = SHARED | bits_of(classes)

    def of(self, address: int) -> int:
        """Return the bit of the class whose variable lies at an address, or `SHARED`."""
        found = bisect_right(self._starts, address) - 1
        if found >= 0 and address < self._ends[found]:
            return self._bits[found]
        return SHARED

    def of_range(self, address: int, size: int) -> int:
        """Return the owners of a range, as bits."""
        found = bisect_right(self._starts, address) - 1
        if found >= 0 and address + size <= self._ends[found]:
            return self._bits[found]
        owners = 0
        for owner, _, _ in self.cut(address, size):
            owners |= owner
        return owners

    def cut(self, address: int, size: int) -> list[tuple[int, int, int]]:
        """Return (owner, address, size) of the parts of a range, each of one owner."""
        edges = {address, address + size}
        edges.update(e for e in (*self._starts, *self._ends) if address < e < address + size)
        at = sorted(edges)
        return [(self.of(a), a, b - a) for a, b in pairwise(at)]
