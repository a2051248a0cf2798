"""Records for a replay, given out piece by piece as the controller asks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.recorder.journal.record import CYCLE, ENDINGS, JournalRecord, entries, numbers_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from plcsim.core.control import Ending
    from plcsim.recorder.journal.record import JournalStore


class EndOfRecord(BaseException):
    """The controller asks the clock for more than was recorded: here the recorded run ended.

    No Exception, so that no program catches it.
    """


class Diverged(BaseException):
    """The replay asks for something else than the recorded run did; no Exception, as above."""


class Feed:
    """What a replay still has before it.

    Args:
        records: of the recording, in order, the first one before the controller is made.

    Attributes:
        current: the record that is being used up, None behind the last one.
        reason: why the replay differs, "" while it does not.
        end_run: called where the recorded run was asked to end.
    """

    def __init__(self, records: Iterable[JournalRecord]) -> None:
        self._records: Iterator[JournalRecord] = iter(records)
        self.current: JournalRecord | None = None
        self.reason = ""
        self.end_run: Callable[[Ending], None] = lambda _ending: None
        self._endings: dict[int, Ending] = {}
        self._clock: tuple[int, ...] = ()
        self._number = self._byte = self._latch = 0
        self.advance()

    def advance(self) -> None:
        """Go to the next record."""
        record = self.current = next(self._records, None)
        self._number = self._byte = self._latch = 0
        self._clock = numbers_of(record.clock) if record is not None else ()
        self._endings = {}
        if record is not None and record.writes:
            asked = [each for each in entries(record.writes) if each.address in ENDINGS]
            self._endings = {each.latch: ENDINGS[each.address] for each in asked}
            self._end_run()

    def _end_run(self) -> None:
        """Ask the run to end where it was asked to, by the answers of the clock so far."""
        if self._number in self._endings:
            self.end_run(self._endings.pop(self._number))

    @property
    def left(self) -> str:
        """Say what of the record has not been asked for, "" where nothing is left."""
        record = self.current
        if record is None:
            return ""
        if self._number < len(self._clock):
            return f"{len(self._clock) - self._number} times the clock was asked more often"
        if self._byte < len(record.network):
            return "the network was asked more often"
        return ""

    def number(self) -> int:
        """Return the next answer of the clock.

        Raises:
            EndOfRecord: there is none in a record that no cycle ended.
            Diverged: the cycle had no more.
        """
        record, at = self.current, self._number
        if at < len(self._clock):
            self._number = at + 1
            if self._endings:
                self._end_run()
            return self._clock[at]
        if record is None or record.step != CYCLE:
            raise EndOfRecord
        raise self.differs("the clock was asked less often")

    def answer(self, asked: bytes) -> int:
        """Return the outcome that the next call of the network had.

        Args:
            asked: the letter of the call.

        Raises:
            Diverged: that was another call, or there was none.
        """
        call, outcome = self.data(2)
        if call != asked[0]:
            raise self.differs(
                f"the network was asked for {chr(call)!r}, now for {asked.decode()!r}"
            )
        return outcome

    def data(self, size: int) -> bytes:
        """Return the next bytes of the network's answers.

        Raises:
            Diverged: there are not so many.
        """
        record, at = self.current, self._byte
        if record is None or at + size > len(record.network):
            raise self.differs("the network was asked less often")
        self._byte = at + size
        return record.network[at : at + size]

    def latch(self) -> list[JournalStore]:
        """Return what was written in the LATCH that begins now."""
        self._latch += 1
        return self.written(self._latch)

    def written(self, latch: int) -> list[JournalStore]:
        """Return what was written in a LATCH of this record; 0 for between two cycles."""
        if self.current is None or not self.current.writes:
            return []
        found = entries(self.current.writes)
        return [e for e in found if e.latch == latch and e.address not in ENDINGS]

    def differs(self, reason: str) -> Diverged:
        """Return the error for a difference; the first one counts."""
        self.reason = self.reason or reason
        return Diverged(reason)
