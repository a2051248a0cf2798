"""What a campaign needs on disk, as bytes that travel to the workers.

A project is its content, not its place: workers unpack it wherever they are, and the same content
has the same name everywhere.
"""

from __future__ import annotations

import hashlib
import io
import os
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from plcsim.campaign.errors import CampaignError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

LEFT_OUT: Final = frozenset({"__pycache__", "node_modules", "Temp", "Binaries"})
"""Folders that no run reads: caches, and what Automation Studio builds."""

RESULTS_SUFFIX: Final = ".results"
"""Folders of results end so."""

OUTPUT_SUFFIXES: Final = (RESULTS_SUFFIX, ".pyc", ".bag", ".mcap", ".png", ".html")
"""What runs write and no run reads: it does not travel, and changes no campaign."""

MOST_BYTES: Final = 256 << 20
"""Of all files together; who has more has named the wrong folder."""

_EPOCH = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True)
class Content:
    """Files of a campaign.

    Attributes:
        archive: a zip archive; the same for the same files.
        file: of the campaign, relative to the folder where the archive is unpacked.
    """

    archive: bytes
    file: str

    @property
    def name(self) -> str:
        """Hexadecimal digits that stand for this content."""
        return hashlib.sha256(self.archive + b"\0" + self.file.encode()).hexdigest()[:32]

    def unpack(self, folder: Path) -> Path:
        """Write the files below a folder; return the file of the campaign there."""
        with zipfile.ZipFile(io.BytesIO(self.archive)) as archive:
            archive.extractall(folder)
        return folder / self.file


def pack(file: Path, folders: Iterable[Path]) -> Content:
    """Return the content of a campaign.

    Args:
        file: of the campaign; the Python files beside it travel as well, as it may import them.
        folders: of the project and of its libraries, with all that lies below them.

    Raises:
        CampaignError: the folders hold too much.
    """
    wanted = [folder.resolve() for folder in folders]
    here = file.resolve().parent
    top = Path(os.path.commonpath([here, *wanted]))
    found = {path for folder in wanted for path in _files(folder)} | set(here.glob("*.py"))
    found |= set(here.glob("*.csv"))
    size = sum(path.stat().st_size for path in found)
    if size > MOST_BYTES:
        raise CampaignError(f"{top}: {size >> 20} MB would travel to the workers; that is too much")
    stored = io.BytesIO()
    with zipfile.ZipFile(stored, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(found):
            entry = zipfile.ZipInfo(path.relative_to(top).as_posix(), _EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, path.read_bytes())
    return Content(stored.getvalue(), file.resolve().relative_to(top).as_posix())


def _files(folder: Path) -> Iterator[Path]:
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not _is_left_out(name)]
        yield from (Path(root, name) for name in names if not _is_left_out(name))


def _is_left_out(name: str) -> bool:
    return name.startswith(".") or name in LEFT_OUT or name.endswith(OUTPUT_SUFFIXES)
