"""Three loops on the same absolute grid, each run in a fresh process and measured alike.

The bare C loop is the floor: what is late there is late by the host. The bare Python loop shows
what the interpreter adds. The scan loop is plcsim itself: ``plcsim run`` of a project with one
empty program. All latenesses go through one kind of histogram, so rounding is the same for all.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from plcsim.core.statistics import Histogram, Summary
from plcsim.doctor.errors import MeasurementError
from plcsim.doctor.host import read_cpu_ticks
from plcsim.host import processors, realtime
from plcsim.process.report import summary_of

if TYPE_CHECKING:
    from collections.abc import Sequence

PRIORITY = 50
"""SCHED_FIFO priority of a loop with rights; the default of plc.toml."""

FLOOR_SOURCE = Path(__file__).with_name("floor.c")

PROJECT = """\
[plc]
name = "empty"
tick = "{cycle_ns} ns"
realtime = "{realtime}"
priority = {priority}
cpu = {cpu}

[task_class.1]
cycle = "{cycle_ns} ns"
on_violation = "log"
programs = ["empty"]
"""

PROGRAM = """\
from plcsim import Program

class Empty(Program):
    def cyclic(self) -> None:
        pass
"""


class LoopOrder(NamedTuple):
    """What a loop is to do.

    Attributes:
        cycle_ns: distance of the grid points.
        cycles: how often to wake.
        realtime: with real-time rights; without them nothing but sharp timers is asked for.
    """

    cycle_ns: int
    cycles: int
    realtime: bool

    def arguments(self) -> list[str]:
        """Return the arguments of a bare loop: CYCLE_NS CYCLES PRIORITY CPU."""
        numbers = (self.cycle_ns, self.cycles, PRIORITY if self.realtime else 0, _cpu())
        return [str(number) for number in numbers]


class Figures(NamedTuple):
    """What a loop gives: grid points it missed, and how late it woke."""

    missed: int
    lateness: Summary


class Measurement(NamedTuple):
    """One run of one loop.

    Attributes:
        loop: name of the loop.
        order: what it was to do.
        missed: grid points that passed while it slept or worked.
        lateness: from the grid point to the wake-up.
        stolen_percent: share of the machine's CPU time that the hypervisor gave to others.
    """

    loop: str
    order: LoopOrder
    missed: int
    lateness: Summary
    stolen_percent: float

    def as_json(self) -> dict[str, Any]:
        """Return the measurement as JSON can hold it."""
        inner = {"order": self.order._asdict(), "lateness": self.lateness._asdict()}
        return {**self._asdict(), **inner}


class MeasuredLoop(Protocol):
    """A loop that can be measured."""

    @property
    def name(self) -> str:
        """What it is called in tables."""

    def run(self, order: LoopOrder) -> Figures:
        """Run it in a fresh process.

        Raises:
            MeasurementError: it could not be run.
        """


def measure(loop: MeasuredLoop, order: LoopOrder) -> Measurement:
    """Run a loop and note the time stolen meanwhile."""
    before = read_cpu_ticks()
    figures = loop.run(order)
    stolen_percent = read_cpu_ticks().stolen_percent_since(before)
    return Measurement(loop.name, order, figures.missed, figures.lateness, stolen_percent)


class CLoop:
    """The bare C loop.

    Args:
        binary: made by `compile_floor`.
    """

    name = "C"

    def __init__(self, binary: Path) -> None:
        self._binary = binary

    def run(self, order: LoopOrder) -> Figures:
        """Run it."""
        return _bare_figures(_bare_loop(self.name, [str(self._binary)], order))


class PythonLoop:
    """The bare Python loop."""

    name = "Python"

    def run(self, order: LoopOrder) -> Figures:
        """Run it."""
        return _bare_figures(_bare_loop(self.name, _module("plcsim.doctor.python_loop"), order))


class ScanLoop:
    """Plcsim's own loop: ``plcsim run`` of a project with one empty program.

    Args:
        folder: an empty folder for the project and its report.
    """

    name = "plcsim"

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def run(self, order: LoopOrder) -> Figures:
        """Run it."""
        project = write_project(self._folder / "empty", order)
        report = self._folder / "report.json"
        limits = ["--cycles", str(order.cycles), "--quiet", "--report", str(report)]
        _output(self.name, [*_module("plcsim.cli.main"), "run", str(project), *limits], order)
        result = json.loads(report.read_text("utf-8"))["task_classes"][0]
        lateness_ns = result["lateness_ns"]
        return Figures(result["missed_grid_points"], summary_of(lateness_ns))


def write_project(folder: Path, order: LoopOrder) -> Path:
    """Write a project with one empty program, or write it anew; return its folder."""
    program = folder / "empty" / "main.py"
    program.parent.mkdir(parents=True, exist_ok=True)
    program.write_text(PROGRAM, "utf-8")
    rights = "require" if order.realtime else "off"
    text = PROJECT.format(cycle_ns=order.cycle_ns, realtime=rights, priority=PRIORITY, cpu=_cpu())
    (folder / "plc.toml").write_text(text, "utf-8")
    return folder


def compile_floor(folder: Path, compilers: Sequence[str] = ("cc", "gcc", "clang")) -> Path | None:
    """Compile floor.c into ``folder``; return None where no C compiler can.

    Args:
        folder: for the program.
        compilers: tried in this order, after the one that the variable CC of the environment names.
    """
    binary = folder / "floor"
    for name in filter(None, (os.environ.get("CC"), *compilers)):
        compiler = shutil.which(name)
        if compiler is None:
            continue
        command = [compiler, "-O2", "-o", str(binary), str(FLOOR_SOURCE)]
        if subprocess.run(command, capture_output=True, check=False).returncode == 0:  # noqa: S603  # a compiler
            return binary
    return None


def floor_loop(folder: Path) -> MeasuredLoop:
    """Return the C loop, or the Python loop where there is no C compiler."""
    binary = compile_floor(folder)
    return PythonLoop() if binary is None else CLoop(binary)


def probe_rights() -> realtime.Rights:
    """Return the real-time rights that this host gives to a fresh process."""
    order = LoopOrder(cycle_ns=1, cycles=0, realtime=True)
    rights = _bare_loop("rights", _module("plcsim.doctor.python_loop"), order)["rights"]
    return realtime.Rights(tuple(rights["granted"]), tuple(rights["refused"]))


def _cpu() -> int:
    """Return the processor that a scan with rights stays on, -1 for any."""
    cpu = processors.free_cpu()
    return -1 if cpu is None else cpu


def _module(name: str) -> list[str]:
    return [sys.executable, "-P", "-m", name]


def _bare_loop(name: str, command: list[str], order: LoopOrder) -> dict[str, Any]:
    figures: dict[str, Any] = json.loads(_output(name, [*command, *order.arguments()], order))
    return figures


def _bare_figures(figures: dict[str, Any]) -> Figures:
    histogram = Histogram()
    for late_ns in figures["lateness_ns"]:
        histogram.record(late_ns)
    return Figures(figures["missed"], histogram.summary())


def _output(name: str, command: list[str], order: LoopOrder) -> str:
    """Run a command and return what it prints."""
    limit_s = 30 + 5 * order.cycles * order.cycle_ns / 1e9
    try:
        done = subprocess.run(  # noqa: S603  # our own modules and the floor just compiled
            command, capture_output=True, text=True, timeout=limit_s, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as err:
        raise MeasurementError(f"the {name} loop: {err}") from None
    if done.returncode:
        reason = done.stderr.strip().rpartition("\n")[2]
        raise MeasurementError(f"the {name} loop ended with {done.returncode}: {reason}")
    return done.stdout
