"""``plcsim watch PROJECT [TAG...]``: live values of a running project."""

from __future__ import annotations

import os
import sys
import time
from typing import TYPE_CHECKING

from rich.live import Live
from rich.table import Table

from plcsim.cli.console import CommandConsole
from plcsim.cli.exit_codes import epilog
from plcsim.cli.project_argument import add_project_and_tags, project_and_tags
from plcsim.core.errors import ConfigurationError
from plcsim.core.tag import Tag, leaves
from plcsim.process.run_file import Run, find_runs
from plcsim.project.plc_toml import find_project
from plcsim.shared_image import ImageError, ImageNotReady, ImageReader
from st_types.types.derived import ArrayType, EnumerationType, StructType
from st_types.types.values import decode

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator, Sequence

    from rich.console import Console

PERIOD_S = 0.2
PATIENCE_S = 5.0
"""A project that has just been started may take so long until it publishes."""


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command."""
    parser = subparsers.add_parser(
        "watch",
        help="show live values of a running project",
        description="Show values of a project that runs elsewhere, until Ctrl-C. A TAG is a "
        "program, a variable or a part of one; all are shown where none is given. The scan does "
        "not notice.",
        examples=(
            ("plcsim watch my_plc", "all variables, anew five times a second"),
            ("plcsim watch my_plc tank.level control", "a tag, and all variables of a program"),
            ("plcsim watch tank.level --once", "inside the project's folder; print it and end"),
        ),
        epilog=epilog(DONE="", FAILED="the project does not run, or has no such tag"),
    )
    add_project_and_tags(parser, "such as tank.level")
    parser.add_argument("--once", action="store_true", help="print the values once and end")
    parser.set_defaults(func=watch)


def watch(options: argparse.Namespace) -> int:
    """Show the values."""
    project, paths = project_and_tags(options)
    run, *others = find_runs(find_project(project).parent)
    if others:
        pids = ", ".join(str(other.pid) for other in others)
        print(
            f"{len(others) + 1} runs of this project; this is the one that was started last, "
            f"process {run.pid}; others: {pids}",
            file=sys.stderr,
        )
    fd = run.open(run.image_fd)
    try:
        reader = _open(fd)
        tags = list(_chosen(reader, paths))
        console = CommandConsole()
        if options.once or not console.is_terminal:
            console.print(_table(reader, tags))
        else:
            _show(console, run, reader, tags)
    finally:
        os.close(fd)
    return 0


def _open(fd: int) -> ImageReader:
    """Return the image; the scan process may still be loading the project."""
    deadline = time.monotonic() + PATIENCE_S
    while True:
        try:
            reader = ImageReader(fd)
            reader.copy(0, 0)
        except ImageNotReady:
            if time.monotonic() > deadline:
                raise
            time.sleep(PERIOD_S / 10)
        else:
            return reader


def _chosen(reader: ImageReader, paths: Sequence[str]) -> Iterator[Tag]:
    """Iterate over the tags to show: those named, or all below a STRUCT or a program."""
    for path in paths or [area.path for area in reader.directory.areas]:
        tag = reader.directory.find(path)
        for leaf in leaves(path, tag.data_type, tag.address):
            whole = isinstance(tag.data_type, StructType | ArrayType)
            try:
                reader.directory.place_of(leaf.address, leaf.data_type.size)
            except ImageError:
                if whole:
                    continue
                raise ConfigurationError(
                    f"{path} is not published: of a project with many variables only those in "
                    "tags.csv are"
                ) from None
            yield leaf


def _show(console: Console, run: Run, reader: ImageReader, tags: Sequence[Tag]) -> None:
    """Draw the values anew until Ctrl-C, or until the run ends."""
    try:
        with Live(console=console, auto_refresh=False) as live:
            while run.is_alive:
                live.update(_table(reader, tags), refresh=True)
                time.sleep(PERIOD_S)
    except KeyboardInterrupt:
        return
    console.print("The run has ended.")


def _table(reader: ImageReader, tags: Sequence[Tag]) -> Table:
    """Return the values of one snapshot."""
    number, snapshot = reader.copy(0, reader.directory.bank_size)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(f"tag (snapshot {number})", no_wrap=True)
    table.add_column("value", justify="right")
    table.add_column("type")
    for tag in tags:
        place = reader.directory.place_of(tag.address, tag.data_type.size)
        value = decode(tag.data_type, snapshot[place : place + tag.data_type.size])
        table.add_row(tag.path, _shown(tag, value), str(tag.data_type))
    return table


def _shown(tag: Tag, value: object) -> str:
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, str):
        return repr(value)
    if isinstance(tag.data_type, EnumerationType):
        names = {number: name for name, number in tag.data_type.values.items()}
        return names.get(int(str(value)), str(value))
    return str(value)
