"""The parser of ``plcsim`` and what becomes of the errors of its commands."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from importlib import import_module
from importlib.metadata import version
from typing import TYPE_CHECKING, Final, TextIO

from plcsim.cli.console import print_error
from plcsim.cli.exit_codes import ExitCode, epilog
from plcsim.cli.installed import COMMANDS, register_installed
from plcsim.cli.parser import CommandParser
from plcsim.core.errors import PlcError
from st_types.errors import TypeSystemError

if TYPE_CHECKING:
    import argparse


OWN_COMMANDS: Final = {
    "new": "new",
    "import-as": "import_as",
    "check": "check",
    "run": "run",
    "watch": "watch",
    "set": "operate",
    "force": "operate",
    "release": "operate",
    "logbook": "logbook",
    "types": "types",
    "st": "st",
    "doctor": "doctor",
    "report": "report",
    "completion": "completion",
}
"""Modules of ``plcsim.cli`` by the command; one module may have several."""


def build_parser(command: str = "") -> argparse.ArgumentParser:
    """Return the parser of all commands, those of other packages included.

    Args:
        command: the one that will be given; of our own commands the others are not even imported.
    """
    parser: argparse.ArgumentParser = CommandParser(
        prog="plcsim",
        description="Runs PLC programs on Linux the way a B&R controller runs them.",
        examples=(
            ("plcsim new my_plc", "a project that runs and tests itself"),
            ("plcsim run my_plc", "run it until Ctrl-C"),
            ("plcsim run --help", "what else a command can do"),
        ),
        epilog=epilog(**{code.name: "" for code in ExitCode}),
    )
    parser.add_argument("--version", action="version", version=f"plcsim {version('plcsim')}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    own = OWN_COMMANDS.get(command)
    for module in (own,) if own else dict.fromkeys(OWN_COMMANDS.values()):
        import_module(f"plcsim.cli.{module}").register(subparsers)
    if own is None:
        register_installed(COMMANDS, subparsers)
    return parser


def run_command(arguments: list[str] | None) -> int:
    """Run a command and return its exit code; an error is told in one line."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # LANG=C has no letters beyond ASCII
    code = 0
    try:
        words = sys.argv[1:] if arguments is None else arguments
        options = build_parser(words[0] if words else "").parse_args(words)
        code = options.func(options)
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:  # the reader has seen enough, as `head` has
        pass
    except (PlcError, TypeSystemError, OSError) as err:
        print_error(err)
        code = ExitCode.FAILED
    _drop_output(sys.stdout)
    _drop_output(sys.stderr)
    return code


def _drop_output(stream: TextIO | None) -> None:
    """Let nothing that could not be written fail again at the end: Python would exit with 120."""
    if stream is None:  # closed before the process began
        return
    with contextlib.suppress(OSError, ValueError):
        stream.flush()
        return
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
