"""Headers found whatever case their names are written in, as on the system they were written on.

clang looks files up in an overlay first, which can be case-blind; it names the real files.
"""

from __future__ import annotations

import hashlib
import json
import os
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

DEEPEST: Final = 6
"""Folders one in another that are looked into."""

SUFFIXES: Final = (".h", ".hpp", ".hh", ".hxx", ".inc", ".c", ".cpp")
"""Of files that are included."""


def overlay_of(folders: Iterable[Path]) -> str:
    """Return the text of an overlay (clang's ``-ivfsoverlay``) with the headers in folders."""
    roots = [root for folder in folders if (root := _folder(os.fspath(folder), DEEPEST))]
    return json.dumps(
        {
            "version": 0,
            "case-sensitive": "false",
            "use-external-names": "true",
            "roots": roots,
        }
    )


def written_overlay(folders: Iterable[Path], parent: Path) -> Path:
    """Write an overlay into a folder, under a name by its content; return the file."""
    text = overlay_of(folders)
    name = hashlib.blake2b(text.encode(), digest_size=16).hexdigest()
    file = parent / f"{name}.overlay"
    if not file.is_file():
        new = parent / f"{name}.{os.getpid()}.new"
        new.write_text(text, "utf-8")
        new.replace(file)
    return file


def spelled(folder: Path, name: str) -> str | None:
    """Return the name of a file as it is spelled on the disk, None where there is none.

    Args:
        folder: from which the name counts.
        name: with ``/`` between its parts, in any case.
    """
    known: list[str] = []
    for part in name.split("/"):
        here = folder.joinpath(*known)
        found = part if part in ("", "..") or (here / part).exists() else _in_any_case(here, part)
        if found is None:
            return None
        known.append(found)
    return "/".join(known) if folder.joinpath(*known).is_file() else None


def _in_any_case(folder: Path, name: str) -> str | None:
    try:
        names = sorted(each.name for each in folder.iterdir())
    except OSError:
        return None
    return next((each for each in names if each.lower() == name.lower()), None)


def _folder(path: str, depth: int, name: str | None = None) -> dict[str, Any] | None:
    contents: list[dict[str, Any]] = []
    try:
        with os.scandir(path) as found:
            entries = sorted(found, key=lambda entry: entry.name)
    except OSError:
        return None
    for entry in entries:
        if entry.name.lower().endswith(SUFFIXES) and entry.is_file():
            contents.append({"type": "file", "name": entry.name, "external-contents": entry.path})
        elif depth and entry.name[0] not in "._" and entry.is_dir(follow_symlinks=False):
            inner = _folder(entry.path, depth - 1, entry.name)
            if inner:
                contents.append(inner)
    if not contents:
        return None
    return {"type": "directory", "name": name or path, "contents": contents}
