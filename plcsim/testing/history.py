"""The last cycles of a controller, so that a failure can show tags that nobody recorded.

After every cycle the whole used memory is copied into a ring of fixed size. A copy costs less than
a microsecond for programs of ordinary size, and any tag can be read from it afterwards.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.memory import FIRST
from plcsim.library.value_text import text_of
from plcsim.testing.diagram import draw, foot_of, step_for, table
from plcsim.testing.trace import Trace, TraceRow
from plcsim.testing.values import value_in

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag
    from plcsim.core.task import TaskClass

SHOWN = 20
"""Cycles in the table of a failure."""

MOST_CYCLES = 1000
MOST_BYTES = 4 * 1024 * 1024
"""Bounds of the ring of each task class; never fewer than `SHOWN` cycles are kept."""


class Cycle(NamedTuple):
    """The memory after one cycle; for the other fields see `plcsim.testing.trace.TraceRow`."""

    time_ns: int
    task_class: int
    number: int
    image: bytes


class History:
    """The last cycles of every task class of one controller."""

    def __init__(self, controller: Controller) -> None:
        self._memory = controller.memory
        self._scan = controller.scan
        self._context = controller.context
        self._size = controller.memory.used
        length = max(SHOWN, min(MOST_CYCLES, MOST_BYTES // max(1, self._size)))
        self._rings: dict[int, deque[Cycle]] = {
            c.number: deque(maxlen=length) for c in controller.classes
        }
        self._class_of = {t.name.upper(): c.number for c in controller.classes for t in c.tasks}

    def clear(self) -> None:
        """Forget all cycles (a restart)."""
        for ring in self._rings.values():
            ring.clear()

    def add(self, task_class: TaskClass) -> None:
        """Copy the memory; called in PUBLISH."""
        time_ns = self._context.release_ns - self._scan.origin_ns
        image = self._memory.read(FIRST, self._size)
        number = task_class.number
        self._rings[number].append(Cycle(time_ns, number, task_class.cycles, image))

    def _cycles(self, tags: Sequence[Tag]) -> list[Cycle]:
        """Return the kept cycles of the task classes that the tags' programs run in."""
        names = {tag.path.partition(".")[0].upper() for tag in tags}
        classes = {self._class_of[name] for name in names if name in self._class_of}
        rings = (ring for number, ring in self._rings.items() if number in (classes or self._rings))
        return sorted((c for ring in rings for c in ring), key=lambda c: c.time_ns)

    def trace(self, tags: Sequence[Tag]) -> Trace:
        """Return what the kept cycles say of the tags."""
        trace = Trace(tags)
        for cycle in self._cycles(tags):
            raw = tuple(
                cycle.image[t.address - FIRST : t.address - FIRST + t.data_type.size] for t in tags
            )
            trace.add(TraceRow(cycle.time_ns, cycle.task_class, cycle.number, raw))
        return trace

    def explain(self, given: Sequence[Tag], most: int = 100) -> str:
        """Return the last `SHOWN` cycles of tags, at most ``most``, as a table and as a diagram."""
        by_path: dict[str, Tag] = {}
        for tag in given:
            by_path.setdefault(tag.path.upper(), tag)
        tags = list(by_path.values())[:most]
        cycles = self._cycles(tags)[-SHOWN:]
        if not cycles or not tags:
            return ""
        many = len({cycle.task_class for cycle in cycles}) > 1
        head = ["class", "cycle", "time"] if many else ["cycle", "time"]
        rows = [self._row(cycle, tags, many=many) for cycle in cycles]
        step = step_for(tags, len(cycles))
        lanes = [(tag, [value_in(cycle.image, tag) for cycle in cycles]) for tag in tags]
        foot = "" if many else foot_of([cycle.number for cycle in cycles], step)
        return (
            f"{_heading(len(cycles))}\n\n"
            f"{table(rows, [*head, *(tag.path for tag in tags)])}\n\n{draw(lanes, step, foot)}"
        )

    @staticmethod
    def _row(cycle: Cycle, tags: Sequence[Tag], *, many: bool) -> list[str]:
        first = [f"#{cycle.task_class}"] if many else []
        values = (text_of(tag.data_type, value_in(cycle.image, tag)) for tag in tags)
        return [*first, str(cycle.number), f"{cycle.time_ns / 1e6:g} ms", *values]


def _heading(count: int) -> str:
    return "the only cycle" if count == 1 else f"the last {count} cycles"
