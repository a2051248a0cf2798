"""Acts that a test plans for a time or a cycle; they happen in LATCH, before the programs run."""

from __future__ import annotations

from heapq import heappop, heappush
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

__tracebackhide__ = True


class Schedule:
    """Acts in the order (moment, planning), where a moment is a time or a cycle number."""

    def __init__(self) -> None:
        self._acts: list[tuple[int, int, Callable[[], None]]] = []
        self._planned = 0

    def plan(self, moment: int, act: Callable[[], None]) -> None:
        """Plan an act."""
        self._planned += 1
        heappush(self._acts, (moment, self._planned, act))

    def perform(self, moment: int) -> None:
        """Perform all acts planned up to ``moment``."""
        while self._acts and self._acts[0][0] <= moment:
            heappop(self._acts)[2]()

    def clear(self) -> None:
        """Forget all acts."""
        self._acts.clear()

    def __len__(self) -> int:
        return len(self._acts)
