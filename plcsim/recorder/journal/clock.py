"""The clock of a run that is recorded, and of one that is replayed."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.clock import Clock
    from plcsim.recorder.journal.feed import Feed
    from plcsim.recorder.journal.journal import Journal


class RecordedClock:
    """A clock whose answers go into the journal.

    Args:
        clock: answers.
        journal: takes the answers down.

    Attributes:
        journal: as above.
        recorded: the clock itself, for what must not stand in the journal.
    """

    def __init__(self, clock: Clock, journal: Journal) -> None:
        self.is_virtual = clock.is_virtual
        self.journal = journal
        self.recorded = clock
        self.stamp_ns = clock.stamp_ns
        self.sleep_until_ns = clock.sleep_until_ns
        note = journal.clock.append
        self.now_ns = _noted(clock.now_ns, note)
        self.cpu_ns = _noted(clock.cpu_ns, note)
        self.waits = _noted(clock.waits, note)
        self.unix_ns = _noted(clock.unix_ns, note)


def _noted(ask: Callable[[], int], note: Callable[[int], None]) -> Callable[[], int]:
    def answer() -> int:
        value = ask()
        note(value)
        return value

    return answer


class ReplayClock:
    """A clock that answers what was recorded.

    Args:
        feed: the records.
        is_virtual: as that of the recorded run.
    """

    def __init__(self, feed: Feed, *, is_virtual: bool) -> None:
        self.is_virtual = is_virtual
        self._feed = feed
        self._latest_ns = 0
        self.cpu_ns = self.waits = self.unix_ns = feed.number

    def now_ns(self) -> int:
        """Return the next recorded time."""
        self._latest_ns = self._feed.number()
        return self._latest_ns

    def stamp_ns(self) -> int:
        """Return the time that was asked for last."""
        return self._latest_ns

    def sleep_until_ns(self, until_ns: int) -> None:
        """Return at once: the next answer tells when the scan woke."""
