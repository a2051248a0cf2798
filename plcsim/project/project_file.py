"""Which file is the project: plc.toml, or the project file of Automation Studio."""

from __future__ import annotations

import contextlib
import itertools
import os
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError
from plcsim.project.automation_studio.logical_view import logical_folder
from plcsim.project.automation_studio.logical_view import project_file as automation_studio_file

if TYPE_CHECKING:
    from pathlib import Path

FILE_NAME: Final = "plc.toml"

AUTOMATION_STUDIO: Final = ".apj"

PROJECT_IS: Final = "a project is a folder with plc.toml, or one of Automation Studio with *.apj"

ARCHIVES: Final = (".zip", ".7z", ".gz", ".tar", ".tgz", ".rar")

DEEPEST: Final = 3
"""Folders one in another that are looked through for an Automation Studio project."""

MOST_HINTS: Final = 5
"""Projects that are named where one was not found."""


def project_file(folder: Path) -> Path | None:
    """Return the file that makes a folder a project, None where it is none.

    plc.toml counts before the project file of Automation Studio, for it may say more about it.
    """
    if os.path.isfile(folder / FILE_NAME):  # noqa: PTH113  # no error for what can be no path
        return folder / FILE_NAME
    return automation_studio_file(folder)


def find_project(path: Path) -> Path:
    """Return the file of a project that a person named by its folder or by that file.

    A checkout or an unpacked archive may hold the project's folder in another one, or two: where
    there is one Automation Studio project below the folder, it is that one.

    Raises:
        ConfigurationError: there is none, or there are several; projects nearby are named.
    """
    is_folder = os.path.isdir(path)  # noqa: PTH112  # no error for what can be no path
    if path.name == FILE_NAME or (path.suffix.lower() == AUTOMATION_STUDIO and not is_folder):
        return _readable(path, path)
    if os.path.isfile(path):  # noqa: PTH113  # likewise
        kind = "an archive to unpack" if path.suffix.lower() in ARCHIVES else "a file"
        raise ConfigurationError(f"{path}: is no project but {kind}{_nearby(path)}")
    found = project_file(path)
    if found is None:
        below = _below(path)
        found = automation_studio_file(below[0]) if len(below) == 1 else None
    return _readable(found or path / FILE_NAME, path)


def _below(path: Path, deepest: int = DEEPEST) -> list[Path]:
    """Return the folders of Automation Studio projects below a folder, those of samples too."""
    if not os.path.isdir(path):  # noqa: PTH112  # no error for what can be no path
        return []
    files = itertools.chain.from_iterable(
        path.glob(f"{'*/' * depth}*{AUTOMATION_STUDIO}") for depth in range(1, deepest + 1)
    )
    found: dict[Path, None] = {}
    with contextlib.suppress(OSError):  # folders that come, go or may not be read
        for file in itertools.islice(files, MOST_HINTS):
            found[file.parent] = None
    return [folder for folder in found if logical_folder(folder) is not None]


def _readable(file: Path, named: Path) -> Path:
    try:
        file.stat()
    except (FileNotFoundError, NotADirectoryError):
        raise ConfigurationError(f"{file}: there is no such file{_nearby(named)}") from None
    except (OSError, ValueError) as err:
        raise ConfigurationError(f"{file}: cannot be read: {err}") from None
    return file


def _nearby(path: Path) -> str:
    """Return a hint at the project that ``path`` lies in, or at those below it or beside it."""
    for parent in path.resolve().parents:
        if project_file(parent) is not None:
            return f"; did you mean {parent}?"
    folder = path if path.is_dir() else path.parent
    folders = _below(path) if path.is_dir() else _below(folder, 1)
    with contextlib.suppress(OSError):
        files = itertools.islice(folder.glob(f"*/{FILE_NAME}"), MOST_HINTS)
        folders += [file.parent for file in files]
    found = sorted(dict.fromkeys(map(str, folders)))
    return f"; there are projects in {', '.join(found)}" if found else f"; {PROJECT_IS}"
