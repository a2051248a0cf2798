"""Received bytes, and generator parsers over them.

A parser is a generator written as if all bytes were there: ``data = yield from reader.exactly(n)``.
Where bytes are missing it yields None, and goes on from there when it is resumed.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final

from crosnode.errors import TcprosError

if TYPE_CHECKING:
    from collections.abc import Generator

_LENGTH: Final = struct.Struct("<I")

AHEAD: Final = 1 << 20
"""Bytes of a large block that are laid out at once."""


class ByteReader:
    """Bytes received and not parsed yet, and whether the peer has closed."""

    __slots__ = ("_buffer", "_eof")

    def __init__(self) -> None:
        self._buffer = bytearray()
        self._eof = False

    def __len__(self) -> int:
        return len(self._buffer)

    def feed(self, data: bytes | bytearray | memoryview) -> None:
        """Add received bytes."""
        self._buffer += data

    def feed_eof(self) -> None:
        """Note that no more bytes will come."""
        self._eof = True

    def clear(self) -> None:
        """Drop what is not parsed."""
        self._buffer.clear()

    def more(self) -> Generator[None, None, bool]:
        """Wait for the next byte; return False where the peer has closed instead."""
        while not self._buffer:
            if self._eof:
                return False
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

        Where they do not fit into one read they go to their place piece by piece, and what is
        returned is a read-only view of it. No more than ``AHEAD`` bytes are laid out before they
        have come. Raises as ``exactly`` does.
        """
        if size <= AHEAD // 16:
            return (yield from self.exactly(size))
        buffer, target, have = self._buffer, bytearray(min(size, AHEAD)), 0
        while have < size:
            if not buffer:
                if self._eof:
                    raise TcprosError(f"connection closed after {have} of {size} bytes")
                yield
                continue
            if have == len(target):
                target += bytes(min(AHEAD, size - have))
            piece = min(len(buffer), len(target) - have)
            with memoryview(buffer) as data:
                target[have : have + piece] = data[:piece]
            del buffer[:piece]
            have += piece
        return memoryview(target).toreadonly()

    def large_block(self, limit: int, what: str) -> Generator[None, None, bytes | memoryview]:
        """Take a block as ``block`` does, its bytes as ``large`` does."""
        size = yield from self._length(limit, what)
        return (yield from self.large(size))

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
