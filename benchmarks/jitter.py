"""How late plcsim wakes, beside a bare C loop and a bare Python loop on the same absolute grid.

The three loops run in turn, each in a fresh process with the same real-time rights, priority and
CPU; every round begins with another loop. plcsim is measured as it is used: ``plcsim run`` of a
project with one empty program, by the report of that run. Figures are medians over the rounds;
differences and ratios are taken within each round, then their median. What plcsim itself costs in
an empty cycle is measured from a wake-up to the next sleep, in real time and on the virtual clock.

    python benchmarks/jitter.py [--seconds 3] [--rounds 5] [--json FILE]
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path
from statistics import median
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
from _run import HERE, run_project
from _statements import write_statements

from plcsim.core.statistics import Summary
from plcsim.doctor.loops import (
    LoopOrder,
    MeasuredLoop,
    Measurement,
    PythonLoop,
    ScanLoop,
    floor_loop,
    measure,
    probe_rights,
)

CYCLE_NS = 1_000_000
VIRTUAL_SCANS = 20_000
PERCENTILES = ("p50_ns", "p99_ns", "p99_9_ns")


class Round(NamedTuple):
    """One alternation: each loop once, then our own cost on both clocks."""

    measurements: dict[str, Measurement]
    awake: Summary
    virtual_ns: float


def main() -> int:
    options = _options()
    before = print_machine("before")
    rights = probe_rights()
    console.print(f"rights: {', '.join(rights.granted) or 'none'}")
    order = LoopOrder(CYCLE_NS, options.seconds * 1000, rights.complete)
    with tempfile.TemporaryDirectory(prefix="plcsim-jitter-") as folder:
        loops = (floor_loop(Path(folder)), ScanLoop(Path(folder)), PythonLoop())
        rounds = [_round(i, loops, order, Path(folder)) for i in range(options.rounds)]
    after = print_machine("after")
    floor = loops[0].name
    _print_lateness(rounds, floor)
    _print_cost(rounds)
    _print_missed(rounds)
    targets = _targets(rounds, floor)
    print_targets(targets)
    if not rights.complete:
        console.print("The targets are for SCHED_FIFO, which this host does not give.")
    if floor != "C":
        console.print("There is no C compiler here: the floor is the bare Python loop.")
    raw = [
        {
            "loops": [m.as_json() for m in r.measurements.values()],
            "awake": r.awake._asdict(),
            "virtual_ns": r.virtual_ns,
        }
        for r in rounds
    ]
    write_json(options.json, [before, after], targets, rights=rights._asdict(), rounds=raw)
    return 0


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Wake-up lateness of plcsim beside its floor.")
    parser.add_argument("--seconds", type=number_above_0, default=3, help="of each leg")
    parser.add_argument("--rounds", type=number_above_0, default=5)
    parser.add_argument("--json", type=Path, metavar="FILE")
    return parser.parse_args()


def _round(number: int, loops: tuple[MeasuredLoop, ...], order: LoopOrder, folder: Path) -> Round:
    turn = number % len(loops)
    measurements = {loop.name: measure(loop, order) for loop in (*loops[turn:], *loops[:turn])}
    awake = run_project(HERE / "awake", order.cycles // 3, virtual=False)
    empty = write_statements(folder / "virtual", 0, VIRTUAL_SCANS)
    virtual = run_project(empty, VIRTUAL_SCANS, virtual=True)
    return Round(measurements, Summary(**awake), virtual["scan_ns"])


def _median_ns(rounds: list[Round], loop: str, name: str) -> float:
    return float(median(getattr(r.measurements[loop].lateness, name) for r in rounds))


def _pairs_ns(rounds: list[Round], loop: str, floor: str, name: str) -> list[tuple[int, int]]:
    """Return a percentile of the loop and of the floor, round by round."""
    both = [(r.measurements[loop].lateness, r.measurements[floor].lateness) for r in rounds]
    return [(getattr(ours, name), getattr(theirs, name)) for ours, theirs in both]


def _difference_us(rounds: list[Round], loop: str, floor: str, name: str) -> float:
    return median(a - b for a, b in _pairs_ns(rounds, loop, floor, name)) / 1000


def _ratio(rounds: list[Round], loop: str, floor: str, name: str) -> float:
    return median(a / max(b, 1) for a, b in _pairs_ns(rounds, loop, floor, name))


def _missed_more(rounds: list[Round], loop: str, floor: str) -> float:
    return median(r.measurements[loop].missed - r.measurements[floor].missed for r in rounds)


def _print_lateness(rounds: list[Round], floor: str) -> None:
    table = figures_table(
        "lateness in us", "p50", "p99", "p99.9", "max", "missed", "of", "steal",
        *(f"{name} to {floor}" for name in ("p50", "p99", "p99.9")),
    )  # fmt: skip
    for loop in sorted(rounds[0].measurements):
        runs = [r.measurements[loop] for r in rounds]
        table.add_row(
            f"{loop} loop",
            *(f"{_median_ns(rounds, loop, name) / 1000:.1f}" for name in PERCENTILES),
            f"{max(m.lateness.maximum_ns for m in runs) / 1000:.0f}",
            str(sum(m.missed for m in runs)),
            str(sum(m.order.cycles for m in runs)),
            f"{max(m.stolen_percent for m in runs):.1f} %",
            *(
                f"{_difference_us(rounds, loop, floor, name):+.1f} "
                f"x{_ratio(rounds, loop, floor, name):.2f}"
                for name in PERCENTILES
            ),
        )
    console.print()
    console.print(table, soft_wrap=True)


def _print_missed(rounds: list[Round]) -> None:
    console.print("\ngrid points missed, round by round")
    for loop in sorted(rounds[0].measurements):
        missed = " ".join(f"{r.measurements[loop].missed:4}" for r in rounds)
        console.print(f"  {loop:<8}{missed}")


def _print_cost(rounds: list[Round]) -> None:
    real = [median(getattr(r.awake, n) for r in rounds) / 1000 for n in PERCENTILES]
    virtual = median(r.virtual_ns for r in rounds) / 1000
    console.print(
        f"\nown cost of an empty cycle: real time p50 {real[0]:.1f} us, p99 {real[1]:.1f} us, "
        f"p99.9 {real[2]:.1f} us; virtual clock {virtual:.1f} us",
        soft_wrap=True,
    )


def _targets(rounds: list[Round], floor: str) -> list[Target]:
    ours, cost = ScanLoop.name, median(r.awake.p50_ns for r in rounds) / 1000
    more = _missed_more(rounds, ours, floor)
    p50, p99 = (_difference_us(rounds, ours, floor, name) for name in PERCENTILES[:2])
    return [
        Target(f"lateness p50 above the {floor} floor", p50, 15, "us"),
        Target(f"lateness p99 above the {floor} floor", p99, 25, "us"),
        Target(f"grid points missed beyond the {floor} floor, median", more, 0, "a leg"),
        Target("own cost of an empty cycle, real time, median", cost, 25, "us"),
    ]


if __name__ == "__main__":
    sys.exit(main())
