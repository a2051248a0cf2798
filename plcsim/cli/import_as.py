"""``plcsim import-as AS_PROJECT FOLDER``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.cli.console import CommandConsole, print_error
from plcsim.cli.exit_codes import ExitCode, epilog
from plcsim.cli.project_argument import add_configuration, configuration_of
from plcsim.core.errors import ConfigurationError
from plcsim.project.assembly import load, still_controller
from plcsim.project.native import write_native
from plcsim.project.plc_toml import read_project

if TYPE_CHECKING:
    import argparse


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "import-as",
        help="make a native project of an Automation Studio project",
        description="Write what runs of one configuration of an Automation Studio project into a "
        "new folder: plc.toml, programs, libraries, declarations, I/O. It runs without the "
        "Automation Studio project, whose files stay as they are. What is left out is told.",
        examples=(
            ("plcsim import-as machine my_plc", ""),
            ("plcsim import-as machine my_plc --config Simulation", "not the active configuration"),
        ),
        epilog=epilog(DONE="", FAILED="the folder is there, or nothing of the project runs"),
    )
    parser.add_argument(
        "project", type=Path, metavar="AS_PROJECT", help="folder of an Automation Studio project"
    )
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="folder to make")
    add_configuration(parser)
    parser.set_defaults(func=import_as)


def import_as(options: argparse.Namespace) -> int:
    """Write the project, and load it once: what does not run there is told here."""
    written = write_native(read_project(options.project, configuration_of(options)), options.folder)
    console = CommandConsole()
    for text in written.left_out:
        console.print(text, soft_wrap=True)
    try:
        application = load(read_project(options.folder))
        tasks = len(still_controller(application).tasks)
        application.unload()
    except ConfigurationError as err:
        for finding in err.findings:
            print_error(finding)
        print_error(f"{options.folder}: was written, and does not run as it is")
        return ExitCode.FAILED
    console.print(
        f"{options.folder}: {tasks} task{'s' * (tasks != 1)}, {written.files} files; "
        f"next: plcsim check {options.folder}",
        soft_wrap=True,
    )
    return ExitCode.DONE
