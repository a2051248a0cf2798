"""The logbook: a ring of fixed length, written without allocation that grows."""

from __future__ import annotations

from collections import deque
from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

LENGTH = 512
"""Entries kept; the oldest is dropped and counted."""


class Severity(Enum):
    """How bad it is, in the words of the controller's logger."""

    INFORMATION = "information"
    WARNING = "warning"
    ERROR = "error"


class Entry(NamedTuple):
    """One line of the logbook.

    Attributes:
        time_ns: on the controller's clock, since its start.
        severity: how bad it is.
        source: who reports: a program, a task class, "system".
        text: what happened, in one line.
    """

    time_ns: int
    severity: Severity
    source: str
    text: str

    def __str__(self) -> str:
        seconds, rest = divmod(self.time_ns, 1_000_000_000)
        stamp = f"{seconds:6d}.{rest // 1000:06d}"
        return f"{stamp} {self.severity.value:<11} {self.source}: {self.text}"


class Logbook:
    """The last `LENGTH` entries and the number of those dropped."""

    def __init__(self, length: int = LENGTH) -> None:
        self._entries: deque[Entry] = deque(maxlen=length)
        self._written = 0
        self._followers: list[Callable[[Entry], None]] = []

    def follow(self, written: Callable[[Entry], None]) -> None:
        """Have ``written`` called with every entry from now on."""
        self._followers.append(written)

    def write(self, time_ns: int, severity: Severity, source: str, text: str) -> None:
        """Add an entry; a full ring drops its oldest."""
        entry = Entry(time_ns, severity, source, text)
        self._entries.append(entry)
        self._written += 1
        for written in self._followers:
            written(entry)

    @property
    def dropped(self) -> int:
        """How many entries are no longer there."""
        return self._written - len(self._entries)

    def __iter__(self) -> Iterator[Entry]:
        return iter(tuple(self._entries))

    def __len__(self) -> int:
        return len(self._entries)
