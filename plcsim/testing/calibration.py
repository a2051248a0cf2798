"""How fast this machine is right now: a loop of known work, run between the cycles of a test.

Budgets are written for the reference machine, on which the loop takes `REFERENCE_NS`. The loop does
what programs do: it reads and writes variables in PLC memory, adds, compares, calls. So a slow or
busy machine slows it as much as the programs, and the ratio of the two stays.
"""

from __future__ import annotations

from time import thread_time_ns
from typing import TYPE_CHECKING

from st_types.types.elementary import BOOL, DINT, REAL
from st_types.types.views import Struct, var

if TYPE_CHECKING:
    from plcsim.testing.costs import Costs

REFERENCE_NS = 10_000
"""CPU time of the loop on the reference machine."""

ROUNDS = 40

SHARE = 4
"""The loop is run when the programs have used this many times as much CPU time as it takes."""

MOST_CYCLES = 50
"""... or after this many cycles."""

QUIET_PERCENT = 10
"""Of all runs of the loop, this part is taken as those that nothing disturbed."""


class _Block(Struct):
    """The variables of the loop."""

    counter = var(DINT)
    level = var(REAL)
    high = var(BOOL)


class Calibration:
    """The loop, and how long it took each time.

    Attributes:
        samples_ns: CPU time of each run of the loop.
    """

    def __init__(self) -> None:
        self.samples_ns: list[int] = []
        self._block = _Block()
        self._cycles = 0
        self._due_ns = 0

    def measure(self, times: int = 1) -> None:
        """Run the loop."""
        for _ in range(times):
            begin_ns = thread_time_ns()
            for _ in range(ROUNDS):
                self._round()
            self.samples_ns.append(thread_time_ns() - begin_ns)

    def _round(self) -> None:
        block = self._block
        block.counter = block.counter + 1
        if block.high:
            block.level = block.level * 0.5
        block.high = not block.high

    def after_cycle(self, costs: Costs) -> None:
        """Run the loop if it is time; called after each cycle."""
        self._cycles += 1
        if self._cycles < MOST_CYCLES and costs.total_ns < self._due_ns:
            return
        self._cycles = 0
        self.measure()
        self._due_ns = costs.total_ns + SHARE * self.samples_ns[-1]


def slowness(samples_ns: list[int], reference_ns: int, percent: int = QUIET_PERCENT) -> float:
    """Return how many times slower than the reference machine the loop ran, 1.0 for as fast."""
    ordered = sorted(samples_ns)
    return ordered[len(ordered) * percent // 100] / reference_ns
