"""What the operator sees of a controller's files: one folder of one device, page by page."""

from __future__ import annotations

import os
import shutil
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from plcsim.library.block import StatusError
from plcsim.library.fileio.directories import entries_of
from plcsim.library.fileio.volumes import FileRefusedError, Volumes, inside
from plcsim.library.mapp.errors import (
    DIR_ALREADY_EXISTS,
    FILE_SYSTEM,
    INVALID_FILE_DEVICE,
    INVALID_NAME,
    NAME_EMPTY,
    NOTHING_SELECTED,
    NOTHING_TO_PASTE,
    PASTE_NOT_ALLOWED,
)

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from plcsim.library.fileio.volumes import DirectoryEntry


class FileView:
    """A folder of a device.

    Args:
        volumes: the devices.

    Attributes:
        device: index of the device.
        entries: of the folder, folders first; as they were when `refresh` was called.
    """

    def __init__(self, volumes: Volumes) -> None:
        self._volumes = volumes
        self.device = 0
        self.entries: list[DirectoryEntry] = []
        self._parts: list[bytes] = []
        self._clipboard: list[Path] = []
        self._is_cut = False

    @property
    def directory(self) -> str:
        """The path of the folder on its device."""
        return os.fsdecode(b"/".join(self._parts))

    def _folder(self) -> Path:
        """Return the host's path of the folder.

        Raises:
            StatusError: there is no such device.
            FileRefusedError: it leads out of the device.
        """
        names = self._volumes.device_names
        root = None if self.device >= len(names) else self._volumes.folder(names[self.device])
        if root is None:
            raise StatusError(INVALID_FILE_DEVICE)
        return inside(root, b"/".join(self._parts))

    def refresh(self) -> None:
        """Read the entries.

        Raises:
            StatusError: they cannot be read.
        """
        self.entries = []
        with _file_system():
            found = entries_of(self._folder())
        self.entries = sorted(found, key=lambda each: not each.is_directory)

    def change_device(self, index: int) -> None:
        """Show the folder of another device."""
        self.device, self._parts = index, []

    def enter(self, selected: list[DirectoryEntry]) -> None:
        """Show the first folder that is selected.

        Raises:
            StatusError: none is.
        """
        name = next((each.name for each in selected if each.is_directory), None)
        if name is None:
            raise StatusError(NOTHING_SELECTED)
        self._parts.append(name)

    def leave(self) -> None:
        """Show the folder around this one; that of the device stays."""
        del self._parts[-1:]

    def create_folder(self, name: str) -> None:
        """Make a folder.

        Raises:
            StatusError: it is there, or cannot be made.
        """
        with _file_system():
            self._named(name).mkdir()

    def rename(self, selected: list[DirectoryEntry], name: str) -> None:
        """Rename what is selected first.

        Raises:
            StatusError: nothing is, or the new name is taken, or none.
        """
        source, target = self._paths(selected)[0], self._named(name)
        with _file_system():
            if target.exists():
                raise StatusError(INVALID_NAME)
            source.rename(target)

    def delete(self, selected: list[DirectoryEntry]) -> None:
        """Delete what is selected.

        Raises:
            StatusError: nothing is, or it cannot be.
        """
        for path in self._paths(selected):
            with _file_system():
                if path.is_dir():
                    shutil.rmtree(path)
                else:
                    path.unlink()

    def take(self, selected: list[DirectoryEntry], *, is_cut: bool) -> None:
        """Keep what is selected for `paste`, which deletes what is cut here.

        Raises:
            StatusError: nothing is selected.
        """
        self._clipboard, self._is_cut = self._paths(selected), is_cut

    def paste(self) -> None:
        """Put what was taken into this folder; files of the same names are overwritten.

        Raises:
            StatusError: nothing was taken, or it cannot be put here.
        """
        if not self._clipboard:
            raise StatusError(NOTHING_TO_PASTE)
        for source in self._clipboard:
            with _file_system():
                self._put(source, self._folder() / source.name)
        if self._is_cut:
            self._clipboard = []

    def _put(self, source: Path, target: Path) -> None:
        if target.is_relative_to(source):
            raise StatusError(PASTE_NOT_ALLOWED)
        if target.is_dir():
            raise StatusError(DIR_ALREADY_EXISTS)
        if self._is_cut:
            shutil.move(source, target)
        elif source.is_dir():
            shutil.copytree(source, target, symlinks=True)
        else:
            shutil.copyfile(source, target)
        self._volumes.date(target)

    def _paths(self, selected: list[DirectoryEntry]) -> list[Path]:
        """Return where what is selected lies; it is not empty."""
        if not selected:
            raise StatusError(NOTHING_SELECTED)
        with _file_system():
            folder = self._folder()
            return [inside(folder, each.name) for each in selected]

    def _named(self, name: str) -> Path:
        """Return where something of a new name lies."""
        if not name:
            raise StatusError(NAME_EMPTY)
        if name in _NO_NAMES or set(name) & _SEPARATORS:
            raise StatusError(INVALID_NAME)
        with _file_system():
            return inside(self._folder(), os.fsencode(name))


_NO_NAMES: Final = (".", "..")
_SEPARATORS: Final = frozenset("/\\")


@contextmanager
def _file_system() -> Iterator[None]:
    """Raise what the host refuses as a `StatusError`."""
    try:
        yield
    except FileExistsError:
        raise StatusError(DIR_ALREADY_EXISTS) from None
    except (OSError, shutil.Error, FileRefusedError):
        raise StatusError(FILE_SYSTEM) from None
