"""``plcsim set``, ``force`` and ``release``: tags of a running project, written from outside."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.table import Table

from plcsim.cli.console import CommandConsole
from plcsim.cli.exit_codes import epilog
from plcsim.cli.project_argument import add_project_and_tags, project_and_tags
from plcsim.cli.running import ask, find_running, open_as_guest, open_image
from plcsim.core.errors import ConfigurationError, TagError
from plcsim.shared_image import ForceCommand, Release, StoreCommand, Write
from st_types.errors import ValueRangeError
from st_types.resolve.value_text import value_from
from st_types.types.values import decode, encode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    import argparse

    from plcsim.core.tag import Tag
    from plcsim.process.run_file import Run
    from plcsim.shared_image import ImageReader

_VALUES = (
    "VALUE is written as in Structured Text: TRUE, -7, 16#FF, 1.5, T#1m30s, a name of an "
    "enumeration, [1, 2, 3], (x := 1, y := 2). Put -- before a VALUE that looks like an option."
)
_EPILOG = epilog(
    DONE="", FAILED="the project does not run, has no such tag, or the value does not fit"
)


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the commands."""
    parser = subparsers.add_parser(
        "set",
        help="write a tag of a running project",
        description=f"Write a tag of a project that runs, once. {_VALUES}",
        examples=(
            ("plcsim set my_plc tank.setpoint 6.5", "before the next cycle; prints old and new"),
            ("plcsim set tank.mode AUTO", "inside the project's folder"),
        ),
        epilog=_EPILOG,
    )
    add_project_and_tags(parser, "TAG and VALUE")
    parser.set_defaults(func=set_tag)
    parser = subparsers.add_parser(
        "force",
        help="keep a tag of a running project at a value, or list those that are",
        description="Keep a tag of a project that runs at a value, whatever inputs and programs "
        f"do, until it is released; without TAG list the forced tags. {_VALUES}",
        examples=(
            ("plcsim force my_plc tank.valve TRUE", "until it is released"),
            ("plcsim force my_plc", "list what is forced, and by whom"),
        ),
        epilog=_EPILOG,
    )
    add_project_and_tags(parser, "TAG and VALUE")
    parser.set_defaults(func=force)
    parser = subparsers.add_parser(
        "release",
        help="let forced tags of a running project go",
        description="Let forced tags go: they keep their value until somebody writes them.",
        examples=(
            ("plcsim release my_plc tank.valve", "one tag"),
            ("plcsim release my_plc --all", "all that are forced, by whomever"),
        ),
        epilog=_EPILOG,
    )
    add_project_and_tags(parser, "such as tank.valve")
    parser.add_argument("--all", action="store_true", help="all forced tags")
    parser.set_defaults(func=release)


def _tag_and_value(reader: ImageReader, words: list[str]) -> tuple[Tag, bytes]:
    if len(words) != 2:
        raise ConfigurationError("a TAG and a VALUE are needed, such as tank.setpoint 6.5")
    path, text = words
    tag = reader.directory.find(path)
    try:
        return tag, encode(tag.data_type, value_from(tag.data_type, text))
    except ValueRangeError as err:
        raise TagError(f"{path}: {err}") from None


def _text(tag: Tag, data: bytes) -> str:
    return value_text(tag.data_type, decode(tag.data_type, data))


def set_tag(options: argparse.Namespace) -> int:
    """Write a tag."""
    project, words = project_and_tags(options)
    run = find_running(project)
    with open_as_guest(run) as reader:
        tag, data = _tag_and_value(reader, words)
        write = Write((StoreCommand(tag.address, data),))
        answer = ask(run, reader, write, f"set {tag.path}")
        forced = _forces_at(reader, tag)
        print(f"{tag.path}: {_text(tag, _before(answer.before, data))} -> {_text(tag, data)}")
        if forced:
            print(f"but {', '.join(forced)} is forced; release it first")
    return 0


def _before(command: object, data: bytes) -> bytes:
    """Return what was there before, from the answer to a write of one store."""
    if isinstance(command, Write) and isinstance(command.operations[0], StoreCommand):
        return command.operations[0].data
    return data


def _forces_at(reader: ImageReader, tag: Tag) -> list[str]:
    """Return the forced tags that lie where a tag lies."""
    end = tag.address + tag.data_type.size
    return [
        force.path
        for force in reader.forces()
        if force.address < end and tag.address < force.address + len(force.data)
    ]


def force(options: argparse.Namespace) -> int:
    """Force a tag, or list what is forced."""
    project, words = project_and_tags(options)
    run = find_running(project)
    if not words:
        return _list_forces(run)
    with open_as_guest(run) as reader:
        tag, data = _tag_and_value(reader, words)
        ask(run, reader, ForceCommand(tag.path, data), f"force {tag.path}")
        print(f"{tag.path} is forced to {_text(tag, data)}; plcsim release lets it go")
    return 0


def _list_forces(run: Run) -> int:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column("forced tag", no_wrap=True)
    table.add_column("value", justify="right")
    table.add_column("by")
    with open_image(run) as reader:
        forces = reader.forces()
        for one in forces:
            table.add_row(one.path, _text(reader.directory.find(one.path), one.data), one.source)
    if forces:
        CommandConsole().print(table)
    else:
        print("no tag is forced")
    return 0


def release(options: argparse.Namespace) -> int:
    """Let forced tags go."""
    project, words = project_and_tags(options)
    run = find_running(project)
    if options.all == bool(words):
        raise ConfigurationError("name the tags to release, or give --all")
    with open_as_guest(run) as reader:
        for path in words or [""]:
            if path:
                reader.directory.find(path)
            ask(run, reader, Release(path), f"release {path or 'all'}")
    return 0
