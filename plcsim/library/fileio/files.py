"""Files by name: FileRename, FileCopy, FileDelete, FileInfo, FileTruncate, attributes."""

from __future__ import annotations

import os
import shutil
import stat
import struct
from typing import TYPE_CHECKING, Final

from plcsim.library.fileio import interface
from plcsim.library.fileio.block import FileIoBlock
from plcsim.library.fileio.interface import (
    fiATTR_DIRECTORY,
    fiATTR_RDONLY,
    fiERR_ACCESS,
    fiERR_DATA,
    fiERR_EXIST,
    fiOVERWRITE,
)
from plcsim.library.fileio.transfer import LAST_BYTE
from plcsim.library.fileio.volumes import FileRefusedError, is_there

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.library.fileio.volumes import Volumes

_INFO: Final = struct.Struct("<5I84x")
"""fiFILE_INFO: size, links, three dates, 21 reserves."""

_WRITE_BITS: Final = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH


def _check_is_file(path: Path) -> os.stat_result:
    """Return what the host knows of a file.

    Raises:
        OSError: it is not there.
        RefusedError: it is something else.
    """
    info = path.stat()
    if not stat.S_ISREG(info.st_mode):
        raise FileRefusedError(fiERR_ACCESS)
    return info


class FileRename(interface.FileRename, FileIoBlock):
    """Rename a file. Inputs: enable, pDevice, pName, pNewName. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Rename it."""
        path = volumes.path(self.pDevice, self.pName)
        target = volumes.path(self.pDevice, self.pNewName)
        _check_is_file(path)
        if target != path and is_there(target):
            raise FileRefusedError(fiERR_EXIST)
        path.rename(target)


class FileCopy(interface.FileCopy, FileIoBlock):
    """Copy a file; one that is there already is replaced with option fiOVERWRITE only.

    Inputs: enable, pSrcDev, pSrc, pDestDev, pDest, option. Output: status.
    """

    def act(self, volumes: Volumes) -> None:
        """Copy it."""
        path = volumes.path(self.pSrcDev, self.pSrc)
        target = volumes.path(self.pDestDev, self.pDest)
        _check_is_file(path)
        if is_there(target):
            if not self.option & fiOVERWRITE:
                raise FileRefusedError(fiERR_EXIST)
            _check_is_file(target)
            if path.samefile(target):
                return
        shutil.copyfile(path, target)
        volumes.date(target)


class FileDelete(interface.FileDelete, FileIoBlock):
    """Delete a file. Inputs: enable, pDevice, pName. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Delete it."""
        path = volumes.path(self.pDevice, self.pName)
        info = _check_is_file(path)
        if not info.st_mode & stat.S_IWUSR:
            raise FileRefusedError(fiERR_ACCESS)
        path.unlink()


class FileInfo(interface.FileInfo, FileIoBlock):
    """Size and dates of a file, at pInfo. Inputs: enable, pDevice, pName, pInfo. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Store them."""
        info = volumes.path(self.pDevice, self.pName).stat()
        if not self.pInfo:
            raise FileRefusedError(fiERR_DATA)
        dates = (info.st_atime, info.st_mtime, info.st_mtime)
        seconds = [min(max(0, int(date)), LAST_BYTE) for date in dates]
        size = min(info.st_size, LAST_BYTE)
        self.context.memory.write(self.pInfo, _INFO.pack(size, info.st_nlink, *seconds))


class FileTruncate(interface.FileTruncate, FileIoBlock):
    """Cut a file to newLength bytes. Inputs: enable, pDevice, pName, newLength. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Cut it."""
        path = volumes.path(self.pDevice, self.pName)
        if self.newLength > _check_is_file(path).st_size:
            raise FileRefusedError(interface.fiERR_SEEK)
        os.truncate(path, self.newLength)
        volumes.date(path)


class SetAttributes(interface.SetAttributes, FileIoBlock):
    """Make a file read-only or not; the host keeps no other attributes. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Set them."""
        path = volumes.path(self.pDevice, self.pPath)
        mode = stat.S_IMODE(_check_is_file(path).st_mode)
        is_fixed = self.attributes & fiATTR_RDONLY
        path.chmod(mode & ~_WRITE_BITS if is_fixed else mode | stat.S_IWUSR)


class GetAttributes(interface.GetAttributes, FileIoBlock):
    """Attributes of a file or directory. Inputs: enable, pDevice, pPath. Outputs: status,
    attributes (fiATTR_RDONLY, fiATTR_DIRECTORY).
    """  # noqa: D205  # the outputs do not fit one line

    def act(self, volumes: Volumes) -> None:
        """Read them."""
        mode = volumes.path(self.pDevice, self.pPath, is_optional=True).stat().st_mode
        is_fixed = not mode & stat.S_IWUSR
        attributes = fiATTR_DIRECTORY if stat.S_ISDIR(mode) else 0
        self.attributes = attributes | (fiATTR_RDONLY if is_fixed else 0)
