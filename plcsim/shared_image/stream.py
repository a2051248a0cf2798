"""A stream: records in order, out of the scan to any number of readers, none of whom it waits for.

The scan writes into a ring of bytes over the oldest records; a reader that is too slow loses those,
and counts them by the gap in their numbers. Positions are counted in bytes and never wrap. Before
the scan overwrites a record it moves TAIL past it; HEAD moves when a record is complete. So a
reader copies what lies between the two and keeps what TAIL has not passed meanwhile.
"""

from __future__ import annotations

import struct
from collections import deque
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.shared_image.layout import StreamCells

_HEAD = struct.Struct("<IIQq")
"""Bytes of the record, itself and padding included; kind and bytes of padding; number; time."""

_HEAD_SIZE = _HEAD.size
_HEAD_AND_PADDING = _HEAD_SIZE + 7
_pack_head = _HEAD.pack_into

_SIZE = struct.Struct("<I")
"""The first field; 0 for what fills the end of the ring."""

PIECE = 1 << 18
"""Bytes that a reader copies at once, where one record is not longer."""

BLOCKS = 64
"""In so many parts of a stream old records are let go of."""

_KIND_BITS = 28
_KIND = (1 << _KIND_BITS) - 1


class StreamRecord(NamedTuple):
    """One record of a stream.

    Attributes:
        kind: what it is, above 0.
        number: 0 for the first of the stream.
        time_ns: on the controller's clock, since its start.
        data: as written.
    """

    kind: int
    number: int
    time_ns: int
    data: bytes


class StreamWriter:
    """The scan's end.

    Args:
        cells: the header, as 64-bit numbers.
        ring: the bytes of the stream, a multiple of 8; none for a service that asked for none.
        at: which cells belong to it.
    """

    __slots__ = (
        "_at_head",
        "_at_records",
        "_at_tail",
        "_at_too_long",
        "_block",
        "_cells",
        "_head",
        "_marks",
        "_records",
        "_ring",
        "_room_end",
        "_size",
        "_start",
        "_tail",
    )

    def __init__(self, cells: memoryview[int], ring: memoryview[int], at: StreamCells) -> None:
        self._cells = cells
        self._ring = ring
        self._at_head, self._at_tail, self._at_records, self._at_too_long = at
        self._size = len(ring)
        self._block = self._size // BLOCKS
        self._head = cells[at.head]
        self._tail = cells[at.tail]
        self._records = cells[at.records]
        self._start = self._room_end = self._head % self._size if self._size else 0
        self._marks = deque(self._places())

    def _places(self) -> Iterator[int]:
        """Return where the records lie that another writer has left."""
        place = self._tail
        while place < self._head:
            yield place
            offset = place % self._size
            place += _SIZE.unpack_from(self._ring, offset)[0] or self._size - offset

    def write(self, kind: int, time_ns: int, data: bytes) -> None:
        """Add a record; one that is longer than half the stream is lost, and counted."""
        count = len(data)
        size = count + _HEAD_AND_PADDING & -8
        start = self._start
        end = start + size
        if end > self._room_end:
            if 2 * size > self._size:
                self._cells[self._at_too_long] += 1
                return
            start = self._make_room(size)
            end = start + size
        ring, cells, records = self._ring, self._cells, self._records
        begin = start + _HEAD_SIZE
        behind = begin + count
        _pack_head(ring, start, size, end - behind << _KIND_BITS | kind, records, time_ns)
        ring[begin:behind] = data
        self._start = end
        self._records = cells[self._at_records] = records + 1
        self._head = cells[self._at_head] = self._head + size

    def _make_room(self, size: int) -> int:
        """Let go of the oldest records that lie where the next ones shall; return their place.

        That is done for a block at once, or it would cost each record of a full stream its time.
        """
        start = end = self._start % self._size
        if start + size > self._size:  # the rest of the ring becomes filling
            self._head += self._size - start
            start = 0
        room = min(max(size, self._block), self._size - start)
        self._marks.append(self._head)
        oldest = self._head + room - self._size
        if self._tail < oldest:
            while self._tail < oldest:
                self._tail = self._marks.popleft()
            self._cells[self._at_tail] = self._tail
        if start != end:
            _SIZE.pack_into(self._ring, end, 0)
        self._room_end = start + room
        return start


class StreamReader:
    """One reader's end; other arguments as for `StreamWriter`.

    Args:
        from_oldest: begin with what is still there; what is not counts as lost.
    """

    def __init__(
        self,
        cells: memoryview[int],
        ring: memoryview[int],
        at: StreamCells,
        *,
        from_oldest: bool = False,
    ) -> None:
        self._cells = cells
        self._ring = ring
        self._at = at
        self._size = len(ring)
        self._gaps = 0
        self._too_long = 0 if from_oldest else cells[at.too_long]
        # the head first: a record that is written meanwhile is read, and no gap
        self._position = 0 if from_oldest else cells[at.head]
        self._expected = 0 if from_oldest else cells[at.records]

    @property
    def lost(self) -> int:
        """Records so far that were overwritten before they were read, or were too long."""
        return self._gaps + self._cells[self._at.too_long] - self._too_long

    def read(self, most: int = 1000) -> list[StreamRecord]:
        """Return the records that are new, the oldest first.

        Args:
            most: records at once.
        """
        records: list[StreamRecord] = []
        while len(records) < most:
            part = self._read_part(most - len(records))
            if not part:
                break
            records += part
        return records

    def _read_part(self, most: int) -> list[StreamRecord]:
        """Return new records that lie in one piece; none where there are none."""
        cells, at = self._cells, self._at
        while True:
            position = max(self._position, cells[at.tail])
            head = cells[at.head]
            if position >= head:
                return []
            start = position % self._size
            (first,) = _SIZE.unpack_from(self._ring, start)  # overwritten, perhaps: see ``passed``
            piece = min(head - position, self._size - start, max(first, PIECE))
            data = bytes(self._ring[start : start + piece])
            passed = max(0, cells[at.tail] - position)  # what was overwritten while we copied
            found = self._parse(data, position, passed, most)
            if found:
                return found

    def _parse(self, data: bytes, position: int, at: int, most: int) -> list[StreamRecord]:
        """Return the records in ``data`` from ``at`` on, and go on behind them."""
        found: list[StreamRecord] = []
        while at < len(data) and len(found) < most:
            (size,) = _SIZE.unpack_from(data, at)
            if not size:
                at = self._size - position % self._size
                break
            if at + size > len(data):
                break
            size, kind, number, time_ns = _HEAD.unpack_from(data, at)
            end = at + size - (kind >> _KIND_BITS)
            found.append(StreamRecord(kind & _KIND, number, time_ns, data[at + _HEAD.size : end]))
            self._gaps += max(0, number - self._expected)
            self._expected = number + 1
            at += size
        self._position = position + at
        return found
