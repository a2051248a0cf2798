"""Queues between the node and its program: bounded, the oldest entry is dropped for a new one.

They take the place of callbacks, as in the thesis (section 1.3): the node pushes, the program
pops.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Generic, TypeVar

if TYPE_CHECKING:
    from collections.abc import Sequence

T = TypeVar("T")


class DropOldestQueue(Generic[T]):
    """A queue that makes room by dropping its oldest entry.

    Args:
        length: entries it may hold, above 0.

    Attributes:
        dropped: entries dropped so far.
        pushed: entries pushed so far.
    """

    __slots__ = ("_entries", "dropped", "length", "pushed")

    def __init__(self, length: int) -> None:
        if length < 1:
            raise ValueError(f"a queue of {length} entries: must be above 0")
        self.length = length
        self.dropped = 0
        self.pushed = 0
        self._entries: deque[T] = deque()

    def __len__(self) -> int:
        return len(self._entries)

    def push(self, entry: T) -> None:
        """Add an entry."""
        self.pushed += 1
        if len(self._entries) == self.length:
            self._entries.popleft()
            self.dropped += 1
        self._entries.append(entry)

    def extend(self, entries: Sequence[T]) -> None:
        """Add entries."""
        self.pushed += len(entries)
        self._entries.extend(entries)
        while len(self._entries) > self.length:
            self._entries.popleft()
            self.dropped += 1

    def pop(self) -> T | None:
        """Return the oldest entry and take it away, None where there is none."""
        return self._entries.popleft() if self._entries else None

    @property
    def newest(self) -> T | None:
        """The entry pushed last, where it still waits."""
        return self._entries[-1] if self._entries else None

    def release(self) -> None:
        """Forget all entries."""
        self._entries.clear()
