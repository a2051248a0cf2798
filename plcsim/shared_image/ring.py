"""A ring of records with one producer (a service) and one consumer (the scan).

Positions are counted in bytes and never wrap; a record lies in one piece, so the last bytes before
the end of the ring may be filling. HEAD moves after the record is complete: a producer that dies in
the middle of one leaves nothing behind. The scan answers each record in its place, in any order;
TAIL moves past those that are answered, in order. The answer of a record can be read until the
producer needs the place again, so it takes note of it before.
"""

from __future__ import annotations

import struct
from collections import OrderedDict, deque
from typing import TYPE_CHECKING

from plcsim.shared_image.command import HEAD, OUTCOME_AT, CommandOutcome, answer_of, outcome_of
from plcsim.shared_image.errors import CommandRefused
from plcsim.shared_image.layout import RING_SIZE

if TYPE_CHECKING:
    from plcsim.shared_image.command import Answer, Command
    from plcsim.shared_image.layout import RingCells
    from plcsim.shared_image.stores import Plan

LARGEST_RECORD = RING_SIZE // 2

_FIELDS = struct.Struct("<IBxH")
"""The first bytes of `HEAD`; filling may be too short for all of it."""

_APPLIED = CommandOutcome.APPLIED.value

ANSWERS_KEPT = 4096
"""Answers that nobody has asked for; the oldest are forgotten."""


class Producer:
    """The service's end.

    Args:
        cells: the header, as 64-bit numbers.
        ring: the bytes of the ring.
        at: which cells belong to it.
    """

    def __init__(self, cells: memoryview[int], ring: memoryview[int], at: RingCells) -> None:
        self._cells = cells
        self._ring = ring
        self._at = at
        self._open: OrderedDict[int, int] = OrderedDict()
        self._answers: OrderedDict[int, bytes] = OrderedDict()

    def put(self, record: bytes) -> int:
        """Queue a record and return its ticket.

        Raises:
            CommandRefused: there is no room, or the record is too large for any ring.
        """
        size = len(record)
        if size > LARGEST_RECORD:
            raise CommandRefused(f"a command of {size} bytes is too long")
        head = self._cells[self._at.head]
        rest = RING_SIZE - head % RING_SIZE
        filling = rest if rest < size else 0
        end = head + filling + size
        if end - self._cells[self._at.tail] > RING_SIZE:
            raise CommandRefused("the ring of commands is full")
        if end > RING_SIZE:
            self._save_answers(end - RING_SIZE)
        if filling:
            self._store(head, HEAD.pack(filling, 0, 0, 0, 0)[:filling])
            head += filling
        self._store(head, record)
        self._open[head] = size
        self._cells[self._at.head] = end
        return head

    def _store(self, position: int, data: bytes) -> None:
        start = position % RING_SIZE
        self._ring[start : start + len(data)] = data

    def _save_answers(self, below: int) -> None:
        """Take note of the answers that lie where the next record shall."""
        while self._open and next(iter(self._open)) < below:
            position, size = self._open.popitem(last=False)
            self._answers[position] = self._record(position, size)
            if len(self._answers) > ANSWERS_KEPT:
                self._answers.popitem(last=False)

    def _record(self, position: int, size: int) -> bytes:
        start = position % RING_SIZE
        return bytes(self._ring[start : start + size])

    def outcome(self, ticket: int) -> CommandOutcome:
        """Return what has become of a record so far."""
        if ticket in self._open:
            start = ticket % RING_SIZE
            return outcome_of(self._ring[start : start + HEAD.size])
        saved = self._answers.get(ticket)
        return CommandOutcome.APPLIED if saved is None else answer_of(saved).outcome

    def take_answer(self, ticket: int) -> Answer | None:
        """Return the answer of a record, once; None while it waits, or where it is forgotten."""
        if ticket in self._answers:
            return answer_of(self._answers.pop(ticket))
        if ticket not in self._open or not self._ring[ticket % RING_SIZE + OUTCOME_AT]:
            return None
        return answer_of(self._record(ticket, self._open.pop(ticket)))

    @property
    def refused(self) -> int:
        """Records that the scan could make nothing of; above 0 means a fault of plcsim."""
        return self._cells[self._at.refused]


class Taken:
    """A record that the scan has taken.

    Attributes:
        kind: of the command, 0 for filling.
        count: of its operations.
        record: the record in the ring, where its answer goes to.
        end: position behind it.
        is_answered: its place may be used again.
        owners: of what it writes, as bits; noted by whoever took it, like the next two.
        plan: of a `Write`.
        command: another command.
    """

    __slots__ = ("command", "count", "end", "is_answered", "kind", "owners", "plan", "record")

    def __init__(self, kind: int, count: int, record: memoryview[int], end: int) -> None:
        self.kind = kind
        self.count = count
        self.record = record
        self.end = end
        self.is_answered = not kind
        self.owners = 0
        self.plan: Plan | None = None
        self.command: Command | None = None

    def answer(self, outcome: CommandOutcome) -> None:
        """Answer the record; what else is noted in it must be there already."""
        self.record[OUTCOME_AT] = outcome.value
        self.is_answered = True

    def applied(self) -> None:
        """Answer the record by `CommandOutcome.APPLIED`."""
        self.record[OUTCOME_AT] = _APPLIED
        self.is_answered = True


class Consumer:
    """The scan's end; arguments as for `Producer`."""

    def __init__(self, cells: memoryview[int], ring: memoryview[int], at: RingCells) -> None:
        self._cells = cells
        self._ring = ring
        self._at = at
        self._position = cells[at.tail]
        self._taken: deque[Taken] = deque()

    @property
    def is_empty(self) -> bool:
        """True where there is no record to take."""
        return self._cells[self._at.head] == self._position

    @property
    def is_open(self) -> bool:
        """True until all that was taken is answered and acknowledged."""
        return bool(self._taken)

    def take(self) -> Taken | None:
        """Take the next record, None where there is none."""
        while True:
            available = self._cells[self._at.head] - self._position
            if available == 0:
                return None
            if not 0 < available <= RING_SIZE or available % 8:
                break
            start = self._position % RING_SIZE
            size, kind, count = _FIELDS.unpack_from(self._ring, start)
            end = start + size
            least = HEAD.size if kind else 8
            if size < least or size % 8 or size > available or end > RING_SIZE:
                break
            self._position += size
            taken = Taken(kind, count, self._ring[start:end], self._position)
            self._taken.append(taken)
            if kind:
                return taken
        self._drop_all()
        return None

    def _drop_all(self) -> None:
        """Forget what is queued: without a length there is no next record to be found."""
        self._position = self._cells[self._at.head] & ~7
        self._taken.append(Taken(0, 0, self._ring[:0], self._position))
        self._cells[self._at.refused] += 1

    def serving(self, samples: int) -> None:
        """Show how many requests for samples are served."""
        self._cells[self._at.samples] = samples

    def acknowledge(self) -> bool:
        """Let the producer use the places of what is answered again; return whether any was."""
        taken, tail = self._taken, 0
        while taken and taken[0].is_answered:
            tail = taken.popleft().end
        if tail:
            self._cells[self._at.tail] = tail
        return bool(tail)
