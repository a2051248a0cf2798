"""Functions of C that come compiled for the controller: a header declares what objects beside hold.

Such objects are of another processor's code, so nothing here executes what is in them.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Final

from plcsim.ansi_c.plain_words import without_comments

if TYPE_CHECKING:
    from collections.abc import Iterator

OBJECTS: Final = (".a", ".o", ".br")
"""Suffixes of compiled code, in small letters."""

_DEEPEST: Final = 2
"""Folders one in another in which they lie beside a header: ``SG4/Arm/libMotion.a``."""

_HEADERS: Final = (".h", ".hpp")


def has_objects(folder: Path) -> bool:
    """Return whether compiled code lies in a folder, or below as vendors have it."""
    return next(_below(folder, OBJECTS), None) is not None


def declaring_header(folder: Path, name: str) -> Path | None:
    """Return the header in a folder with compiled code that declares a function, None for none."""
    if not has_objects(folder):
        return None
    declared = re.compile(
        rf"(?:^|[;{{}}])\s*(?:extern\s*\"C\"\s*)?(?!(?:return|else|do|typedef)\b)[A-Za-z_]"
        rf"[\w\s*]*[\s*]{re.escape(name)}\s*\([^;{{}}]*\)[^;{{}}()=]*;",
        re.MULTILINE,
    )
    headers = sorted(_below(folder, _HEADERS))
    return next((each for each in headers if declared.search(without_comments(each))), None)


def _below(folder: Path, suffixes: tuple[str, ...], deepest: int = _DEEPEST) -> Iterator[Path]:
    """Yield the files with some suffixes; what cannot be read holds none."""
    try:
        with os.scandir(folder) as found:
            entries = sorted(found, key=lambda entry: entry.name)
    except OSError:
        return
    for entry in entries:
        if entry.name.lower().endswith(suffixes):
            yield Path(entry.path)
        elif deepest and entry.is_dir():
            yield from _below(Path(entry.path), suffixes, deepest - 1)
