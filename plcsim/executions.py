"""Who used the CPU lately: what tells a preempted cycle from one that the host disturbed."""

from __future__ import annotations

from typing import NamedTuple

LENGTH = 256
"""Executions remembered; enough for eight classes between two releases of the slowest."""


class Execution(NamedTuple):
    """One run of one program."""

    task_class: int
    program: str
    start_ns: int
    end_ns: int
    used_ns: int

    def share_ns(self, start_ns: int, end_ns: int) -> int:
        """Return how much of the time used can lie between ``start_ns`` and ``end_ns``."""
        overlap_ns = min(self.end_ns, end_ns) - max(self.start_ns, start_ns)
        return max(0, min(self.used_ns, overlap_ns))


class Executions:
    """A ring of the last `LENGTH` executions."""

    __slots__ = ("_next", "_ring")

    def __init__(self) -> None:
        self._ring: list[tuple[int, str, int, int, int] | None] = [None] * LENGTH
        self._next = 0

    def record(self, execution: tuple[int, str, int, int, int]) -> None:
        """Remember one execution, given as the fields of `Execution`."""
        self._ring[self._next] = execution
        self._next = (self._next + 1) % LENGTH

    def between(self, start_ns: int, end_ns: int) -> list[tuple[Execution, int]]:
        """Return the executions between two times, each with the time it used there."""
        known = (Execution(*entry) for entry in self._ring if entry is not None)
        shares = ((e, e.share_ns(start_ns, end_ns)) for e in known if e.end_ns > start_ns)
        return [(e, share_ns) for e, share_ns in shares if share_ns > 0]
