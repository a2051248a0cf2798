"""Guests: processes that come and go, such as ``plcsim force``, and need a ring for a moment.

A guest holds a lock on a byte of the shared file, which the kernel lets go when it ends, however it
ends (an open file description lock, fcntl(2)). What it had asked to be sampled is then cancelled by
the supervisor; what it had forced stays forced.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import struct
from typing import TYPE_CHECKING

from plcsim.shared_image import layout
from plcsim.shared_image.command import Cancel
from plcsim.shared_image.errors import CommandRefused, ImageError
from plcsim.shared_image.reader import ImageReader

if TYPE_CHECKING:
    from collections.abc import Iterator

_FLOCK = struct.Struct("@hhqqi")


def _lock(fd: int, kind: int, offset: int) -> bool:
    """Lock or unlock one byte for this open file; return False where another has it."""
    try:
        fcntl.fcntl(fd, fcntl.F_OFD_SETLK, _FLOCK.pack(kind, os.SEEK_SET, offset, 1, 0))
    except OSError:
        return False
    return True


@contextlib.contextmanager
def guest(file: str) -> Iterator[ImageReader]:
    """Open the image for a while, with a ring of one's own.

    Args:
        file: the shared file by name, such as ``/proc/PID/fd/FD``.

    Raises:
        ImageError: see `ImageReader`.
        CommandRefused: all rings for guests are in use.
    """
    fd = os.open(file, os.O_RDWR | os.O_CLOEXEC)
    try:
        first = len(ImageReader(fd).directory.services)
        for number in range(first, first + layout.GUESTS):
            if _lock(fd, fcntl.F_WRLCK, number):
                reader = ImageReader(fd, ring=number)
                reader.send(Cancel(0))  # whatever a guest before may have left
                try:
                    yield reader
                finally:
                    with contextlib.suppress(ImageError):
                        reader.send(Cancel(0))
                    _lock(fd, fcntl.F_UNLCK, number)  # the mapping keeps the open file alive
                return
        raise CommandRefused(f"{layout.GUESTS} others write to this project already")
    finally:
        os.close(fd)


def tidy(reader: ImageReader, fd: int) -> None:
    """Cancel the samples of guests that have died; the supervisor does it now and then.

    Args:
        reader: of the image.
        fd: the shared file.
    """
    first = len(reader.directory.services)
    left = [n for n in range(first, first + layout.GUESTS) if reader.samples_of(n)]
    if not left:
        return
    own = os.open(f"/proc/self/fd/{fd}", os.O_RDWR | os.O_CLOEXEC)
    try:
        for number in left:
            if _lock(own, fcntl.F_WRLCK, number):
                with contextlib.suppress(CommandRefused):
                    ImageReader(own, ring=number).send(Cancel(0))
                _lock(own, fcntl.F_UNLCK, number)
    finally:
        os.close(own)
