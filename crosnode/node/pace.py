"""How much a node may do in a step: what a millisecond may take, for each of its cycle.

The cycle is learnt from the releases at which the steps are done, so no clock is read, and a node
does the same work for the same cycles on the virtual clock and on the real one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from crosnode.transport.budget import LARGE_SHARE, STREAM_SHARE, StepBudget, StepLimits

if TYPE_CHECKING:
    from collections.abc import Mapping

UNIT_NS: Final = 1_000_000
"""Nanoseconds of cycle that `StepLimits` are meant for."""

MOST_UNITS: Final = 100
LONGER: Final = 16
"""Steps after which a longer cycle is believed: after a violation one cycle is long, no more."""

WINDOW_NS: Final = 1_000_000_000
FEWEST_STEPS: Final = 5
"""Of a window that tells something."""

STREAM_STEPS: Final = 16
"""As many more steps with large messages than without make a stream of them."""


class Pace:
    """Gives each step its budget, and sees where they do not suffice.

    Args:
        given: bounds that hold as they are; the others are those of `StepLimits` times the
            milliseconds of the cycle.

    Attributes:
        limits: of the present step.
        is_behind: whether nine in ten steps of the last second left work for the next.
    """

    def __init__(self, given: Mapping[str, int]) -> None:
        self.limits = StepLimits(**given)
        self.is_behind = False
        self._given = given
        self._before_ns: int | None = None
        self._cycle_ns = UNIT_NS
        self._longer = 0
        self._shortest_longer_ns = 0
        self._since_ns: int | None = None
        self._steps = self._short = 0
        self._streaming = 0

    def begin(self, now_ns: int) -> StepBudget:
        """Return the budget of a step at this release."""
        if self._before_ns is not None:
            self._learn(now_ns - self._before_ns)
        self._before_ns = now_ns
        is_stream = self._streaming >= STREAM_STEPS
        return StepBudget(self.limits, STREAM_SHARE if is_stream else LARGE_SHARE)

    def _learn(self, cycle_ns: int) -> None:
        if cycle_ns == self._cycle_ns or cycle_ns <= 0:
            self._longer = 0
        elif cycle_ns < self._cycle_ns:
            self._adopt(cycle_ns)
        else:
            shortest = self._shortest_longer_ns if self._longer else cycle_ns
            self._shortest_longer_ns = min(shortest, cycle_ns)
            self._longer += 1
            if self._longer == LONGER:
                self._adopt(self._shortest_longer_ns)

    def _adopt(self, cycle_ns: int) -> None:
        self._cycle_ns, self._longer = cycle_ns, 0
        units = min(max(1, cycle_ns // UNIT_NS), MOST_UNITS)
        scaled = {name: units * bound for name, bound in StepLimits()._asdict().items()}
        self.limits = StepLimits(**scaled | dict(self._given))

    def end(self, now_ns: int, budget: StepBudget) -> bool:
        """Note what is left of a step's budget; return whether ``is_behind`` is another by it."""
        is_half_full = 2 * budget.large >= LARGE_SHARE * self.limits.work
        streaming = self._streaming + (1 if is_half_full else -1)
        self._streaming = min(max(0, streaming), 2 * STREAM_STEPS)
        if self._since_ns is None:
            self._since_ns = now_ns
        self._steps += 1
        self._short += budget.is_short
        if now_ns - self._since_ns < WINDOW_NS or self._steps < FEWEST_STEPS:
            return False
        was_behind, self.is_behind = self.is_behind, 10 * self._short >= 9 * self._steps
        self._since_ns, self._steps, self._short = now_ns, 0, 0
        return self.is_behind is not was_behind
