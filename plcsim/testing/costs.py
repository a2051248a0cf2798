"""What programs cost: CPU time of the host and instructions, measured, and time, planned.

On the virtual clock a cycle takes no time unless a test says what it costs. The CPU time that the
host needed for it is measured beside that and never reaches the clock, so a run stays repeatable.
Of compiled programs the instructions are counted there, exactly and alike on every machine.
"""

from __future__ import annotations

import gc
from contextlib import contextmanager
from functools import partial
from time import thread_time_ns
from typing import TYPE_CHECKING

from plcsim.core.clock import VirtualClock
from plcsim.testing.errors import PlcTestError
from plcsim.testing.line_costs import line_costs_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from plcsim.core.controller import Controller
    from plcsim.core.task import Task

__tracebackhide__ = True


class Costs:
    """Costs of all programs of one controller, cycle by cycle.

    Attributes:
        measured_ns: CPU time of each CYCLIC, one list a program, in the order of cycles.
        instructions: of each CYCLIC, likewise, of programs in which they are counted.
        lines: instructions by line, of programs that are compiled with counters.
        total_ns: sum of all of them.
    """

    def __init__(self, controller: Controller) -> None:
        self.measured_ns: dict[str, list[int]] = {task.name: [] for task in controller.tasks}
        self.instructions: dict[str, list[int]] = {
            task.name: [] for task in controller.tasks if task.instructions
        }
        self.lines = line_costs_of(controller)
        self.total_ns = 0
        self._clock = controller.clock
        self._count = dict.fromkeys(self.measured_ns, 0)
        self._always: dict[str, int] = {}
        self._planned: dict[tuple[str, int], int] = {}
        self._names = {task.name.upper(): task.name for task in controller.tasks}
        for task in controller.tasks:
            cyclic = task.cyclic
            if task.instructions:
                cyclic = partial(self._count_instructions, task, cyclic)
            task.cyclic = partial(self._run, task.name, cyclic, self.measured_ns[task.name])

    def restart(self) -> None:
        """Count cycles from 1 again."""
        self._count = dict.fromkeys(self._count, 0)

    def plan(self, program: str, cost_ns: int, cycle: int | None = None) -> None:
        """Let a program take time: in every cycle, or in its cycle number ``cycle`` only.

        Raises:
            PlcTestError: there is no such program, or time is real and cannot be planned.
        """
        name = self._names.get(program.upper())
        if name is None:
            raise PlcTestError(
                f"no program {program!r}; there are {', '.join(self._names.values())}"
            )
        if not isinstance(self._clock, VirtualClock):
            raise PlcTestError("on the real clock a program costs what it costs")
        if cycle is None:
            self._always[name] = cost_ns
        else:
            self._planned[name, cycle] = cost_ns

    def _run(self, name: str, cyclic: Callable[[], None], measured_ns: list[int]) -> None:
        self._count[name] += 1
        if self._always or self._planned:
            self._spend(name, self._count[name])
        begin_ns = thread_time_ns()
        try:
            cyclic()
        finally:
            used_ns = thread_time_ns() - begin_ns
            measured_ns.append(used_ns)
            self.total_ns += used_ns

    def _count_instructions(self, task: Task, cyclic: Callable[[], None]) -> None:
        assert task.instructions is not None
        before = task.instructions()
        try:
            cyclic()
        finally:
            self.instructions[task.name].append(task.instructions() - before)

    def _spend(self, name: str, cycle: int) -> None:
        cost_ns = self._planned.get((name, cycle), self._always.get(name, 0))
        if cost_ns and isinstance(self._clock, VirtualClock):
            self._clock.spend_ns(cost_ns)


@contextmanager
def garbage_held() -> Iterator[None]:
    """Keep Python's cyclic collector out of the programs, as on the controller.

    The scan collects while it sleeps (`plcsim.host.garbage`).
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


def overhead_ns() -> int:
    """Return the CPU time that measuring alone adds to every cycle."""
    pairs = (thread_time_ns() - thread_time_ns() for _ in range(50))
    return -max(pairs)
