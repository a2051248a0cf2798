"""``plcsim types library``: writes what Python sees of libraries."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError
from plcsim.library.face import INTERFACE
from plcsim.library.face_writer import interface_source
from plcsim.library.installed import Scopes, installed
from plcsim.library.library import Library, check_scope, declarations_of, files_in
from plcsim.program.declarations import Declarations
from plcsim.project.plc_toml import read_project
from plcsim.project.project_file import project_file

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence
    from pathlib import Path


def library(options: argparse.Namespace) -> int:
    """Write ``interface.py`` into the folders of libraries, or say which are not fresh."""
    stale = [file for folder in options.paths if (file := _written(folder, options.check))]
    for file in stale:
        sys.stderr.write(f"{file}: is not fresh\n")
    return 1 if stale else 0


def _written(folder: Path, only_checked: bool) -> Path | None:  # of the command
    found, others = _library_in(folder)
    check_scope(found.scope)
    text = interface_source(found, others)
    file = folder / f"{INTERFACE}.py"
    if file.is_file() and file.read_text("utf-8") == text:
        return None
    if only_checked:
        return file
    try:
        file.write_text(text, "utf-8")
    except OSError as err:
        raise ConfigurationError(f"{file}: cannot be written: {err.strerror}") from None
    print(file)
    return None


def _library_in(folder: Path) -> tuple[Library, Sequence[Library]]:
    """Return the library in a folder, and those of its project."""
    if not declarations_of(files_in(folder)):
        raise ConfigurationError(f"{folder}: no .typ, .var or .fun file was found")
    here = folder.resolve()
    own: Sequence[Library] = [each for each in installed().values() if each.folder == here]
    if not own:
        own = _of_project(here)
    found = next((each for each in own if each.folder == here), None)
    return found or Library(here, here.name, Scopes([*installed().values()])), own


def _of_project(folder: Path) -> Sequence[Library]:
    """Return the libraries of the project that a folder lies in."""
    for parent in folder.parents:
        if project_file(parent) is not None:
            layout = read_project(parent).layout
            return Declarations(layout, "project").own_libraries
    return ()
