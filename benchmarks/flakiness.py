"""Are the example tests flaky? Runs all of programs/*/tests again and again, half beside CPU hogs.

Prints how often each outcome came, and which tests did not always end in the same one. A realtime
test that is skipped because the host could not hold the tick is counted apart: it says so, and it
is no result about the program.

    python benchmarks/flakiness.py --runs 100
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ET
from collections import Counter, defaultdict
from pathlib import Path

from _hogs import hogs

ROOT = Path(__file__).resolve().parents[1]


def outcomes(junit: Path) -> dict[str, str]:
    """Return the outcome of every test of a run."""
    found = {}
    for case in ET.parse(junit).iter("testcase"):
        kinds = {child.tag for child in case} & {"failure", "error", "skipped"}
        found[f"{case.get('classname')}::{case.get('name')}"] = min(kinds, default="passed")
    return found


def run(suite: list[str], junit: Path) -> dict[str, str]:
    """Run the suite once in a process of its own."""
    command = [sys.executable, "-m", "pytest", "-q", f"--junitxml={junit}", *suite]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        raise SystemExit(f"pytest ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return outcomes(junit)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=100, help="half of them beside hogs")
    parser.add_argument("suite", nargs="*", help="default: all of programs/*/tests")
    options = parser.parse_args()
    suite = options.suite or [str(p) for p in sorted((ROOT / "programs").glob("*/tests"))]
    seen: dict[str, Counter[str]] = defaultdict(Counter)
    begin_s = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        for loaded in (False, True):
            totals: Counter[str] = Counter()
            with hogs(wanted=loaded):
                for _ in range(options.runs // 2):
                    for test, outcome in run(suite, Path(folder) / "junit.xml").items():
                        seen[test][outcome] += 1
                        totals[outcome] += 1
            place = "beside hogs" if loaded else "quiet"
            print(f"{place:12} {options.runs // 2} runs: {dict(totals)}", flush=True)
    flaky = {t: c for t, c in seen.items() if len(set(c) - {"skipped"}) > 1}
    failing = {t: c for t, c in seen.items() if c["failure"] or c["error"]}
    skipped = sum(c["skipped"] for c in seen.values())
    for test, counts in sorted((flaky | failing).items()):
        print(f"  {test}: {dict(counts)}")
    print(
        f"{len(seen)} tests, {options.runs} runs, {time.monotonic() - begin_s:.0f} s: "
        f"{len(flaky)} flaky, {len(failing)} ever failing, {skipped} skipped because the "
        "host could not hold the tick"
    )
    return 1 if failing else 0


if __name__ == "__main__":
    sys.exit(main())
