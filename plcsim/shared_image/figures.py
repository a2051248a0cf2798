"""Figures of the scan for services that follow them: when programs ran, and histograms.

Nothing of it costs anything while nobody follows. A cycle is one record; a histogram is copied only
while the scan is idle, one at a time.
"""

from __future__ import annotations

import struct
from array import array
from enum import Enum
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.shared_image.events import EventKind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.statistics import Histogram
    from plcsim.core.task import Task, TaskClass
    from plcsim.shared_image.samples import Sampler

_CYCLE = struct.Struct("<IIqqqq")
_RUN = struct.Struct("<Iqqq")
_HISTOGRAM = struct.Struct("<HHqqq")

ENOUGH_NS: Final = 300_000
"""A histogram is copied where the scan sleeps so long at least; it takes some 20 us."""

ROUND_NS: Final = 500_000_000
"""All histograms are copied once in so long."""


class Measured(Enum):
    """What a histogram is of."""

    LATENESS = 0
    EXECUTION = 1
    RESPONSE = 2
    CONTROLLER = 3
    PROGRAM = 4


class ProgramRun(NamedTuple):
    """A run of CYCLIC.

    Attributes:
        task: its index.
        start_ns: as in `ClassCycle`.
        end_ns: likewise.
        used_ns: CPU time.
    """

    task: int
    start_ns: int
    end_ns: int
    used_ns: int


class ClassCycle(NamedTuple):
    """A cycle of a task class; times count from the start of the controller.

    Attributes:
        task_class: its number.
        number: of the cycle, from 1.
        release_ns: the grid point.
        start_ns: of LATCH.
        end_ns: of PUBLISH.
        controller_ns: CPU time of LATCH and PUBLISH.
        runs: of its programs, in order.
    """

    task_class: int
    number: int
    release_ns: int
    start_ns: int
    end_ns: int
    controller_ns: int
    runs: Sequence[ProgramRun]


class Buckets(NamedTuple):
    """A histogram (`plcsim.core.statistics.Histogram`).

    Attributes:
        measured: what it is of.
        number: of the task class, or the index of the task.
        total_ns: sum of all durations.
        minimum_ns: the shortest.
        maximum_ns: the longest.
        counts: of each bucket.
    """

    measured: Measured
    number: int
    total_ns: int
    minimum_ns: int
    maximum_ns: int
    counts: Sequence[int]


def cycle_of(data: bytes) -> ClassCycle:
    """Return the cycle in a record of the kind `EventKind.CYCLE`."""
    runs = [ProgramRun(*fields) for fields in _RUN.iter_unpack(data[_CYCLE.size :])]
    number, cycle, release_ns, start_ns, end_ns, controller_ns = _CYCLE.unpack_from(data)
    return ClassCycle(number, cycle, release_ns, start_ns, end_ns, controller_ns, runs)


def buckets_of(data: bytes) -> Buckets:
    """Return the histogram in a record of the kind `EventKind.HISTOGRAM`."""
    measured, number, total_ns, minimum_ns, maximum_ns = _HISTOGRAM.unpack_from(data)
    counts = array("I")
    counts.frombytes(data[_HISTOGRAM.size :])
    return Buckets(Measured(measured), number, total_ns, minimum_ns, maximum_ns, counts)


class FiguresWriter:
    """Writes the figures into the streams of those who follow them.

    Args:
        controller: whose figures they are.
    """

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self._runs: list[tuple[Task, int, int, int]] = []
        self._cycles: list[Sampler] = []
        self._histograms: list[Sampler] = []
        self._due_ns = 0
        self._next = 0
        self._all: list[tuple[Measured, int, Histogram]] = []
        for task_class in controller.classes:
            number = task_class.number
            self._all += [
                (Measured.LATENESS, number, task_class.lateness),
                (Measured.EXECUTION, number, task_class.execution),
                (Measured.RESPONSE, number, task_class.response),
                (Measured.CONTROLLER, number, task_class.controller),
            ]
        self._all += [(Measured.PROGRAM, task.index, task.execution) for task in controller.tasks]

    def serve(self, samplers: Sequence[Sampler]) -> None:
        """Serve those of some services that follow figures, and no other."""
        scan = self._controller.scan
        self._cycles = [sampler for sampler in samplers if sampler.follows.cycles]
        self._histograms = [sampler for sampler in samplers if sampler.follows.histograms]
        self._runs.clear()
        scan.run_follower = self if self._cycles else None
        if (self.idle in scan.idlers) != bool(self._histograms):
            if self._histograms:
                scan.idlers.append(self.idle)
            else:
                scan.idlers.remove(self.idle)

    # what the scan tells (plcsim.core.scan.RunFollower)

    def ran(self, task: Task, start_ns: int, end_ns: int, used_ns: int) -> None:
        """Keep a run until its cycle has ended."""
        self._runs.append((task, start_ns, end_ns, used_ns))

    def cycled(self, task_class: TaskClass, start_ns: int, end_ns: int) -> None:
        """Write a cycle with its runs; those of a class that it has preempted stay."""
        origin_ns = self._controller.origin_ns
        parts = [
            _CYCLE.pack(
                task_class.number,
                task_class.cycles,
                task_class.release_ns - origin_ns,
                start_ns - origin_ns,
                end_ns - origin_ns,
                task_class.controller.last_ns,
            )
        ]
        left = []
        for run in self._runs:
            task, began_ns, ended_ns, used_ns = run
            if task in task_class.tasks:
                parts.append(
                    _RUN.pack(task.index, began_ns - origin_ns, ended_ns - origin_ns, used_ns)
                )
            elif began_ns > start_ns:
                continue  # an exception program, which is in no class
            else:
                left.append(run)
        self._runs = left
        data = b"".join(parts)
        for sampler in self._cycles:
            sampler.stream.write(EventKind.CYCLE.value, end_ns - origin_ns, data)

    def idle(self, idle_ns: int) -> None:
        """Write the next histogram, where there is time for it."""
        controller = self._controller
        now_ns = controller.clock.stamp_ns()
        if idle_ns < ENOUGH_NS or now_ns < self._due_ns:
            return
        self._due_ns = now_ns + ROUND_NS // len(self._all)
        measured, number, histogram = self._all[self._next]
        self._next = (self._next + 1) % len(self._all)
        head = _HISTOGRAM.pack(
            measured.value,
            number,
            histogram.total_ns,
            min(histogram.minimum_ns, histogram.maximum_ns),
            histogram.maximum_ns,
        )
        data = head + array("I", histogram.counts).tobytes()
        for sampler in self._histograms:
            time_ns = now_ns - controller.origin_ns
            sampler.stream.write(EventKind.HISTOGRAM.value, time_ns, data)
