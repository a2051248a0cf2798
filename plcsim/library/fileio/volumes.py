"""The devices of a controller, paths on them, and what is open."""

from __future__ import annotations

import errno
import os
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from plcsim.library.block import StatusError
from plcsim.library.fileio.interface import (
    fiERR_ACCESS,
    fiERR_DIR_NOT_EMPTY,
    fiERR_FILE_DEVICE,
    fiERR_INVALID_PATH,
    fiERR_NO_MORE_ENTRIES,
    fiERR_SPACE,
    fiERR_SYSTEM,
)
from plcsim.library.fileio.settings import FileIoSettings, MadeDevices
from plcsim.library.idents import Idents

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.core.context import Context

LONGEST_PATH: Final = 259
"""Bytes of a path; names in the structures of the library have no room for more."""

MOST_OPEN: Final = 128
"""Files, directories and devices that can be in use at once, of each kind."""

_STATUSES: Final = {
    errno.EACCES: fiERR_ACCESS,
    errno.EPERM: fiERR_ACCESS,
    errno.EROFS: fiERR_ACCESS,
    errno.EISDIR: fiERR_ACCESS,
    errno.ENXIO: fiERR_ACCESS,
    errno.ENOSPC: fiERR_SPACE,
    errno.EDQUOT: fiERR_SPACE,
    errno.ENOTEMPTY: fiERR_DIR_NOT_EMPTY,
    errno.ENAMETOOLONG: fiERR_INVALID_PATH,
    errno.ELOOP: fiERR_INVALID_PATH,
    errno.EINVAL: fiERR_INVALID_PATH,
    errno.EMFILE: fiERR_NO_MORE_ENTRIES,
    errno.ENFILE: fiERR_NO_MORE_ENTRIES,
}


class FileRefusedError(StatusError):
    """A block of FileIO cannot do what it is asked for."""


@dataclass(slots=True)
class OpenFile:
    """A file that an ident stands for."""

    fd: int
    reads: bool
    writes: bool


@dataclass(slots=True)
class DirectoryEntry:
    """An entry of a directory."""

    name: bytes
    is_directory: bool
    size: int
    date: int


@dataclass(slots=True)
class OpenDirectory:
    """A directory that an ident stands for: its entries when it was opened, and the next one."""

    entries: list[DirectoryEntry]
    position: int = 0


@dataclass(slots=True)
class LinkedDevice:
    """A device that DevLink made."""

    name: bytes
    folder: Path


class Volumes:
    """The devices of a controller.

    Args:
        context: the controller's.

    Attributes:
        files: those that are open.
        directories: likewise.
        links: devices made by DevLink.
        last_error: number of the host's last error.
    """

    def __init__(self, context: Context) -> None:
        settings = context.settings(FileIoSettings) or FileIoSettings()
        self.context = context
        made = context.settings(MadeDevices) or MadeDevices({})
        devices = {**made.folders, **settings.devices}
        self._folders = {os.fsencode(name): folder for name, folder in devices.items()}
        self._made = {folder for name, folder in devices.items() if name not in settings.devices}
        self.files: Idents[OpenFile] = Idents(context, MOST_OPEN)
        self.directories: Idents[OpenDirectory] = Idents(context, MOST_OPEN)
        self.links: Idents[LinkedDevice] = Idents(context, MOST_OPEN)
        self.last_error = 0

    def close(self) -> None:
        """Close all files."""
        for ident, file in self.files:
            self.files.remove(ident)
            os.close(file.fd)

    def text(self, address: int, status: int) -> bytes:
        """Return the name or path at an address.

        Raises:
            RefusedError: with ``status``, for a null pointer or a text that is too long.
        """
        text = self.context.memory.string(address, LONGEST_PATH + 1) if address else b""
        if not address or len(text) > LONGEST_PATH:
            raise FileRefusedError(status)
        return text

    @property
    def device_names(self) -> list[bytes]:
        """The names of all devices: those of the settings, then those that DevLink made."""
        return [*self._folders, *(link.name for _, link in self.links)]

    def folder(self, device: bytes) -> Path | None:
        """Return the folder of a device, None where there is no such device."""
        for _, link in self.links:
            if link.name == device:
                return link.folder
        return self._ready(self._folders.get(device))

    def _ready(self, folder: Path | None) -> Path | None:
        """Make the folder of a device that plc.toml does not name."""
        if folder in self._made:
            _make(folder)
        return folder

    def linked_folder(self, path: bytes) -> Path | None:
        """Return the folder that ``/DEVICE=`` names: a known one, or one inside it.

        Below a device that plc.toml does not name it is made: whoever wrote the program had it on
        his controller.
        """
        for name, folder in self._folders.items():
            rest = path[len(name) :]
            if path[: len(name)].upper() == name.upper() and rest[:1] in (b"", b"/", b"\\"):
                found = inside(folder, rest)
                if folder in self._made:
                    _make(found)
                return found
        return None

    def path(self, p_device: int, p_path: int, *, is_optional: bool = False) -> Path:
        """Return the host's path of a file or directory on a device.

        Args:
            p_device: address of the device's name.
            p_path: address of the path.
            is_optional: a null pointer means the device's folder.

        Raises:
            RefusedError: there is no such device, or the path leads out of it.
        """
        folder = self.folder(self.text(p_device, fiERR_FILE_DEVICE))
        if folder is None:
            raise FileRefusedError(fiERR_FILE_DEVICE)
        if is_optional and not p_path:
            return folder
        return inside(folder, self.text(p_path, fiERR_INVALID_PATH))

    def status_of(self, error: OSError, missing: int, existing: int) -> int:
        """Note an error of the host and return the status for it."""
        number = self.last_error = error.errno or 0
        if number in (errno.ENOENT, errno.ENOTDIR):
            return missing
        if number == errno.EEXIST:
            return existing
        return _STATUSES.get(number, fiERR_SYSTEM)

    def date(self, path: Path | int) -> None:
        """Give a file that was changed the controller's date."""
        date_ns = self.context.date_ns
        os.utime(path, ns=(date_ns, date_ns))


def _make(folder: Path) -> None:
    if not folder.is_dir():
        with suppress(OSError):  # what is done there is refused then
            folder.mkdir(parents=True)


def inside(folder: Path, path: bytes) -> Path:
    """Return the host's path of ``path`` in a folder; both kinds of slash separate.

    What is not there as it is written may be there in another case, as on the controller.

    Raises:
        RefusedError: it leads out of the folder, by ``..`` or a symbolic link.
    """
    parts: list[str] = []
    for part in os.fsdecode(path).replace("\\", "/").split("/"):
        if part == "..":
            if not parts:
                raise FileRefusedError(fiERR_INVALID_PATH)
            parts.pop()
        elif part not in ("", "."):
            parts.append(part)
    found = root = folder.resolve()
    for part in parts:
        found = _as_there(found, part)
    try:
        real = found.resolve()
    except RuntimeError:  # links that lead to one another
        raise FileRefusedError(fiERR_INVALID_PATH) from None
    if not real.is_relative_to(root):
        raise FileRefusedError(fiERR_INVALID_PATH)
    return real


def _as_there(folder: Path, name: str) -> Path:
    """Return the entry of a folder with a name, or the only one with it in another case."""
    path = folder / name
    try:
        if is_there(path):
            return path
        near = [each for each in folder.iterdir() if each.name.upper() == name.upper()]
    except OSError:
        return path
    return near[0] if len(near) == 1 else path


def is_there(path: Path) -> bool:
    """Return whether there is a file, a directory or a link of this name."""
    return path.is_symlink() or path.exists()
