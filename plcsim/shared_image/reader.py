"""A service's side of the shared image: consistent copies out, commands in."""

from __future__ import annotations

import mmap
import os

from plcsim.shared_image import layout
from plcsim.shared_image.command import MAX_OPERATIONS, Command, encode_command, merged
from plcsim.shared_image.directory import directory_from, hash_of
from plcsim.shared_image.errors import CommandRefused, ImageError, ImageNotReady
from plcsim.shared_image.ring import Producer

ATTEMPTS = 1000
"""To copy a snapshot. A copy fails only where the scan has published twice meanwhile."""

STALE_NS = 250_000_000
"""The scan is taken for dead after this time without a snapshot, or after three cycles."""


class ImageReader:
    """The image of a controller as a service sees it.

    Args:
        fd: the shared memory file.
        service: the table of plc.toml whose ring commands go into; "" for a reader only.

    Attributes:
        directory: what the image holds.

    Raises:
        ImageNotReady: the scan process has not laid the image out yet.
        ImageError: the file is not an image of this version of plcsim.
    """

    def __init__(self, fd: int, service: str = "") -> None:
        size = os.fstat(fd).st_size
        if size < layout.HEADER_SIZE:
            raise ImageNotReady("the scan process has not made the image yet")
        view = memoryview(mmap.mmap(fd, size))
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
        bank_size = self._cells[layout.CELL_BANK_SIZE]
        regions = layout.regions(length, bank_size, self._cells[layout.CELL_RINGS])
        self._banks = [view[at : at + bank_size] for at in regions.banks]
        self._producer: Producer | None = None
        if service:
            number = list(self.directory.services).index(service)
            at = regions.rings[number]
            ring = view[at : at + layout.RING_SIZE]
            self._producer = Producer(self._cells, ring, layout.ring_cells(number))

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

    def send(self, command: Command) -> int:
        """Queue a command, to be applied whole in one LATCH; return its ticket.

        Raises:
            CommandRefused: there is no room, or the command is too long.
            ImageError: the layout has changed.
        """
        self._check_layout()
        if self._producer is None:
            raise CommandRefused("this reader has no ring")
        command = merged(command)
        if len(command) > MAX_OPERATIONS:
            raise CommandRefused(f"a command of {len(command)} operations is too long")
        return self._producer.put(encode_command(command))

    def is_acknowledged(self, ticket: int) -> bool:
        """Return True once the command is applied and the latest snapshot shows it."""
        return self._producer is not None and self._producer.is_acknowledged(ticket)


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
