"""Is a slower program seen? Budgets and `plcsim report compare`, quiet and beside CPU hogs.

A program does 1, 1.2 and 2 times the work. Counted is

- how often the test with a budget of 1.5 times the program's cost passes with 1 and fails with 2
  times the work;
- how often `plcsim report compare` sees 1.2 times the work over 30 repeats, and how often it raises
  an alarm between two runs of the same program. Every run with more work is compared with every
  run without, and every two runs without.

    python benchmarks/slowdown.py --runs 20
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from itertools import combinations, product
from pathlib import Path

from _hogs import hogs

from plcsim.cli.report import comparisons, read_samples
from plcsim.testing.calibration import REFERENCE_NS

STEPS = 100
REPEATS = 30

PROGRAM = """
from plcsim import Program
from st_types import BOOL, DINT, REAL, var


class Worker(Program):
    count = var(DINT)
    level = var(REAL)
    high = var(BOOL)

    def cyclic(self):
        for step in range({steps}):
            self.count = self.count + step
            self.level = self.level * 0.5
            self.high = self.level > 1.0
"""

TEST = """
import pytest


def test_cost(plc):
    plc.run("3s")


@pytest.mark.cycle_budget(p99="{p99}ns", worst="{worst}ns")
def test_budget(plc):
    plc.run("10s")
"""


def make_project(folder: Path, factor: float, budget_ns: int) -> Path:
    """Write a project whose program does ``factor`` times the work."""
    (folder / "worker").mkdir(parents=True)
    (folder / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["worker"]\n')
    (folder / "worker" / "main.py").write_text(PROGRAM.format(steps=round(STEPS * factor)))
    (folder / "test_worker.py").write_text(TEST.format(p99=budget_ns, worst=2 * budget_ns))
    return folder


def run(project: Path, *arguments: str) -> int:
    """Run tests of a project; return pytest's exit code."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments]
    done = subprocess.run(command, cwd=project, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        raise SystemExit(f"pytest ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.returncode


def measure(project: Path, report: Path) -> dict[tuple[str, str], list[float]]:
    """Return the costs of 30 repeats."""
    run(project, "-k", "test_cost", f"--plc-report={report}", f"--plc-repeat={REPEATS}")
    return read_samples(report)


def alarm(before: dict, after: dict) -> bool:
    return any(c.worse for c in comparisons(before, after))


def base_cost_ns(folder: Path) -> int:
    """Return the program's cost on the reference machine."""
    samples = measure(make_project(folder / "first", 1.0, 1), folder / "first-report")
    (values,) = samples.values()
    return round(sorted(values)[len(values) // 2] * REFERENCE_NS)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=20, help="of each kind, quiet and loaded")
    runs = parser.parse_args().runs
    begin_s = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        cost_ns = base_cost_ns(folder)
        budget_ns = round(1.5 * cost_ns)
        print(f"cost {cost_ns / 1000:.1f} us, budget p99 {budget_ns / 1000:.1f} us (reference)")
        projects = {f: make_project(folder / str(f), f, budget_ns) for f in (1.0, 1.2, 2.0)}
        samples: dict[float, list[dict]] = {1.0: [], 1.2: []}
        for loaded in (False, True):
            with hogs(wanted=loaded):
                place = "beside hogs" if loaded else "quiet"
                passed = sum(run(projects[1.0], "-k", "budget") == 0 for _ in range(runs))
                failed = sum(run(projects[2.0], "-k", "budget") == 1 for _ in range(runs))
                print(f"{place:12} budget: 1.0 times the work passed {passed} of {runs}, "
                      f"2.0 times failed {failed} of {runs}", flush=True)  # fmt: skip
                for number in range(runs):
                    for factor, found in samples.items():
                        report = folder / f"report-{loaded}-{factor}-{number}"
                        found.append(measure(projects[factor], report))
            _print_alarms(place, samples[1.0][-runs:], samples[1.2][-runs:])
        _print_alarms("all together", samples[1.0], samples[1.2])
    print(f"{time.monotonic() - begin_s:.0f} s")
    return 0


def _print_alarms(place: str, same: list[dict], slower: list[dict]) -> None:
    pairs = list(combinations(same, 2))
    false = sum(alarm(a, b) or alarm(b, a) for a, b in pairs)
    seen = sum(alarm(a, b) for a, b in product(same, slower))
    print(
        f"{place:12} compare: false alarms {false} of {len(pairs)} pairs of equal runs, "
        f"1.2 times the work seen in {seen} of {len(same) * len(slower)} pairs",
        flush=True,
    )


if __name__ == "__main__":
    sys.exit(main())
