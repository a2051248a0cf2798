"""What is to happen later on a virtual net: a queue ordered by time, then by order of planning."""

from __future__ import annotations

from dataclasses import dataclass, field
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


@dataclass(order=True, slots=True)
class NetworkEvent:
    """One planned act; ``action`` is None once it is cancelled."""

    time_ns: int
    sequence: int
    action: Callable[[], None] | None = field(compare=False)


class EventQueue:
    """Events in the order (time, planning), so that a run repeats exactly."""

    def __init__(self) -> None:
        self._heap: list[NetworkEvent] = []
        self._sequence = 0
        self._cancelled = 0

    def __len__(self) -> int:
        return len(self._heap) - self._cancelled

    @property
    def next_ns(self) -> int | None:
        """Time of the next event, None if nothing is planned."""
        while self._heap and self._heap[0].action is None:
            heappop(self._heap)
            self._cancelled -= 1
        return self._heap[0].time_ns if self._heap else None

    def plan(self, time_ns: int, action: Callable[[], None]) -> NetworkEvent:
        """Plan ``action`` for ``time_ns``."""
        self._sequence += 1
        event = NetworkEvent(time_ns, self._sequence, action)
        heappush(self._heap, event)
        return event

    def cancel(self, event: NetworkEvent) -> None:
        """Take a planned event back; nothing happens if it is over or already cancelled."""
        if event.action is None:
            return
        event.action = None
        self._cancelled += 1
        if self._cancelled > 64 + len(self._heap) // 2:
            # Long time limits that are nearly always cancelled must not pile up.
            self._heap = [kept for kept in self._heap if kept.action is not None]
            heapify(self._heap)
            self._cancelled = 0

    def take_due(self, now_ns: int) -> tuple[int, Callable[[], None]] | None:
        """Take the next event that is due: its time and its action, or None."""
        time_ns = self.next_ns
        if time_ns is None or time_ns > now_ns:
            return None
        event = heappop(self._heap)
        action, event.action = event.action, None
        return None if action is None else (time_ns, action)
