"""Where things lie in the shared mapping: header, directory, banks, rings, streams.

The header is an array of 64-bit cells, each written in one store by one side only. A snapshot goes
into the bank that is not the latest: its BEGIN cell, the bytes, its END cell, then LATEST. A reader
copies the latest bank and takes the copy only if BEGIN and END still hold the number it started
from. This needs stores to become visible in program order, which x86-64 guarantees; on other
processors a fence would be needed.

Rings and streams have numbers: first those of the services in the order of the directory, then
those of `GUESTS` processes that come and go, such as ``plcsim force``. A guest takes a ring by a
lock on its byte of the file; the kernel gives it back when the guest ends, however it ends.
"""

from __future__ import annotations

import mmap
import os
from typing import TYPE_CHECKING, Final, NamedTuple

from st_types.types.layout import align_up

if TYPE_CHECKING:
    from collections.abc import Sequence

MAGIC: Final = 0x504C_4349_4D47_0002
HEADER_SIZE: Final = 4096
RING_SIZE: Final = 64 * 1024
"""Bytes of one ring of commands."""

EVENTS_SIZE: Final = 256 * 1024
"""Bytes of the stream of what happened; some thousand entries of the logbook."""

GUEST_STREAM_SIZE: Final = 128 * 1024
"""Bytes of the stream of a guest."""

FORCES_SIZE: Final = 64 * 1024
"""Bytes of the list of forced tags."""

GUESTS: Final = 4
MAX_RINGS: Final = 16

CELL_MAGIC, CELL_HASH, CELL_DIRECTORY_SIZE = range(3)
CELL_LATEST: Final = 16
CELL_BEGIN: Final = (24, 32)
CELL_END: Final = (25, 33)
_EVENTS: Final = 40
_FORCES: Final = 48
HEADS: Final = 64
"""Cell of the head of the first ring; the others follow, so that the scan sees all at one look."""

_FIRST_RING: Final = 80
_CELLS_PER_RING: Final = 16


class RingCells(NamedTuple):
    """Cells of one ring: bytes put in, bytes that may be used again, faults, samples served."""

    head: int
    tail: int
    refused: int
    samples: int


class StreamCells(NamedTuple):
    """Cells of one stream: bytes put in, start of the oldest record, records, those too long."""

    head: int
    tail: int
    records: int
    too_long: int


class ListCells(NamedTuple):
    """Cells of the list of forces: numbers of its versions, and the bytes of the present one."""

    begin: int
    end: int
    size: int


def ring_cells(number: int) -> RingCells:
    """Return the cells of a ring; what the scan writes lies on other cache lines than the heads."""
    first = _FIRST_RING + number * _CELLS_PER_RING
    return RingCells(HEADS + number, first, first + 1, first + 2)


def stream_cells(number: int) -> StreamCells:
    """Return the cells of the stream beside a ring."""
    first = _FIRST_RING + number * _CELLS_PER_RING + 8
    return StreamCells(first, first + 1, first + 2, first + 3)


EVENT_CELLS: Final = StreamCells(_EVENTS, _EVENTS + 1, _EVENTS + 2, _EVENTS + 3)
FORCE_CELLS: Final = ListCells(_FORCES, _FORCES + 1, _FORCES + 2)


class Regions(NamedTuple):
    """Offsets in bytes from the start of the mapping, and its size."""

    banks: tuple[int, int]
    forces: int
    events: int
    rings: tuple[int, ...]
    streams: tuple[int, ...]
    size: int


def regions(directory_size: int, bank_size: int, streams: Sequence[int]) -> Regions:
    """Return where everything lies.

    Args:
        directory_size: bytes of the directory.
        bank_size: bytes of a snapshot.
        streams: bytes of the stream beside each ring, 0 for none.
    """
    sizes = [bank_size, bank_size, FORCES_SIZE, EVENTS_SIZE]
    sizes += [RING_SIZE] * len(streams) + list(streams)
    at, places = align_up(HEADER_SIZE + directory_size, 64), []
    for size in sizes:
        places.append(at)
        at = align_up(at + size, 64)
    first, second, forces, events, *rest = places
    rings, behind = rest[: len(streams)], rest[len(streams) :]
    size = align_up(at, mmap.PAGESIZE)
    return Regions((first, second), forces, events, tuple(rings), tuple(behind), size)


def make_file() -> int:
    """Return the descriptor of an empty shared memory file, to be handed to the processes."""
    return os.memfd_create("plcsim-image")
