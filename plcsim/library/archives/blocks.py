"""zipArchive and zipExtract of AsZip: .tar, .tar.gz and .gz, as their endings say.

Options are not looked at. The work is done within the call in which the block is no longer BUSY.
"""

from __future__ import annotations

import errno
import gzip
import shutil
import tarfile
import zlib
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from plcsim.library.block import StatusError
from plcsim.library.fileio.interface import fiERR_FILE_DEVICE
from plcsim.library.fileio.volumes import FileRefusedError, Volumes
from plcsim.library.runtime import ERR_OK
from plcsim.library.status_block import DelayedBlock

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from plcsim.library.members import BlockVariables
    from plcsim.library.status_block import StatusBlock

NULLPOINTER: Final = 38060
INVALID_DEVICE: Final = 38061
UNSUPPORTED_EXTENSION: Final = 38062
INTERNAL_ERROR: Final = 38063
SPACE: Final = 38064
FILE_NOT_FOUND: Final = 38065
FILE_WRITE_ERROR: Final = 38066
"""zipERR_..."""

_FULL: Final = frozenset([errno.ENOSPC, errno.EDQUOT])


class _ArchiveBlock(DelayedBlock):
    """A block with an archive, and a file or a folder."""

    def act(self, variables: BlockVariables) -> int:
        """Do it; return the status."""
        archive = self._path(variables, "pArchiveDevice", "pArchiveFile")
        with _host():
            self.work(variables, archive)
        return ERR_OK

    def work(self, variables: BlockVariables, archive: Path) -> None:
        """Make or read the archive.

        Raises:
            StatusError: it cannot be.
        """
        raise NotImplementedError(type(self).__name__)

    def _path(self, variables: BlockVariables, device: str, file: str) -> Path:
        p_device, p_file = variables.address(device), variables.address(file)
        if not (p_device and p_file):
            raise StatusError(NULLPOINTER)
        try:
            return self.context.library(Volumes).path(p_device, p_file)
        except FileRefusedError as refused:
            is_device = refused.status == fiERR_FILE_DEVICE
            raise StatusError(INVALID_DEVICE if is_device else FILE_NOT_FOUND) from None


class Archive(_ArchiveBlock):
    """zipArchive."""

    def work(self, variables: BlockVariables, archive: Path) -> None:
        """Pack a file, or a folder with what is in it."""
        source = self._path(variables, "pSrcDevice", "pSrcFile")
        if not source.exists():
            raise StatusError(FILE_NOT_FOUND)
        if _is_tar(archive):
            with tarfile.open(archive, "w:gz" if _is_packed(archive) else "w") as made:
                made.add(source, source.name)
        elif not _is_packed(archive) or source.is_dir():
            raise StatusError(UNSUPPORTED_EXTENSION)
        else:
            with source.open("rb") as data, gzip.open(archive, "wb") as packed:
                shutil.copyfileobj(data, packed)
        self.context.library(Volumes).date(archive)


class Extract(_ArchiveBlock):
    """zipExtract: nothing is written outside of the folder, whatever the archive names."""

    def work(self, variables: BlockVariables, archive: Path) -> None:
        """Unpack it; the folder is made where it is not there."""
        folder = self._path(variables, "pOutDevice", "pOutFolder")
        if not archive.is_file():
            raise StatusError(FILE_NOT_FOUND)
        folder.mkdir(parents=True, exist_ok=True)
        if _is_tar(archive):
            with tarfile.open(archive) as found:
                found.extractall(folder, filter="data")
        elif _is_packed(archive):
            with gzip.open(archive) as data, (folder / archive.stem).open("wb") as made:
                shutil.copyfileobj(data, made)
        else:
            raise StatusError(UNSUPPORTED_EXTENSION)


def _is_packed(archive: Path) -> bool:
    return archive.suffix.lower() in (".gz", ".tgz")


def _is_tar(archive: Path) -> bool:
    return archive.name.lower().endswith((".tar", ".tar.gz", ".tgz"))


@contextmanager
def _host() -> Iterator[None]:
    """Raise what the host refuses as a `StatusError`."""
    try:
        yield
    except (tarfile.TarError, gzip.BadGzipFile, zlib.error, EOFError):
        raise StatusError(INTERNAL_ERROR) from None
    except OSError as err:
        raise StatusError(SPACE if err.errno in _FULL else FILE_WRITE_ERROR) from None


BLOCKS: Final[Mapping[str, type[StatusBlock]]] = {"zipArchive": Archive, "zipExtract": Extract}
"""What runs the blocks by their names."""
