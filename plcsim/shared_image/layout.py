"""Where things lie in the shared mapping: header, directory, two banks, rings.

The header is an array of 64-bit cells, each written in one store by one side only. A snapshot goes
into the bank that is not the latest: its BEGIN cell, the bytes, its END cell, then LATEST. A reader
copies the latest bank and takes the copy only if BEGIN and END still hold the number it started
from. This needs stores to become visible in program order, which x86-64 guarantees; on other
processors a fence would be needed.
"""

from __future__ import annotations

import mmap
import os
from typing import Final, NamedTuple

from st_types.types.layout import align_up

MAGIC: Final = 0x504C_4349_4D47_0001
HEADER_SIZE: Final = 4096
RING_SIZE: Final = 64 * 1024
"""Bytes of one ring of commands."""

MAX_RINGS: Final = 8

CELL_MAGIC, CELL_HASH, CELL_DIRECTORY_SIZE, CELL_BANK_SIZE, CELL_RINGS = range(5)
CELL_LATEST: Final = 16
CELL_BEGIN: Final = (24, 32)
CELL_END: Final = (25, 33)
_FIRST_RING: Final = 64
_CELLS_PER_RING: Final = 16


class RingCells(NamedTuple):
    """Cells of one ring: bytes put in, bytes applied and shown, commands that made no sense."""

    head: int
    tail: int
    refused: int


def ring_cells(number: int) -> RingCells:
    """Return the cells of a ring; head and tail on cache lines of their own."""
    first = _FIRST_RING + number * _CELLS_PER_RING
    return RingCells(first, first + 8, first + 9)


class Regions(NamedTuple):
    """Offsets in bytes from the start of the mapping, and its size."""

    banks: tuple[int, int]
    rings: tuple[int, ...]
    size: int


def regions(directory_size: int, bank_size: int, rings: int) -> Regions:
    """Return where banks and rings lie."""
    first = align_up(HEADER_SIZE + directory_size, 64)
    second = align_up(first + bank_size, 64)
    ring = align_up(second + bank_size, 64)
    places = tuple(ring + i * RING_SIZE for i in range(rings))
    return Regions((first, second), places, align_up(ring + rings * RING_SIZE, mmap.PAGESIZE))


def make_file() -> int:
    """Return the descriptor of an empty shared memory file, to be handed to the processes."""
    return os.memfd_create("plcsim-image")
