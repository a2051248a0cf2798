"""The end of a process whose code of others does not return from one call into a library in C.

No exception reaches such code (`plcsim.host.time_limit`), and no other thread of Python runs beside
it. ``faulthandler`` can still write the stack and end the process; at the other end of the pipe it
writes to waits a process (`plcsim.host.stack_reader`) that makes one line of it.
"""

from __future__ import annotations

import faulthandler
import json
import os
import signal
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Final, TextIO

from plcsim.host.time_limit import can_be_limited

if TYPE_CHECKING:
    from collections.abc import Iterator

PATIENCE_S = 3.0
"""The last resort comes so much later than the limit."""

_READER: Final = Path(__file__).with_name("stack_reader.py")

_readers: dict[tuple[int, int], TextIO] = {}
"""Pipes to the readers by process, for one forked from this needs its own, and by the descriptor
that the reader writes to."""


@contextmanager
def last_resort(
    limit_ns: int, folder: Path, text: str, errors_fd: int | None = 2
) -> Iterator[None]:
    """End this process, with exit code 1, some seconds after the limit of the block.

    There is no limit where `time_limit` has none.

    Args:
        limit_ns: of the `time_limit` that would end the block before.
        folder: of the project; its innermost frame is told.
        text: what is told then, behind "plcsim: FILE:LINE: ".
        errors_fd: the standard error it is told on; None lets the block be.
    """
    if errors_fd is None or not can_be_limited():
        yield
        return
    order = f"{json.dumps([str(folder), text])}\n"
    try:
        pipe = _told(order, errors_fd)
    except BrokenPipeError:  # somebody has ended the reader
        del _readers[os.getpid(), errors_fd]
        pipe = _told(order, errors_fd)
    faulthandler.dump_traceback_later(limit_ns / 1e9 + PATIENCE_S, exit=True, file=pipe)
    try:
        yield
    finally:
        faulthandler.cancel_dump_traceback_later()


def _told(order: str, errors_fd: int) -> TextIO:
    """Give an order to the reader, and return the pipe to it."""
    pipe = _reader(errors_fd)
    pipe.write(order)
    pipe.flush()
    return pipe


def _reader(errors_fd: int) -> TextIO:
    """Return the pipe to the reader of this process, which is started when it is first needed."""
    key = (os.getpid(), errors_fd)
    if key not in _readers:
        _readers[key] = _start_reader(errors_fd)
    return _readers[key]


def _start_reader(errors_fd: int) -> TextIO:
    """Start the reader; it ends when this process has."""
    out_fd, in_fd = os.pipe()
    os.posix_spawn(
        sys.executable,
        [sys.executable, "-I", "-S", str(_READER)],
        os.environ,
        file_actions=[
            (os.POSIX_SPAWN_DUP2, out_fd, 0),
            (os.POSIX_SPAWN_DUP2, errors_fd, 2),
            (os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0),
        ],
        setpgroup=0,  # Ctrl-C is not for it
        setsigmask=[signal.SIGINT],
    )
    os.close(out_fd)
    return os.fdopen(in_fd, "w", encoding="utf-8")  # open as long as this process lives
