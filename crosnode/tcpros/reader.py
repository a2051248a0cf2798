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

    def block(self, limit: int, what: str) -> Generator[None, None, bytes]:
        """Take a block: four bytes of length, little-endian, then as many bytes.

        Raises:
            TcprosError: the length is above ``limit``, or the peer closes before the end.
        """
        (size,) = _LENGTH.unpack((yield from self.exactly(_LENGTH.size)))
        if size > limit:
            raise TcprosError(f"{what} of {size} bytes, at most {limit} are read")
        return (yield from self.exactly(size))


def length_of(body: bytes | memoryview) -> bytes:
    """Return the four bytes of length that go before a block."""
    return _LENGTH.pack(len(body))
