"""What both benchmarks share: the machine beside the figures, targets met or not, the JSON file."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any, NamedTuple

from rich.console import Console
from rich.table import Table

from plcsim.doctor.host import Host, read_host

if TYPE_CHECKING:
    from pathlib import Path

console = Console(highlight=False)
if not console.is_terminal:
    console.width = 120


class Target(NamedTuple):
    """A figure to reach.

    Attributes:
        name: what is measured.
        value: what it came to.
        limit: what is asked for.
        unit: of both.
        at_least: the value must reach the limit; otherwise it must not exceed it.
    """

    name: str
    value: float
    limit: float
    unit: str
    at_least: bool = False

    @property
    def met(self) -> bool:
        return self.value >= self.limit if self.at_least else self.value <= self.limit


def number_above_0(text: str) -> int:
    """Return an argument of the command line as a whole number above 0."""
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number above 0")
    return int(text)


def print_machine(when: str) -> Host:
    """Print and return the state of the machine, before or after."""
    host = read_host()
    console.print(
        f"{when}: {host.cpus} x {host.cpu_model}, load {host.load:.2f}, {host.kernel} "
        f"{host.preemption}, {host.python}",
        soft_wrap=True,
    )
    return host


def figures_table(*columns: str) -> Table:
    """Return an empty table: the first column for names, the others for numbers."""
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for place, column in enumerate(columns):
        table.add_column(column, justify="right" if place else "left", no_wrap=True)
    return table


def print_targets(targets: list[Target]) -> None:
    """Print each target with what came out, and whether it is met."""
    table = figures_table("target", "asked", "got", "")
    for t in targets:
        asked = f"{'>=' if t.at_least else '<='} {t.limit:,g} {t.unit}"
        got = f"{t.value:,.0f} {t.unit}" if t.value >= 1000 else f"{t.value:.3g} {t.unit}"
        table.add_row(t.name, asked, got, "met" if t.met else "NOT MET")
    console.print()
    console.print(table)


def write_json(file: Path | None, hosts: list[Host], targets: list[Target], **figures: Any) -> None:
    """Write everything to a file, where one was asked for."""
    if file is not None:
        result = {
            "machine": [asdict(host) for host in hosts],
            "targets": [{**t._asdict(), "met": t.met} for t in targets],
            **figures,
        }
        file.write_text(json.dumps(result, indent=2) + "\n", "utf-8")
