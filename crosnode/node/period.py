"""Loop periods: when the node asks its program for the next message or request."""

from __future__ import annotations


class Period:
    """Comes due once a period, on a grid from its first step; missed points are not caught up.

    Args:
        period_ns: nanoseconds; 0 or less is never due.
    """

    __slots__ = ("_due_ns", "_period_ns")

    def __init__(self, period_ns: int) -> None:
        self._period_ns = period_ns
        self._due_ns: int | None = None

    def is_due(self, now_ns: int) -> bool:
        """Whether a point of the grid has come since the last time this was true."""
        if self._period_ns <= 0:
            return False
        if self._due_ns is None:
            self._due_ns = now_ns
        if now_ns < self._due_ns:
            return False
        self._due_ns += ((now_ns - self._due_ns) // self._period_ns + 1) * self._period_ns
        return True
