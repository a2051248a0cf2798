"""PROJECT on the command line: optional inside a project's folder."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.project.plc_toml import FILE_NAME

if TYPE_CHECKING:
    import argparse

HELP = "folder with plc.toml (default: the one that this folder belongs to)"


def add_project(parser: argparse.ArgumentParser) -> None:
    """Add PROJECT as the argument ``project``, a `Path`."""
    parser.add_argument(
        "project", type=Path, nargs="?", default=own_project(), metavar="PROJECT", help=HELP
    )


def own_project() -> Path:
    """Return the nearest folder with a plc.toml, this one or above it; this one where none has."""
    here = Path()
    for depth, folder in enumerate((here.absolute(), *here.absolute().parents)):
        if (folder / FILE_NAME).is_file():
            return Path(*[".."] * depth)
    return here


def add_project_and_tags(parser: argparse.ArgumentParser, help_on_tags: str) -> None:
    """Add PROJECT and any number of TAGs; for what was typed ask `project_and_tags`."""
    parser.add_argument("project", nargs="?", metavar="PROJECT", help=HELP)
    parser.add_argument("tags", nargs="*", metavar="TAG", help=help_on_tags)


def project_and_tags(options: argparse.Namespace) -> tuple[Path, list[str]]:
    """Return the project and the tags that were named.

    The first word is the project where that is one, or where this folder belongs to none.
    """
    here = own_project()
    if options.project is None:
        return here, []
    first = Path(options.project)
    is_project = (first / FILE_NAME).is_file() or first.name == FILE_NAME
    if is_project or not (here / FILE_NAME).is_file():
        return first, options.tags
    return here, [options.project, *options.tags]
