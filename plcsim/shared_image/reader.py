"""A service's side of the shared image: consistent copies and streams out, commands in."""

from __future__ import annotations

import mmap
import os
from typing import TYPE_CHECKING

from plcsim.shared_image import layout
from plcsim.shared_image.command import (
    MAX_OPERATIONS,
    Command,
    CommandOutcome,
    SampleCommand,
    Write,
    encode_command,
)
from plcsim.shared_image.directory import directory_from, hash_of
from plcsim.shared_image.errors import CommandRefused, ImageError, ImageNotReady
from plcsim.shared_image.events import LogbookReader
from plcsim.shared_image.force_list import ForcedTag, read_forces
from plcsim.shared_image.ring import Producer
from plcsim.shared_image.stream import StreamReader

if TYPE_CHECKING:
    from plcsim.shared_image.command import Answer

ATTEMPTS = 1000
"""To copy a snapshot. A copy fails only where the scan has published twice meanwhile."""

STALE_NS = 250_000_000
"""The scan is taken for dead after this time without a snapshot, or after three cycles."""


class ImageReader:
    """The image of a controller as a service sees it.

    Args:
        fd: the shared memory file.
        service: the table of plc.toml whose ring commands go into; "" for a reader only.
        ring: number of a ring that the caller has taken (see `plcsim.shared_image.guest`).

    Attributes:
        directory: what the image holds.

    Raises:
        ImageNotReady: the scan process has not laid the image out yet.
        ImageError: the file is not an image of this version of plcsim.
    """

    def __init__(self, fd: int, service: str = "", *, ring: int | None = None) -> None:
        size = os.fstat(fd).st_size
        if size < layout.HEADER_SIZE:
            raise ImageNotReady("the scan process has not made the image yet")
        self._view = view = memoryview(mmap.mmap(fd, size))
        self._cells = view[: layout.HEADER_SIZE].cast("Q")
        if self._cells[layout.CELL_MAGIC] == 0:
            raise ImageNotReady("the scan process has not made the image yet")
        if self._cells[layout.CELL_MAGIC] != layout.MAGIC:
            raise ImageError("this is not an image of this version of plcsim")
        length = self._cells[layout.CELL_DIRECTORY_SIZE]
        data = bytes(view[layout.HEADER_SIZE : layout.HEADER_SIZE + length])
        self._hash = hash_of(data)
        self._check_layout()
        self.directory = directory_from(data)
        bank_size = self.directory.bank_size
        self._regions = layout.regions(length, bank_size, self.directory.streams)
        self._banks = [view[at : at + bank_size] for at in self._regions.banks]
        if service:
            ring = list(self.directory.services).index(service)
        self._number = ring
        self._producer: Producer | None = None
        if ring is not None:
            at = self._regions.rings[ring]
            area = view[at : at + layout.RING_SIZE]
            self._producer = Producer(self._cells, area, layout.ring_cells(ring))

    def _check_layout(self) -> None:
        if self._cells[layout.CELL_HASH] != self._hash:
            raise ImageError("the layout of the image has changed")

    @property
    def layout_hash(self) -> int:
        """64 bits that stand for the variables, their types and addresses."""
        return self._hash

    @property
    def latest(self) -> int:
        """Number of the latest snapshot, 0 where there is none yet."""
        return self._cells[layout.CELL_LATEST]

    def copy(self, start: int, end: int) -> tuple[int, bytes]:
        """Return a snapshot's number and its bytes from ``start`` up to ``end``, all of one scan.

        Raises:
            ImageNotReady: nothing is published yet.
            ImageError: the layout has changed, or the scan publishes faster than this can copy.
        """
        cells = self._cells
        for _ in range(ATTEMPTS):
            number = cells[layout.CELL_LATEST]
            bank = number & 1
            data = bytes(self._banks[bank][start:end])
            if cells[layout.CELL_BEGIN[bank]] == number and cells[layout.CELL_END[bank]] == number:
                if number == 0:
                    raise ImageNotReady("nothing is published yet")
                self._check_layout()
                return number, data
        raise ImageError("the scan publishes faster than snapshots can be copied")

    def forces(self) -> list[ForcedTag]:
        """Return the forced tags, in the order in which they were forced.

        Raises:
            ImageError: the scan process has died while it wrote the list.
        """
        region = self._view[self._regions.forces :][: layout.FORCES_SIZE]
        return read_forces(self._cells, region)

    def events(self, *, from_oldest: bool = False) -> StreamReader:
        """Return a reader of what happens: entries of the logbook and violations.

        Args:
            from_oldest: begin with what is still there, not with what comes next.
        """
        region = self._view[self._regions.events :][: layout.EVENTS_SIZE]
        return StreamReader(self._cells, region, layout.EVENT_CELLS, from_oldest=from_oldest)

    def logbook(self, *, from_oldest: bool = True) -> LogbookReader:
        """Return a reader of the logbook; it sees what `Logbook` keeps, and more."""
        return LogbookReader(self.events(from_oldest=from_oldest))

    def samples(self, *, from_oldest: bool = False) -> StreamReader:
        """Return a reader of the samples that this service asks for from now on.

        Args:
            from_oldest: begin with what is still there, not with what comes next.

        Raises:
            ImageError: it has no stream.
        """
        size = 0 if self._number is None else self.directory.streams[self._number]
        if self._number is None or not size:
            raise ImageError("this reader has no stream of samples")
        region = self._view[self._regions.streams[self._number] :][:size]
        cells = layout.stream_cells(self._number)
        return StreamReader(self._cells, region, cells, from_oldest=from_oldest)

    def samples_of(self, ring: int) -> int:
        """Return how many requests for samples of a ring are served."""
        return self._cells[layout.ring_cells(ring).samples]

    def send(self, command: Command) -> int:
        """Queue a command, to be applied whole in one LATCH; return its ticket.

        Raises:
            CommandRefused: there is no room, or the command is too long.
            ImageError: the layout has changed.
        """
        self._check_layout()
        if self._producer is None:
            raise CommandRefused("this reader has no ring")
        count = 0
        if isinstance(command, Write):
            count = len(command.operations)
        elif isinstance(command, SampleCommand):
            count = len(command.spans)
        if count > MAX_OPERATIONS:
            raise CommandRefused(f"a command of {count} operations is too long")
        return self._producer.put(encode_command(command))

    def outcome(self, ticket: int) -> CommandOutcome:
        """Return what has become of a command so far; APPLIED once the latest snapshot shows it."""
        return CommandOutcome.WAITING if self._producer is None else self._producer.outcome(ticket)

    def take_answer(self, ticket: int) -> Answer | None:
        """Return the answer of a command, once; None while it waits.

        Only the last few thousand answers that nobody took are kept.
        """
        return None if self._producer is None else self._producer.take_answer(ticket)


class ScanWatch:
    """Tells a scan that stands still: the number of the snapshot does not change any more.

    Args:
        cycle_ns: the shortest cycle time.
    """

    def __init__(self, cycle_ns: int) -> None:
        self._limit_ns = max(STALE_NS, 3 * cycle_ns)
        self._seen = -1
        self._since_ns = 0

    def is_alive(self, latest: int, now_ns: int) -> bool:
        """Return False where ``latest`` has not changed for too long; call it regularly."""
        if latest != self._seen:
            self._seen, self._since_ns = latest, now_ns
        return now_ns - self._since_ns <= self._limit_ns
