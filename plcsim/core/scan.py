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

from plcsim.core.errors import CycleTimeViolation, PhaseError
from plcsim.core.system_area import RELEASE
from plcsim.core.task import Cause, Policy, TaskClass, Violation

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.core.clock import Clock
    from plcsim.core.context import Context
    from plcsim.core.task import Task

_NEVER = 1 << 63
"""Later than every time and more than every count."""


class Phase(Enum):
    """What the scan is doing, and so what may be done."""

    SLEEP = "SLEEP"
    LATCH = "LATCH"
    RUN = "RUN"
    PUBLISH = "PUBLISH"


_LATCH, _RUN, _PUBLISH = Phase.LATCH, Phase.RUN, Phase.PUBLISH  # an Enum is slow to ask


class ScanImage(Protocol):
    """What moves values in and out around a cycle (`plcsim.core.image`)."""

    def latch(self, task_class: TaskClass) -> None:
        """Bring inputs in; called in LATCH."""

    def publish(self, task_class: TaskClass) -> None:
        """Give outputs out; called in PUBLISH."""


class ScanHeartbeat(Protocol):
    """Who watches the scan is told here, in every cycle."""

    def started(self, task: Task) -> None:
        """Note that ``task`` is about to run a unit."""

    def finished(self, task_class: TaskClass) -> None:
        """Note that a cycle of ``task_class`` has ended and its figures are up to date."""


class ScanListener(Protocol):
    """Who decides what a fault leads to."""

    def failed(self, task: Task, error: BaseException) -> None:
        """Handle what a program raised."""

    def violated(self, violation: Violation, policy: Policy) -> None:
        """Handle a cycle time violation."""


class RunFollower(Protocol):
    """Who is told when each program and each cycle ran; durations and times as in `Scan`."""

    def ran(self, task: Task, start_ns: int, end_ns: int, used_ns: int) -> None:
        """Note a run of CYCLIC and the CPU time it used."""

    def cycled(self, task_class: TaskClass, start_ns: int, end_ns: int) -> None:
        """Note a cycle, before its class goes to the next release."""


class Scan:
    """The loop over task classes.

    Args:
        classes: the task classes, in any order.
        clock: virtual or real.
        context: its ``release_ns`` is set before programs run.
        image: called in LATCH and PUBLISH.
        supervisor: told of everything that goes wrong.
        heartbeat: told of every program that starts and every cycle that ends.
        idle: called in SLEEP with the nanoseconds until the next release, for what must not cost a
            cycle its time.

    Attributes:
        classes: in order.
        phase: what the scan is doing.
        in_cycle: classes whose cycle has begun and not ended; the last one runs, the others are
            preempted.
        active: the program that runs, None while none does.
        origin_ns: when the grids were laid.
        run_follower: told of every run, None for nobody.
        idlers: called in SLEEP with the nanoseconds until the next release; `idle` is the first.
    """

    def __init__(
        self,
        classes: Sequence[TaskClass],
        clock: Clock,
        context: Context,
        image: ScanImage,
        supervisor: ScanListener,
        heartbeat: ScanHeartbeat,
        idle: Callable[[int], None],
    ) -> None:
        numbers = sorted(c.number for c in classes)
        if not numbers or len(set(numbers)) < len(numbers):
            raise ValueError(f"task classes {numbers}: at least one, each number once")
        self.classes = sorted(classes, key=lambda c: c.number)
        self.phase = Phase.SLEEP
        self.in_cycle: list[TaskClass] = []
        self.running = False
        self.halted = False
        self.paused = False
        self.active: Task | None = None
        self.origin_ns = 0
        self._clock = clock
        self._context = context
        self._cells = context.memory.system.cells  # what `Context.release_ns` reads and sets
        self._image = image
        self._supervisor = supervisor
        self._heartbeat = heartbeat
        self.run_follower: RunFollower | None = None
        self.idlers = [idle]
        self._own_ns = 0
        self._elsewhere_ns = 0
        self._aborted: tuple[Task, str] | None = None
        self._end_ns = _NEVER
        self._last_cycle = _NEVER

    def require(self, phase: Phase) -> None:
        """Raise PhaseError unless the scan is in ``phase``."""
        if self.phase is not phase:
            raise PhaseError(f"not allowed in {self.phase.value}, only in {phase.value}")

    def start(self) -> None:
        """Lay the grids of all classes from now on."""
        self.origin_ns = self._clock.now_ns()
        for task_class in self.classes:
            task_class.lay_grid(self.origin_ns)
        self.running = True
        self.halted = False

    def stop(self) -> None:
        """End `run` after the current cycle; may be called by a signal handler."""
        self.running = False

    def pause(self) -> None:
        """End this `run` after the current cycle; the next `run` goes on from there."""
        self.paused = True

    def resume(self) -> None:
        """Go on after a pause: grid points that have passed meanwhile are not missed."""
        now_ns = self._clock.now_ns()
        for task_class in self.classes:
            task_class.skip_to(now_ns)

    def halt(self) -> None:
        """End `run` at once: no other program starts any more."""
        self.running = False
        self.halted = True

    def run(self, until_ns: int | None = None, cycles: int | None = None) -> None:
        """Run until stopped or paused, until a time, or for cycles of the first class.

        A cycle that has begun is finished, but nothing preempts it any more once the run is to end:
        under overload that might go on for ever.

        Args:
            until_ns: releases at or after this time of the clock are not run.
            cycles: cycles of the class with the lowest number, counted from now.

        Raises:
            PhaseError: a program called this.
        """
        self.require(Phase.SLEEP)
        self.paused = False
        self._end_ns = _NEVER if until_ns is None else until_ns
        self._last_cycle = _NEVER if cycles is None else self.classes[0].cycles + cycles
        while self._goes_on():
            now_ns = self._clock.now_ns()
            wake_ns = self._end_ns
            # One pass finds the first class that is due, or the earliest release: the classes stand
            # in the order of their priority, and this loop is what an idle scan costs.
            for task_class in self.classes:
                if task_class.release_ns < wake_ns:
                    wake_ns = task_class.release_ns
                    if wake_ns <= now_ns:
                        self._run_class(task_class)
                        break
            else:
                if wake_ns == self._end_ns and now_ns >= wake_ns:
                    return  # not before: who runs for a second of real time wants to wait for it
                for idle in self.idlers:
                    idle(wake_ns - now_ns)
                self._clock.sleep_until_ns(wake_ns)

    def _goes_on(self) -> bool:
        """Return whether another cycle may start."""
        return self.running and not self.paused and self.classes[0].cycles < self._last_cycle

    def _run_class(self, task_class: TaskClass) -> None:
        """Run one cycle of a class; what it interrupts goes on as it was."""
        cells, clock, image = self._cells, self._clock, self._image
        # A class that preempts runs inside the RUN of another one, whose programs must find their
        # release time, and whose figures must go on, as if nothing had been.
        outer = self.phase, cells[RELEASE], self._own_ns, self._aborted
        elsewhere_ns = self._elsewhere_ns
        cells[RELEASE] = task_class.release_ns
        self._own_ns = self._elsewhere_ns = 0
        self._aborted = None
        start_ns = clock.now_ns()
        task_class.lateness.record(start_ns - task_class.release_ns)
        task_class.cycles += 1
        self.in_cycle.append(task_class)
        cpu_ns = clock.cpu_ns()
        try:
            self.phase = _LATCH
            image.latch(task_class)
            self.phase = _RUN
            self._run_tasks(task_class)
            self.phase = _PUBLISH
            image.publish(task_class)
            used_ns = clock.cpu_ns() - cpu_ns
            # What is neither a program's nor a preempting class' is that of LATCH and PUBLISH.
            self._account(task_class, start_ns, used_ns - self._elsewhere_ns)
            elsewhere_ns += used_ns
        finally:
            self.in_cycle.pop()
            self.phase, cells[RELEASE], self._own_ns, self._aborted = outer
            self._elsewhere_ns = elsewhere_ns

    def _run_tasks(self, task_class: TaskClass) -> None:
        order = self.classes.index(task_class)
        for task in task_class.tasks:
            if order:  # between two programs and never inside one: a program is never interrupted
                self._run_higher(order)
            if self.halted:
                return
            error = self._run_task(task)
            if error is not None:  # judged with the cycle, so that there is one record of both
                self._aborted = task, task.fault_of(error).location

    def _run_higher(self, below: int) -> None:
        """Run the first ``below`` classes in order that have been released meanwhile."""
        while self._goes_on():
            due = self._due(below)
            if due is None:
                return
            self._run_class(due)

    def _due(self, below: int) -> TaskClass | None:
        """Return the first released class among the first ``below``."""
        now_ns = self._clock.now_ns()
        for task_class in self.classes[:below]:
            if task_class.release_ns <= now_ns and task_class.release_ns < self._end_ns:
                return task_class
        return None

    def run_exception_program(self, task: Task) -> None:
        """Run a program of no task class, for a violation; it is measured, but has no limit."""
        outer = self.phase
        self.phase = Phase.RUN
        error = self._run_task(task)
        if error is not None:
            self._supervisor.failed(task, error)
        self.phase = outer

    def _run_task(self, task: Task) -> CycleTimeViolation | None:
        """Run CYCLIC of a program; return the error by which the watchdog ended it."""
        clock = self._clock
        ended: CycleTimeViolation | None = None
        self._heartbeat.started(task)
        start_ns, cpu_ns, waits = clock.now_ns(), clock.cpu_ns(), clock.waits()
        try:
            self.active = task
            task.cyclic()
            self.active = None  # first of all: a signal of the watchdog that comes now is too late
        except CycleTimeViolation as error:
            self.active = None
            self._context.memory.system.rearm()
            ended = error
        except BaseException as error:  # whatever a program raises ends in SERVICE
            self.active = None
            self._supervisor.failed(task, error)
        used_ns = clock.cpu_ns() - cpu_ns
        self._elsewhere_ns += used_ns
        end_ns = clock.now_ns()
        if clock.waits() != waits:  # it waited itself: CPU time would acquit a program that sleeps
            used_ns = max(used_ns, end_ns - start_ns)
        task.execution.record(used_ns)
        if self.run_follower is not None:
            self.run_follower.ran(task, start_ns, end_ns, used_ns)
        self._own_ns += used_ns
        if end_ns > start_ns:  # on the virtual clock it seldom is
            for task_class in self.classes:
                task_class.note_use(task, start_ns, end_ns, used_ns)
        return ended

    def _account(self, task_class: TaskClass, start_ns: int, controller_ns: int) -> None:
        """Record the cycle, lay the next release on the grid, judge an overrun.

        Args:
            task_class: whose cycle has ended.
            start_ns: of the cycle.
            controller_ns: CPU time that LATCH and PUBLISH used.
        """
        end_ns = self._clock.now_ns()
        response_ns = end_ns - task_class.release_ns
        task_class.execution.record(self._own_ns)
        task_class.controller.record(controller_ns)
        task_class.response.record(response_ns)
        if controller_ns:
            for each in self.classes:
                each.note_use(None, start_ns, end_ns, controller_ns)
        violation = None
        if response_ns > task_class.cycle_ns + task_class.tolerance_ns or self._aborted:
            violation = self._judge(task_class, response_ns)
            task_class.violations[violation.cause] += 1
        elif response_ns > task_class.cycle_ns:
            task_class.in_tolerance += 1
        if self.run_follower is not None:
            self.run_follower.cycled(task_class, start_ns, end_ns)
        task_class.advance(end_ns)  # before the exception program, whose time is not this cycle's
        if violation is not None:
            self._supervisor.violated(violation, task_class.policy_for(violation.cause))
        self._heartbeat.finished(task_class)

    def _judge(self, task_class: TaskClass, response_ns: int) -> Violation:
        """Return the violation with its cause: who used more than the limit allows."""
        limit_ns = task_class.cycle_ns + task_class.tolerance_ns
        own, others, controller_ns = task_class.used_by_own_and_others()
        own_ns, others_ns = sum(own.values()), sum(others.values())
        # From the nearest to the farthest: each has to explain the whole excess together with those
        # before it; what nobody here has used the host has taken.
        if own_ns > limit_ns or self._aborted:
            cause = Cause.PROGRAM
        elif own_ns + others_ns > limit_ns:
            cause = Cause.PREEMPTED
        elif own_ns + others_ns + controller_ns > limit_ns:
            cause = Cause.CONTROLLER
        else:
            cause = Cause.HOST
        suspects = others if cause is Cause.PREEMPTED else own
        suspect = max(suspects, key=suspects.__getitem__, default=None)
        task, location = self._aborted or (suspect, "")
        return Violation(
            task_class=task_class.number,
            program=task.name if task else "",
            cycle=task_class.cycles,
            cause=cause,
            release_ns=task_class.release_ns - self.origin_ns,
            response_ns=response_ns,
            own_ns=own_ns,
            others_ns=others_ns,
            controller_ns=controller_ns,
            limit_ns=limit_ns,
            location=location,
        )
