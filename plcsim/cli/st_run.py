"""``plcsim st run FILE``: some cycles of a file of Structured Text on the virtual clock."""

from __future__ import annotations

import csv
import io
import json
import sys
from typing import TYPE_CHECKING, Any

from rich.table import Table

from plcsim.cli.console import CommandConsole
from plcsim.cli.exit_codes import ExitCode
from plcsim.core.clock import VirtualClock
from plcsim.core.duration import format_duration, parse_duration_ns
from plcsim.core.errors import ConfigurationError, PlcError
from plcsim.core.suggestion import did_you_mean
from plcsim.core.system import State
from plcsim.network import VirtualNetwork
from plcsim.project.assembly import VIRTUAL_IP, assemble
from plcsim.project.structured_text_file import load_file
from st_types.errors import ValueRangeError
from st_types.resolve.value_text import value_from
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag

MOST_SHOWN = 200
"""Variables that are shown where none are named."""


def run(options: argparse.Namespace) -> int:
    """Run the file and print what was asked for."""
    cycle_ns = None if options.cycle is None else _duration(options.cycle)
    application = load_file(options.file, cycle_ns)
    for warning in application.warnings:
        print(warning, file=sys.stderr)
    clock = VirtualClock()
    network = VirtualNetwork(clock.now_ns).host(VIRTUAL_IP)
    controller = assemble(application, clock=clock, network=network)
    given = [_setting(controller, text) for text in options.set]
    traced = [_tag(controller, name) for text in options.trace for name in text.split(",")]
    controller.boot()
    for tag, value in given:
        controller.tags.write(tag, value)
    rows = _run(controller, options.cycles, traced)
    if not traced:
        _WRITERS[options.format](("variable", "value"), _final(controller))
    else:
        names = ("cycle", "time", *(tag.path for tag in traced))
        _WRITERS[options.format](names, rows)
    if controller.state is State.SERVICE:
        print(f"SERVICE: {controller.fault}", file=sys.stderr)
        return ExitCode.SERVICE
    return ExitCode.DONE


def _duration(text: str) -> int:
    try:
        return parse_duration_ns(text)
    except ValueError as err:
        raise ConfigurationError(f"--cycle {text}: {err}") from None


def _run(controller: Controller, cycles: int, traced: Sequence[Tag]) -> list[Sequence[str]]:
    """Run some cycles of the first task class; return a row for each."""
    rows: list[Sequence[str]] = []
    for number in range(1, cycles + 1):
        if controller.run(cycles=1) is not State.RUN:
            break
        time_ns = controller.clock.now_ns() - controller.origin_ns
        values = (_text(controller, tag) for tag in traced)
        rows.append((str(number), format_duration(time_ns), *values))
    return rows


def _text(controller: Controller, tag: Tag) -> str:
    return value_text(tag.data_type, controller.tags.read(tag))


def _final(controller: Controller) -> list[Sequence[str]]:
    tags = list(controller.tags)
    rows = [(tag.path, _text(controller, tag)) for tag in tags[:MOST_SHOWN]]
    if len(tags) > MOST_SHOWN:
        print(f"{len(tags) - MOST_SHOWN} more variables are not shown", file=sys.stderr)
    return [*rows]


def _tag(controller: Controller, name: str) -> Tag:
    """Return a variable; the name of a program may be left out."""
    names = [name, *(f"{task.name}.{name}" for task in controller.tasks)]
    found = next((tag for each in names if (tag := controller.tags.get(each))), None)
    if found is None:
        known = [tag.path.partition(".")[2] or tag.path for tag in controller.tags]
        raise PlcError(f"no variable is called {name}{did_you_mean(name, known)}")
    return found


def _setting(controller: Controller, text: str) -> tuple[Tag, Any]:
    name, sign, value = text.partition("=")
    if not sign:
        raise PlcError(f"--set {text}: NAME=VALUE was expected.")
    tag = _tag(controller, name.strip())
    try:
        return tag, value_from(tag.data_type, value)
    except ValueRangeError as err:
        raise PlcError(f"--set {text}: {err}") from None


def _table(names: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for name in names:
        table.add_column(name, justify="left" if name in ("variable", "value") else "right")
    for row in rows:
        table.add_row(*row)
    CommandConsole().print(table)


def _csv(names: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([names, *rows])
    print(text.getvalue(), end="")


def _json(names: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    print(json.dumps([dict(zip(names, row, strict=True)) for row in rows], indent=1))


_WRITERS: dict[str, Callable[[Sequence[str], Sequence[Sequence[str]]], None]] = {
    "table": _table,
    "csv": _csv,
    "json": _json,
}
