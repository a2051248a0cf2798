"""When a scan misses grid points, and by whom: the host had taken its processor, or it was busy."""

from __future__ import annotations

import json
import math
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Self

from plcsim.process.run_file import find_run
from plcsim.shared_image.status_page import StatusPage

if TYPE_CHECKING:
    from collections.abc import Sequence

LOOK_S = 0.1


class Sample(NamedTuple):
    """Grid points missed so far, and time stolen from the scan's processor, in ticks."""

    missed: int
    stolen: int


class Stalls(NamedTuple):
    """Figures of one run.

    Attributes:
        windows: samples taken; each looks at 300 ms.
        stolen_windows: those in which the hypervisor took time from the scan's processor.
        stalls: samples in which grid points were missed.
        stolen_stalls: those of them that are stolen windows.
    """

    windows: int
    stolen_windows: int
    stalls: int
    stolen_stalls: int


def stalls_of(samples: Sequence[Sample]) -> Stalls:
    """Return the figures of samples; steal is accounted late, so a neighbour counts as well."""
    windows = stolen_windows = stalls = stolen_stalls = 0
    for i in range(1, len(samples)):
        around = samples[max(0, i - 2)], samples[min(len(samples) - 1, i + 1)]
        stolen = around[0].stolen != around[1].stolen
        missed = samples[i].missed != samples[i - 1].missed
        windows += 1
        stolen_windows += stolen
        stalls += missed
        stolen_stalls += missed and stolen
    return Stalls(windows, stolen_windows, stalls, stolen_stalls)


def stolen_ticks(cpu: int) -> int:
    """Return the steal of a processor since the host started (proc(5), /proc/stat)."""
    for line in Path("/proc/stat").read_text().splitlines():
        name, *fields = line.split()
        if name == f"cpu{cpu}":
            return int(fields[7])
    raise SystemExit(f"/proc/stat knows no cpu{cpu}")


class StallWatch:
    """Samples a run from outside, ten times a second, while the block lasts.

    Args:
        project: folder of the running project.
        cpu: the processor of its scan.
    """

    def __init__(self, project: Path, cpu: int) -> None:
        run = find_run(project)
        self._page = StatusPage(run.open(run.status_fd))
        self._cpu = cpu
        self._samples: list[Sample] = []
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._sample)

    def _sample(self) -> None:
        while True:
            missed = self._page.of_class(1).missed
            self._samples.append(Sample(missed, stolen_ticks(self._cpu)))
            if self._ended.wait(LOOK_S):
                return

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()
        self._page.close()

    @property
    def stalls(self) -> Stalls:
        """The figures."""
        return stalls_of(self._samples)

    @property
    def missed(self) -> int:
        """Grid points missed while it watched."""
        return self._samples[-1].missed - self._samples[0].missed


def figures_of(report: Path) -> dict[str, Any]:
    """Return what the report of a run says of a scan with one task class and 1 us of tolerance.

    All grid points of a stall have one cause: "own" where programs and controller were on the
    processor for longer than the cycle time, and the host otherwise. A hypervisor that takes time
    without a word makes some of the first kind too.
    """
    told = json.loads(report.read_text())
    (timing,) = told["task_classes"]
    causes = timing["violations"]
    return {
        "rights": ", ".join(told["realtime_rights"]) or "no rights",
        "cycles": timing["cycles"],
        "missed": timing["missed_grid_points"],
        "stalls": causes["host"],
        "own": sum(count for cause, count in causes.items() if cause != "host"),
        "p50_us": timing["lateness_ns"]["p50"] / 1000,
        "p99_us": timing["lateness_ns"]["p99"] / 1000,
        "controller_us": timing["controller_ns"]["mean"] / 1000,
    }


def by_chance(one: int, other: int) -> int:
    """Return by how much two counts of stalls may differ though nothing else does."""
    return math.floor(2 * math.sqrt(one + other))
