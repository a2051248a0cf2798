"""kill -9 while retained variables change: nothing torn, no more lost than is said.

A program counts in retained variables, all of which change in every cycle: in a UDINT, in an ARRAY
of 64, in a global variable, in one of Structured Text and in one of C; the last two have initial
values. Its scan process is killed at random
moments, and in every second run the process that writes the files together with it. Each run goes
on with what the last one left.

- Torn: the values of the file are not all of one cycle, or the next run begins with others.
- Lost, where the scan alone is killed: cycles that were published and are not in the file.
- Lost, where both are killed: the time between the last cycle published and the one in the file.
  It is a period at most, and what the host and its disk take until the process has run.

    python benchmarks/retain.py [--kills 200] [--json FILE]
"""

from __future__ import annotations

import argparse
import contextlib
import os
import random
import signal
import sys
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, NamedTuple

from _children import end_at_sigterm
from _outcome import (
    Target,
    console,
    figures_table,
    number_above_0,
    print_machine,
    print_targets,
    write_json,
)

from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project
from plcsim.retain.generations import Generations
from plcsim.shared_image import ImageError

if TYPE_CHECKING:
    from plcsim.doctor.host import Host

CYCLE_MS = 2
PERIOD_MS = 50
ELEMENTS = 64

FIRST = [0, 7, 9]
"""Initial values of the counts in Python, Structured Text and C."""

COUNTS = ["counter.count", "text.count", "machine.count"]
BEGAN = ["counter.began", "text.began", "machine.began"]

FILES = {
    "plc.toml": f"""
[plc]
realtime = "off"
init_timeout = "60s"
[task_class.1]
cycle = "{CYCLE_MS}ms"
programs = ["counter", "text", "machine"]
[retain]
period = "{PERIOD_MS}ms"
""",
    "Global.var": "VAR RETAIN\n\tgCount : UDINT;\nEND_VAR\nVAR\n\tgNow : UDINT;\nEND_VAR\n",
    "counter/main.py": f"""
from plcsim import Program
from st_types import ARRAY, UDINT, var


class Counter(Program):
    count = var(UDINT, retain=True)
    table = var(ARRAY(UDINT, (1, {ELEMENTS})), retain=True)
    began = var(UDINT, retain=True)

    def init(self) -> None:
        self.began = self.count

    def cyclic(self) -> None:
        self.count += 1
        self.gNow = self.count
        self.gCount = self.count
        for number in range(1, {ELEMENTS} + 1):
            self.table[number] = self.count
""",
    "text/Main.st": """
PROGRAM _INIT
    began := count;
END_PROGRAM
PROGRAM _CYCLIC
    count := gNow;
END_PROGRAM
""",
    "text/Variables.var": f"""
VAR RETAIN
    count : UDINT := {FIRST[1]};
    began : UDINT;
END_VAR
""",
    "machine/Main.c": f"""
#include <bur/plctypes.h>
_LOCAL_RETAIN UDINT count = {FIRST[2]};
_LOCAL_RETAIN UDINT began;
_GLOBAL UDINT gNow;
void _INIT ProgramInit(void) {{ began = count; }}
void _CYCLIC ProgramCyclic(void) {{ count = gNow; }}
""",
}


class Kill(NamedTuple):
    """What a kill has done.

    Attributes:
        both: the service was killed too.
        is_torn: values of different cycles, or others than were there before.
        lost_ms: of the controller's time.
    """

    both: bool
    is_torn: bool
    lost_ms: int


def main() -> int:
    """Kill, and print what was lost."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--kills", type=number_above_0, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", type=Path, metavar="FILE")
    options = parser.parse_args()
    before = print_machine("before")
    chance = random.Random(options.seed)
    kills: list[Kill] = []
    end_at_sigterm()
    with (
        contextlib.suppress(SystemExit),  # what was found until then counts
        tempfile.TemporaryDirectory(prefix="plcsim-retain-") as folder,
    ):
        _fill(kills, Path(folder), chance, options.kills)
    after = print_machine("after")
    return _report(options.json, [before, after], kills, options.kills)


def _fill(kills: list[Kill], folder: Path, chance: random.Random, count: int) -> None:
    """Make the project, and kill it so often."""
    for name, text in FILES.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text, "utf-8")
    last = FIRST
    for number in range(count):
        last, kill = _kill(folder, chance.uniform(0.03, 0.3), last, both=bool(number % 2))
        kills.append(kill)


def _kill(folder: Path, after_s: float, last: list[int], *, both: bool) -> tuple[list[int], Kill]:
    """Run, kill after a time in RUN; return the counts that are kept, and what was lost."""
    published = 0
    killed = False
    until_s = 0.0
    with Supervisor(read_project(folder), quiet=True) as run:

        def look() -> None:
            nonlocal published, killed, until_s
            image = run.services.image
            with contextlib.suppress(ImageError):
                if killed or image is None or not image.latest or not run.services.pids:
                    return
                until_s = until_s or time.monotonic() + after_s
                if time.monotonic() < until_s or not _is_serving(run):
                    return
                killed = True
                _end((_children() - run.services.pids) | (run.services.pids if both else set()))
                published = _published(run)

        run.wait(look)
    counts, is_whole, began = _kept(folder)
    is_unchanged = counts == last  # killed before anything was written: they began earlier
    is_torn = not is_whole or (began != last and not is_unchanged)
    return counts, Kill(both, is_torn, (published - counts[0]) * CYCLE_MS)


def _is_serving(run: Supervisor) -> bool:
    return all(state.name == "SERVING" for state in run.services.states.values())


def _published(run: Supervisor) -> int:
    image = run.services.image
    assert image is not None
    tag = image.directory.find("counter.count")
    at = image.directory.offset_of(tag.address, 4)
    return int.from_bytes(image.copy(at, at + 4)[1], "little")


def _kept(folder: Path) -> tuple[list[int], bool, list[int]]:
    """Return the counts in the files, whether all values are of one cycle, and where they began."""
    latest, _ = Generations(folder / "retain").latest()
    assert latest is not None
    data = memoryview(latest.data)
    kept = {
        tag.path: data[tag.address : tag.address + tag.data_type.size].cast("I").tolist()
        for tag in latest.variables
    }
    began = [kept.pop(path)[0] for path in BEGAN]
    assert set(kept) == {"gCount", "counter.table", *COUNTS}
    counts = [kept[path][0] for path in COUNTS]
    return counts, len({number for numbers in kept.values() for number in numbers}) == 1, began


def _end(pids: set[int]) -> None:
    for pid in pids:
        os.kill(pid, signal.SIGKILL)
    deadline = time.monotonic() + 10
    while time.monotonic() < deadline and not all(map(_has_ended, pids)):
        time.sleep(0.001)  # no children of ours: nothing tells when they have ended


def _has_ended(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text("ascii").rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def _children() -> set[int]:
    found: set[int] = set()
    for file in Path("/proc/self/task").glob("*/children"):
        found |= {int(pid) for pid in file.read_text("ascii").split()}
    return found


def _report(file: Path | None, hosts: list[Host], kills: list[Kill], wanted: int) -> int:
    table = figures_table("killed", "runs", "torn", "lost p50 ms", "worst ms")
    for both, text in ((False, "the scan"), (True, "scan and service")):
        lost = sorted(k.lost_ms for k in kills if k.both is both) or [0]
        torn = sum(k.is_torn for k in kills if k.both is both)
        table.add_row(text, str(len(lost)), str(torn), f"{median(lost):g}", str(lost[-1]))
    console.print(table)
    alone = [k.lost_ms for k in kills if not k.both]
    both_killed = sorted(k.lost_ms for k in kills if k.both) or [0]
    targets = [
        Target("kills", len(kills), wanted, "", at_least=True),
        Target("torn values", sum(k.is_torn for k in kills), 0, ""),
        Target("lost, the scan killed", max(alone, default=0), 0, "ms"),
        Target("lost, both killed, median", median(both_killed), PERIOD_MS, "ms"),
        Target("lost, both killed, worst", both_killed[-1], 4 * PERIOD_MS, "ms"),
    ]
    print_targets(targets)
    write_json(file, hosts, targets, kills=[k._asdict() for k in kills])
    return 0 if all(t.met for t in targets) else 1


if __name__ == "__main__":
    sys.exit(main())
