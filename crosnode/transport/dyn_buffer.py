"""DynBuffer and DynString: the thesis' growing buffers (figure 1.6), with a bound on their growth.

A DynBuffer holds bytes on their way between a socket and a protocol. It keeps what it is given by
reference, piece by piece, so a large message is not copied until it is written. The position
indicator of the thesis is its front: what has been taken is gone.
"""

from __future__ import annotations

from collections import deque
from itertools import islice
from typing import Final, TypeAlias

Data: TypeAlias = bytes | bytearray | memoryview

DEFAULT_MAX: Final = 1 << 20
"""Bytes that a buffer may hold where nothing else is said."""


class DynBuffer:
    """Bytes in order, first in, first out.

    Args:
        maximum: bytes it may hold.

    Attributes:
        size: bytes it holds.
    """

    __slots__ = ("_pieces", "maximum", "size")

    def __init__(self, maximum: int = DEFAULT_MAX) -> None:
        self.maximum = maximum
        self.size = 0
        self._pieces: deque[Data] = deque()

    def __len__(self) -> int:
        return self.size

    def push_back(self, data: Data) -> bool:
        """Add bytes at the end, which must not change until taken; False where they do not fit."""
        size = len(data)
        if self.size + size > self.maximum:
            return False
        if size:
            self._pieces.append(data)
            self.size += size
        return True

    @property
    def front_size(self) -> int:
        """Bytes of the first piece, 0 where there is none."""
        return len(self._pieces[0]) if self._pieces else 0

    def has_large_piece(self, size: int) -> bool:
        """Whether the first or the second piece, behind a length, has so many bytes."""
        return any(len(piece) >= size for piece in islice(self._pieces, 2))

    def front(self, size: int) -> memoryview:
        """Return up to ``size`` bytes of the first piece and keep them; there is one."""
        return memoryview(self._pieces[0])[:size]

    def peek(self, size: int) -> Data:
        """Return up to ``size`` bytes from the front and keep them."""
        pieces = self._pieces
        if not pieces:
            return b""
        first = pieces[0]
        if len(pieces) == 1 or len(first) >= size:
            return first if len(first) <= size else memoryview(first)[:size]
        return self._joined(size)

    def _joined(self, size: int) -> bytes:
        parts: list[Data] = []
        for piece in self._pieces:
            parts.append(piece if len(piece) <= size else memoryview(piece)[:size])
            size -= len(parts[-1])
            if size <= 0:
                break
        return b"".join(parts)

    def discard(self, size: int) -> None:
        """Drop ``size`` bytes from the front, at most all."""
        size = min(size, self.size)
        self.size -= size
        pieces = self._pieces
        while size:
            first = pieces[0]
            if len(first) > size:
                pieces[0] = memoryview(first)[size:]
                return
            size -= len(pieces.popleft())

    def take(self) -> Data:
        """Return all bytes and forget them."""
        data = self.peek(self.size)
        self.clear()
        return data

    def clear(self) -> None:
        """Forget all bytes."""
        self._pieces.clear()
        self.size = 0


class DynString(DynBuffer):
    """A DynBuffer that is filled with text and read as text, UTF-8."""

    __slots__ = ()

    def push_back_str(self, text: str) -> bool:
        """Add text at the end; False where it does not fit."""
        return self.push_back(text.encode())

    def __str__(self) -> str:
        return bytes(self.peek(self.size)).decode(errors="replace")
