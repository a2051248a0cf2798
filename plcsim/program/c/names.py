"""What C is called in messages, and which files are C."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.library import SUFFIXES_OF_C

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

NAME: Final = "ANSI C"


def c_files(files: Iterable[Path]) -> list[Path]:
    """Return those of some files that are compiled."""
    return [file for file in files if file.suffix.lower() in SUFFIXES_OF_C]
