"""``plcsim watch PROJECT [TAG...]``: live values of a running project."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from rich.live import Live
from rich.table import Table

from plcsim.cli.console import CommandConsole
from plcsim.cli.exit_codes import epilog
from plcsim.cli.project_argument import add_project_and_tags, project_and_tags
from plcsim.cli.running import PATIENCE_S, find_running, open_as_guest, open_image
from plcsim.cli.tag_values import TagValues
from plcsim.core.tag import Tag, leaves
from st_types.types.values import decode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator, Sequence

    from rich.console import Console

    from plcsim.process.run_file import Run
    from plcsim.shared_image import ImageReader

PERIOD_S = 0.2


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
    run = find_running(project)
    with open_image(run) as reader:
        tags = list(_chosen(reader, paths))
        published = all(map(reader.directory.holds, tags))
    with open_image(run) if published else open_as_guest(run) as reader:
        values = TagValues(reader, tags)
        console = CommandConsole()
        if options.once or not console.is_terminal:
            values.await_all(PATIENCE_S)
            console.print(_table(values))
        else:
            _show(console, run, values)
    return 0


def _chosen(reader: ImageReader, paths: Sequence[str]) -> Iterator[Tag]:
    """Iterate over the tags to show: those named, or all below a STRUCT or a program.

    The internal variables of a function block are shown where they are named.
    """
    for tag in map(reader.directory.find, paths) if paths else reader.directory.areas:
        yield from leaves(tag, internals=False)


def _show(console: Console, run: Run, values: TagValues) -> None:
    """Draw the values anew until Ctrl-C, or until the run ends."""
    try:
        with Live(console=console, auto_refresh=False) as live:
            while run.is_alive:
                live.update(_table(values), refresh=True)
                time.sleep(PERIOD_S)
    except KeyboardInterrupt:
        return
    console.print("The run has ended.")


def _table(values: TagValues) -> Table:
    """Return the present values; those of forced tags are marked."""
    snapshot, rows = values.read()
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(f"tag (snapshot {snapshot})", no_wrap=True)
    table.add_column("value", justify="right")
    table.add_column("type")
    for tag, data, is_forced in rows:
        text = "..." if data is None else _shown(tag, data)
        if is_forced:
            table.add_row(tag.path, f"{text} forced", str(tag.data_type), style="bold yellow")
        else:
            table.add_row(tag.path, text, str(tag.data_type))
    return table


def _shown(tag: Tag, data: bytes) -> str:
    value = decode(tag.data_type, data)
    return f"{value:.6g}" if isinstance(value, float) else value_text(tag.data_type, value)
