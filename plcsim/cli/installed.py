"""Commands that packages above plcsim bring, found by entry points."""

from __future__ import annotations

from importlib.metadata import entry_points
from typing import TYPE_CHECKING

from plcsim.cli.console import print_error

if TYPE_CHECKING:
    import argparse

COMMANDS = "plcsim.commands"
"""Entry point group of the commands of ``plcsim``."""

TYPE_COMMANDS = "plcsim.commands.types"
"""Entry point group of the commands of ``plcsim types``."""


def register_installed(
    group: str, subparsers: argparse._SubParsersAction[argparse.ArgumentParser]
) -> None:
    """Add the commands of a group; each entry point is a function that takes the subparsers."""
    for entry in sorted(entry_points(group=group), key=lambda e: e.name):
        try:
            entry.load()(subparsers)
        except ImportError as err:  # a package that is half installed costs its own command only
            print_error(f"the command {entry.name} is not there: {err}")
