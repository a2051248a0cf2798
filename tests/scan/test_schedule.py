"""Any schedule of task classes keeps grid and order, and its figures add up.

Random task classes with random costs run on the virtual clock, the host oversleeps now and then.
The trace of what ran when is then held against the rules of docs/timing-model.md, written down here
a second time.
"""

from itertools import pairwise
from typing import NamedTuple

from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.clock import VirtualClock
from plcsim.core.memory import PAGE
from plcsim.core.task import Cause, Policy
from plcsim.program.python.language import PythonCode
from plcsim.program.python.program import Program
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller

MS = 1_000_000
HORIZON_NS = 60 * MS


class Plan(NamedTuple):
    """A task class; each program has what its cycles do, over and over, as (kind, ms)."""

    number: int
    cycle_ns: int
    tolerance_ns: int
    first_release_ns: int | None
    programs: list

    @property
    def first_ns(self):
        return self.cycle_ns // 2 if self.first_release_ns is None else self.first_release_ns


class Ran(NamedTuple):
    """One run of one program; ``used_ns`` is what it is to blame for."""

    number: int
    program: int
    release_ns: int
    start_ns: int
    end_ns: int
    used_ns: int


class Cycle(NamedTuple):
    """One cycle; ``begun`` and ``ended`` count what had run by then."""

    number: int
    release_ns: int
    start_ns: int
    end_ns: int
    begun: int
    ended: int


costs = st.tuples(st.sampled_from(["spend", "spend", "stall", "wait"]), st.integers(0, 15))
plans = st.builds(
    Plan,
    number=st.integers(1, 8),
    cycle_ns=st.integers(1, 12).map(lambda ms: ms * MS),
    tolerance_ns=st.integers(0, 10).map(lambda ms: ms * MS),
    first_release_ns=st.none() | st.integers(0, 20).map(lambda ms: ms * MS),
    programs=st.lists(st.lists(costs, min_size=1, max_size=4), min_size=1, max_size=3),
)
schedules = st.lists(plans, min_size=1, max_size=4, unique_by=lambda plan: plan.number)
oversleeps = st.lists(st.integers(0, 30), min_size=1, max_size=5)


class OversleepingClock(VirtualClock):
    """A host that wakes the scan late by these milliseconds, over and over."""

    def __init__(self, late_ms):
        super().__init__()
        self._late_ms = late_ms
        self._sleeps = 0

    def sleep_until_ns(self, until_ns):
        super().sleep_until_ns(until_ns + self._late_ms[self._sleeps % len(self._late_ms)] * MS)
        self._sleeps += 1


class Play:
    """Runs a schedule and keeps its trace; times are since the start of the scan."""

    def __init__(self, schedule, late_ms=(0,)):
        self.clock = OversleepingClock(late_ms)
        self.origin_ns = self.clock.now_ns()
        self.ran = []
        self.cycles = []
        self._open = []
        self.controller = make_controller(
            Setup([self._setup(plan) for plan in schedule], memory_size=16 * PAGE),
            network=None,
            clock=self.clock,
        )
        self.controller.image.inputs.append(self._latch)
        self.controller.image.watchers.append(self._publish)
        self.controller.boot()

    def _setup(self, plan):
        programs = [
            ProgramSetup(
                f"p{plan.number}_{index}", PythonCode(self._program(plan.number, index, costs))
            )
            for index, costs in enumerate(plan.programs)
        ]
        return TaskClassSetup(
            plan.number,
            plan.cycle_ns,
            programs,
            tolerance_ns=plan.tolerance_ns,
            first_release_ns=plan.first_release_ns,
            policy=Policy.LOG,
        )

    def _program(self, number, place, costs):
        cycles = iter(range(1_000_000))

        def cyclic(program):
            start_ns = self.now_ns
            kind, cost_ms = costs[next(cycles) % len(costs)]
            getattr(self.clock, f"{kind}_ns")(cost_ms * MS)
            release_ns = program.context.release_ns - self.origin_ns
            used_ns = 0 if kind == "stall" else cost_ms * MS
            self.ran.append(Ran(number, place, release_ns, start_ns, self.now_ns, used_ns))

        return type("Planned", (Program,), {"cyclic": cyclic})

    @property
    def now_ns(self):
        return self.clock.now_ns() - self.origin_ns

    def _latch(self, _):
        self._open.append((self.now_ns, len(self.ran)))

    def _publish(self, task_class):
        start_ns, begun = self._open.pop()
        release_ns = self.controller.context.release_ns - self.origin_ns
        cycle = (task_class.number, release_ns, start_ns, self.now_ns, begun, len(self.ran))
        self.cycles.append(Cycle(*cycle))

    def of(self, plan):
        """The cycles of a class, in order."""
        return [cycle for cycle in self.cycles if cycle.number == plan.number]

    def task_class(self, plan):
        return next(c for c in self.controller.classes if c.number == plan.number)


def check_grid(play, plan):
    """Releases are the first grid points not before the end of the cycle before."""
    cycles = play.of(plan)
    releases = [cycle.release_ns for cycle in cycles]
    releases.append(play.task_class(plan).release_ns - play.origin_ns)
    assert releases[0] == plan.first_ns
    for cycle, following_ns in zip(cycles, releases[1:], strict=True):
        assert (following_ns - plan.first_ns) % plan.cycle_ns == 0
        assert following_ns >= max(cycle.end_ns, cycle.release_ns + plan.cycle_ns)
        assert following_ns - plan.cycle_ns <= max(cycle.end_ns - 1, cycle.release_ns)
        assert cycle.start_ns >= cycle.release_ns


def check_counts(play, plan):
    """Every grid point passed was either a cycle or missed; overruns are counted by the limit."""
    found, cycles = play.task_class(plan), play.of(plan)
    passed = (found.release_ns - play.origin_ns - plan.first_ns) // plan.cycle_ns
    assert found.cycles == len(cycles)
    assert found.cycles + found.missed == passed
    responses_ns = [cycle.end_ns - cycle.release_ns for cycle in cycles]
    limit_ns = plan.cycle_ns + plan.tolerance_ns
    assert found.in_tolerance == sum(plan.cycle_ns < ns <= limit_ns for ns in responses_ns)
    assert found.response.maximum_ns == max(responses_ns, default=0)
    late_ns = [cycle.start_ns - cycle.release_ns for cycle in cycles]
    assert found.lateness.maximum_ns == max(late_ns, default=0)
    causes = [cause_of(play, plan, cycle, limit_ns) for cycle in cycles]
    assert found.violations == {cause: causes.count(cause) for cause in Cause}


def cause_of(play, plan, cycle, limit_ns):
    """Who is to blame for a cycle, None where nobody is: by all that ran after its release."""
    if cycle.end_ns - cycle.release_ns <= limit_ns:
        return None
    own_ns = others_ns = 0
    for ran in play.ran[: cycle.ended]:
        overlap_ns = max(0, min(ran.end_ns, cycle.end_ns) - max(ran.start_ns, cycle.release_ns))
        share_ns = min(ran.used_ns, overlap_ns)
        if ran.number == plan.number:
            own_ns += share_ns
        else:
            others_ns += share_ns
    if own_ns > limit_ns:
        return Cause.PROGRAM
    return Cause.PREEMPTED if own_ns + others_ns > limit_ns else Cause.HOST


def check_programs(play, plan):
    """In each cycle every program of the class ran once, in order."""
    for cycle in play.of(plan):
        inside = play.ran[cycle.begun : cycle.ended]
        own = [ran for ran in inside if ran.number == plan.number]
        assert [ran.program for ran in own] == list(range(len(plan.programs)))
        assert all(ran.release_ns == cycle.release_ns for ran in own)
        assert all(ran.number <= plan.number for ran in inside)
        assert all(a.end_ns <= b.start_ns for a, b in pairwise(inside))


def check_order(play, plan):
    """No program starts while a class of lower number is released and has not begun.

    Once the run is to end, cycles that have begun are finished all the same.
    """
    for cycle in play.of(plan):
        earlier = play.ran[: cycle.begun]
        assert not [
            ran for ran in earlier if ran.number > plan.number and cycle.release_ns <= ran.start_ns
        ]


@given(schedules, oversleeps)
def test_any_schedule_keeps_grid_and_order(schedule, late_ms):
    play = Play(schedule, late_ms)
    play.controller.run_for(HORIZON_NS)
    for plan in schedule:
        check_grid(play, plan)
        check_counts(play, plan)
        check_programs(play, plan)
        check_order(play, plan)


@given(schedules)
def test_the_scan_never_idles_while_a_class_is_released(schedule):
    play = Play(schedule)
    play.controller.run_for(HORIZON_NS)
    busy_until = {ran.end_ns for ran in play.ran}
    for cycle in play.cycles:
        assert cycle.start_ns == cycle.release_ns or cycle.start_ns in busy_until
    for plan in schedule:
        assert play.task_class(plan).release_ns - play.origin_ns >= HORIZON_NS


@given(plans, st.lists(st.integers(0, 40), min_size=1, max_size=4))
def test_a_run_of_one_class_in_stretches_is_a_run_in_one(plan, stretches_ms):
    in_one, in_stretches = Play([plan]), Play([plan])
    for duration_ms in stretches_ms:
        in_stretches.controller.run_for(duration_ms * MS)
        in_stretches.controller.run(cycles=1)
    in_one.controller.run(cycles=in_stretches.controller.classes[0].cycles)
    assert in_one.ran == in_stretches.ran
    assert in_one.cycles == in_stretches.cycles
