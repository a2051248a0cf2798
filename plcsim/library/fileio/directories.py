"""Directories: making, reading, renaming, copying and deleting them."""

from __future__ import annotations

import os
import shutil
import struct
from itertools import islice
from typing import TYPE_CHECKING, Final

from plcsim.library.fileio import interface
from plcsim.library.fileio.block import DirectoryBlock
from plcsim.library.fileio.interface import (
    fiBOTH,
    fiDIRECTORY,
    fiERR_ACCESS,
    fiERR_DATA,
    fiERR_DATA_SIZE,
    fiERR_DIR_ALREADY_EXIST,
    fiERR_DIR_INVALID_HANDLE,
    fiERR_INVALID_DIRECTORY,
    fiERR_INVALID_TYP,
    fiERR_NO_MORE_ENTRIES,
    fiFILE,
    fiOVERWRITE,
)
from plcsim.library.fileio.transfer import LAST_BYTE
from plcsim.library.fileio.volumes import DirectoryEntry, FileRefusedError, OpenDirectory, is_there

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.library.fileio.volumes import Volumes

MOST_ENTRIES: Final = 65_536
"""Entries of a directory that are looked at."""

_DATA: Final = struct.Struct("<260sII")
"""fiDIR_READ_DATA: name, date, bytes."""

_EX_DATA: Final = struct.Struct("<260sIIHxx")
"""fiDIR_READ_EX_DATA: the same, and fiFILE or fiDIRECTORY."""


def entries_of(path: Path) -> list[DirectoryEntry]:
    """Return the entries of a directory in order of their names.

    Raises:
        OSError: it cannot be read.
    """
    found = []
    with os.scandir(path) as entries:
        for entry in islice(entries, MOST_ENTRIES):
            info = entry.stat(follow_symlinks=False)
            date, size = min(max(0, int(info.st_mtime)), LAST_BYTE), min(info.st_size, LAST_BYTE)
            is_directory = entry.is_dir(follow_symlinks=False)
            found.append(
                DirectoryEntry(
                    os.fsencode(entry.name), is_directory, 0 if is_directory else size, date
                )
            )
    return sorted(found, key=lambda entry: entry.name)


class DirCreate(interface.DirCreate, DirectoryBlock):
    """Create a directory. Inputs: enable, pDevice, pName. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Create it."""
        path = volumes.path(self.pDevice, self.pName)
        path.mkdir()
        volumes.date(path)


class DirOpen(interface.DirOpen, DirectoryBlock):
    """Open a directory for DirReadEx. Inputs: enable, pDevice, pName. Outputs: status, ident."""

    def act(self, volumes: Volumes) -> None:
        """Read its entries."""
        self.ident = 0
        if volumes.directories.full:
            raise FileRefusedError(fiERR_DIR_INVALID_HANDLE)
        path = volumes.path(self.pDevice, self.pName, is_optional=True)
        self.ident = volumes.directories.add(OpenDirectory(entries_of(path)))


class DirClose(interface.DirClose, DirectoryBlock):
    """Close a directory. Inputs: enable, ident. Output: status (fiERR_DIR_INVALID_HANDLE too)."""

    def act(self, volumes: Volumes) -> None:
        """Forget it."""
        if volumes.directories.remove(self.ident) is None:
            raise FileRefusedError(fiERR_DIR_INVALID_HANDLE)


class DirReadEx(interface.DirReadEx, DirectoryBlock):
    """The next entry of an open directory, at pData.

    Inputs: enable, ident, pData, data_len. Output: status (fiERR_NO_MORE_ENTRIES behind the last
    one, fiERR_DATA_SIZE, fiERR_DATA for a null pointer, fiERR_DIR_INVALID_HANDLE).
    """

    def act(self, volumes: Volumes) -> None:
        """Store it."""
        directory = volumes.directories.find(self.ident)
        if directory is None:
            raise FileRefusedError(fiERR_DIR_INVALID_HANDLE)
        if not self.pData:
            raise FileRefusedError(fiERR_DATA)
        if self.data_len < _EX_DATA.size:
            raise FileRefusedError(fiERR_DATA_SIZE)
        if directory.position >= len(directory.entries):
            raise FileRefusedError(fiERR_NO_MORE_ENTRIES)
        entry = directory.entries[directory.position]
        kind = fiDIRECTORY if entry.is_directory else fiFILE
        data = _EX_DATA.pack(entry.name, entry.date, entry.size, kind)
        self.context.memory.write(self.pData, data)
        directory.position += 1


class DirRead(interface.DirRead, DirectoryBlock):
    """Entry number ``entry`` of those that ``option`` chooses, at pData.

    Inputs: enable, pDevice, pPath, entry, option (fiFILE, fiDIRECTORY, fiBOTH), pData, data_len.
    Output: status (as for DirReadEx; fiERR_INVALID_TYP for another option).
    """

    def act(self, volumes: Volumes) -> None:
        """Store it."""
        if not self.pData:
            raise FileRefusedError(fiERR_DATA)
        if self.data_len < _DATA.size:
            raise FileRefusedError(fiERR_DATA_SIZE)
        if self.option not in (fiFILE, fiDIRECTORY, fiBOTH):
            raise FileRefusedError(fiERR_INVALID_TYP)
        entries = entries_of(volumes.path(self.pDevice, self.pPath, is_optional=True))
        if self.option != fiBOTH:
            entries = [e for e in entries if e.is_directory == (self.option == fiDIRECTORY)]
        if self.entry >= len(entries):
            raise FileRefusedError(fiERR_NO_MORE_ENTRIES)
        entry = entries[self.entry]
        self.context.memory.write(self.pData, _DATA.pack(entry.name, entry.date, entry.size))


class DirInfo(interface.DirInfo, DirectoryBlock):
    """Count entries. Inputs: enable, pDevice, pPath. Outputs: status, dirnum, filenum."""

    def act(self, volumes: Volumes) -> None:
        """Count them."""
        self.dirnum = self.filenum = 0
        entries = entries_of(volumes.path(self.pDevice, self.pPath, is_optional=True))
        self.dirnum = sum(entry.is_directory for entry in entries)
        self.filenum = len(entries) - self.dirnum


def _directory(volumes: Volumes, p_device: int, p_path: int) -> Path:
    """Return the path of a directory that is not a whole device.

    Raises:
        RefusedError: it is a device, or no directory.
        OSError: it is not there.
    """
    path = volumes.path(p_device, p_path)
    if path == volumes.path(p_device, 0, is_optional=True).resolve():
        raise FileRefusedError(fiERR_ACCESS)
    if not path.is_dir():
        path.stat()
        raise FileRefusedError(fiERR_INVALID_DIRECTORY)
    return path


class DirRename(interface.DirRename, DirectoryBlock):
    """Rename a directory. Inputs: enable, pDevice, pName, pNewName. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Rename it."""
        path = _directory(volumes, self.pDevice, self.pName)
        target = volumes.path(self.pDevice, self.pNewName)
        if target != path and is_there(target):
            raise FileRefusedError(fiERR_DIR_ALREADY_EXIST)
        path.rename(target)


class DirCopy(interface.DirCopy, DirectoryBlock):
    """Copy a directory with all in it; into one that is there with option fiOVERWRITE only.

    Inputs: enable, pSrcDev, pSrcDir, pDestDev, pDestDir, option. Output: status.
    """

    def act(self, volumes: Volumes) -> None:
        """Copy it."""
        path = volumes.path(self.pSrcDev, self.pSrcDir, is_optional=True)
        target = volumes.path(self.pDestDev, self.pDestDir, is_optional=True)
        if target.is_relative_to(path):
            raise FileRefusedError(fiERR_INVALID_DIRECTORY)
        if is_there(target) and not self.option & fiOVERWRITE:
            raise FileRefusedError(fiERR_DIR_ALREADY_EXIST)
        path.stat()
        try:
            shutil.copytree(path, target, symlinks=True, dirs_exist_ok=True)
        except shutil.Error as error:
            raise FileRefusedError(fiERR_ACCESS) from error


class DirDelete(interface.DirDelete, DirectoryBlock):
    """Delete an empty directory. Inputs: enable, pDevice, pName. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Delete it."""
        _directory(volumes, self.pDevice, self.pName).rmdir()


class DirDeleteEx(interface.DirDeleteEx, DirectoryBlock):
    """Delete a directory with all in it. Inputs: enable, pDevice, pName. Output: status."""

    def act(self, volumes: Volumes) -> None:
        """Delete it."""
        shutil.rmtree(_directory(volumes, self.pDevice, self.pName))
