"""Histograms and the last cycles of all task classes, as the pages show them."""

from __future__ import annotations

from collections import deque
from itertools import groupby
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.statistics import Histogram, bucket_end_ns
from plcsim.shared_image.figures import Measured

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from plcsim.shared_image.figures import Buckets, ClassCycle

CYCLES_KEPT: Final = 400
PER_OCTAVE: Final = 4
"""Bars of a histogram for each power of two."""


class ClassFigures:
    """What is known of the task classes.

    Args:
        classes: as the extension described them.
        tasks: names of all tasks, by index.
    """

    def __init__(self, classes: Sequence[Mapping[str, Any]], tasks: Sequence[str]) -> None:
        self._tasks = tasks
        self._histograms: dict[tuple[Measured, int], dict[str, Any]] = {}
        self._cycles: dict[int, deque[ClassCycle]] = {
            c["number"]: deque(maxlen=CYCLES_KEPT) for c in classes
        }

    def take_histogram(self, buckets: Buckets) -> None:
        """Take a histogram, instead of the one before of the same."""
        self._histograms[buckets.measured, buckets.number] = _described(buckets)

    def take_cycle(self, cycle: ClassCycle) -> None:
        """Take a cycle."""
        self._cycles[cycle.task_class].append(cycle)

    def histograms(self) -> list[dict[str, Any]]:
        """Return all histograms, with what each is of."""
        found = []
        for (measured, number), described in self._histograms.items():
            is_program = measured is Measured.PROGRAM
            name = self._tasks[number] if is_program else str(number)
            found.append({"of": measured.name.lower(), "name": name, **described})
        return found

    def last_cycles(self, span_ns: int) -> list[dict[str, Any]]:
        """Return the cycles of all classes that ended in the last ``span_ns``, with their runs."""
        latest_ns = max((c[-1].end_ns for c in self._cycles.values() if c), default=0)
        return [
            {
                "class": cycle.task_class,
                "cycle": cycle.number,
                "release_ns": cycle.release_ns,
                "start_ns": cycle.start_ns,
                "end_ns": cycle.end_ns,
                "runs": [
                    [self._tasks[run.task], run.start_ns, run.end_ns, run.used_ns]
                    for run in cycle.runs
                ],
            }
            for cycles in self._cycles.values()
            for cycle in cycles
            if cycle.end_ns >= latest_ns - span_ns
        ]


def _described(buckets: Buckets) -> dict[str, Any]:
    """Return percentiles, and bars as [start, end, count] with `PER_OCTAVE` for each octave."""
    histogram = Histogram()
    histogram.counts[:] = buckets.counts
    histogram.total_ns = buckets.total_ns
    histogram.minimum_ns, histogram.maximum_ns = buckets.minimum_ns, buckets.maximum_ns
    step = 32 // PER_OCTAVE
    bars = []
    for number, group in groupby(enumerate(buckets.counts), lambda each: each[0] // step):
        count = sum(each for _, each in group)
        if count:
            start_ns = bucket_end_ns(number * step - 1) + 1 if number else 0
            bars.append([start_ns, bucket_end_ns(number * step + step - 1), count])
    return {**histogram.summary()._asdict(), "bars": bars}
