"""Which file is the project: plc.toml, or the project file of Automation Studio."""

from __future__ import annotations

import itertools
import os
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError
from plcsim.project.automation_studio.logical_view import project_file as automation_studio_file

if TYPE_CHECKING:
    from pathlib import Path

FILE_NAME: Final = "plc.toml"

AUTOMATION_STUDIO: Final = ".apj"

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

    Raises:
        ConfigurationError: there is none; projects nearby are named.
    """
    if path.name == FILE_NAME or path.suffix.lower() == AUTOMATION_STUDIO:
        return _readable(path, path)
    return _readable(project_file(path) or path / FILE_NAME, path)


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
    files = itertools.chain(folder.glob(f"*/{FILE_NAME}"), folder.glob("*/*.apj"))
    found = sorted(dict.fromkeys(str(f.parent) for f in itertools.islice(files, MOST_HINTS)))
    return f"; there are projects in {', '.join(found)}" if found else "; a project has one"
