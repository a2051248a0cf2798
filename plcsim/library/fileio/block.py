"""What all blocks of FileIO share."""

from __future__ import annotations

from plcsim.library.block import AsynchronousBlock
from plcsim.library.fileio.interface import (
    fiERR_DIR_ALREADY_EXIST,
    fiERR_DIR_NOT_EXIST,
    fiERR_EXIST,
    fiERR_FILE_NOT_FOUND,
)
from plcsim.library.fileio.volumes import FileRefusedError, Volumes
from plcsim.library.runtime import ERR_OK


class FileIoBlock(AsynchronousBlock):
    """Base of the blocks that deal with files.

    Statuses of all: ERR_OK, fiERR_FILE_DEVICE (no such device), fiERR_INVALID_PATH (too long, or
    out of the device), fiERR_FILE_NOT_FOUND, fiERR_EXIST, fiERR_ACCESS, fiERR_SPACE,
    fiERR_NO_MORE_ENTRIES (too many are open), fiERR_SYSTEM.
    """

    __slots__ = ()

    _missing = fiERR_FILE_NOT_FOUND
    _existing = fiERR_EXIST

    def step(self) -> int:
        """Do what the block does."""
        volumes = self.context.library(Volumes)
        try:
            self.act(volumes)
        except FileRefusedError as refused:
            return refused.status
        except OSError as error:
            return volumes.status_of(error, self._missing, self._existing)
        return ERR_OK

    def act(self, volumes: Volumes) -> None:
        """Do what the block does.

        Raises:
            RefusedError: it cannot; with the status.
            OSError: the host cannot.
        """
        raise NotImplementedError(f"{type(self).__name__} has no act method.")


class DirectoryBlock(FileIoBlock):
    """Base of the blocks that deal with directories.

    Statuses: as for files, with fiERR_DIR_NOT_EXIST, fiERR_DIR_ALREADY_EXIST.
    """

    __slots__ = ()

    _missing = fiERR_DIR_NOT_EXIST
    _existing = fiERR_DIR_ALREADY_EXIST
