"""Winds a controller under test back: it runs again from its start, on what came in then.

What came in up to each LATCH is told by the variables: they are compared with those at the end of
the cycle before. Every cycle that is run again has to end as it did, so what is wound back is what
it was; a program that asks the world otherwise is named instead.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.control import Step
from plcsim.recorder.bag.changes import changed, changes
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from plcsim.core.task import TaskClass
    from plcsim.testing.plc import Plc


class _Cycle(NamedTuple):
    """A cycle as it was.

    Attributes:
        task_class: number of the class.
        cycle: of that class.
        came_in: what changed between the end of the cycle before and the programs of this one.
        variables: at its end, as changes of those before its programs.
    """

    task_class: int
    cycle: int
    came_in: bytes
    variables: bytes


class Winding:
    """The cycles of a controller since its start.

    Args:
        plc: the controller under test.
        name: returns the first tag that differs, with both values, of two sets of variables.
    """

    def __init__(self, plc: Plc, name: Callable[[bytes, bytes], tuple[str, str, str]]) -> None:
        self._plc = plc
        self._name = name
        controller = plc.controller
        memory = controller.memory
        self._views = [memory.view(a.address, a.data_type.size) for a in controller.areas]
        self._before = self._latched = b""
        self._came_in = b""
        self._cycles: list[_Cycle] = []
        self._script: Iterator[_Cycle] | None = None
        self._current: _Cycle | None = None
        self._reason = ""
        controller.image.inputs.append(self._latch)
        controller.image.watchers.insert(0, self._publish)
        controller.follow_steps(self._stepped)

    @property
    def is_winding(self) -> bool:
        """Whether cycles are run again."""
        return self._script is not None

    def back(self, cycles: int) -> None:
        """Go back by cycles of the task class under test.

        Raises:
            PlcTestError: there were not so many, or one cannot be repeated.
        """
        plc = self._plc
        target = plc.cycle_count - cycles
        if cycles < 1 or target < 0:
            raise PlcTestError(f"rewind: {plc.cycle_count} cycles can be wound back, not {cycles}")
        self._script, self._reason = iter(self._cycles), ""
        try:
            plc.restart()
            if target:
                plc.cycles(target)
        finally:
            self._script = None
        if self._reason:
            raise PlcTestError(
                f"rewind: {self._reason}; what a program has from elsewhere than its variables "
                "cannot be wound back"
            )

    def _stepped(self, step: Step, _until_ns: int, _cycles: int) -> None:
        if step is Step.BOOT:
            self._before = b""
            self._cycles = []

    def _variables(self) -> bytes:
        return b"".join(self._views)

    def _latch(self, task_class: TaskClass) -> None:
        now = self._variables()
        if self._script is not None:
            now = self._repeat(task_class, now)
        self._came_in = changes(self._before, now) if self._before else now
        self._latched = now

    def _repeat(self, task_class: TaskClass, now: bytes) -> bytes:
        """Let come in what came in then; return the variables."""
        assert self._script is not None
        cycle = self._current = next(self._script, None)
        if self._reason or cycle is None:
            return now
        here = task_class.number, task_class.cycles
        if (cycle.task_class, cycle.cycle) != here:
            was = f"cycle {cycle.cycle} of task class {cycle.task_class}"
            self._reason = f"now it is cycle {here[1]} of task class {here[0]}, and was {was}"
            return now
        now = changed(self._before, cycle.came_in) if self._before else cycle.came_in
        at = 0
        for view in self._views:
            view[:] = now[at : at + len(view)]
            at += len(view)
        return now

    def _publish(self, task_class: TaskClass) -> None:
        now = self._variables()
        cycle = self._current if self._script is not None else None
        if cycle is not None and not self._reason:
            then = changed(self._latched, cycle.variables)
            if now != then:
                tag, here, there = self._name(now, then)
                where = f"cycle {cycle.cycle} of task class {cycle.task_class}"
                self._reason = f"{where}: {tag} is {here} now, and was {there}"
        self._cycles.append(
            _Cycle(task_class.number, task_class.cycles, self._came_in, changes(self._latched, now))
        )
        self._before = now
