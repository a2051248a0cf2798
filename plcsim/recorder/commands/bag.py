"""``plcsim bag``."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

from rich.table import Table

from plcsim.cli.console import CommandConsole
from plcsim.cli.exit_codes import ExitCode
from plcsim.cli.output_file import check_output, write_output
from plcsim.core.duration import format_duration
from plcsim.recorder.bag.difference import difference
from plcsim.recorder.bag.names import ACTIVE
from plcsim.recorder.bag.parquet import write_parquet
from plcsim.recorder.bag.plot import draw, page
from plcsim.recorder.bag.plot_png import draw_png
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.reindex import reindex as recover
from plcsim.recorder.bag.series import columns_of, rows_of, series_of
from plcsim.recorder.bag.types import CYCLES, HEAD
from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator
    from pathlib import Path

    from plcsim.recorder.journal.record import JournalRecord


def info(options: argparse.Namespace) -> int:
    """Print what a bag holds."""
    console = CommandConsole()
    with open_bag(options.bag) as bag:
        names = {topic.name for topic in bag.topics}
        console.print(f"{bag.path}: {format_duration(bag.end_ns - bag.start_ns)}", soft_wrap=True)
        if HEAD in names:
            head = bag.head()
            clock = "virtual clock" if head.is_virtual else "real clock"
            classes = ", ".join(f"#{n} every {format_duration(ns)}" for n, ns in head.classes)
            console.print(f"project {head.project}, {clock}, task classes {classes}")
        if CYCLES in names:
            console.print(_records(bag.records()))
        table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
        table.add_column("topic")
        table.add_column("type")
        table.add_column("messages", justify="right")
        for topic in bag.topics:
            table.add_row(topic.name, topic.type_name.replace("/msg/", "/"), str(topic.messages))
        console.print(table)
    return ExitCode.DONE


def _records(records: Iterator[tuple[int, JournalRecord]]) -> str:
    """Return how many records there are, and how many were lost."""
    count, last = 0, -1
    for number, _ in records:
        count, last = count + 1, number
    lost = last + 1 - count
    return f"{count} records of cycles and steps, {lost or 'none'} lost"


def plot(options: argparse.Namespace) -> int:
    """Draw tags over time."""
    check_output("--output", options.output)
    form = options.output.suffix
    if form not in (".png", ".svg", ".html"):
        raise RecordingError(f"{options.output}: a picture ends in .png, .svg or .html")
    with open_bag(options.bag) as bag:
        head = bag.head()
        found = series_of(head, bag.records(), options.tags)
    title = f"{head.project}: {options.bag.name}"
    if form == ".png":
        write_output("--output", options.output, draw_png(found, title))
        return ExitCode.DONE
    picture = draw(found, title)
    write_output("--output", options.output, page(picture, title) if form == ".html" else picture)
    return ExitCode.DONE


def export(options: argparse.Namespace) -> int:
    """Write tags of every cycle as CSV or Parquet."""
    if options.output is not None:
        check_output("--output", options.output)
        if options.output.suffix == ".parquet":
            with open_bag(options.bag) as bag:
                head = bag.head()
                rows = rows_of(head, bag.records(), options.tags)
                write_parquet(options.output, columns_of(head, options.tags), rows)
            return ExitCode.DONE
    text = io.StringIO()
    with open_bag(options.bag) as bag:
        csv.writer(text, lineterminator="\n").writerows(
            rows_of(bag.head(), bag.records(), options.tags)
        )
    if options.output is None:
        print(text.getvalue(), end="")
    else:
        write_output("--output", options.output, text.getvalue())
    return ExitCode.DONE


def reindex(options: argparse.Namespace) -> int:
    """Copy what is complete in a bag that was not closed."""
    source: Path = options.bag
    target: Path | None = options.output
    if target is None:
        if not source.name.endswith(ACTIVE):
            raise RecordingError(f"{source}: say where to with --output; it stays as it is")
        target = source.with_name(source.name.removesuffix(ACTIVE))
    found = recover(source, target)
    left_out = f", {found.left_out} bytes of an incomplete chunk left out" if found.left_out else ""
    print(f"{target}: {found.messages} messages{left_out}")
    return ExitCode.DONE


def diff(options: argparse.Namespace) -> int:
    """Print where two recordings differ first."""
    with open_bag(options.first) as first, open_bag(options.second) as second:
        found = difference(first, second)
    print(found or "the recordings are the same")
    return ExitCode.DIFFERENT if found else ExitCode.DONE
