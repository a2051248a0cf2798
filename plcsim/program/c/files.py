"""Files that programs in C open by fopen: those of the devices of the library FileIO."""

from __future__ import annotations

import errno
import os
import stat
from contextlib import suppress
from typing import TYPE_CHECKING, Final

from plcsim.ansi_c.c_library import FolderEntry
from plcsim.core.controller import Controller
from plcsim.core.logbook import Severity
from plcsim.library.fileio.settings import FileIoSettings
from plcsim.library.fileio.volumes import MOST_OPEN, FileRefusedError, Volumes, inside

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from plcsim.core.context import Context

_READ, _WRITE, _CREATE, _TRUNCATE, _EXCLUSIVE = 1, 2, 4, 8, 16
_SAFE: Final = os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY  # opening a pipe must not wait
_MODES: Final = {_READ: os.O_RDONLY, _WRITE: os.O_WRONLY, _READ | _WRITE: os.O_RDWR}
_FLAGS: Final = {_CREATE: os.O_CREAT, _TRUNCATE: os.O_TRUNC, _EXCLUSIVE: os.O_EXCL}


class DeviceFiles:
    """See `plcsim.ansi_c.c_library.Files`.

    Args:
        context: of the controller.
    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self._open: dict[int, int] = {}
        self._folders: dict[int, Iterator[tuple[Path, bytes]]] = {}
        self._has_told = False

    def close_all(self) -> None:
        """Close what is open, as at a restart."""
        while self._open:
            os.close(self._open.popitem()[1])
        self._folders.clear()

    def open(self, path: bytes, flags: int) -> int:
        """Open a file; return the lowest number that is free."""
        if len(self._open) >= MOST_OPEN:
            raise OSError(errno.EMFILE, "open files")
        found = self._path(path)
        mode = _MODES[flags & (_READ | _WRITE)] | _SAFE
        for flag, of_host in _FLAGS.items():
            mode |= of_host if flags & flag else 0
        fd = os.open(found, mode, 0o666)
        if not stat.S_ISREG(os.fstat(fd).st_mode):
            os.close(fd)
            raise OSError(errno.EISDIR, "no file")
        if flags & (_CREATE | _TRUNCATE):
            self._date(fd)
        number = next(n for n in range(MOST_OPEN) if n not in self._open)
        self._open[number] = fd
        return number

    def close(self, file: int) -> None:
        """Close a file."""
        os.close(self._fd(file))
        del self._open[file]

    def read(self, file: int, address: int, count: int, place: int) -> int:
        """Read bytes into memory."""
        fd = self._fd(file)
        with self._context.memory.view(address, count) as target:
            return os.preadv(fd, [target], place)

    def write(self, file: int, address: int, count: int, place: int) -> int:
        """Write bytes of memory, all of them."""
        fd = self._fd(file)
        with self._context.memory.view(address, count) as source:
            if os.pwrite(fd, source, place) < count:
                raise OSError(errno.ENOSPC, "device")
        self._date(fd)
        return count

    def size(self, file: int) -> int:
        """Return its bytes."""
        return os.fstat(self._fd(file)).st_size

    def remove(self, path: bytes) -> None:
        """Delete a file."""
        self._path(path).unlink()

    def rename(self, old: bytes, new: bytes) -> None:
        """Rename a file; one that has the name already goes."""
        self._path(old).rename(self._path(new))

    def entry(self, path: bytes) -> FolderEntry:
        """Tell of a file or a folder."""
        return _entry_of(self._path(path).stat())

    def entry_of_file(self, file: int) -> FolderEntry:
        """Tell of an open file."""
        return _entry_of(os.fstat(self._fd(file)))

    def open_folder(self, path: bytes) -> int:
        """Open a folder; its entries come as they are now, in the order of their names."""
        if len(self._folders) >= MOST_OPEN:
            raise OSError(errno.EMFILE, "open folders")
        found = self._path(path)
        names = sorted(os.fsencode(entry.name) for entry in found.iterdir())
        number = next(n for n in range(MOST_OPEN) if n not in self._folders)
        self._folders[number] = iter([(found, name) for name in (b".", b"..", *names)])
        return number

    def next_entry(self, folder: int) -> FolderEntry | None:
        """Return the next entry that is a file or a folder, and still there."""
        if folder not in self._folders:
            raise OSError(errno.EBADF, "folder")
        for found, name in self._folders[folder]:
            with suppress(OSError):
                is_own = name in (b".", b"..")
                status = (found if is_own else found / os.fsdecode(name)).lstat()
                if stat.S_ISREG(status.st_mode) or stat.S_ISDIR(status.st_mode):
                    return _entry_of(status)._replace(name=name)
        return None

    def close_folder(self, folder: int) -> None:
        """Close a folder."""
        if self._folders.pop(folder, None) is None:
            raise OSError(errno.EBADF, "folder")

    def make_folder(self, path: bytes) -> None:
        """Make a folder."""
        self._path(path).mkdir()

    def remove_folder(self, path: bytes) -> None:
        """Delete an empty folder."""
        self._path(path).rmdir()

    def _fd(self, file: int) -> int:
        if file not in self._open:
            raise OSError(errno.EBADF, "file")
        return self._open[file]

    def _date(self, fd: int) -> None:
        """Give a file the controller's date."""
        date_ns = self._context.date_ns
        os.utime(fd, ns=(date_ns, date_ns))

    def _path(self, path: bytes) -> Path:
        """Return where a file lies: on the device that its path begins with, or the first one."""
        device, colon, inner = path.rpartition(b":")
        folder = self._folder(device + colon) if colon else self._first()
        if folder is None:
            self._tell_missing(path)
            raise OSError(errno.ENODEV, "device")
        try:
            return inside(folder, inner)
        except FileRefusedError:
            raise OSError(errno.EACCES, "out of the device") from None

    def _tell_missing(self, path: bytes) -> None:
        """Log once that a device is missing: C tells of it by a number only."""
        controller = Controller.of(self._context)
        if controller is not None and not self._has_told:
            self._has_told = True
            text = f"fopen of {os.fsdecode(path)!r}: no such file device; plc.toml names them in "
            controller.log(Severity.WARNING, "C", f"{text}[library.FileIO] devices")

    def _folder(self, name: bytes) -> Path | None:
        """Return the folder of a device, as DevLink or plc.toml names it, in any case."""
        linked = self._context.library(Volumes).folder(name)
        near = {os.fsencode(n).upper(): folder for n, folder in self._devices.items()}
        return linked or near.get(name.upper()) or near.get(name[:-1].upper())

    @property
    def _devices(self) -> Mapping[str, Path]:
        return (self._context.settings(FileIoSettings) or FileIoSettings()).devices

    def _first(self) -> Path | None:
        return next(iter(self._devices.values()), None)


def _entry_of(status: os.stat_result) -> FolderEntry:
    is_folder = stat.S_ISDIR(status.st_mode)
    size = 0 if is_folder else min(status.st_size, 0x7FFF_FFFF)
    return FolderEntry(is_folder, size, int(status.st_mtime))
