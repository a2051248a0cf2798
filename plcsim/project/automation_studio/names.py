r"""File names as Windows takes them: in any case, with ``\`` between folders."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path


def names_in(folder: Path) -> dict[str, str]:
    """Return the names in a folder by themselves in small letters; {} if it cannot be read."""
    try:
        return {path.name.lower(): path.name for path in folder.iterdir()}
    except (OSError, ValueError):
        return {}


def in_any_case(path: Iterable[str]) -> tuple[str, ...]:
    """Return the parts of a path of the logical view as they are compared: in small letters."""
    return tuple(part.lower() for part in path)


class FileNames:
    """Finds files of one project, each folder being read once.

    Args:
        folder: of the project, where the project file lies.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._names = cache(names_in)

    def in_folder(self, folder: Path) -> dict[str, str]:
        """See `names_in`."""
        return self._names(folder)

    def below(self, folder: Path, name: str) -> Path | None:
        r"""Return what ``name`` means, counted from ``folder``; None if it is not there.

        Args:
            folder: where the name stands.
            name: with ``\`` or ``/`` between its parts, also doubled, in any case.
        """
        for part in name.replace("\\", "/").split("/"):
            if part == "..":
                folder = folder.parent
            elif part not in ("", "."):
                found = self._names(folder).get(part.lower())
                if found is None:
                    return None
                folder = folder / found
        return folder

    def referenced(self, folder: Path, name: str) -> Path | None:
        r"""Return what a reference means: counted from the project's folder, else from ``folder``.

        One that begins with ``\`` counts from the project's folder.
        """
        found = self.below(self.folder, name)
        if found is None and not name.startswith("\\"):
            found = self.below(folder, name)
        return found
