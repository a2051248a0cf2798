"""``plcsim types library``: writes what Python sees of libraries, projects and programs."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError
from plcsim.library.face import INTERFACE
from plcsim.library.face_writer import FolderFace, interface_source
from plcsim.library.installed import Scopes, installed
from plcsim.library.library import Library, check_scope, declarations_of, files_in
from plcsim.program.declarations import Declarations
from plcsim.project.plc_toml import read_project
from plcsim.project.project_file import project_file

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.library.face_writer import FaceSource

STUB: Final = "__init__.pyi"
"""Tells editors and type checkers what a folder is as a package; Python does not read it."""


def library(options: argparse.Namespace) -> int:
    """Write ``interface.py`` into the folders of libraries, or say which are not fresh.

    Into the folders of a project and its programs goes a stub with what they declare.
    """
    stale = [file for folder in options.paths if (file := _written(folder, options.check))]
    for file in stale:
        sys.stderr.write(f"{file}: is not fresh\n")
    return 1 if stale else 0


def _written(folder: Path, only_checked: bool) -> Path | None:  # of the command
    found, others = _declared_in(folder)
    check_scope(found.scope)
    text = interface_source(found, others)
    file = folder / (f"{INTERFACE}.py" if isinstance(found, Library) else STUB)
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


def _declared_in(folder: Path) -> tuple[FaceSource, Sequence[FaceSource]]:
    """Return what is declared in a folder, and what it sees beside installed libraries."""
    if not declarations_of(files_in(folder)):
        raise ConfigurationError(f"{folder}: no .typ, .var or .fun file was found")
    here = folder.resolve()
    own = next((each for each in installed().values() if each.folder == here), None)
    if own is not None:
        return own, [own]
    declarations = _project_around(here)
    if declarations is None:
        return Library(here, here.name, Scopes([*installed().values()])), ()
    libraries = declarations.own_libraries
    packages = _packages(declarations, here)
    faces: dict[Path, FaceSource] = {each.folder: each for each in libraries}
    faces.update(packages)
    found = faces.get(here) or Library(here, here.name, declarations.catalogue.scopes)
    return found, [*libraries, *packages.values()]


def _project_around(folder: Path) -> Declarations | None:
    """Return the declarations of the project that a folder lies in."""
    for parent in (folder, *folder.parents):
        if project_file(parent) is not None:
            return Declarations(read_project(parent).layout, parent.name)
    return None


def _packages(declarations: Declarations, folder: Path) -> dict[Path, FolderFace]:
    """Return what a project declares, and what the program in a folder does, by folder."""
    top = declarations.folder
    found = {top: FolderFace(top.name, declarations.package, declarations.scope)}
    for source, place in declarations.layout.programs.items():
        if place.folder == folder != top:
            inner = folder.relative_to(top).parts
            package = ".".join((declarations.package, *inner))
            found[folder] = FolderFace(folder.name, package, declarations.scope_of(source))
    return found
