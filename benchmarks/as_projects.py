"""Which Automation Studio projects below some folders load, check, run, and move.

    python benchmarks/as_projects.py [--for SECONDS] [--wall SECONDS] [--all] FOLDER...

Each project is copied, as programs may write files beside it. A process of its own checks it with
all of its configurations, or with the one that runs by default, then runs what can run on a virtual
clock, and says in one line: tasks that run, of how many; blocks and functions that are simulated
or idle; how long it ran until SERVICE, or the end; how many tasks move, which is that at least one
of their own variables or instances changed after the first second, or a global one while they ran;
how many bytes of their own those are, and how many bytes of global variables. Below it stand the
reasons of what does not run, and the tasks that stand still. A folder with a plc.toml is tried as
it is, so the table [operator] can stand there.
"""

from __future__ import annotations

import argparse
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.core.logbook import Severity
from plcsim.core.system import State
from plcsim.network import VirtualNetwork
from plcsim.project.assembly import assemble, load, runnable
from plcsim.project.plc_toml import read_project
from plcsim.project.survey import Survey, survey

if TYPE_CHECKING:
    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag
    from plcsim.core.task import Task, TaskClass

RUN_S: Final = 600
WALL_S: Final = 180
"""Time of the wall that a project gets for its run."""

GLOBAL: Final = "global variables"
LARGEST_BYTES: Final = 16 << 30
LARGEST_COMPARED: Final = 256 << 10
"""Bytes of global variables that are compared after each run of a task; of more, in one second of
ten."""

NOT_COPIED: Final = ("Temp", "Binaries", "Diagnosis", ".git")
COLUMNS: Final = ("load", "tasks", "stubs", "ran", "moves", "bytes", "global")
HEAD: Final = f"{'project':<44}" + "".join(f"{name:>9}" for name in COLUMNS)
MOST: Final = 6


def projects_in(folder: Path) -> list[Path]:
    """Return the folders with a project file, without those inside another one."""
    if (folder / "plc.toml").is_file():
        return [folder]
    found = sorted({file.parent for file in folder.rglob("*.[aA][pP][jJ]")})
    outer = [each for each in found if not any(other in each.parents for other in found)]
    return outer or [folder]


def configurations_of(folder: Path) -> list[str]:
    """Return the names of the configurations of a project."""
    found = read_project(folder).automation_studio
    return [] if found is None else list(found.configurations)


class Movement:
    """Which bytes of the variables of tasks change.

    Args:
        controller: whose tasks.
    """

    def __init__(self, controller: Controller) -> None:
        self._memory = controller.memory
        self._areas: dict[str, list[Tag]] = {
            task.name: [area for area in task.areas if not area.is_constant]
            for task in controller.tasks
        }
        self._areas[GLOBAL] = [a for a in controller.areas if not a.path and not a.is_constant]
        self._before = {name: self._read(name) for name in self._areas}
        self.changed: dict[str, set[int]] = {name: set() for name in self._areas}
        self.writers: set[str] = set()
        self._views = [
            memoryview(self._memory.view(t.address, t.data_type.size)) for t in self._areas[GLOBAL]
        ]
        self._globals = b"".join(self._views)
        self.is_large = len(self._globals) > LARGEST_COMPARED
        controller.image.inputs.append(self._latched)
        self._scan = controller.scan
        self.compare(is_on=True)

    def compare(self, *, is_on: bool) -> None:
        """Compare the global variables after each run of a task, or do not."""
        self._is_on = is_on
        self._scan.run_follower = self if is_on else None

    def _latched(self, _task_class: TaskClass) -> None:
        if self._is_on:
            self._globals = b"".join(self._views)

    def ran(self, task: Task, _start_ns: int, _end_ns: int, _used_ns: int) -> None:
        """Note whether a task has changed a global variable."""
        now = b"".join(self._views)
        if now != self._globals:
            self.writers.add(task.name)
            self._globals = now

    def cycled(self, _task_class: TaskClass, _start_ns: int, _end_ns: int) -> None:
        """Nothing changes between the last task and the end of the cycle."""

    @property
    def moving(self) -> set[str]:
        """The tasks that move."""
        own = {name for name, places in self.changed.items() if places and name != GLOBAL}
        return own | self.writers

    def _read(self, name: str) -> bytes:
        areas = self._areas[name]
        return b"".join(self._memory.read(tag.address, tag.data_type.size) for tag in areas)

    def look(self) -> None:
        """Note what is different since the last time."""
        for name, before in self._before.items():
            now = self._read(name)
            if now != before:
                pairs = enumerate(zip(before, now, strict=True))
                self.changed[name].update(at for at, (old, new) in pairs if old != new)
                self._before[name] = now


def _given(configuration: str) -> dict[str, dict[str, str]]:
    return {"as": {"config": configuration}} if configuration else {}


def survey_of(folder: Path, configuration: str) -> Survey:
    """Check a project.

    Raises:
        ConfigurationError: it cannot be read at all.
    """
    project = read_project(folder, _given(configuration))
    assert project.automation_studio is not None
    return survey(project, project.automation_studio)


def one(folder: Path, configuration: str, run_s: int, wall_s: int) -> None:
    """Check and run a project in this process, and print what came of it."""
    name = f"{folder.name}/{configuration}" if configuration else folder.name
    start = time.process_time()
    try:
        found = survey_of(folder, configuration)
    except ConfigurationError as err:
        print(f"{name:<44}  cannot be read: {err.findings[0].splitlines()[0]}")
        return
    load_s = time.process_time() - start
    good = [row for row in found.rows if not row.reasons]
    stubs = len({(each.library, each.name) for each in found.stubs})
    head = f"{name:<44}{load_s:>7.1f} s{f'{len(good)}/{len(found.rows)}':>9}{stubs:>9}"
    ran, moves = _ran(folder, configuration, run_s, wall_s) if good else ("-", None)
    short = ran.partition(":")[0]
    if moves is None:
        print(f"{head}{short:>9}", flush=True)
    else:
        shared = len(moves.changed.pop(GLOBAL))
        moving = len(moves.moving)
        total = sum(map(len, moves.changed.values()))
        share = f"{moving}/{len(moves.changed)}"
        print(f"{head}{short:>9}{share:>9}{total:>9}{shared:>9}", flush=True)
    reasons = [
        f"{row.entry.name}: {row.reasons[0].splitlines()[0]}" for row in found.rows if row.reasons
    ]
    told = [*found.common, *found.trouble, *reasons]
    for text in told[:MOST]:
        print(f"    {text.splitlines()[0]}".replace(str(folder.parent), ""))
    if len(told) > MOST:
        print(f"    ... {len(told) - MOST} more")
    if ":" in ran:
        print(f"    {ran}".replace(str(folder.parent), ""))
    still = [] if moves is None else [task for task in moves.changed if task not in moves.moving]
    if still:
        print(f"    still: {', '.join(still)}")


def _ran(folder: Path, configuration: str, run_s: int, wall_s: int) -> tuple[str, Movement | None]:
    """Run what can run; return how long it ran, ":" and why not longer; and what moved."""
    try:
        project = runnable(read_project(folder, _given(configuration)))
        application = load(project).in_process("192.168.0.1")
        clock = VirtualClock()
        network = VirtualNetwork(clock.now_ns).host("192.168.0.1")
        controller = assemble(application, clock=clock, network=network)
    except ConfigurationError as err:
        return f"-:{err.findings[0].splitlines()[0]}", None
    controller.boot()
    if controller.state is State.SERVICE:
        return f"INIT:{_fault(controller)}", None
    controller.start()
    limit = time.monotonic() + wall_s
    controller.run_for(1_000_000_000)
    moves = Movement(controller)
    seconds = 1
    while controller.state is State.RUN and seconds < run_s and time.monotonic() < limit:
        moves.compare(is_on=not moves.is_large or seconds % 10 == 0)
        controller.run_for(1_000_000_000)
        seconds += 1
        moves.look()
    if controller.state is not State.RUN:
        return f"{seconds} s:{_fault(controller)}", moves
    return f"{seconds} s", moves


def _fault(controller: Controller) -> str:
    told = [each.text for each in controller.logbook if each.severity is Severity.ERROR]
    return told[0].splitlines()[0] if told else "no error in the logbook"


def main() -> int:
    """Try all projects."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER")
    parser.add_argument("--for", dest="run_s", type=int, default=RUN_S, metavar="SECONDS")
    parser.add_argument("--wall", dest="wall_s", type=int, default=WALL_S, metavar="SECONDS")
    parser.add_argument("--all", action="store_true", help="all configurations of each project")
    parser.add_argument("--one", default=None, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one is not None:
        resource.setrlimit(resource.RLIMIT_AS, (LARGEST_BYTES, LARGEST_BYTES))
        one(options.folders[0], options.one, options.run_s, options.wall_s)
        return 0
    print(HEAD)
    for given in options.folders:
        with tempfile.TemporaryDirectory() as place:
            copy = Path(place) / given.resolve().name
            ignored = shutil.ignore_patterns(*NOT_COPIED)
            shutil.copytree(given, copy, ignore=ignored, symlinks=True)
            for folder in projects_in(copy):
                _try(folder, options)
    return 0


def _try(folder: Path, options: argparse.Namespace) -> None:
    """Try a project in processes of their own, one for each configuration."""
    names = [""]
    if options.all:
        with suppress(ConfigurationError):  # the process tells it
            names = configurations_of(folder) or names
    for name in names:
        arguments = ["--one", name, "--for", str(options.run_s), "--wall", str(options.wall_s)]
        command = [sys.executable, __file__, *arguments, str(folder)]
        limit = 3 * options.wall_s + 120
        try:
            done = subprocess.run(
                command, timeout=limit, check=False, capture_output=True, text=True
            )
        except subprocess.TimeoutExpired:
            print(f"{folder.name:<44}  not done within {limit} s", flush=True)
            continue
        print(done.stdout, end="", flush=True)
        if done.returncode:
            last = (done.stderr.strip().splitlines() or [""])[-1]
            print(f"{folder.name:<44}  CRASH {done.returncode}: {last}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
