"""PROJECT on the command line: optional inside a project's folder."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.project.project_file import AUTOMATION_STUDIO, FILE_NAME, project_file

if TYPE_CHECKING:
    import argparse

HELP = (
    "folder with plc.toml, or of an Automation Studio project (default: the one that this "
    "folder belongs to)"
)


def add_project(parser: argparse.ArgumentParser) -> None:
    """Add PROJECT as the argument ``project``, a `Path`."""
    parser.add_argument(
        "project", type=Path, nargs="?", default=own_project(), metavar="PROJECT", help=HELP
    )


def add_configuration(parser: argparse.ArgumentParser) -> None:
    """Add the option ``config``, "" where it is not given."""
    parser.add_argument(
        "--config",
        default="",
        metavar="NAME",
        help="configuration of an Automation Studio project (default: the active one)",
    )


def configuration_of(options: argparse.Namespace) -> dict[str, dict[str, object]]:
    """Return what the option ``config`` gives to a project."""
    return {"as": {"config": options.config}} if options.config else {}


def own_project() -> Path:
    """Return the nearest folder that is a project, this one or above it; this one where none is."""
    here = Path()
    for depth, folder in enumerate((here.absolute(), *here.absolute().parents)):
        if project_file(folder) is not None:
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
    is_file = first.name == FILE_NAME or first.suffix.lower() == AUTOMATION_STUDIO
    if is_file or project_file(first) is not None or project_file(here) is None:
        return first, options.tags
    return here, [options.project, *options.tags]
