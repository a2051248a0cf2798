"""Open files: FileCreate, FileOpen, FileClose, reading and writing."""

from __future__ import annotations

import os
import stat
from typing import TYPE_CHECKING, Final

from plcsim.library.fileio import interface
from plcsim.library.fileio.block import FileIoBlock
from plcsim.library.fileio.interface import (
    fiERR_ACCESS,
    fiERR_DATA,
    fiERR_FILE_NOT_OPENED,
    fiERR_MODE,
    fiERR_NO_MORE_ENTRIES,
    fiERR_SEEK,
    fiERR_SPACE,
    fiREAD_ONLY,
    fiREAD_WRITE,
    fiTruncate,
    fiWRITE_ONLY,
)
from plcsim.library.fileio.volumes import FileRefusedError, OpenFile

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.library.fileio.volumes import Volumes

_FLAGS: Final = {fiREAD_ONLY: os.O_RDONLY, fiWRITE_ONLY: os.O_WRONLY, fiREAD_WRITE: os.O_RDWR}
_SAFE: Final = os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY
"""Opening what is no file of its own, such as a pipe, must not wait."""

LAST_BYTE: Final = 0xFFFF_FFFF
"""Sizes and offsets are UDINT."""


def _opened(volumes: Volumes, path: Path, mode: int, flags: int = 0) -> tuple[int, int]:
    """Open a file; return its ident and its bytes."""
    if volumes.files.full:
        raise FileRefusedError(fiERR_NO_MORE_ENTRIES)
    fd = os.open(path, _FLAGS[mode] | flags | _SAFE, 0o666)
    info = os.fstat(fd)
    if not stat.S_ISREG(info.st_mode):
        os.close(fd)
        raise FileRefusedError(fiERR_ACCESS)
    file = OpenFile(fd, reads=mode != fiWRITE_ONLY, writes=mode != fiREAD_ONLY)
    return volumes.files.add(file), min(info.st_size, LAST_BYTE)


class FileCreate(interface.FileCreate, FileIoBlock):
    """Create a file that is not there yet, and open it for reading and writing.

    Inputs: enable, pDevice, pFile. Outputs: status, ident.
    """

    def act(self, volumes: Volumes) -> None:
        """Create it."""
        self.ident = 0
        path = volumes.path(self.pDevice, self.pFile)
        self.ident, _ = _opened(volumes, path, fiREAD_WRITE, os.O_CREAT | os.O_EXCL)
        volumes.date(path)


class FileOpen(interface.FileOpen, FileIoBlock):
    """Open a file. Inputs: enable, pDevice, pFile, mode. Outputs: status, ident, filelen.

    Status fiERR_MODE too.
    """

    def act(self, volumes: Volumes) -> None:
        """Open it."""
        self.ident = self.filelen = 0
        if self.mode not in _FLAGS:
            raise FileRefusedError(fiERR_MODE)
        path = volumes.path(self.pDevice, self.pFile)
        self.ident, self.filelen = _opened(volumes, path, self.mode)


class FileClose(interface.FileClose, FileIoBlock):
    """Close a file. Inputs: enable, ident. Output: status (fiERR_FILE_NOT_OPENED too)."""

    def act(self, volumes: Volumes) -> None:
        """Close it."""
        file = volumes.files.remove(self.ident)
        if file is None:
            raise FileRefusedError(fiERR_FILE_NOT_OPENED)
        os.close(file.fd)


class _Transfer(FileIoBlock):
    """Base of the blocks that read and write: bytes of a file from and to memory."""

    __slots__ = ()

    ident: int
    offset: int

    def read(self, volumes: Volumes, address: int, size: int) -> int:
        """Read at most ``size`` bytes; return how many were there."""
        file = volumes.files.find(self.ident)
        if file is None:
            raise FileRefusedError(fiERR_FILE_NOT_OPENED)
        if not address:
            raise FileRefusedError(fiERR_DATA)
        if not file.reads:
            raise FileRefusedError(fiERR_ACCESS)
        self.context.memory.check(address, size)
        if self.offset > os.fstat(file.fd).st_size:
            raise FileRefusedError(fiERR_SEEK)
        with self.context.memory.view(address, size) as target:
            return os.preadv(file.fd, [target], self.offset)

    def write(self, volumes: Volumes, address: int, size: int, *, ends: bool = False) -> None:
        """Write bytes; where ``ends`` is set, the file ends behind them."""
        file = volumes.files.find(self.ident)
        if file is None:
            raise FileRefusedError(fiERR_FILE_NOT_OPENED)
        if not address:
            raise FileRefusedError(fiERR_DATA)
        if not file.writes:
            raise FileRefusedError(fiERR_ACCESS)
        end = self.offset + size
        if end > LAST_BYTE:
            raise FileRefusedError(fiERR_SEEK)
        self.context.memory.check(address, size)
        with self.context.memory.view(address, size) as source:
            if os.pwrite(file.fd, source, self.offset) < size:
                raise FileRefusedError(fiERR_SPACE)
        if ends:
            os.ftruncate(file.fd, end)
        volumes.date(file.fd)


class FileRead(interface.FileRead, _Transfer):
    """Read from a file; where it ends before, the rest of the buffer is left as it is.

    Inputs: enable, ident, offset, pDest, len. Output: status (fiERR_FILE_NOT_OPENED, fiERR_DATA for
    a null pointer, fiERR_SEEK for an offset beyond the end).
    """

    def act(self, volumes: Volumes) -> None:
        """Read."""
        self.read(volumes, self.pDest, self.len)


class FileReadEx(interface.FileReadEx, _Transfer):
    """The same, and bytesread tells how many bytes were there."""

    def act(self, volumes: Volumes) -> None:
        """Read."""
        self.bytesread = 0
        self.bytesread = self.read(volumes, self.pDest, self.len)


class FileWrite(interface.FileWrite, _Transfer):
    """Write to a file. Inputs: enable, ident, offset, pSrc, len. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Write."""
        self.write(volumes, self.pSrc, self.len)


class FileWriteEx(interface.FileWriteEx, _Transfer):
    """The same; with option fiTruncate the file ends behind what is written."""

    def act(self, volumes: Volumes) -> None:
        """Write."""
        self.write(volumes, self.pSrc, self.len, ends=bool(self.option & fiTruncate))
