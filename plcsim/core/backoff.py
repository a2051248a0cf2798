"""When to try again what failed: a little later each time, up to a longest pause."""

from __future__ import annotations


class Backoff:
    """Pauses between attempts; each is twice as long as the one before.

    Args:
        first_ns: nanoseconds of the first pause.
        longest_ns: nanoseconds of the longest.
    """

    __slots__ = ("_due_ns", "_first_ns", "_longest_ns", "_pause_ns")

    def __init__(self, first_ns: int, longest_ns: int) -> None:
        self._first_ns = self._pause_ns = first_ns
        self._longest_ns = longest_ns
        self._due_ns: int | None = None

    def is_due(self, now_ns: int) -> bool:
        """Whether the pause is over; before anything failed it is."""
        return self._due_ns is None or now_ns >= self._due_ns

    def failed(self, now_ns: int) -> None:
        """Begin a pause."""
        self._due_ns = now_ns + self._pause_ns
        self._pause_ns = min(2 * self._pause_ns, self._longest_ns)

    def succeeded(self) -> None:
        """Begin with the first pause again, when it fails the next time."""
        self._due_ns = None
        self._pause_ns = self._first_ns
