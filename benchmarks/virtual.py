"""Scans per second on the virtual clock, beside the same statements in a bare Python loop.

Programs of 0, 5, 50 and 200 statements run under `plcsim run --virtual`, in turn, each in a fresh
process. When its scans are done, the same process runs the same statements in a bare loop on the
same typed views, so that the difference is the scan's own work, and in a bare loop on plain Python
attributes, which is what the typed views cost. Figures are medians over the rounds; the overhead is
taken within each run, then its median.

Then one program runs for 1,000,000 cycles, and what its process holds after 100,000 is compared
with what it holds at the end.

    python benchmarks/virtual.py [--rounds 5] [--cycles 1000000] [--json FILE]
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

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

SIZES = (0, 5, 50, 200)
SCANS = {0: 40_000, 5: 40_000, 50: 16_000, 200: 8_000}

GROWTH_BLOCKS = 100
"""Objects that may come and go: the interpreter's own caches. A leak of one object in ten
thousand cycles would show."""

GROWTH_KIB = 256
"""Resident memory that may come and go in the allocator; a leak of one byte a cycle would show."""


class Times(NamedTuple):
    """One run: wall time of one scan, or of one turn of a bare loop, in nanoseconds."""

    scan_ns: float
    on_views_ns: float
    on_attributes_ns: float

    @property
    def overhead_ns(self) -> float:
        """What the scan does beside the statements."""
        return self.scan_ns - self.on_views_ns


def main() -> int:
    options = _options()
    before = print_machine("before")
    times = _times(options.rounds)
    _print_speed(times)
    memory = _memory(options.cycles)
    _print_memory(memory)
    after = print_machine("\nafter")
    targets = _targets(times, memory)
    print_targets(targets)
    raw = {size: [t._asdict() for t in times[size]] for size in SIZES}
    write_json(options.json, [before, after], targets, times=raw, memory=memory)
    return 0


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Speed and memory on the virtual clock.")
    parser.add_argument("--rounds", type=number_above_0, default=5)
    parser.add_argument("--cycles", type=number_above_0, default=1_000_000, help="for the memory")
    parser.add_argument("--json", type=Path, metavar="FILE")
    return parser.parse_args()


def _times(rounds: int) -> dict[int, list[Times]]:
    """Return the times of every size, one entry a round."""
    times: dict[int, list[Times]] = {size: [] for size in SIZES}
    with tempfile.TemporaryDirectory(prefix="plcsim-virtual-") as folder:
        for size in SIZES * rounds:
            project = write_statements(Path(folder) / f"statements_{size}", size, SCANS[size])
            times[size].append(Times(**run_project(project, SCANS[size], virtual=True)))
    return times


def _memory(cycles: int) -> list[dict[str, int]]:
    """Return what a process holds after a tenth of the cycles, and after all."""
    more = cycles + cycles // 10
    result = run_project(HERE / "memory", more, virtual=True, PLCSIM_CYCLES=str(cycles))
    rows = zip((cycles // 10, cycles), result["held"], result["traced_bytes"], strict=True)
    return [{"cycles": at, **held, "traced_bytes": traced} for at, held, traced in rows]


def _median_us(times: list[Times], name: str) -> float:
    return float(median(getattr(t, name) for t in times)) / 1000


def _scans_per_second(times: list[Times]) -> float:
    return median(1e9 / t.scan_ns for t in times)


def _print_speed(times: dict[int, list[Times]]) -> None:
    table = figures_table(
        "statements", "scans/s", "scan", "bare, typed views", "overhead", "bare, plain",
        "scan/typed", "typed/plain",
    )  # fmt: skip
    for size, rounds in times.items():
        table.add_row(
            str(size),
            f"{_scans_per_second(rounds):,.0f}",
            f"{_median_us(rounds, 'scan_ns'):.2f}",
            f"{_median_us(rounds, 'on_views_ns'):.2f}",
            f"{_median_us(rounds, 'overhead_ns'):.2f}",
            f"{_median_us(rounds, 'on_attributes_ns'):.2f}",
            f"x{median(t.scan_ns / t.on_views_ns for t in rounds):.2f}",
            f"x{median(t.on_views_ns / t.on_attributes_ns for t in rounds):.2f}",
        )
    console.print("\nmicroseconds per scan, or per turn of the bare loop")
    console.print(table)


def _print_memory(memory: list[dict[str, int]]) -> None:
    table = figures_table("memory after", "resident KiB", "blocks", "objects", "traced bytes")
    for held in memory:
        table.add_row(
            f"{held['cycles']:,} cycles",
            f"{held['resident_kib']:,}",
            f"{held['blocks']:,}",
            f"{held['objects']:,}",
            f"{held['traced_bytes']:,}",
        )
    console.print()
    console.print(table)


def _targets(times: dict[int, list[Times]], memory: list[dict[str, int]]) -> list[Target]:
    first, last = memory
    overhead_us = max(_median_us(rounds, "overhead_ns") for rounds in times.values())
    growth: dict[str, Any] = {name: last[name] - first[name] for name in first}
    over = f"over {last['cycles']:,} cycles"
    return [
        Target("empty scans", _scans_per_second(times[0]), 40_000, "/s", at_least=True),
        Target("overhead of a scan over a bare loop, worst size", overhead_us, 20, "us"),
        Target(f"resident memory grown {over}", growth["resident_kib"], GROWTH_KIB, "KiB"),
        Target(f"memory blocks grown {over}", growth["blocks"], GROWTH_BLOCKS, "blocks"),
    ]


if __name__ == "__main__":
    sys.exit(main())
