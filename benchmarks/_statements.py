"""A project whose program runs a number of statements, in the scan and then in bare loops."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

_GROUP = (
    "self.count_{n} += 1",
    "self.level_{n} = self.level_{n} + self.rate_{n}",
    "self.full_{n} = self.level_{n} > 100.0",
    "if self.full_{n}: self.level_{n} = 0.0",
    "self.step_{n} = (self.step_{n} + 3) & 0x7F",
)
"""Five statements on five variables: a counter, a ramp, a comparison, a reset, a step."""

_VARIABLES = {
    "count": ("UDINT", "0"),
    "level": ("REAL", "0.0"),
    "rate": ("REAL", "0.25"),
    "full": ("BOOL", "False"),
    "step": ("INT", "0"),
}

_PROJECT = """\
[task_class.1]
cycle = "1ms"
programs = ["statements"]
"""

_PROGRAM = """\
import json
import time
from types import SimpleNamespace

from plcsim import Program
from st_types import BOOL, INT, REAL, UDINT, var

start_ns = time.perf_counter_ns()


def bare_loop(self, turns):
    start_ns = time.perf_counter_ns()
    for _ in range(turns):
        {loop}
    return (time.perf_counter_ns() - start_ns) / turns


class Statements(Program):
    {declarations}

    def init(self):
        global start_ns
        start_ns = time.perf_counter_ns()

    def cyclic(self):
        {cyclic}

    def exit(self):
        scans_ns = time.perf_counter_ns() - start_ns
        attributes = SimpleNamespace({attributes})
        print(json.dumps({{
            "scan_ns": scans_ns / {cycles},
            "on_views_ns": bare_loop(self, {cycles}),
            "on_attributes_ns": bare_loop(attributes, {cycles}),
        }}))
"""


def write_statements(folder: Path, statements: int, cycles: int) -> Path:
    """Write the project to be run for ``cycles`` cycles; return its folder.

    In EXIT the program prints the wall time in ns of one scan, of one turn of a bare loop on the
    program's own typed views, and of one on plain attributes.

    Args:
        folder: made where it is missing.
        statements: a multiple of five.
        cycles: scans, and turns of each bare loop.
    """
    groups = range(statements // len(_GROUP))
    names = [(f"{name}_{n}", *kind) for n in groups for name, kind in _VARIABLES.items()]
    lines = [line.format(n=n) for n in groups for line in _GROUP] or ["pass"]
    text = _PROGRAM.format(
        loop="\n        ".join(lines),
        declarations="\n    ".join(f"{name} = var({kind}, {x})" for name, kind, x in names),
        cyclic="\n        ".join(lines),
        attributes=", ".join(f"{name}={x}" for name, _, x in names),
        cycles=cycles,
    )
    program = folder / "statements" / "main.py"
    program.parent.mkdir(parents=True, exist_ok=True)
    program.write_text(text, "utf-8")
    (folder / "plc.toml").write_text(_PROJECT, "utf-8")
    return folder
