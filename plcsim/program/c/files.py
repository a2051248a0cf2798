"""Files that programs in C open by fopen: those of the devices of the library FileIO."""

from __future__ import annotations

import errno
import os
import stat
from typing import TYPE_CHECKING, Final

from plcsim.core.controller import Controller
from plcsim.core.logbook import Severity
from plcsim.library.fileio.settings import FileIoSettings
from plcsim.library.fileio.volumes import MOST_OPEN, FileRefusedError, Volumes, inside

if TYPE_CHECKING:
    from collections.abc import Mapping
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
        self._has_told = False

    def close_all(self) -> None:
        """Close what is open, as at a restart."""
        while self._open:
            os.close(self._open.popitem()[1])

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
