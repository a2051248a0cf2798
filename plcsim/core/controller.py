"""The controller: memory, programs in task classes, the scan, and what happens when one fails."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Protocol

from plcsim.core.clock import MonotonicClock, first_date_ns
from plcsim.core.control import Ending, Step
from plcsim.core.duration import format_duration
from plcsim.core.errors import ProgramError
from plcsim.core.forces import Forces
from plcsim.core.image import ProcessImage
from plcsim.core.logbook import Logbook, Severity
from plcsim.core.owners import Owners
from plcsim.core.retain import RetainedVariables
from plcsim.core.scan import Scan, ScanHeartbeat
from plcsim.core.system import Event, State, next_state
from plcsim.core.tag import TagTable
from plcsim.core.task import Cause, Policy, Task, TaskClass, Unit, Violation
from st_types.types.values import initial_image

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.core.clock import Clock
    from plcsim.core.context import Context
    from plcsim.core.control import Request
    from plcsim.core.tag import Tag

VIOLATIONS_KEPT = 100
"""Records of violations kept; all are counted."""


class Heartbeat(ScanHeartbeat, Protocol):
    """Who watches the controller from outside is told here."""

    def changed(self, state: State) -> None:
        """Note a new system state."""


class _Nobody:
    """The heartbeat of a controller that nobody watches."""

    def started(self, task: Task) -> None:
        pass

    def finished(self, task_class: TaskClass) -> None:
        pass

    def changed(self, state: State) -> None:
        pass


class Controller:
    """A controller with its programs.

    Call `boot`, then `run` as often as wanted, then `shutdown`.

    Args:
        classes: what runs on it; the variables of all tasks lie in the context's memory.
        context: what its programs and blocks work with.
        shared: the global variables and constants, as one tag each with the path "".
        exception_task: runs once for each violation under the policy "exception".
        clock: virtual or real; the real one by default.
        start_date_ns: date and time now, nanoseconds since 1970; None for that of the clock.
        heartbeat: told of every program that starts and every cycle that ends.
        idle: see `plcsim.core.scan.Scan`.

    Attributes:
        classes: in the order of their numbers.
        tasks: in configured order, that of the exception program last.
        areas: all variables of the controller: the global ones, then those of each program, as one
            tag each; constants apart.
        retained: those that keep their values over a warm restart.
        owners: which class owns which of them.
        forces: the forced ones.
        requests: acts asked for and not yet carried out, in order.
        origin_ns: when the controller was made; times in the logbook count from there.
        state: BOOT, RUN, SERVICE or STOPPED.
        fault: what led to SERVICE, None otherwise.
        stop_requested: `stop` was called since the last `boot`.
        violations: the latest records, at most `VIOLATIONS_KEPT`.
    """

    def __init__(
        self,
        classes: Sequence[TaskClass],
        context: Context,
        *,
        shared: Sequence[Tag] = (),
        exception_task: Task | None = None,
        clock: Clock | None = None,
        start_date_ns: int | None = None,
        heartbeat: Heartbeat | None = None,
        idle: Callable[[int], None] = lambda _idle_ns: None,
    ) -> None:
        self.clock = clock or MonotonicClock()
        self.context = context
        self.memory = context.memory
        self.logbook = Logbook()
        self.state = State.BOOT
        self.fault: ProgramError | Violation | None = None
        self.violations: list[Violation] = []
        self.owners = Owners(classes)
        self.forces = Forces(self.memory, self.owners)
        self.image = ProcessImage(self.forces)
        self._heartbeat = heartbeat or _Nobody()
        self.scan = Scan(classes, self.clock, context, self.image, self, self._heartbeat, idle)
        self.image.attach(self.scan)
        self.classes = self.scan.classes
        self._exception_task = exception_task
        self.tasks = [task for c in self.classes for task in c.tasks]
        if exception_task is not None:
            self.tasks.append(exception_task)
        for index, task in enumerate(self.tasks):
            task.index = index
        self.areas = (*shared, *(area for task in self.tasks for area in task.areas))
        self.tags = TagTable(self.memory, self.areas)
        self.retained = RetainedVariables(self.memory, self.areas)
        self.origin_ns = self.clock.now_ns()
        context.release_ns = self.origin_ns
        context.date_ns = first_date_ns(self.clock) if start_date_ns is None else start_date_ns
        context.give_settings(self)
        self.requests: deque[Request] = deque()
        self._violation_followers: list[Callable[[Violation], None]] = []
        self._ending_followers: list[Callable[[Ending], None]] = []
        self._step_followers: list[Callable[[Step, int, int], None]] = []
        self.stop_requested = False
        self._started = False

    @staticmethod
    def of(context: Context) -> Controller | None:
        """Return the controller that blocks run on, None where they run on none."""
        return context.settings(Controller)

    @property
    def running(self) -> tuple[TaskClass | None, Task | None]:
        """The task that runs now and its class; no class for the exception program."""
        task = self.scan.active
        return next((c for c in self.classes if task in c.tasks), None), task

    def boot(self, *, cold: bool = False) -> State:
        """Give all variables their initial values and run every INIT, in configured order.

        Retained variables get what they had before, or what was handed in before the first boot.

        Args:
            cold: only permanent variables keep what they had.

        Returns:
            RUN, or SERVICE where an INIT failed.

        Raises:
            StateError: the controller runs; call `shutdown` first.
        """
        is_restart = self.state is not State.BOOT
        if is_restart:
            self.retained.keep()
        if cold:
            self.retained.clear()
        self._about_to(Step.BOOT)
        if is_restart:
            self._enter(Event.RESTART)
            self.fault = None
            self.stop_requested = False
            self.context.restart()
        self.context.release_ns = self.clock.now_ns()  # INIT knows a time, as every cycle does
        self._heartbeat.changed(self.state)
        for area in self.areas:
            self.memory.write(area.address, initial_image(area.data_type))
        self.memory.restore()
        self.retained.restore()
        for task in self.tasks:
            task.resume()  # what a program has suspended runs again after a restart
        for task in self.tasks:
            self._run_unit(task, Unit.INIT)
            if self.state is not State.BOOT:
                return self.state
        self._enter(Event.INITIALISED)
        self._started = False  # the grid begins with `start`, after what the caller still has to do
        return self.state

    def start(self) -> None:
        """Lay the grids of all task classes from now on; `run` does it where nobody has.

        What takes time after `boot` is done before, so that it costs no grid points.
        """
        if not self._started:
            self._about_to(Step.START)
            self.scan.start()
            self._started = True

    def run(self, until_ns: int | None = None, cycles: int | None = None) -> State:
        """Run the scan until it is stopped or fails; for the limits see `Scan.run`."""
        if self.state is State.RUN:
            self.start()
            if self.stop_requested:  # by a signal that came before the scan had started
                self.scan.stop()
            self._about_to(Step.RUN, until_ns, cycles)
            self.scan.run(until_ns, cycles)
        return self.state

    def resume(self) -> None:
        """Go on after a pause: grid points that have passed meanwhile are not missed."""
        self._about_to(Step.RESUME)
        self.scan.resume()

    def close(self) -> None:
        """Let those who follow the controller end; nothing runs on it any more."""
        self._about_to(Step.CLOSE)

    def run_for(self, duration_ns: int) -> State:
        """Run the scan for ``duration_ns`` from now."""
        return self.run(until_ns=self.clock.now_ns() + duration_ns)

    def stop(self) -> None:
        """End `run` after the current cycle; a signal handler may call this."""
        self.stop_requested = True
        self._ask_to_end(Ending.STOP)

    def abort_program(self, reason: str) -> None:
        """End the program that is running, if one is, by CycleTimeViolation.

        Only a signal handler in the scan's own thread may call this.
        """
        if self.scan.active is None:
            self.memory.system.rearm()
        else:
            self.scan.active.interrupt(reason)

    def shutdown(self) -> State:
        """Run every EXIT, in configured order, and close what the libraries hold.

        Only in RUN: without INIT there is nothing to leave, and in SERVICE the programs are stopped
        where they failed.
        """
        self._about_to(Step.SHUTDOWN)
        if self.state is State.RUN:
            self._enter(Event.STOP)
            self.context.release_ns = self.clock.now_ns()
            for task in self.tasks:
                self._run_unit(task, Unit.EXIT)
        self.context.restart()
        return self.state

    def _run_unit(self, task: Task, unit: Unit) -> None:
        """Run INIT or EXIT of a task; a failure is logged and leads to SERVICE."""
        self._heartbeat.started(task)
        try:
            self.scan.active = task
            task.units[unit]()
            self.scan.active = None
        except BaseException as error:  # whatever a program raises ends in SERVICE
            self.scan.active = None
            self._program_failed(task, unit, error)

    def _enter(self, event: Event) -> None:
        self.state = next_state(self.state, event)
        self._heartbeat.changed(self.state)
        self.log(Severity.INFORMATION, "system", f"{self.state.name}: {event.value}")

    def request(self, request: Request) -> None:
        """Ask for an act, which whoever runs the controller carries out after this cycle."""
        self.requests.append(request)
        self._ask_to_end(Ending.PAUSE)

    def follow_violations(self, told: Callable[[Violation], None]) -> None:
        """Have ``told`` called with every violation from now on."""
        self._violation_followers.append(told)

    def follow_steps(self, told: Callable[[Step, int, int], None]) -> None:
        """Have ``told`` called before every step of the controller from now on.

        It gets the limits of a run as well: its end on the clock and its cycles, 0 for none.
        """
        self._step_followers.append(told)

    def follow_endings(self, told: Callable[[Ending], None]) -> None:
        """Have ``told`` called when a run is asked to end after its cycle, in any phase of it."""
        self._ending_followers.append(told)

    def end_run(self, ending: Ending) -> None:
        """End `run` after the current cycle."""
        if ending is Ending.STOP:
            self.scan.stop()
        else:
            self.scan.pause()

    def _ask_to_end(self, ending: Ending) -> None:
        self.end_run(ending)
        for told in self._ending_followers:
            told(ending)

    def _about_to(self, step: Step, until_ns: int | None = None, cycles: int | None = None) -> None:
        for told in self._step_followers:
            told(step, until_ns or 0, cycles or 0)

    def log(self, severity: Severity, source: str, text: str) -> None:
        """Write an entry of the logbook at the present time."""
        self.logbook.write(self.clock.stamp_ns() - self.origin_ns, severity, source, text)

    # what the scan tells (plcsim.core.scan.ScanListener)

    def failed(self, task: Task, error: BaseException) -> None:
        """Log what a program raised and go to SERVICE."""
        self._program_failed(task, Unit.CYCLIC, error)

    def violated(self, violation: Violation, policy: Policy) -> None:
        """Log a violation and do what the policy says; after a fault no program runs any more."""
        self.violations = [*self.violations[1 - VIOLATIONS_KEPT :], violation]
        for told in self._violation_followers:
            told(violation)
        severity = Severity.ERROR if policy is Policy.SERVICE else Severity.WARNING
        self.log(severity, f"task class {violation.task_class}", describe_violation(violation))
        if policy is Policy.SERVICE:
            self._go_to_service(violation)
        elif policy is Policy.EXCEPTION and self._exception_task and self.state is State.RUN:
            self.context.violation = violation
            self.scan.run_exception_program(self._exception_task)

    def _program_failed(self, task: Task, unit: Unit, error: BaseException) -> None:
        self.memory.system.rearm()  # or the next compiled program would be ended in its stead
        fault = ProgramError(task.name, unit.value, task.fault_of(error))
        fault.__cause__ = error
        self.log(Severity.ERROR, task.name, str(fault))
        self._go_to_service(fault)

    def _go_to_service(self, fault: ProgramError | Violation) -> None:
        self.scan.halt()
        if self.fault is None:  # the first one is the cause; an exception program may add others
            self.fault = fault
        if self.state is not State.SERVICE:
            self._enter(Event.FAULT)


def describe_violation(violation: Violation) -> str:
    """Return the record of a violation as one line."""
    text = {
        Cause.PROGRAM: f"program {violation.program} used {format_duration(violation.own_ns)}",
        Cause.PREEMPTED: (
            f"programs of other classes used {format_duration(violation.others_ns)}, "
            f"{violation.program} most"
        ),
        Cause.CONTROLLER: (
            f"LATCH and PUBLISH used {format_duration(violation.controller_ns)}, for what is read "
            "and written from outside"
        ),
        Cause.HOST: "the host did not give the CPU in time",
    }[violation.cause]
    if violation.location:
        text = f"program {violation.program} did not return, ended at {violation.location}"
    end = (
        f"ended {format_duration(violation.response_ns)} after its release, "
        f"limit {format_duration(violation.limit_ns)}"
    )
    if not violation.response_ns:  # only the watchdog, or Ctrl-C, ends a cycle in no time
        end = "the time limit was the watchdog's, as no virtual time passes while a program runs"
    return (
        f"cycle time violation in cycle {violation.cycle}, cause {violation.cause.value}: {text}; "
        f"{end}"
    )
