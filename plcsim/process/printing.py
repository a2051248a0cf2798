"""stdout and stderr of the scan process: what a program prints never makes the scan wait.

A pipe to the parent takes what is printed (`plcsim.process.output`). Where it is full, the rest is
lost and counted; nobody can be waited for in a cycle.
"""

from __future__ import annotations

import io
import os
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from _typeshed import ReadableBuffer


class NeverWaiting(io.RawIOBase):
    """The write end of a pipe, seen as a file that takes everything at once.

    Args:
        fd: of the pipe. Whoever else writes to it may wait, programs that a program starts for
            example; so it is opened once more, for an open file has one O_NONBLOCK for all.
        lost: told how many bytes nobody took.
    """

    def __init__(self, fd: int, lost: Callable[[int], None]) -> None:
        flags = os.O_WRONLY | os.O_NONBLOCK | os.O_CLOEXEC
        self._fd = os.open(f"/proc/self/fd/{fd}", flags)
        self._lost = lost
        self._is_cut = False

    def writable(self) -> bool:
        """Return True."""
        return True

    def fileno(self) -> int:
        """Return the descriptor."""
        return self._fd

    def write(self, data: ReadableBuffer, /) -> int:
        """Write what there is room for; a line that was cut is ended before the next."""
        text = bytes(data)
        head = b"\n" if self._is_cut and text else b""
        try:
            written = os.write(self._fd, head + text) - len(head)
        except OSError:  # the pipe is full, or the parent has gone
            written = 0
        if written < len(text):
            self._is_cut = self._is_cut or text[:written][-1:] not in (b"", b"\n")
            self._lost(len(text) - max(0, written))
        elif head:
            self._is_cut = False
        return len(text)


def never_wait(lost: Callable[[int], None]) -> None:
    """Let ``print`` and what else writes to sys.stdout and sys.stderr never wait."""
    sys.stdout = _text(1, lost)
    sys.stderr = _text(2, lost)


def _text(fd: int, lost: Callable[[int], None]) -> io.TextIOWrapper:
    buffer = io.BufferedWriter(NeverWaiting(fd, lost))
    return io.TextIOWrapper(buffer, "utf-8", "backslashreplace", line_buffering=True)
