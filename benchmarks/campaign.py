"""What a campaign costs: the memory of ten thousand runs, time beyond the runs, a second processor.

Memory: one program, 20 ms of PLC time for each run, so that what the campaign itself does shows.
The resident memory of the command and of all processes below it is read while it goes on. What
workers import with their first runs is there after a tenth of the runs. From there to the last line
before the results are joined, each thousand of runs may add little: the number of each run that is
done, and what Dask keeps of the last tasks. Joining sorts all results in memory once, at the end.

Time: programs/tank, 10 s of PLC time for each run, on one processor and on two. Each command is
measured with few and with many runs; the difference is the runs alone, without what starts up. What
a run takes itself, its process tells with its result.

    python benchmarks/campaign.py [--runs 10000] [--tank-runs 100] [--json FILE]
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import statistics
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
from pyarrow import parquet

GROWTH_MIB = 2.0
"""Of all processes together with each thousand of runs."""

JOINED_MIB = 32.0
"""More at the end, for what joins the results (16 MiB of pyarrow are loaded for it)."""

OVERHEAD_MS = 20.0
LINEAR = 0.9

FEW = 20
ROUNDS = 3

TANK = """
from plcsim.campaign import Always, Campaign, Random, Uniform

campaign = Campaign(
    duration="10s",
    variables={{"control.setpoint": Uniform(1, 6)}},
    sampling=Random({runs}),
    require=[Always("a level is there", lambda plc: plc["plant.level"] + 1.0)],
)
"""

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


class Speed(NamedTuple):
    """What runs of the tank take: seconds of the campaign for each, and of each run itself."""

    campaign_s: float
    run_s: float


def main() -> int:
    """Run the campaigns and print what they take."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--runs", type=number_above_0, default=10_000)
    parser.add_argument("--tank-runs", type=number_above_0, default=100)
    parser.add_argument("--json", type=Path, metavar="FILE")
    options = parser.parse_args()
    before = print_machine("before")
    with tempfile.TemporaryDirectory(prefix="plcsim-campaign-") as folder:
        speed, speed_figures = _measure_speed(Path(folder), options.tank_runs)
        memory, memory_figures = _measure_memory(Path(folder), options.runs)
    after = print_machine("after")
    targets = [*memory, *speed]
    print_targets(targets)
    write_json(options.json, [before, after], targets, **memory_figures, **speed_figures)
    return 0 if all(t.met for t in targets) else 1


def _measure_speed(folder: Path, runs: int) -> tuple[list[Target], dict[str, object]]:
    """Run the tank on one processor and on two, in turn; print and return the medians."""
    tank = folder / "tank"
    shutil.copytree(Path(__file__).parents[1] / "programs" / "tank", tank)
    counts = [each for each in (1, 2) if each <= len(os.sched_getaffinity(0))]
    found: dict[int, list[Speed]] = {count: [] for count in counts}
    for _ in range(ROUNDS):
        for count in counts:
            found[count].append(_tank_speed(tank, count, runs))
    table = figures_table("processors", "ms for each run", "of these the run itself")
    for count, speeds in found.items():
        each_ms, own_ms = (1e3 * statistics.median(column) for column in zip(*speeds, strict=True))
        table.add_row(str(count), f"{each_ms:.1f}", f"{own_ms:.1f}")
    console.print(table)
    overhead_ms = 1e3 * statistics.median(s.campaign_s - s.run_s for s in found[1])
    targets = [Target("beyond each run", overhead_ms, OVERHEAD_MS, "ms")]
    if 2 in found:
        pairs = zip(found[1], found[2], strict=True)
        linear = statistics.median(one.campaign_s / two.campaign_s / 2 for one, two in pairs)
        targets.append(Target("two processors", linear, LINEAR, "x linear", at_least=True))
    return targets, {"tank": {str(count): speeds for count, speeds in found.items()}}


def _tank_speed(tank: Path, processors: int, runs: int) -> Speed:
    few_s, few_own_s = _timed(tank, processors, FEW)
    many_s, many_own_s = _timed(tank, processors, FEW + runs)
    return Speed((many_s - few_s) / runs, (many_own_s - few_own_s) / runs)


def _timed(tank: Path, processors: int, runs: int) -> tuple[float, float]:
    """Return the seconds of a command, and the sum of what its runs took themselves."""
    file = tank / "speed.py"
    file.write_text(TANK.format(runs=runs), "utf-8")
    output = tank.parent / "speed"
    command = [sys.executable, "-m", "plcsim", "campaign", "run", str(file), "--fresh"]
    command += ["--processors", str(processors), "--output", str(output)]
    start_s = time.monotonic()
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    taken_s = time.monotonic() - start_s
    own_s = parquet.read_table(output / "results.parquet", columns=["host_s"])["host_s"]
    return taken_s, sum(own_s.to_pylist())


def _measure_memory(folder: Path, runs: int) -> tuple[list[Target], dict[str, object]]:
    """Run many short runs; print and return the memory that was seen."""
    sights = _run(folder / "many", runs)
    marks = [_nearest(sights[:-1] or sights, share * runs) for share in (0.1, 0.5, 1.0)]
    marks.append(sights[-1])
    table = figures_table("runs", "seconds", "command MiB", "all others MiB")
    for sight in marks:
        figures = f"{sight.time_s:.0f}", f"{sight.parent_mib:.0f}", f"{sight.others_mib:.0f}"
        table.add_row(str(sight.runs), *figures)
    console.print(table)
    first, *_, last, joined = marks
    rate = (last.runs - first.runs) / max(last.time_s - first.time_s, 1e-3)
    console.print(f"{rate:.1f} runs/s on {len(os.sched_getaffinity(0))} processors")
    grown = (last.all_mib - first.all_mib) / max(last.runs - first.runs, 1) * 1000
    targets = [
        Target("memory, each 1,000 runs", grown, GROWTH_MIB, "MiB"),
        Target("results joined", joined.all_mib - last.all_mib, JOINED_MIB, "MiB"),
    ]
    return targets, {"sights": [each._asdict() for each in marks], "runs_per_s": rate}


def _run(folder: Path, runs: int) -> list[Sight]:
    for name, text in FILES.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
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
