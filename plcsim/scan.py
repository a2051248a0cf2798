"""The scan loop: SLEEP, LATCH, RUN, PUBLISH, on a grid that never moves.

One loop serves both clocks. A task class is released on its grid; when it is the first in order
among those released, its inputs are latched, its programs run one after another, its outputs are
published. Between two programs of a class, classes with a lower number that have been released
meanwhile go first: a program is the unit of preemption. A grid point that passes while the class is
still running is skipped and counted. docs/timing-model.md tells it with pictures.
"""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Protocol

from plcsim.errors import CycleTimeViolation, PhaseError
from plcsim.executions import Executions
from plcsim.garbage import collect_while_idle
from plcsim.task import Cause, Policy, TaskClass, Violation

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.clock import Clock
    from plcsim.context import Context
    from plcsim.task import Task

_NEVER = 1 << 63
"""Later than every time and more than every count."""


class Phase(Enum):
    """What the scan is doing, and so what may be done."""

    SLEEP = "SLEEP"
    LATCH = "LATCH"
    RUN = "RUN"
    PUBLISH = "PUBLISH"


class Image(Protocol):
    """What moves values in and out around a cycle (`plcsim.image`)."""

    def latch(self, task_class: TaskClass) -> None:
        """Bring inputs in; called in LATCH."""

    def publish(self, task_class: TaskClass) -> None:
        """Give outputs out; called in PUBLISH."""


class Supervisor(Protocol):
    """Who is told what runs, and decides what a fault leads to."""

    def started(self, task: Task) -> None:
        """Note that ``task`` is about to run (the heartbeat of the watchdog)."""

    def finished(self, task_class: TaskClass) -> None:
        """Note that a cycle has ended and its figures are up to date."""

    def failed(self, task: Task, error: BaseException) -> None:
        """Handle what a program raised."""

    def violated(self, violation: Violation, policy: Policy) -> None:
        """Handle a cycle time violation."""


class Scan:
    """The loop over task classes.

    Args:
        classes: the task classes, in any order.
        clock: virtual or real.
        context: its ``release_ns`` is set before programs run.
        image: called in LATCH and PUBLISH.
        supervisor: told of everything that goes on.
        place_of: gives "file:line" of what a program raised.
    """

    def __init__(
        self,
        classes: Sequence[TaskClass],
        clock: Clock,
        context: Context,
        image: Image,
        supervisor: Supervisor,
        place_of: Callable[[BaseException], str],
    ) -> None:
        self.classes = sorted(classes, key=lambda c: c.number)
        self.phase = Phase.SLEEP
        self.running = False
        self.halted = False
        self.paused = False
        self.active: Task | None = None
        self.origin_ns = 0
        self._clock = clock
        self._context = context
        self._image = image
        self._supervisor = supervisor
        self._place_of = place_of
        self._executions = Executions()
        self._own_ns = 0
        self._aborted_at = ""
        self._until_ns = _NEVER
        self._last_cycle = _NEVER

    def require(self, phase: Phase) -> None:
        """Raise PhaseError unless the scan is in ``phase``."""
        if self.phase is not phase:
            raise PhaseError(f"not allowed in {self.phase.value}, only in {phase.value}")

    def start(self) -> None:
        """Lay the grids of all classes from now on."""
        self.origin_ns = self._clock.now_ns()
        for task_class in self.classes:
            task_class.release_ns = self.origin_ns + task_class.first_release_ns
        self.running = True
        self.halted = False

    def stop(self) -> None:
        """End `run` after the current cycle; may be called by a signal handler."""
        self.running = False

    def pause(self) -> None:
        """End this `run` after the current cycle; the next `run` goes on from there."""
        self.paused = True

    def halt(self) -> None:
        """End `run` at once: no other program starts any more."""
        self.running = False
        self.halted = True

    def run(self, until_ns: int | None = None, cycles: int | None = None) -> None:
        """Run until stopped or paused, until a time, or for cycles of the first class.

        Args:
            until_ns: releases at or after this time of the clock are not run.
            cycles: cycles of the class with the lowest number, counted from now.

        Raises:
            PhaseError: a program called this.
        """
        self.require(Phase.SLEEP)
        self.paused = False
        self._until_ns = _NEVER if until_ns is None else until_ns
        self._last_cycle = _NEVER if cycles is None else self.classes[0].cycles + cycles
        while self._goes_on():
            due = self._due(len(self.classes))
            if due is not None:
                self._run_class(due)
                continue
            wake_ns = min(self._until_ns, *(c.release_ns for c in self.classes))
            if wake_ns == self._until_ns and self._clock.now_ns() >= wake_ns:
                return
            self._sleep(wake_ns)

    def _goes_on(self) -> bool:
        """Return whether another cycle may start."""
        return self.running and not self.paused and self.classes[0].cycles < self._last_cycle

    def _due(self, below: int) -> TaskClass | None:
        """Return the first released class among the first ``below`` in order."""
        now_ns = self._clock.now_ns()
        for task_class in self.classes[:below]:
            if task_class.release_ns <= now_ns and task_class.release_ns < self._until_ns:
                return task_class
        return None

    def _sleep(self, until_ns: int) -> None:
        self.require(Phase.SLEEP)
        collect_while_idle(until_ns - self._clock.now_ns())
        self._clock.sleep_until_ns(until_ns)

    def _run_class(self, task_class: TaskClass) -> None:
        """Run one cycle of a class: LATCH, RUN, PUBLISH, account."""
        outer = self.phase, self._context.release_ns, self._own_ns, self._aborted_at
        release_ns = task_class.release_ns
        task_class.lateness.record(self._clock.now_ns() - release_ns)
        task_class.cycles += 1
        self._context.release_ns = release_ns
        self._own_ns = 0
        self._aborted_at = ""
        self.phase = Phase.LATCH
        self._image.latch(task_class)
        self.phase = Phase.RUN
        self._run_tasks(task_class)
        self.phase = Phase.PUBLISH
        self._image.publish(task_class)
        self._account(task_class, release_ns)
        self.phase, self._context.release_ns, self._own_ns, self._aborted_at = outer

    def _run_tasks(self, task_class: TaskClass) -> None:
        place = self.classes.index(task_class)
        for task in task_class.tasks:
            if place:
                self._run_higher(place)
            if self.halted:
                return
            self._run_task(task_class, task)

    def _run_higher(self, place: int) -> None:
        """Run the classes before ``place`` that have been released meanwhile."""
        while self._goes_on():
            due = self._due(place)
            if due is None:
                return
            self._run_class(due)

    def _run_task(self, task_class: TaskClass, task: Task) -> None:
        clock = self._clock
        self._supervisor.started(task)
        start_ns, cpu_ns, waits = clock.now_ns(), clock.cpu_ns(), clock.waits()
        try:
            self.active = task
            task.cyclic()
            self.active = None
        except CycleTimeViolation as error:
            self.active = None
            self._aborted_at = self._place_of(error)
        except BaseException as error:  # whatever a program raises ends in SERVICE
            self.active = None
            self._supervisor.failed(task, error)
        used_ns = clock.cpu_ns() - cpu_ns
        end_ns = clock.now_ns()
        if clock.waits() != waits:
            used_ns = max(used_ns, end_ns - start_ns)
        task.execution.record(used_ns)
        self._own_ns += used_ns
        self._executions.record((task_class.number, task.name, start_ns, end_ns, used_ns))

    def _account(self, task_class: TaskClass, release_ns: int) -> None:
        """Record the cycle, lay the next release on the grid, judge an overrun."""
        end_ns = self._clock.now_ns()
        response_ns = end_ns - release_ns
        task_class.execution.record(self._own_ns)
        task_class.response.record(response_ns)
        task_class.release_ns = release_ns + task_class.cycle_ns
        if response_ns > task_class.cycle_ns or self._aborted_at:
            self._overrun(task_class, release_ns, end_ns)
        self._supervisor.finished(task_class)

    def _overrun(self, task_class: TaskClass, release_ns: int, end_ns: int) -> None:
        task_class.release_ns = release_ns
        next_ns = task_class.next_release_ns(end_ns)
        task_class.missed += (next_ns - release_ns) // task_class.cycle_ns - 1
        task_class.release_ns = next_ns
        limit_ns = task_class.cycle_ns + task_class.tolerance_ns
        if end_ns - release_ns <= limit_ns and not self._aborted_at:
            task_class.in_tolerance += 1
            return
        violation = self._judge(task_class, release_ns, end_ns, limit_ns)
        task_class.violations[violation.cause] += 1
        self._supervisor.violated(violation, task_class.policy_for(violation.cause))

    def _judge(
        self, task_class: TaskClass, release_ns: int, end_ns: int, limit_ns: int
    ) -> Violation:
        """Return the violation with its cause: who used more than the limit allows."""
        number = task_class.number
        recent = self._executions.between(release_ns, end_ns)
        others_ns = sum(share_ns for e, share_ns in recent if e.task_class != number)
        if self._own_ns > limit_ns or self._aborted_at:
            cause = Cause.PROGRAM
        elif self._own_ns + others_ns > limit_ns:
            cause = Cause.PREEMPTED
        else:
            cause = Cause.HOST
        suspects = [
            (share_ns, e.program)
            for e, share_ns in recent
            if (e.task_class != number) == (cause is Cause.PREEMPTED)
        ]
        return Violation(
            number,
            max(suspects, default=(0, ""))[1],
            task_class.cycles,
            cause,
            release_ns - self.origin_ns,
            end_ns - release_ns,
            self._own_ns,
            others_ns,
            limit_ns,
            self._aborted_at,
        )
