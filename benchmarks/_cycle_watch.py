"""Each cycle of a scan, seen from outside: how late it began, and what was missed and why.

The scan writes a record of each cycle for whoever follows it, as for the page of the task classes
(`plcsim.shared_image.figures`), and one of each violation for everybody.
"""

from __future__ import annotations

import math
import statistics
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from _stalls import stolen_ticks

from plcsim.core.task import Cause
from plcsim.shared_image.command import Follow
from plcsim.shared_image.events import EventKind, violation_of
from plcsim.shared_image.figures import cycle_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.shared_image.figures import ClassCycle
    from plcsim.shared_image.reader import ImageReader

SECOND_NS = 1_000_000_000


@dataclass
class Cycles:
    """What was seen in a part of a run.

    Attributes:
        late_ns: of each cycle, from its grid point to its start.
        controller_ns: CPU time of LATCH and PUBLISH, likewise.
        seconds_ns: the p99 of ``late_ns`` in each whole second.
        missed: grid points between the cycles.
        causes: of the violations.
        stolen: time stolen from the scan's processor, in ticks.
        lost: records that came too late to be read.
    """

    late_ns: list[int] = field(default_factory=list)
    controller_ns: list[int] = field(default_factory=list)
    seconds_ns: list[float] = field(default_factory=list)
    missed: int = 0
    causes: Counter[Cause] = field(default_factory=Counter)
    stolen: int = 0
    lost: int = 0

    def add(self, other: Cycles) -> None:
        """Take in another part."""
        self.late_ns += other.late_ns
        self.controller_ns += other.controller_ns
        self.seconds_ns += other.seconds_ns
        self.missed += other.missed
        self.causes += other.causes
        self.stolen += other.stolen
        self.lost += other.lost

    @property
    def stalls(self) -> int:
        """Violations by the host."""
        return self.causes[Cause.HOST]

    @property
    def own(self) -> int:
        """Violations by programs and the controller."""
        return self.causes.total() - self.stalls

    def late_us(self, percent: float) -> float:
        """Return a percentile of the lateness, in microseconds."""
        return percentile(self.late_ns, percent) / 1000

    @property
    def second_us(self) -> float:
        """Median of the p99 of each second: what a burst of the host in one second leaves alone."""
        return statistics.median(self.seconds_ns) / 1000 if self.seconds_ns else 0.0

    @property
    def controller_us(self) -> float:
        """What LATCH and PUBLISH take, on the average."""
        return statistics.fmean(self.controller_ns) / 1000


def percentile(values: Sequence[int], percent: float) -> int:
    """Return the smallest value that so many percent do not exceed."""
    return sorted(values)[max(0, math.ceil(len(values) * percent / 100) - 1)]


class CycleWatch:
    """Follows the cycles of the one task class of a run.

    Args:
        image: of the run, with a ring for commands.
        cycle_ns: the cycle time.
        cpu: the processor of the scan.
    """

    def __init__(self, image: ImageReader, cycle_ns: int, cpu: int) -> None:
        self._cycle_ns = cycle_ns
        self._cpu = cpu
        self._samples = image.samples()
        self._events = image.events()
        image.send(Follow(cycles=True))
        self._last: ClassCycle | None = None
        self._into = Cycles()
        self._lost = 0
        self._stolen = stolen_ticks(cpu)
        self._second: list[int] = []
        self._second_ends_ns = 0

    def look(self) -> None:
        """Take in what has come; a second's records are lost where nobody looks for so long."""
        for record in self._samples.read(100_000):
            if record.kind == EventKind.CYCLE.value:
                self._note(cycle_of(record.data))
        for record in self._events.read(100_000):
            if record.kind == EventKind.VIOLATION.value:
                self._into.causes[violation_of(record).cause] += 1

    def _note(self, cycle: ClassCycle) -> None:
        into, late_ns = self._into, cycle.start_ns - cycle.release_ns
        into.late_ns.append(late_ns)
        into.controller_ns.append(cycle.controller_ns)
        if self._last is not None and self._last.number + 1 == cycle.number:
            into.missed += (cycle.release_ns - self._last.release_ns) // self._cycle_ns - 1
        self._last = cycle
        if cycle.release_ns >= self._second_ends_ns:
            if self._second:
                into.seconds_ns.append(percentile(self._second, 99))
                self._second = []
            self._second_ends_ns = cycle.release_ns + SECOND_NS
        self._second.append(late_ns)

    def take(self) -> Cycles:
        """Return what was seen since the last call."""
        self.look()
        found, self._into = self._into, Cycles()
        stolen, lost = stolen_ticks(self._cpu), self._samples.lost
        found.stolen, self._stolen = stolen - self._stolen, stolen
        found.lost, self._lost = lost - self._lost, lost
        self._second, self._second_ends_ns = [], 0  # what has begun belongs to two parts
        return found
