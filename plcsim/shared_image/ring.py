"""A ring of records with one producer (a service) and one consumer (the scan).

Positions are counted in bytes and never wrap; a record lies in one piece, so the last bytes before
the end of the ring may be filling. HEAD moves after the record is complete: a producer that dies in
the middle of one leaves nothing behind. TAIL moves when the scan has applied a record *and*
published a snapshot that shows it: that is the acknowledgement.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.shared_image.command import HEAD
from plcsim.shared_image.errors import CommandRefused
from plcsim.shared_image.layout import RING_SIZE

if TYPE_CHECKING:
    from plcsim.shared_image.layout import RingCells

LARGEST_RECORD = RING_SIZE // 2


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

    def put(self, record: bytes) -> int:
        """Queue a record and return its ticket for `is_acknowledged`.

        Raises:
            CommandRefused: there is no room, or the record is too large for any ring.
        """
        size = len(record)
        if size > LARGEST_RECORD:
            raise CommandRefused(f"a command of {size} bytes is too long")
        head = self._cells[self._at.head]
        rest = RING_SIZE - head % RING_SIZE
        filling = rest if rest < size else 0
        if head + filling + size - self._cells[self._at.tail] > RING_SIZE:
            raise CommandRefused("the ring of commands is full")
        if filling:
            self._store(head, HEAD.pack(filling, 0))
            head += filling
        self._store(head, record)
        self._cells[self._at.head] = head + size
        return head + size

    def _store(self, position: int, data: bytes) -> None:
        start = position % RING_SIZE
        self._ring[start : start + len(data)] = data

    def is_acknowledged(self, ticket: int) -> bool:
        """Return True once the command is applied and a snapshot shows it."""
        return self._cells[self._at.tail] >= ticket

    @property
    def refused(self) -> int:
        """Records that the scan found to make no sense; above 0 means a fault of plcsim."""
        return self._cells[self._at.refused]


class Consumer:
    """The scan's end; arguments as for `Producer`."""

    def __init__(self, cells: memoryview[int], ring: memoryview[int], at: RingCells) -> None:
        self._cells = cells
        self._ring = ring
        self._at = at
        self.position = cells[at.tail]

    def peek(self) -> bytes | None:
        """Return the next record without taking it, None where there is none."""
        while True:
            available = self._cells[self._at.head] - self.position
            if available <= 0:
                return None
            if available > RING_SIZE or available % 8:
                self._drop_all()
                return None
            start = self.position % RING_SIZE
            size, count = HEAD.unpack_from(self._ring, start)
            if size < HEAD.size or size % 8 or size > min(available, RING_SIZE - start):
                self._drop_all()
                return None
            if count:
                return bytes(self._ring[start : start + size])
            self.position += size

    def _drop_all(self) -> None:
        """Forget what is queued: without a length there is no next record to be found."""
        self.position = self._cells[self._at.head] & ~7
        self.refuse()

    def refuse(self) -> None:
        """Count a record that makes no sense."""
        self._cells[self._at.refused] += 1

    def acknowledge(self, position: int) -> None:
        """Say that everything before ``position`` is applied and shown."""
        self._cells[self._at.tail] = position
