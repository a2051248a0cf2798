"""A campaign of ten thousand short runs: the memory it holds, its rate, its cost for each run.

One program, 20 ms of PLC time for each run, so that what the campaign itself does shows. The
resident memory of the command and of all processes below it is read while it goes on. What workers
import with their first runs is there after a tenth of the runs; from there on it may not grow.

    python benchmarks/campaign.py [--runs 10000] [--json FILE]
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from _outcome import (
    Target,
    console,
    figures_table,
    number_above_0,
    print_machine,
    print_targets,
    write_json,
)

GROWTH_MIB = 32
"""Of all processes together, from a tenth of the runs to the last: pools of the allocator, and
four bytes for the number of each run that is done. A KiB for each run would be three times that."""

FILES = {
    "plc.toml": '[task_class.1]\ncycle = "10ms"\nprograms = ["ramp"]\n',
    "ramp/main.py": """
from plcsim import Program
from st_types import REAL, var


class Ramp(Program):
    slope = var(REAL, 1.0)
    value = var(REAL)

    def cyclic(self) -> None:
        self.value += self.slope
""",
    "many.py": """
from plcsim.campaign import Always, Campaign, Final, Random, Uniform

campaign = Campaign(
    duration="20ms",
    variables={{"ramp.slope": Uniform(0, 1)}},
    sampling=Random({runs}),
    require=[Always("stays low", lambda plc: 5.0 - plc["ramp.value"])],
    measure=[Final("ramp.value")],
)
""",
}
_DONE = re.compile(r"(\d+)/\d+ runs")


class Sight(NamedTuple):
    """What is seen at one moment: runs done, seconds since the first, memory."""

    runs: int
    time_s: float
    parent_mib: float
    others_mib: float

    @property
    def all_mib(self) -> float:
        return self.parent_mib + self.others_mib


def main() -> int:
    """Run the campaign and print what it holds."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--runs", type=number_above_0, default=10_000)
    parser.add_argument("--json", type=Path, metavar="FILE")
    options = parser.parse_args()
    before = print_machine("before")
    with tempfile.TemporaryDirectory(prefix="plcsim-campaign-") as folder:
        sights = _run(Path(folder), options.runs)
    after = print_machine("after")
    marks = [_nearest(sights, share * options.runs) for share in (0.1, 0.5, 1.0)]
    table = figures_table("runs", "seconds", "command MiB", "all others MiB")
    for sight in marks:
        figures = f"{sight.time_s:.0f}", f"{sight.parent_mib:.0f}", f"{sight.others_mib:.0f}"
        table.add_row(str(sight.runs), *figures)
    console.print(table)
    first, last = marks[0], marks[-1]
    rate = (last.runs - first.runs) / max(last.time_s - first.time_s, 1e-3)
    console.print(f"{rate:.1f} runs/s on {os.cpu_count()} processors")
    targets = [Target("growth of memory", last.all_mib - first.all_mib, GROWTH_MIB, "MiB")]
    print_targets(targets)
    write_json(
        options.json,
        [before, after],
        targets,
        sights=[each._asdict() for each in marks],
        runs_per_s=rate,
    )
    return 0 if all(t.met for t in targets) else 1


def _run(folder: Path, runs: int) -> list[Sight]:
    for name, text in FILES.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text.format(runs=runs) if name == "many.py" else text, "utf-8")
    command = [sys.executable, "-m", "plcsim", "campaign", "run", str(folder / "many.py")]
    sights: list[Sight] = []
    start_s = time.monotonic()
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if found := _DONE.search(line):
                own, others = _memory(process.pid)
                sights.append(Sight(int(found[1]), time.monotonic() - start_s, own, others))
    if process.returncode or not sights:
        raise SystemExit("the campaign did not pass")
    return sights


def _nearest(sights: list[Sight], runs: float) -> Sight:
    return min(sights, key=lambda sight: abs(sight.runs - runs))


def _memory(pid: int) -> tuple[float, float]:
    """Return MiB of a process, and of all below it together."""
    below = {pid}
    found = {int(p.name): p for p in Path("/proc").iterdir() if p.name.isdecimal()}
    parents = {number: _parent(place) for number, place in found.items()}
    while more := {n for n, parent in parents.items() if parent in below} - below:
        below |= more
    return _resident(found[pid]), sum(_resident(found[n]) for n in below - {pid})


def _parent(place: Path) -> int:
    try:
        return int((place / "stat").read_text("ascii").rpartition(")")[2].split()[1])
    except (OSError, UnicodeDecodeError):
        return 0


def _resident(place: Path) -> float:
    try:
        pages = int((place / "statm").read_text("ascii").split()[1])
    except OSError:
        return 0.0
    return pages * os.sysconf("SC_PAGE_SIZE") / (1 << 20)


if __name__ == "__main__":
    sys.exit(main())
