"""``plcsim st``: the arguments of its commands; `plcsim.cli.st_commands` does the work."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.cli.exit_codes import epilog

if TYPE_CHECKING:
    import argparse

EPILOG = epilog(DONE="", FAILED="errors were found", WRONG_USAGE="")


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command and its sub-commands."""
    parser = subparsers.add_parser(
        "st",
        help="check programs in Structured Text",
        description="Work with Structured Text: programs of B&R projects and standard files.",
        epilog=EPILOG,
    )
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _add_check(commands)


def _add_check(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    text = "read files and report what is wrong in them"
    parser = commands.add_parser(
        "check",
        help=text,
        description=f"{text[0].upper()}{text[1:]}.",
        examples=(
            ("plcsim st check my_plc", "all .st files of a folder"),
            ("plcsim st check --syntax Main.st", "without the declarations around it"),
        ),
        epilog=EPILOG,
    )
    parser.add_argument("--syntax", action="store_true", help="do not look at names and types")
    parser.add_argument(
        "-D",
        dest="defines",
        metavar="NAME[=VALUE]",
        action="append",
        default=[],
        help="define a macro for #if and #ifdef",
    )
    parser.add_argument(
        "paths",
        nargs="+",
        type=Path,
        metavar="PATH",
        help="file, or folder with all .st files below it",
    )
    parser.set_defaults(func=_run, act="check")


def _run(options: argparse.Namespace) -> int:
    # Imported here, so that other commands start without the parsers.
    commands = import_module("plcsim.cli.st_commands")
    code: int = commands.COMMANDS[options.act](options)
    return code
