"""What C is called in messages, and which files are C."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import Path

NAME: Final = "ANSI C"

SUFFIXES: Final = (".c", ".cpp", ".cc", ".cxx")
"""Of files that are compiled."""


DEEPEST: Final = 8
"""Folders one in another that hold one program, as packages in Automation Studio do."""


def c_files(folder: Path, depth: int = DEEPEST) -> list[Path]:
    """Return the files of a folder that are compiled, then those of the folders in it."""
    entries = sorted(folder.iterdir())
    found = [f for f in entries if f.suffix.lower() in SUFFIXES and f.is_file()]
    for entry in entries:
        if depth and entry.name[0] not in "._" and entry.is_dir() and not entry.is_symlink():
            found += c_files(entry, depth - 1)
    return found
