"""Programs, and the task classes they run in."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.statistics import Histogram

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.core.errors import Fault
    from plcsim.core.tag import Tag

LOWEST_CLASS = 1
HIGHEST_CLASS = 8


class Unit(Enum):
    """The three units of a program."""

    INIT = "INIT"
    CYCLIC = "CYCLIC"
    EXIT = "EXIT"


class Task:
    """A program under a name in a task class; two tasks of one program have two sets of variables.

    What it is written in shows nowhere but in what it is given.

    Attributes:
        name: as in plc.toml; the first part of the program's tags.
        variables: all variables of the program as one tag, its path the name of the task.
        areas: these, its constants where it has some, and what else it has of its own.
        units: what runs for INIT, CYCLIC and EXIT.
        fault_of: tells what something that a unit raised means, and where it was.
        interrupt: ends the unit that runs: it raises CycleTimeViolation with the given reason, at
            once or as soon as it can. Called by a signal handler in the scan's own thread, and only
            while a unit of this task runs.
        instructions: tells how many instructions of compiled code the controller's units have taken
            so far, where they are counted; None where not, or where there is none in this task.
        execution: CPU time of CYCLIC, one entry per cycle.
        index: number among all tasks of the controller, in configured order.
    """

    __slots__ = (
        "_suspended",
        "areas",
        "cyclic",
        "execution",
        "fault_of",
        "index",
        "instructions",
        "interrupt",
        "name",
        "units",
        "variables",
    )

    def __init__(
        self,
        name: str,
        variables: Tag,
        units: Mapping[Unit, Callable[[], None]],
        *,
        constants: Tag | None = None,
        more: Sequence[Tag] = (),
        fault_of: Callable[[BaseException], Fault],
        interrupt: Callable[[str], None],
        instructions: Callable[[], int] | None = None,
    ) -> None:
        self.name = name
        self.variables = variables
        self.areas = (variables, *(() if constants is None else (constants,)), *more)
        self.units = units
        self.cyclic = units[Unit.CYCLIC]
        self._suspended: Callable[[], None] | None = None
        self.fault_of = fault_of
        self.interrupt = interrupt
        self.instructions = instructions
        self.execution = Histogram()
        self.index = 0

    @property
    def is_suspended(self) -> bool:
        """Whether CYCLIC is left out."""
        return self._suspended is not None

    def suspend(self) -> None:
        """Leave CYCLIC out from the next cycle on."""
        if self._suspended is None:
            self._suspended, self.cyclic = self.cyclic, _nothing

    def resume(self) -> None:
        """Run CYCLIC again from the next cycle on."""
        if self._suspended is not None:
            self.cyclic, self._suspended = self._suspended, None


def _nothing() -> None:
    """Stand for the CYCLIC of a task that is suspended."""


class Cause(Enum):
    """Who is to blame for a cycle that took too long."""

    PROGRAM = "program"
    HOST = "host"
    PREEMPTED = "preempted"
    CONTROLLER = "controller"


class Policy(Enum):
    """What a cycle time violation leads to."""

    SERVICE = "service"
    LOG = "log"
    EXCEPTION = "exception"


class Violation(NamedTuple):
    """One cycle that ended later than cycle time plus tolerance after its release.

    Attributes:
        task_class: number of the task class.
        program: the program that used most of the time, "" where none ran.
        cycle: number of the cycle in its class, from 1.
        cause: the class' own programs, programs of other classes, the controller, or the host.
        release_ns: grid point the cycle belonged to, since the start of the scan.
        response_ns: from the release to the end of the cycle.
        own_ns: CPU time of the class' own programs; wall time of those that waited.
        others_ns: CPU time of programs of other classes between release and end.
        controller_ns: CPU time of LATCH and PUBLISH of all classes between release and end.
        limit_ns: cycle time plus tolerance.
        location: "file:line" where a program that did not return was ended, "" otherwise.
    """

    task_class: int
    program: str
    cycle: int
    cause: Cause
    release_ns: int
    response_ns: int
    own_ns: int
    others_ns: int
    controller_ns: int
    limit_ns: int
    location: str = ""


class TaskClass:
    """A task class: a cycle time, a tolerance, and tasks that run one after another.

    Attributes:
        number: 1 to 8; the lower number goes first.
        cycle_ns: time between releases.
        tolerance_ns: how much longer a cycle may take before it is a violation.
        first_release_ns: from the start of the scan to the first release; half the cycle time on
            the controller.
        policy: what a violation by a program leads to.
        host_policy: what a violation by the host or the controller leads to.
        tasks: in configured order.
        release_ns: the next grid point, on the controller's clock.
        cycles: cycles begun.
        missed: grid points skipped because a cycle was still running.
        in_tolerance: cycles that took longer than the cycle time, but not than the tolerance.
        violations: number of violations by cause.
        lateness: from the release to the start of the cycle.
        execution: CPU time of all programs of one cycle.
        controller: CPU time of LATCH and PUBLISH of one cycle.
        response: from the release to the end of the cycle.
    """

    def __init__(
        self,
        number: int,
        cycle_ns: int,
        tolerance_ns: int,
        tasks: Sequence[Task],
        *,
        first_release_ns: int | None = None,
        policy: Policy = Policy.SERVICE,
        host_policy: Policy = Policy.LOG,
    ) -> None:
        if not LOWEST_CLASS <= number <= HIGHEST_CLASS:
            raise ValueError(f"task class {number} is outside {LOWEST_CLASS}..{HIGHEST_CLASS}")
        if cycle_ns <= 0:
            raise ValueError(f"task class {number}: the cycle time must be above 0")
        first_release_ns = cycle_ns // 2 if first_release_ns is None else first_release_ns
        for what, duration_ns in ("tolerance", tolerance_ns), ("first release", first_release_ns):
            if duration_ns < 0:
                raise ValueError(f"task class {number}: the {what} must not be below 0")
        self.number = number
        self.cycle_ns = cycle_ns
        self.tolerance_ns = tolerance_ns
        self.tasks = tuple(tasks)
        self.first_release_ns = first_release_ns
        self.policy = policy
        self.host_policy = host_policy
        self.release_ns = 0
        self.cycles = 0
        self.missed = 0
        self.in_tolerance = 0
        self.violations = dict.fromkeys(Cause, 0)
        self.lateness = Histogram()
        self.execution = Histogram()
        self.controller = Histogram()
        self.response = Histogram()
        self._used_ns: dict[Task | None, int] = {}

    def policy_for(self, cause: Cause) -> Policy:
        """Return what a violation by ``cause`` leads to; only programs answer for theirs."""
        return self.host_policy if cause in (Cause.HOST, Cause.CONTROLLER) else self.policy

    def lay_grid(self, origin_ns: int) -> None:
        """Go to the first release of a scan that starts at ``origin_ns``."""
        self.release_ns = origin_ns + self.first_release_ns
        self._used_ns.clear()

    def note_use(self, task: Task | None, start_ns: int, end_ns: int, used_ns: int) -> None:
        """Note what a program used after the release of this class; before it, it took nothing.

        Args:
            task: of any class, None for LATCH and PUBLISH.
            start_ns: when it ran, on the controller's clock.
            end_ns: until when.
            used_ns: CPU time used between the two.
        """
        release_ns = self.release_ns
        # Comparisons, not max() and min(): this runs for each program and class in every cycle.
        overlap_ns = end_ns - (start_ns if start_ns > release_ns else release_ns)
        if overlap_ns > 0:
            noted_ns = used_ns if used_ns < overlap_ns else overlap_ns
            self._used_ns[task] = self._used_ns.get(task, 0) + noted_ns

    def used_by_own_and_others(self) -> tuple[dict[Task, int], dict[Task, int], int]:
        """Return what the class' own programs, those of others and LATCH and PUBLISH have used."""
        own: dict[Task, int] = {}
        others: dict[Task, int] = {}
        for task, ns in self._used_ns.items():
            if task is not None:
                (own if task in self.tasks else others)[task] = ns
        return own, others, self._used_ns.get(None, 0)

    def skip_to(self, now_ns: int) -> None:
        """Go to the first grid point that has not passed, without missing any."""
        # Rounded up: a point at this very moment has not passed.
        passed = -(-(now_ns - self.release_ns) // self.cycle_ns)
        if passed > 0:
            self.release_ns += passed * self.cycle_ns
        self._used_ns.clear()

    def advance(self, end_ns: int) -> None:
        """Go to the first grid point after the current one that is not before ``end_ns``.

        The points in between are missed.
        """
        self._used_ns.clear()
        if end_ns <= self.release_ns + self.cycle_ns:  # on the point itself is in time
            self.release_ns += self.cycle_ns
            return
        passed = -(-(end_ns - self.release_ns) // self.cycle_ns)
        self.release_ns += passed * self.cycle_ns
        self.missed += passed - 1
