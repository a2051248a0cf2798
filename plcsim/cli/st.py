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
        help="check, run, format and look into programs in Structured Text",
        description="Work with Structured Text: programs of B&R projects and standard files.",
        epilog=EPILOG,
    )
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _add_check(commands)
    _add_run(commands)
    _add_format(commands)
    _add_wat(commands)


def _add_check(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    text = "read files and report what is wrong in them"
    parser = commands.add_parser(
        "check",
        help=text,
        description=f"{text[0].upper()}{text[1:]}.",
        examples=(
            ("plcsim st check my_plc", "all files of programs in a folder"),
            ("plcsim st check --syntax Main.st", "without the declarations around it"),
            ("plcsim st check --show ST5002 my_plc", "unused variables, too"),
        ),
        epilog=EPILOG,
    )
    parser.add_argument("--syntax", action="store_true", help="do not look at names and types")
    parser.add_argument(
        "--hide", default="", metavar="CODE,...", help="warnings that are not wanted, as ST5006"
    )
    parser.add_argument(
        "--show",
        default="",
        metavar="CODE,...",
        help="warnings that are told on demand: ST5002 unused variables, ST5005 narrowing",
    )
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
        help="file, or folder with all files of programs below it: .st, .ld, .il, .sfc, ...",
    )
    parser.set_defaults(func=_run, act="check")


def _add_run(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "run",
        help="run a file for some cycles and show variables",
        description="Run the programs of a file on the virtual clock, without a project. Task "
        "classes are the TASKs of its CONFIGURATION, where it has one. To the file of a program "
        "of Automation Studio belong the files beside it.",
        examples=(
            ("plcsim st run counter.st", "100 cycles, and the last value of every variable"),
            ("plcsim st run Main.st --cycles 5 --trace count,timer.Q", "a row for each cycle"),
            ("plcsim st run Main.st --set limit=10 --format csv --trace count", ""),
        ),
        epilog=epilog(DONE="", FAILED="the file is wrong", WRONG_USAGE="", SERVICE=""),
    )
    parser.add_argument("--cycles", type=_count, default=100, metavar="N", help="default: 100")
    parser.add_argument(
        "--cycle", metavar="TIME", help="cycle time of what no TASK has (default: 10ms)"
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="give a variable a value after INIT",
    )
    parser.add_argument(
        "--trace",
        action="append",
        default=[],
        metavar="NAME,...",
        help="variables to show after each cycle of the first task class",
    )
    parser.add_argument(
        "--format", choices=("table", "csv", "json"), default="table", help="default: table"
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="an .st file, or .ld, .il, ...")
    parser.set_defaults(func=_run, act="run")


def _add_format(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "format",
        help="indent files and put blanks in order",
        description="Indent files by their blocks and put one blank where readers expect one. "
        "Tokens, comments and line breaks stay as they are; a file with errors in its syntax or "
        "with lines of the preprocessor is left alone.",
        examples=(
            ("plcsim st format my_plc", "all .st files of a folder"),
            ("plcsim st format --check my_plc", "change nothing; exit 1 where something would be"),
        ),
        epilog=epilog(DONE="", FAILED="errors were found, or --check would change a file"),
    )
    parser.add_argument("--check", action="store_true", help="change nothing, name the files")
    parser.add_argument(
        "--indent",
        type=_count,
        metavar="N",
        help="blanks of a step; a tab by default",
    )
    parser.add_argument(
        "paths",
        nargs="+",
        type=Path,
        metavar="PATH",
        help="file, or folder with all .st files below it",
    )
    parser.set_defaults(func=_run, act="format")


def _add_wat(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "wat",
        help="show the WebAssembly that a file becomes",
        description="Print the programs of a file as WebAssembly text. Comments tell lines of the "
        "source, and of addresses the segment of variables with the bytes from its start.",
        examples=(("plcsim st wat Main.st", ""),),
        epilog=epilog(DONE="", FAILED="the file is wrong", WRONG_USAGE=""),
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="an .st file")
    parser.set_defaults(func=_run, act="wat")


def _count(text: str) -> int:
    number = int(text)
    if number < 1:
        raise ValueError
    return number


def _run(options: argparse.Namespace) -> int:
    # Imported here, so that other commands start without the parsers.
    commands = import_module("plcsim.cli.st_commands")
    code: int = commands.COMMANDS[options.act](options)
    return code
