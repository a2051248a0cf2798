"""``plcsim tags``: the Modbus map of a project."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from rich.table import Table

from plcsim.cli.console import CommandConsole
from plcsim.cli.exit_codes import epilog
from plcsim.cli.output_file import check_output, write_output
from plcsim.cli.project_argument import add_project
from plcsim.core.errors import ConfigurationError
from plcsim.modbus.export import FORMATS
from plcsim.modbus.export.entry import ExportEntry, MapExport
from plcsim.modbus.map.automatic import LOCK_FILE, write_lock
from plcsim.modbus.map.load import TagMap, load_map
from plcsim.project.assembly import load, still_controller
from plcsim.project.plc_toml import read_project
from plcsim.project.project_file import find_project

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

    from plcsim.modbus.settings import ModbusSettings

EXTENSION = "modbus"

EXAMPLES = {
    "check": (("plcsim tags check my_plc", ""),),
    "list": (("plcsim tags list my_plc", ""), ("plcsim tags list", "inside the project's folder")),
    "lock": (("plcsim tags lock my_plc", "addresses that will not change any more"),),
    "export": (
        ("plcsim tags export my_plc", "as CSV"),
        ("plcsim tags export my_plc --format json -o tags.json", ""),
    ),
}

EXITS = epilog(DONE="", FAILED="the project or its map is wrong")


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command and its own commands."""
    tags = subparsers.add_parser(
        "tags",
        help="check, list and export the Modbus map of a project",
        description="The Modbus map of a project: tags.csv, automatic addresses, or both.",
        epilog=EXITS,
    )
    commands = tags.add_subparsers(title="commands", metavar="COMMAND", required=True)
    _add(commands, "check", check, "say whether the map fits the programs")
    _add(commands, "list", list_tags, "print every tag with its addresses")
    _add(commands, "lock", lock, f"write the automatic addresses to {LOCK_FILE}")
    parser = _add(commands, "export", export, "print the map for another tool")
    parser.add_argument("--format", choices=list(FORMATS), default="csv")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="instead of stdout")


def _add(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    function: Callable[[argparse.Namespace], int],
    text: str,
) -> argparse.ArgumentParser:
    parser = commands.add_parser(
        name,
        help=text,
        description=f"{text[0].upper()}{text[1:]}.",
        examples=EXAMPLES[name],
        epilog=EXITS,
    )
    add_project(parser)
    parser.set_defaults(func=function)
    return parser


def _load(folder: Path) -> tuple[str, ModbusSettings, TagMap]:
    """Return name, settings and map of a project; no unit of any program runs."""
    project = read_project(folder)
    found = project.extensions.get(EXTENSION)
    if found is None:
        raise ConfigurationError(f"{project.folder / 'plc.toml'}: there is no table [modbus]")
    controller = still_controller(load(project))
    tag_map = load_map(found.settings, found.folder, controller.tags, controller.areas)
    return project.name, found.settings, tag_map


def check(options: argparse.Namespace) -> int:
    """Print how many tags lie in each area, and whether the lock file is up to date."""
    name, _, tag_map = _load(options.project)
    counts: dict[str, int] = {}
    for point in tag_map.points:
        counts[point.area] = counts.get(point.area, 0) + 1
    areas = ", ".join(f"{area} {count}" for area, count in sorted(counts.items()))
    print(f"{name}: {len(tag_map.points)} tags{f' ({areas})' if areas else ''}")
    if not tag_map.is_locked:
        print(f"{LOCK_FILE} lacks some addresses; plcsim tags lock or plcsim run writes them")
    return 0


def lock(options: argparse.Namespace) -> int:
    """Write the lock file where it lacks addresses."""
    folder = find_project(options.project).parent
    _, settings, tag_map = _load(folder)
    if not settings.auto:
        raise ConfigurationError("modbus.auto: is not true, so there is nothing to lock")
    if not tag_map.is_locked:
        write_lock(folder, tag_map.lock)
    print(f"{folder / LOCK_FILE}: {len(tag_map.lock)} addresses")
    return 0


def list_tags(options: argparse.Namespace) -> int:
    """Print a table."""
    _, _, tag_map = _load(options.project)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for column in ("tag", "area", "offset", "Modicon", "type", "order", "access", "unit"):
        table.add_column(column, no_wrap=column == "tag")
    for entry in _entries(tag_map):
        point = entry.point
        offset = f"{point.offset}.{point.bit}" if point.bit >= 0 else str(point.offset)
        order = point.order if point.registers > 1 else ""
        table.add_row(
            point.tag, point.area, offset, entry.modicon6, entry.type, order, point.access,
            entry.row.unit,
        )  # fmt: skip
    CommandConsole().print(table)
    return 0


def _entries(tag_map: TagMap) -> list[ExportEntry]:
    return [
        ExportEntry(row, point) for row, point in zip(tag_map.rows, tag_map.points, strict=True)
    ]


def export(options: argparse.Namespace) -> int:
    """Print the map, or write it to a file."""
    check_output("--output", options.output)
    name, settings, tag_map = _load(options.project)
    text = FORMATS[options.format](MapExport(name, settings.host, settings.port, _entries(tag_map)))
    if options.output is None:
        sys.stdout.write(text)
    else:
        write_output("--output", options.output, text)
    return 0
