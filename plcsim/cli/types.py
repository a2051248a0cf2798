"""``plcsim types``: the arguments of its commands; `plcsim.cli.type_commands` does the work."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.cli.exit_codes import epilog
from plcsim.cli.installed import TYPE_COMMANDS, register_installed

if TYPE_CHECKING:
    import argparse

EPILOG = epilog(DONE="", FAILED="errors were found", WRONG_USAGE="")

EXAMPLES = {
    "check": (("plcsim types check Logical", "all files of an Automation Studio project"),),
    "layout": (("plcsim types layout Motor_typ my_plc", "offsets of its members, in bytes"),),
    "header": (("plcsim types header -o include my_plc", ""),),
    "python": (("plcsim types python -o my_plc_types my_plc", ""),),
    "library": (
        ("plcsim types library my_lib", "its interface.py, for editors and mypy"),
        ("plcsim types library my_plc", "__init__.pyi: types and constants of the project"),
    ),
    "print": (("plcsim types print --write Types.typ", ""),),
}


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command and its sub-commands."""
    parser = subparsers.add_parser(
        "types",
        help="check, lay out, print and convert .typ, .var and .fun files",
        description="Work with the declarations of a B&R project: .typ, .var and .fun files.",
        epilog=EPILOG,
    )
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    check = _add(commands, "check", "read files and report what is wrong in them")
    check.add_argument(
        "--strict", action="store_true", help="a name that no file declares is an error"
    )
    layout = _add(commands, "layout", "show where the members of a type lie", "type")
    layout.add_argument("--deep", action="store_true", help="show members of inner STRUCTs too")
    header = _add(commands, "header", "write the C header that Automation Studio would generate")
    header.add_argument("--name", default="", help="name for the guard; default: the file's")
    module = _add(commands, "python", "write a Python module of typed views")
    for parser in (header, module):
        parser.add_argument(
            "-o",
            "--output",
            type=Path,
            metavar="FOLDER",
            help="write a file there for each program, package, library",
        )
    printed = _add(commands, "print", "write the declarations again, in Automation Studio's shape")
    printed.add_argument(
        "-w", "--write", action="store_true", help="into the files themselves, encoded as they are"
    )
    library = _add(
        commands, "library", "write what Python sees of a library, a project or a program"
    )
    library.add_argument(
        "--check", action="store_true", help="write nothing; a file that is not fresh is an error"
    )
    register_installed(TYPE_COMMANDS, commands)


def _add(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    text: str,
    *arguments: str,
) -> argparse.ArgumentParser:
    parser = commands.add_parser(
        name, help=text, description=_sentence(text), examples=EXAMPLES[name], epilog=EPILOG
    )
    for argument in arguments:
        parser.add_argument(argument, metavar=argument.upper(), help="its name")
    parser.add_argument(
        "paths",
        nargs="+" if name == "check" else "*",
        type=Path,
        default=None if name == "check" else [Path()],
        metavar="PATH",
        help="file, or folder with all below it"
        + ("" if name == "check" else "; default: this folder"),
    )
    parser.set_defaults(func=_run, act=name)
    return parser


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def _run(options: argparse.Namespace) -> int:
    # Imported here, so that other commands start without the parsers.
    commands = import_module("plcsim.cli.type_commands")
    code: int = commands.COMMANDS[options.act](options)
    return code
