"""``plcsim check PROJECT``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.table import Table

from plcsim.cli.console import CommandConsole, print_error
from plcsim.cli.exit_codes import ExitCode, epilog
from plcsim.cli.project_argument import add_configuration, add_project, configuration_of
from plcsim.cli.survey import show
from plcsim.core.duration import format_duration
from plcsim.core.tag import leaves
from plcsim.host.processors import missing_cpu
from plcsim.project.assembly import load, still_controller
from plcsim.project.automation_studio.io_channels import unmapped
from plcsim.project.extension import check_settings
from plcsim.project.plc_toml import read_project
from plcsim.project.survey import survey
from st_types.syntax.collector import collector_paused

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterable

    from plcsim.core.tag import Tag
    from plcsim.core.task import TaskClass
    from plcsim.project.plc_toml import Project


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "check",
        help="check a project without running it",
        description="Load a project, lay out its memory, check what it maps and names, and show "
        "what would run. No unit of any program runs.",
        examples=(
            ("plcsim check my_plc", ""),
            ("plcsim check", "the project that this folder belongs to"),
            ("plcsim check machine --config Simulation", "an Automation Studio project"),
        ),
        epilog=epilog(DONE="the project is right", FAILED="it is not"),
    )
    add_project(parser)
    add_configuration(parser)
    parser.add_argument(
        "--all",
        action="store_true",
        help="of an Automation Studio project, show every finding and every warning",
    )
    parser.set_defaults(func=check)


@collector_paused()
def check(options: argparse.Namespace) -> int:
    """Check the project and print what it consists of."""
    project = read_project(options.project, configuration_of(options))
    if project.automation_studio is not None:
        found = survey(project, project.automation_studio)
        console = CommandConsole()
        show(console, project.automation_studio, found, everything=options.all)
        _show_notes(console, [*found.notes, *notes_on_cpu(project)])
        return ExitCode.DONE if found.is_right else ExitCode.FAILED
    application = load(project)
    controller = still_controller(application)
    notes = [*check_settings(project.extensions, controller), *notes_on_cpu(project)]
    console = CommandConsole()
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for column in ("class", "cycle", "tolerance", "program", "address", "bytes", "tags"):
        table.add_column(column, justify="left" if column == "program" else "right")
    for area in controller.areas:
        if not area.path:
            what = "global constants" if area.is_constant else "global variables"
            table.add_row("", "", "", what, *_figures(area))
    for task_class in controller.classes:
        _add_rows(table, task_class)
    console.print(table)
    count = len(controller.tasks)
    console.print(
        f"{project.name}: {count} program{'s' * (count != 1)}, {controller.memory.used} of "
        f"{controller.memory.size} bytes of PLC memory used, tick "
        f"{format_duration(project.plc.tick_ns)}"
    )
    for warning in application.warnings:
        print_error(warning)
    for warning in unmapped(controller, application.maps):
        print_error(warning)
    _show_notes(console, notes)
    return 0


def _show_notes(console: CommandConsole, notes: Iterable[str]) -> None:
    for note in notes:
        console.print(f"on this host: {note}", soft_wrap=True)


def notes_on_cpu(project: Project) -> list[str]:
    """Return what this host makes of ``plc.cpu``, where that is not what was asked for."""
    missing = "" if project.plc.realtime == "off" else missing_cpu(project.plc.pinned_cpu)
    return [f"plc.cpu: {missing}"] if missing else []


def _add_rows(table: Table, task_class: TaskClass) -> None:
    for task in task_class.tasks:
        table.add_row(
            f"#{task_class.number}",
            format_duration(task_class.cycle_ns),
            format_duration(task_class.tolerance_ns),
            task.name,
            *_figures(task.variables),
        )


def _figures(area: Tag) -> tuple[str, str, str]:
    """Return address, bytes and number of the variables of one area."""
    tags = sum(1 for _ in leaves(area, elements=False))
    return f"16#{area.address:08X}", str(area.data_type.size), str(tags)
