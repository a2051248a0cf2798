"""``plcsim retain``: what the files of retained variables hold."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.table import Table

from plcsim.cli.console import CommandConsole, print_error
from plcsim.cli.exit_codes import ExitCode, epilog
from plcsim.cli.output_file import check_output, write_output
from plcsim.cli.project_argument import HELP as PROJECT_HELP
from plcsim.cli.project_argument import add_project, own_project
from plcsim.core.errors import ConfigurationError
from plcsim.core.tag import encode_tag, leaves
from plcsim.core.text import escaped
from plcsim.project.assembly import load, still_controller
from plcsim.project.plc_toml import read_project
from plcsim.retain.errors import RetainError
from plcsim.retain.fitting import fit
from plcsim.retain.generations import Generation, Generations, decode, describe
from st_types.types.values import decode as value_of

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Iterator, Sequence

    from plcsim.core.tag import Tag
    from plcsim.retain.settings import RetainProject

EXITS = epilog(DONE="", FAILED="the project or a file is wrong, or the controller runs")


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command and its own commands."""
    retain = subparsers.add_parser(
        "retain",
        help="show, clear, export or import what retained variables keep",
        description="The values that VAR RETAIN and permanent variables of a project have when it "
        "starts next, from the files of its table [retain].",
        epilog=EXITS,
    )
    commands = retain.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, func, text in (
        ("show", _show, "print the values"),
        ("export", _export, "write the values as JSON"),
    ):
        parser = _add(commands, name, func, text, ((f"plcsim retain {name} my_plc", ""),))
        add_project(parser)
        parser.add_argument("--file", type=Path, metavar="FILE", help="one of the files instead")
        if name == "export":
            parser.add_argument("-o", "--output", type=Path, metavar="OUT", help="not to stdout")
    clear = _add(
        commands,
        "clear",
        _clear,
        "forget the values; a cold start does so too",
        (("plcsim retain clear my_plc", ""),),
    )
    add_project(clear)
    given = _add(
        commands,
        "import",
        _import,
        "take values from JSON; variables that are not named keep theirs",
        (("plcsim retain import values.json my_plc", ""),),
    )
    given.add_argument("values", type=Path, metavar="JSON", help="as `plcsim retain export` has it")
    given.add_argument("project", type=Path, nargs="?", default=own_project(), help=PROJECT_HELP)


def _add(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    func: Callable[[argparse.Namespace], int],
    text: str,
    examples: Sequence[tuple[str, str]],
) -> argparse.ArgumentParser:
    parser = commands.add_parser(
        name, help=text, description=f"{text.capitalize()}.", examples=examples, epilog=EXITS
    )
    parser.set_defaults(func=func)
    return parser


def _settings(folder: Path) -> RetainProject:
    project = read_project(folder)
    settings: RetainProject | None = project.extensions.get("retain")
    if settings is None:
        raise ConfigurationError(
            f"{project.folder}: the project has no table [retain]: its retained variables are kept "
            "over a warm restart only"
        )
    return settings


def _generation(options: argparse.Namespace) -> Generation:
    """Return what is to be shown."""
    if options.file is not None:
        return _read(options.file)
    generations = Generations(_settings(options.project).folder)
    latest, wrong = generations.latest()
    for line in wrong:
        print_error(line)
    if latest is None:
        raise RetainError(f"{generations.folder}: nothing is kept yet")
    return latest


def _read(file: Path) -> Generation:
    try:
        return decode(file.read_bytes())
    except OSError as err:
        raise RetainError(f"{file}: cannot be read: {err.strerror}") from None
    except ValueError as err:
        raise RetainError(f"{file}: {err}") from None


def _values(generation: Generation) -> Iterator[tuple[Tag, Any]]:
    for variable in generation.variables:
        for leaf in leaves(variable):
            data = generation.data[leaf.address : leaf.address + leaf.data_type.size]
            yield leaf, value_of(leaf.data_type, data)


def _show(options: argparse.Namespace) -> int:
    generation = _generation(options)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for column in ("variable", "type", "value"):
        table.add_column(column)
    for leaf, value in _values(generation):
        table.add_row(leaf.path, str(leaf.data_type), escaped(str(value)))
    console = CommandConsole()
    console.print(table)
    console.print(f"generation {generation.number}, {len(generation.data)} bytes")
    return ExitCode.DONE


def _export(options: argparse.Namespace) -> int:
    check_output("--output", options.output)
    values = {leaf.path: value for leaf, value in _values(_generation(options))}
    text = json.dumps(values, indent=1, ensure_ascii=False) + "\n"
    if options.output is None:
        sys.stdout.write(text)
    else:
        write_output("--output", options.output, text)
    return ExitCode.DONE


def _clear(options: argparse.Namespace) -> int:
    generations = Generations(_settings(options.project).folder)
    with generations.locked():
        generations.clear()
    return ExitCode.DONE


def _import(options: argparse.Namespace) -> int:
    given = _given(options.values)
    project = read_project(options.project)
    generations = Generations(_settings(options.project).folder)
    controller = still_controller(load(project))
    memory, tags = controller.memory, controller.retained.tags
    with generations.locked():
        latest, _ = generations.latest()
        for address, data in fit(latest, tags).taken if latest is not None else ():
            memory.write(address, data)
        places = {leaf.path: leaf for tag in tags for leaf in leaves(tag)}
        left = [name for name in given if name not in places]
        for name in given.keys() & places.keys():
            memory.write(places[name].address, encode_tag(places[name], given[name]))
        data = b"".join(memory.read(tag.address, tag.data_type.size) for tag in tags)
        generations.write(describe(tags), data)
    for name in left:
        print_error(f"{options.values}: {name}: there is no such retained variable")
    print(f"{len(given) - len(left)} values taken")  # noqa: T201  # what the command tells
    return ExitCode.FAILED if left else ExitCode.DONE


def _given(file: Path) -> dict[str, Any]:
    try:
        found = json.loads(file.read_text("utf-8"))
    except OSError as err:
        raise RetainError(f"{file}: cannot be read: {err.strerror}") from None
    except ValueError as err:
        raise RetainError(f"{file}: {err}") from None
    if not isinstance(found, dict):
        raise RetainError(f"{file}: an object of names and values was expected")
    return found
