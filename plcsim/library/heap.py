"""Memory that programs reserve while they run, and give back.

What is free and what is reserved is known here and not in PLC memory, so a program that writes
where it should not spoils its data only. A restart of the controller frees everything.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from typing import TYPE_CHECKING, Final

from st_types.types.layout import align_up

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.core.memory import Memory

UNIT: Final = 8
"""Bytes; every block begins at a multiple of it and takes a multiple of it."""

CHUNK: Final = 0x1_0000
"""Bytes by which the heap grows at least."""


class FreeRanges:
    """Ranges of free addresses; those that touch are one."""

    def __init__(self) -> None:
        self._by_size: list[tuple[int, int]] = []
        self._size_at: dict[int, int] = {}
        self._start_of_end: dict[int, int] = {}
        self.total = 0

    @property
    def largest(self) -> int:
        """Bytes of the largest range."""
        return self._by_size[-1][0] if self._by_size else 0

    def add(self, start: int, size: int) -> None:
        """Add a range that touches none of those there, or joins them."""
        if start + size in self._size_at:
            size += self._remove(start + size)
        if start in self._start_of_end:
            before = self._start_of_end[start]
            size += self._remove(before)
            start = before
        insort(self._by_size, (size, start))
        self._size_at[start] = size
        self._start_of_end[start + size] = start
        self.total += size

    def take(self, size: int) -> int | None:
        """Take ``size`` bytes from the smallest range that has them; None where none has."""
        index = bisect_left(self._by_size, (size, 0))
        if index == len(self._by_size):
            return None
        found, start = self._by_size[index]
        self._remove(start)
        if found > size:
            self.add(start + size, found - size)
        return start

    def _remove(self, start: int) -> int:
        size = self._size_at.pop(start)
        del self._start_of_end[start + size]
        del self._by_size[bisect_left(self._by_size, (size, start))]
        self.total -= size
        return size


class Blocks:
    """Blocks reserved in some ranges.

    Args:
        start: of the first range.
        size: its bytes; 0 for none yet.
    """

    def __init__(self, start: int = 0, size: int = 0) -> None:
        self.free = FreeRanges()
        self._sizes: dict[int, int] = {}
        if size:
            self.free.add(start, size)

    def allocate(self, size: int) -> int | None:
        """Reserve ``size`` bytes and return their address; None where they do not fit."""
        size = align_up(max(size, 1), UNIT)
        address = self.free.take(size)
        if address is not None:
            self._sizes[address] = size
        return address

    def size_of(self, address: int) -> int | None:
        """Return the bytes of a block, None where none begins at ``address``."""
        return self._sizes.get(address)

    def release(self, address: int) -> bool:
        """Free a block; return whether one began at ``address``."""
        size = self._sizes.pop(address, None)
        if size is not None:
            self.free.add(address, size)
        return size is not None


class Heap:
    """What programs reserve while they run, in the memory of one controller.

    Args:
        memory: it takes more of it as it needs more.
    """

    def __init__(self, memory: Memory) -> None:
        self._memory = memory
        self._chunks: list[tuple[int, int]] = []
        self._blocks = Blocks()

    def allocate(self, size: int) -> int | None:
        """Reserve ``size`` bytes, zeroed, at a multiple of `UNIT`; None where memory is full."""
        address = self._blocks.allocate(size)
        if address is None and self._grow(size):
            address = self._blocks.allocate(size)
        if address is not None:
            self._memory.write(address, bytes(size))
        return address

    def _grow(self, size: int) -> bool:
        for wanted in (max(size + UNIT, CHUNK), size + UNIT):
            if wanted <= self.room:
                start = align_up(self._memory.allocate(wanted, UNIT), UNIT)
                taken = wanted - wanted % UNIT
                self._chunks.append((start, taken))
                self._blocks.free.add(start, taken)
                return True
        return False

    @property
    def room(self) -> int:
        """Bytes by which the heap can still grow."""
        return max(0, self._memory.size - align_up(self._memory.used, UNIT))

    def size_of(self, address: int) -> int | None:
        """Return the bytes of a block, a multiple of `UNIT`; None where none begins there."""
        return self._blocks.size_of(address)

    def release(self, address: int) -> bool:
        """Free a block; return whether one began at ``address``."""
        return self._blocks.release(address)

    @property
    def free_bytes(self) -> int:
        """Bytes that can still be reserved, if they lie as they are wanted."""
        return self._blocks.free.total + self.room

    @property
    def largest_free(self) -> int:
        """Bytes of the largest block that can still be reserved."""
        return max(self._blocks.free.largest, self.room - self.room % UNIT)

    def reset(self) -> None:
        """Free all blocks."""
        self._blocks = Blocks()
        for start, size in self._chunks:
            self._blocks.free.add(start, size)


class _HeapInUse:
    """The heap between two starts of a controller; the memory that it has taken stays its own."""

    def __init__(self, context: Context) -> None:
        self.heap = context.settings(Heap) or Heap(context.memory)
        context.give_settings(self.heap)

    def close(self) -> None:
        self.heap.reset()


def heap_of(context: Context) -> Heap:
    """Return the heap of a controller, which all its libraries share."""
    return context.library(_HeapInUse).heap
