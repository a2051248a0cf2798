"""Received bytes, and generator parsers over them.

A parser is a generator written as if all bytes were there: ``data = yield from reader.exactly(n)``.
Where bytes are missing it yields None, and goes on from there when it is resumed.
"""

from __future__ import annotations

import mmap
import struct
from sys import getrefcount
from typing import TYPE_CHECKING, Final

from crosnode.errors import TcprosError
from crosnode.transport.connection import MOST_READ

if TYPE_CHECKING:
    from collections.abc import Generator

_LENGTH: Final = struct.Struct("<I")

LARGE: Final = 1 << 16
"""Bytes; larger blocks go to memory of their own as they come."""

BEHIND_LARGE: Final = 4_096
"""Bytes that are read behind a large block, to learn the length of the next one."""

KEPT: Final = 3
"""Memories that a reader keeps for the next large blocks, whatever their size."""

KEPT_BYTES: Final = 1 << 24
"""Bytes of the memories that it keeps beyond these: as many wait for the program with what comes in
a step of 10 ms."""

MOST_KEPT: Final = 64
"""Memories that it keeps at most, for each is looked at."""

UNUSED_NS: Final = 1_000_000_000
"""Nanoseconds after which a memory that was not used goes back to the system."""

GIVEN_BACK: Final = 1 << 16
"""Bytes of it that go at once: a large one as a whole takes longer than a step may."""


class BlockMemory:
    """Memory for large blocks: reserved at once, but the system lays out a page when it is filled.

    A memory is used again when nobody has a view of it, so a stream of images costs page faults
    for the first ones only. Beyond ``KEPT`` of them, what is not used for long is given back.

    Attributes:
        is_fresh: whether the system has yet to lay out the pages of what was taken last.
    """

    __slots__ = ("_kept", "_oldest", "_oldest_ns", "is_fresh")

    def __init__(self) -> None:
        self._kept: list[mmap.mmap] = []  # in the order in which they were taken
        self._oldest = self._oldest_ns = 0
        self.is_fresh = True

    def take(self, size: int) -> mmap.mmap:
        """Return memory of at least ``size`` bytes, of whatever was there before."""
        kept = self._kept
        for place in reversed(range(len(kept))):  # what was used last is still in the caches
            if len(kept[place]) >= size and getrefcount(kept[place]) == _UNUSED:
                kept.append(kept.pop(place))
                self.is_fresh = False
                return kept[-1]
        # Private: pages of shared memory cost more.
        kept.append(mmap.mmap(-1, size, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS))
        while len(kept) > KEPT and (len(kept) > MOST_KEPT or sum(map(len, kept)) > KEPT_BYTES):
            del kept[0]
        self.is_fresh = True
        return kept[-1]

    def give_back(self, now_ns: int) -> None:
        """Give the system a piece of what was not used for long; called now and then."""
        kept = self._kept
        if len(kept) <= KEPT:
            return
        if id(kept[0]) != self._oldest:
            self._oldest, self._oldest_ns = id(kept[0]), now_ns
        elif now_ns - self._oldest_ns >= UNUSED_NS and getrefcount(kept[0]) == _UNUSED:
            if len(kept[0]) > GIVEN_BACK:
                kept[0].resize(len(kept[0]) - GIVEN_BACK)
            else:
                del kept[0]


_PROBE: Final = [object()]
_UNUSED: Final = getrefcount(_PROBE[0])
"""References to an object that only a list has, with those of the call that counts them."""


class LargeBlock:
    """A block of ``size`` bytes that is filled as they come.

    Args:
        size: bytes.
        memory: at least as many bytes.

    Attributes:
        size: bytes.
        data: the bytes that came, and room for more.
        have: how many came.
    """

    __slots__ = ("data", "have", "size")

    def __init__(self, size: int, memory: mmap.mmap) -> None:
        self.size = size
        self.data = memoryview(memory)[:size]
        self.have = 0

    @property
    def is_full(self) -> bool:
        """Whether all bytes came."""
        return self.have == self.size

    def fill(self, data: memoryview) -> memoryview:
        """Take bytes; return those that belong to what follows the block."""
        piece = min(len(data), self.size - self.have)
        self.data[self.have : self.have + piece] = data[:piece]
        self.have += piece
        return data[piece:]


class ByteReader:
    """Bytes received and not parsed yet, and whether the peer has closed.

    Attributes:
        next_read: bytes that the next read should ask for at most.
    """

    __slots__ = ("_buffer", "_eof", "_expected", "_large", "_last", "_memory", "next_read")

    def __init__(self) -> None:
        self.next_read = MOST_READ
        self._buffer = bytearray()
        self._eof = False
        self._large: LargeBlock | None = None
        self._last = self._expected = 0
        self._memory = BlockMemory()

    def __len__(self) -> int:
        return len(self._buffer)

    def feed(self, data: bytes | bytearray | memoryview) -> None:
        """Add received bytes; they are copied, so ``data`` may change afterwards."""
        self.next_read = MOST_READ
        if self._large is not None:
            data = self._large.fill(memoryview(data))
        self._buffer += data

    @property
    def room(self) -> memoryview | None:
        """Where the rest of a large block goes, None where none is being filled."""
        large = self._large
        return None if large is None or large.is_full else large.data[large.have :]

    @property
    def is_room_fresh(self) -> bool:
        """Whether the system lays out the pages of ``room`` as they are filled."""
        return self._memory.is_fresh

    def filled(self, size: int) -> None:
        """Note that bytes of a large block lie in their ``room``."""
        assert self._large is not None
        self._large.have += size

    def give_back(self, now_ns: int) -> None:
        """Give the system a piece of the memory of large blocks that was not used for long."""
        self._memory.give_back(now_ns)

    @property
    def is_idle(self) -> bool:
        """Whether a parser can go on with bytes to come only."""
        return not (self._buffer or self._eof or self._expected or self._large)

    def feed_eof(self) -> None:
        """Note that no more bytes will come."""
        self._eof = True

    def clear(self) -> None:
        """Drop what is not parsed."""
        self._buffer.clear()
        self._large = None

    def more(self) -> Generator[None, None, bool]:
        """Wait for the next byte; return False where the peer has closed instead."""
        while not self._buffer:
            if self._eof:
                return False
            yield
        return True

    def more_blocks(self) -> Generator[None, None, bool]:
        """Wait as ``more`` does, where all that comes are blocks, to be taken by ``large_block``.

        After two large blocks of one size the next is expected to be like them: it is read to its
        place with its length, without a look at that first.
        """
        if self._expected and not self._buffer:
            size = _LENGTH.size + self._expected
            self._large = LargeBlock(size, self._memory.take(size))
        while self._large is None or not self._large.have:
            if self._buffer or self._eof:
                return bool(self._buffer)
            yield
        return True

    def exactly(self, size: int) -> Generator[None, None, bytes]:
        """Take ``size`` bytes.

        Raises:
            TcprosError: the peer closes before.
        """
        buffer = self._buffer
        while len(buffer) < size:
            if self._eof:
                raise TcprosError(f"connection closed after {len(buffer)} of {size} bytes")
            yield
        data = bytes(memoryview(buffer)[:size])
        del buffer[:size]
        return data

    def large(self, size: int) -> Generator[None, None, bytes | memoryview]:
        """Take ``size`` bytes as they come, so that the last of them is not the most work.

        Where they do not fit into one read they go to their place as they are fed, and what is
        returned is a read-only view of it. Raises as ``exactly`` does.
        """
        if size <= LARGE:
            return (yield from self.exactly(size))
        block = LargeBlock(size, self._memory.take(_LENGTH.size + size))
        with memoryview(self._buffer) as data:
            used = len(data) - len(block.fill(data))
        del self._buffer[:used]
        self._large = block
        self._expected, self._last = size if size == self._last else 0, size
        return (yield from self._whole(block))

    def _whole(self, block: LargeBlock) -> Generator[None, None, memoryview]:
        """Wait for the rest of a block, and return a read-only view of it."""
        yield from self._wait_for(block.size, block)
        self._large = None
        self.next_read = BEHIND_LARGE
        return block.data.toreadonly()

    def _wait_for(self, have: int, block: LargeBlock) -> Generator[None, None, None]:
        """Wait until a block has so many bytes."""
        while block.have < have:
            if self._eof:
                raise TcprosError(f"connection closed after {block.have} of {block.size} bytes")
            yield

    def large_block(self, limit: int, what: str) -> Generator[None, None, bytes | memoryview]:
        """Take a block as ``block`` does, its bytes as ``large`` does."""
        block = self._large
        if block is not None and (yield from self._is_as_expected(block)):
            return (yield from self._whole(block))[_LENGTH.size :]
        size = yield from self._length(limit, what)
        return (yield from self.large(size))

    def _is_as_expected(self, block: LargeBlock) -> Generator[None, None, bool]:
        """Look at the length of an expected block; what is none of its size is parsed anew."""
        yield from self._wait_for(_LENGTH.size, block)
        if _LENGTH.unpack_from(block.data) == (self._expected,):
            return True
        self._buffer[:0] = block.data[: block.have]
        self._large, self._expected = None, 0
        return False

    def take_blocks(self, blocks: list[bytes | memoryview], most: int, limit: int) -> None:
        """Take the blocks that are whole within the next ``LARGE`` bytes, without a stop for each.

        Args:
            blocks: gets them.
            most: blocks to take.
            limit: bytes; a longer block is left.
        """
        with memoryview(self._buffer) as received:
            data = bytes(received[:LARGE])
        end, at = len(data), 0
        while most and end - at >= _LENGTH.size:
            begin = at + _LENGTH.size
            (size,) = _LENGTH.unpack_from(data, at)
            if size > limit or begin + size > end:
                break
            at = begin + size
            blocks.append(data[begin:at])
            most -= 1
        del self._buffer[:at]

    def block(self, limit: int, what: str) -> Generator[None, None, bytes]:
        """Take a block: four bytes of length, little-endian, then as many bytes.

        Raises:
            TcprosError: the length is above ``limit``, or the peer closes before the end.
        """
        size = yield from self._length(limit, what)
        return (yield from self.exactly(size))

    def _length(self, limit: int, what: str) -> Generator[None, None, int]:
        (size,) = _LENGTH.unpack((yield from self.exactly(_LENGTH.size)))
        if size > limit:
            raise TcprosError(f"{what} of {size} bytes, at most {limit} are read")
        return int(size)


def length_of(body: bytes | memoryview) -> bytes:
    """Return the four bytes of length that go before a block."""
    return _LENGTH.pack(len(body))
