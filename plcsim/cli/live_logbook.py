"""Warnings of the logbook while the PLC runs, a line each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.logbook import Severity
from plcsim.core.task import Cause
from plcsim.core.text import escaped
from plcsim.shared_image.events import EventKind, entry_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.logbook import Entry
    from plcsim.shared_image.stream import StreamReader

MOST_PER_SECOND: Final = 10
"""Lines; what is more is counted, and told when it is quieter."""

OF_THE_HOST: Final = "cycle time violations by the host: plcsim doctor says why"


def is_by_host(source: str, text: str) -> bool:
    """Whether an entry of the logbook is about a cycle time violation by the host."""
    return source.startswith("task class") and f", cause {Cause.HOST.value}:" in text


def line_of(time_ns: int, source: str, text: str) -> str:
    """Return an entry as `plcsim run` prints it, without the end of the line."""
    return f"{time_ns / 1e9:>13.6f} s  {escaped(source)}: {escaped(text)}"


class LiveLogbook:
    """Prints warnings as they come; those by the host in one line for all.

    Errors are not printed where they end the run: its summary tells them.

    Args:
        events: gives a reader of the stream of events once there is one.
        say: prints a line.
        with_errors: the run goes on after them, so they are printed too.

    Attributes:
        shown: what was printed, as (time_ns, source, text).
    """

    def __init__(
        self,
        events: Callable[[], StreamReader | None],
        say: Callable[[str], None],
        *,
        with_errors: bool = False,
    ) -> None:
        self.shown: set[tuple[int, str, str]] = set()
        self._events = events
        self._say = say
        self._told = {Severity.WARNING, Severity.ERROR} if with_errors else {Severity.WARNING}
        self._reader: StreamReader | None = None
        self._second = 0
        self._lines = 0
        self._unsaid = 0
        self._told_of_host = False

    def look(self, now_ns: int) -> None:
        """Print what is new.

        Args:
            now_ns: on any clock that does not jump.
        """
        self._reader = self._reader or self._events()
        if self._reader is None:
            return
        if now_ns // 1_000_000_000 != self._second:
            self._begin_second(now_ns // 1_000_000_000)
        for record in self._reader.read():
            if record.kind == EventKind.ENTRY.value:
                self._tell(entry_of(record))

    def _begin_second(self, second: int) -> None:
        self._second = second
        self._lines = 0
        if self._unsaid:
            self._say(f"... and {self._unsaid} more entries of the logbook")
            self._unsaid = 0

    def _tell(self, entry: Entry) -> None:
        if entry.severity not in self._told:
            return
        if is_by_host(entry.source, entry.text):
            self._tell_of_host(entry)
        elif self._lines < MOST_PER_SECOND:
            self._lines += 1
            self.shown.add((entry.time_ns, entry.source, entry.text))
            self._say(line_of(entry.time_ns, entry.source, entry.text))
        else:
            self._unsaid += 1

    def _tell_of_host(self, entry: Entry) -> None:
        if not self._told_of_host:
            self._told_of_host = True
            self._say(line_of(entry.time_ns, entry.source, OF_THE_HOST))
