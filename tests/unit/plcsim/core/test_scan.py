"""The loop over task classes: grid, order, phases, preemption, overruns and who is to blame."""

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.errors import Fault, PhaseError
from plcsim.core.scan import Phase
from plcsim.core.system import State
from plcsim.core.task import Cause, Policy

MS = 1_000_000


def log_only(tolerance_ms=0, first_release_ms=None):
    """Settings under which no violation ends the run."""
    settings = {"policy": Policy.LOG, "tolerance_ns": tolerance_ms * MS}
    if first_release_ms is not None:
        settings["first_release_ns"] = first_release_ms * MS
    return settings


class Trace:
    """What ran when, in milliseconds since the start: (program, release, start)."""

    def __init__(self, clock, program_of):
        self.entries = []
        self._clock = clock
        self._program_of = program_of
        self._origin_ns = clock.now_ns()

    def program(self, name, *costs_ms):
        """A program whose cycles use these milliseconds of CPU time, over and over."""
        cycles = iter(range(1_000_000))

        def cyclic(program):
            release_ns = program.context.release_ns - self._origin_ns
            start_ns = self._clock.now_ns() - self._origin_ns
            self.entries.append((name, release_ns / MS, start_ns / MS))
            if costs_ms:
                self._clock.spend_ns(int(costs_ms[next(cycles) % len(costs_ms)] * MS))

        return self._program_of(cyclic)

    def releases_ms(self, name):
        return [release for program, release, _ in self.entries if program == name]


@pytest.fixture
def trace(clock, program_of):
    return Trace(clock, program_of)


# the grid


def test_releases_start_at_half_the_cycle_and_stay_on_the_grid(run_for, task_class, trace):
    run_for(50, task_class(1, 10, p=trace.program("p", 0, 3, 9)))
    assert trace.entries == [("p", t, t) for t in (5, 15, 25, 35, 45)]


def test_the_first_release_can_be_set(run_for, task_class, trace):
    settings = {"first_release_ns": 0}
    run_for(21, task_class(1, 10, settings, p=trace.program("p")))
    assert trace.releases_ms("p") == [0, 10, 20]


def test_a_cycle_as_long_as_the_cycle_time_misses_nothing(run_for, task_class, trace):
    controller = run_for(100, task_class(1, 10, p=trace.program("p", 10)))
    assert trace.releases_ms("p") == [5, 15, 25, 35, 45, 55, 65, 75, 85, 95]
    scanned = controller.classes[0]
    assert (scanned.missed, scanned.in_tolerance, sum(scanned.violations.values())) == (0, 0, 0)


def test_missed_grid_points_are_skipped_and_counted(run_for, task_class, trace):
    program = trace.program("p", 16.5)
    controller = run_for(100, task_class(1, 10, log_only(tolerance_ms=10), p=program))
    assert trace.releases_ms("p") == [5, 25, 45, 65, 85]
    assert controller.classes[0].missed == 5
    assert controller.classes[0].in_tolerance == 5


def test_a_long_stall_is_not_caught_up_in_a_burst(run_for, task_class, trace):
    program = trace.program("p", 0, 43, 0, 0, 0, 0, 0)
    controller = run_for(100, task_class(1, 10, log_only(), p=program))
    assert trace.entries == [("p", t, t) for t in (5, 15, 65, 75, 85, 95)]
    assert controller.classes[0].missed == 4


def test_a_late_wake_up_is_recorded_and_does_not_move_the_grid(task_class, make_controller, trace):
    class LateClock(VirtualClock):
        def sleep_until_ns(self, until_ns):
            super().sleep_until_ns(until_ns + 2 * MS)

    late = LateClock(trace._origin_ns)
    trace._clock = late
    controller = make_controller(task_class(1, 10, p=trace.program("p")), clock=late)
    controller.boot()
    controller.run(cycles=3)
    assert trace.entries == [("p", 5, 7), ("p", 15, 17), ("p", 25, 27)]
    assert controller.classes[0].lateness.maximum_ns == 2 * MS
    assert controller.classes[0].lateness.minimum_ns == 2 * MS


# the end of a run


def test_a_release_at_the_end_of_the_run_is_left_for_the_next(run_for, task_class, trace, clock):
    controller = run_for(15, task_class(1, 10, p=trace.program("p")))
    assert trace.releases_ms("p") == [5]
    assert clock.now_ns() - trace._origin_ns == 15 * MS
    controller.run_for(10 * MS)
    assert trace.entries == [("p", 5, 5), ("p", 15, 15)]


def test_a_run_ends_though_a_class_before_one_that_is_due_is_beyond_the_end(
    run_for, task_class, trace
):
    programs = [trace.program("first"), trace.program("second"), trace.program("third", 11)]
    run_for(
        20,
        task_class(1, 10, {"first_release_ns": 10 * MS}, first=programs[0]),
        task_class(2, 20, {"first_release_ns": 12 * MS}, second=programs[1]),
        task_class(3, 20, {"first_release_ns": 11 * MS}, third=programs[2]),
    )
    assert trace.entries == [("first", 10, 10), ("third", 11, 11), ("second", 12, 22)]


def test_preempting_releases_after_the_end_do_not_run(run_for, task_class, trace):
    programs = {"a": trace.program("a", 6), "b": trace.program("b", 6)}
    run_for(
        12,
        task_class(1, 10, first=trace.program("first")),
        task_class(2, 20, **programs),
    )
    assert trace.entries == [("first", 5, 5), ("a", 10, 10), ("b", 10, 16)]


def test_a_number_of_cycles_holds_for_preempting_cycles_too(make_controller, task_class, trace):
    programs = {name: trace.program(name, 11) for name in "abc"}
    controller = make_controller(
        task_class(1, 10, log_only(), first=trace.program("first")),
        task_class(2, 100, log_only(first_release_ms=5), **programs),
    )
    controller.boot()
    controller.run(cycles=2)
    assert controller.classes[0].cycles == 2


def test_the_clock_stands_at_the_end_of_the_run(run_for, task_class, trace, clock):
    run_for(3, task_class(1, 10, p=trace.program("p")))
    assert trace.entries == []
    assert clock.now_ns() == trace._origin_ns + 3 * MS


def test_a_program_cannot_run_the_scan(make_controller, task_class, program_of):
    programs = task_class(1, 10, p=program_of(lambda _: controller.run(cycles=1)))
    controller = make_controller(programs)
    controller.boot()
    assert controller.run(cycles=3) is State.SERVICE
    assert "not allowed in RUN, only in SLEEP" in controller.fault.reason


# order and preemption


def test_the_lower_number_goes_first_and_programs_run_in_order(run_for, task_class, trace):
    low = {name: trace.program(name) for name in "ba"}
    run_for(16, task_class(7, 10, **low), task_class(2, 10, c=trace.program("c")))
    assert [name for name, _, _ in trace.entries] == ["c", "b", "a", "c", "b", "a"]


def test_a_released_class_runs_between_two_programs_of_a_lower_one(run_for, task_class, trace):
    slow = {name: trace.program(name, 4) for name in "xyz"}
    run_for(
        19,
        task_class(1, 4, fast=trace.program("fast", 1)),
        task_class(2, 20, **slow),
    )
    assert trace.entries == [
        ("fast", 2, 2),
        ("fast", 6, 6),
        ("fast", 10, 10),
        ("x", 10, 11),
        ("fast", 14, 15),
        ("y", 10, 16),
        ("fast", 18, 20),
        ("z", 10, 21),
    ]


# phases


def test_each_phase_comes_in_turn(make_controller, task_class, program_of):
    seen = []

    def phase_of(who):
        return lambda *_: seen.append((who, controller.scan.phase))

    controller = make_controller(task_class(1, 10, p=program_of(phase_of("program"))))
    controller.image.inputs.append(phase_of("input"))
    controller.image.watchers.append(phase_of("watcher"))
    controller.boot()
    controller.run(cycles=1)
    assert seen == [("input", Phase.LATCH), ("program", Phase.RUN), ("watcher", Phase.PUBLISH)]
    assert controller.scan.phase is Phase.SLEEP


def test_phase_and_release_of_a_preempted_cycle_are_restored(
    make_controller, task_class, program_of, clock
):
    seen = []
    origin_ns = clock.now_ns()

    def note(name, cost_ms):
        def cyclic(program):
            release_ms = (program.context.release_ns - origin_ns) // MS
            seen.append((name, release_ms, controller.scan.phase))
            clock.spend_ns(cost_ms * MS)

        return program_of(cyclic)

    controller = make_controller(
        task_class(1, 10, fast=note("fast", 0)),
        task_class(2, 10, log_only(tolerance_ms=20), a=note("a", 12), b=note("b", 0)),
    )
    controller.boot()
    controller.run_for(16 * MS)
    order = [("fast", 5), ("a", 5), ("fast", 15), ("b", 5)]
    assert seen == [(*entry, Phase.RUN) for entry in order]


def test_acts_in_the_wrong_phase_raise(make_controller, task_class, program_of):
    controller = make_controller(task_class(1, 10, p=program_of()))
    image, first = controller.image, controller.classes[0]
    with pytest.raises(PhaseError, match="not allowed in SLEEP, only in LATCH"):
        image.latch(first)
    with pytest.raises(PhaseError, match="not allowed in SLEEP, only in PUBLISH"):
        image.publish(first)


@pytest.mark.parametrize("act", ["latch", "publish"])
def test_a_program_may_neither_latch_nor_publish(make_controller, task_class, program_of, act):
    def cyclic(_):
        getattr(controller.image, act)(controller.classes[0])

    controller = make_controller(task_class(1, 10, p=program_of(cyclic)))
    controller.boot()
    assert controller.run(cycles=1) is State.SERVICE
    assert "not allowed in RUN" in controller.fault.reason


@pytest.mark.parametrize("hooks", ["inputs", "watchers"])
def test_what_an_input_or_a_watcher_raises_ends_the_run_and_leaves_the_scan_usable(
    make_controller, task_class, program_of, hooks
):
    def fail(_):
        raise AssertionError("seen by the test")

    controller = make_controller(task_class(1, 10, p=program_of()))
    getattr(controller.image, hooks).append(fail)
    controller.boot()
    with pytest.raises(AssertionError, match="seen by the test"):
        controller.run(cycles=1)
    getattr(controller.image, hooks).clear()
    assert controller.run(cycles=1) is State.RUN


# overruns and their cause


def the_violation(controller):
    (violation,) = controller.violations
    return violation


def test_within_the_tolerance_is_counted_and_is_no_violation(run_for, task_class, trace):
    settings = {"tolerance_ns": 5 * MS}
    controller = run_for(25, task_class(1, 10, settings, p=trace.program("p", 15, 0)))
    first = controller.classes[0]
    assert (first.in_tolerance, first.missed, controller.state) == (1, 1, State.RUN)
    assert controller.violations == []


def test_beyond_the_tolerance_is_a_violation_by_the_program(run_for, task_class, trace):
    settings = {"tolerance_ns": 5 * MS}
    programs = {"small": trace.program("small", 1), "big": trace.program("big", 15)}
    controller = run_for(50, task_class(3, 10, settings, **programs))
    violation = the_violation(controller)
    assert violation.cause is Cause.PROGRAM
    assert (violation.task_class, violation.program, violation.cycle) == (3, "big", 1)
    assert (violation.release_ns, violation.response_ns) == (5 * MS, 16 * MS)
    assert (violation.own_ns, violation.others_ns, violation.limit_ns) == (16 * MS, 0, 15 * MS)
    assert controller.state is State.SERVICE
    assert controller.classes[0].cycles == 1


def test_cpu_taken_away_is_the_fault_of_the_host(run_for, task_class, program_of, clock):
    def cyclic(_):
        clock.spend_ns(2 * MS)
        clock.stall_ns(30 * MS)

    controller = run_for(40, task_class(1, 10, p=program_of(cyclic)))
    assert controller.state is State.RUN
    assert the_violation(controller).cause is Cause.HOST
    assert the_violation(controller).own_ns == 2 * MS
    assert controller.classes[0].violations == {
        Cause.PROGRAM: 0,
        Cause.HOST: 1,
        Cause.PREEMPTED: 0,
        Cause.CONTROLLER: 0,
    }


@pytest.mark.parametrize("phase", ["inputs", "watchers"])
def test_time_spent_in_latch_and_publish_is_the_controllers_own(
    make_controller, task_class, program_of, clock, phase
):
    program = program_of(lambda _: clock.spend_ns(4 * MS))
    controller = make_controller(task_class(1, 10, p=program))
    getattr(controller.image, phase).append(lambda _: clock.spend_ns(8 * MS))
    controller.boot()
    controller.run(cycles=1)
    violation = the_violation(controller)
    assert violation.cause is Cause.CONTROLLER
    assert (violation.own_ns, violation.controller_ns) == (4 * MS, 8 * MS)
    assert controller.state is State.RUN  # no fault of a program
    assert controller.classes[0].controller.maximum_ns == 8 * MS
    assert controller.classes[0].execution.maximum_ns == 4 * MS


def test_a_class_that_waited_for_anothers_publish_was_held_up_by_the_controller(
    make_controller, task_class, program_of, clock
):
    fast = task_class(1, 20, log_only(20, 0), fast=program_of(lambda _: clock.spend_ns(MS)))
    slow = task_class(2, 10, log_only(0, 1), slow=program_of(lambda _: clock.spend_ns(2 * MS)))
    controller = make_controller(fast, slow)
    controller.image.watchers.append(
        lambda task_class: clock.spend_ns(11 * MS if task_class.number == 1 else 0)
    )
    controller.boot()
    controller.run_for(15 * MS)
    (violation,) = controller.violations
    assert (violation.task_class, violation.cause) == (2, Cause.CONTROLLER)
    assert (violation.own_ns, violation.others_ns) == (2 * MS, 0)
    assert violation.controller_ns == 11 * MS


def test_what_preempts_a_class_does_not_count_as_its_latch_and_publish(
    make_controller, task_class, program_of, clock
):
    fast = task_class(1, 10, log_only(0, 5), fast=program_of(lambda _: clock.spend_ns(3 * MS)))
    slow = task_class(
        2,
        50,
        log_only(50, 0),
        first=program_of(lambda _: clock.spend_ns(6 * MS)),
        second=program_of(lambda _: clock.spend_ns(MS)),
    )
    controller = make_controller(fast, slow)
    controller.image.watchers.append(lambda _: clock.spend_ns(MS))
    controller.boot()
    controller.run_for(10 * MS)
    first, second = controller.classes
    assert (first.cycles, second.cycles) == (1, 1)
    assert (first.controller.maximum_ns, second.controller.maximum_ns) == (MS, MS)


def test_a_late_wake_up_is_the_fault_of_the_host(make_controller, task_class, program_of):
    class LateClock(VirtualClock):
        def sleep_until_ns(self, until_ns):
            super().sleep_until_ns(until_ns + 25 * MS)

    programs = task_class(1, 10, p=program_of())
    controller = make_controller(programs, clock=LateClock())
    controller.boot()
    controller.run(cycles=1)
    assert the_violation(controller).cause is Cause.HOST
    assert controller.classes[0].missed == 2


def test_waiting_inside_a_program_is_its_own_fault(run_for, task_class, program_of, clock):
    program = program_of(lambda _: clock.wait_ns(30 * MS))
    controller = run_for(20, task_class(1, 10, p=program))
    assert the_violation(controller).cause is Cause.PROGRAM
    assert the_violation(controller).own_ns == 30 * MS


def test_programs_of_other_classes_preempt(run_for, task_class, trace):
    slow = {"x": trace.program("x", 1), "y": trace.program("y", 1)}
    fast = {"small": trace.program("small", 1), "large": trace.program("large", 28)}
    controller = run_for(
        40,
        task_class(1, 100, log_only(first_release_ms=6), **fast),
        task_class(2, 10, log_only(first_release_ms=5), **slow),
    )
    violation = the_violation(controller)
    assert (violation.task_class, violation.cause) == (2, Cause.PREEMPTED)
    assert violation.program == "large"
    assert (violation.own_ns, violation.others_ns) == (2 * MS, 29 * MS)


def test_what_others_used_before_the_release_does_not_count(
    run_for, task_class, trace, program_of, clock
):
    before = trace.program("before", 9)  # runs from 1 to 10 ms, 5 ms of it after the release
    stalled = program_of(lambda _: clock.stall_ns(9 * MS))
    controller = run_for(
        12,
        task_class(1, 100, log_only(first_release_ms=1), before=before),
        task_class(2, 10, log_only(first_release_ms=5), stalled=stalled),
    )
    violation = the_violation(controller)
    assert (violation.task_class, violation.cause) == (2, Cause.HOST)
    assert violation.others_ns == 5 * MS


def test_preemption_by_any_number_of_executions_is_seen(run_for, task_class, trace):
    slow = {f"p{i}": trace.program("p", 1) for i in range(160)}
    controller = run_for(
        400,
        task_class(1, 1, {"first_release_ns": 0}, fast=trace.program("fast", 0.5)),
        task_class(2, 300, log_only(first_release_ms=0), **slow),
    )
    violation = the_violation(controller)
    assert (violation.cause, violation.program) == (Cause.PREEMPTED, "fast")
    assert (violation.own_ns, violation.others_ns) == (160 * MS, 159.5 * MS)


def test_use_before_a_restart_is_not_counted_after_it(run_for, task_class, trace, program_of):
    failing = program_of(lambda _: 1 // 0)
    controller = run_for(
        60,
        task_class(1, 10, first=trace.program("first", 9, 0)),
        task_class(2, 10, log_only(), second=failing),
    )
    assert controller.state is State.SERVICE
    controller.boot()
    controller.start()
    assert controller.classes[1].used_by_own_and_others() == ({}, {}, 0)


@pytest.mark.parametrize(
    ("policy", "state"), [(Policy.SERVICE, State.SERVICE), (Policy.LOG, State.RUN)]
)
def test_the_policy_for_the_host_is_one_of_its_own(
    run_for, task_class, program_of, clock, policy, state
):
    program = program_of(lambda _: clock.stall_ns(30 * MS))
    settings = {"policy": Policy.LOG, "host_policy": policy}
    assert run_for(20, task_class(1, 10, settings, p=program)).state is state


def test_a_program_that_catches_exceptions_is_ended_all_the_same(
    make_controller, task_class, program_of
):
    def stuck(_):
        try:
            controller.abort_program("the program did not return")
        except Exception:
            raise AssertionError("it was caught") from None

    controller = make_controller(task_class(1, 10, p=program_of(stuck)))
    controller.boot()
    assert controller.run(cycles=1) is State.SERVICE
    assert the_violation(controller).cause is Cause.PROGRAM


@pytest.mark.parametrize("location", ["main.py:7", ""])
def test_a_program_that_was_ended_is_the_one_to_blame(
    make_controller, task_class, trace, program_of, clock, location
):
    def stuck(_):
        clock.spend_ns(2 * MS)
        controller.abort_program("the program did not return")

    programs = {"longer": trace.program("longer", 6), "stuck": program_of(stuck)}
    controller = make_controller(task_class(1, 10, **programs))
    controller.tasks[1].fault_of = lambda _: Fault(location, "")
    controller.boot()
    assert controller.run(cycles=3) is State.SERVICE
    violation = the_violation(controller)
    assert (violation.cause, violation.program) == (Cause.PROGRAM, "stuck")
    assert violation.location == location
    assert violation.response_ns == 8 * MS


# the exception program


def test_the_exception_program_runs_once_for_each_violation(
    make_controller, task_class, trace, program_of
):
    records = []
    note = program_of(lambda p: records.append((controller.scan.phase, p.context.violation)))
    settings = {"policy": Policy.EXCEPTION}
    controller = make_controller(
        task_class(1, 10, settings, p=trace.program("p", 12, 0, 11)), exception_program=note
    )
    controller.boot()
    controller.run(cycles=3)
    assert controller.state is State.RUN
    assert [phase for phase, _ in records] == [Phase.RUN, Phase.RUN]
    assert [violation for _, violation in records] == controller.violations
    assert [violation.own_ns for _, violation in records] == [12 * MS, 11 * MS]


def test_a_cycle_that_the_exception_program_delays_was_preempted(
    make_controller, task_class, trace, program_of, clock
):
    slow = {"long": trace.program("long", 95), "short": trace.program("short", 6)}
    controller = make_controller(
        task_class(1, 10, log_only(), fast=trace.program("fast")),
        task_class(2, 100, {"policy": Policy.EXCEPTION}, **slow),
        exception_program=program_of(lambda _: clock.spend_ns(30 * MS)),
    )
    controller.boot()
    controller.run_for(160 * MS)
    by_long, by_exception = [v for v in controller.violations if v.task_class == 1]
    assert (by_long.cause, by_long.program) == (Cause.PREEMPTED, "long")
    assert (by_exception.cause, by_exception.program) == (Cause.PREEMPTED, "exception")


def test_an_exception_program_that_fails_leads_to_service(
    make_controller, task_class, trace, program_of
):
    def fail(_):
        raise ValueError("no")

    settings = {"policy": Policy.EXCEPTION}
    controller = make_controller(
        task_class(1, 10, settings, p=trace.program("p", 12)), exception_program=program_of(fail)
    )
    controller.boot()
    assert controller.run(cycles=3) is State.SERVICE
    assert str(controller.fault).startswith("exception CYCLIC: ValueError: no")


def test_an_exception_program_that_does_not_return_leads_to_service(
    make_controller, task_class, trace, program_of
):
    settings = {"policy": Policy.EXCEPTION}
    stuck = program_of(lambda _: controller.abort_program("the program did not return"))
    controller = make_controller(
        task_class(1, 10, settings, p=trace.program("p", 12)), exception_program=stuck
    )
    controller.boot()
    assert controller.run(cycles=3) is State.SERVICE
    assert "the program did not return" in str(controller.fault)


# overload


@pytest.mark.parametrize("limit", ["stop", "pause", "cycles", "until"])
def test_a_run_ends_though_higher_classes_leave_no_time(
    make_controller, task_class, trace, program_of, clock, limit
):
    """Class 1 needs all the time there is, so class 2 is never done with being preempted."""

    def cyclic(_):
        clock.spend_ns(10 * MS)
        if controller.classes[0].cycles == 20 and limit in ("stop", "pause"):
            getattr(controller.scan, limit)()

    slow = {"a": trace.program("a", 5), "b": trace.program("b", 0)}
    controller = make_controller(
        task_class(1, 10, log_only(tolerance_ms=20, first_release_ms=5), p=program_of(cyclic)),
        task_class(2, 10, log_only(first_release_ms=0), **slow),
    )
    controller.boot()
    if limit == "until":
        controller.run_for(201 * MS)
    else:
        controller.run(cycles=20 if limit == "cycles" else None)
    assert controller.classes[0].cycles == 20
    assert [name for name, _, _ in trace.entries] == ["a", "b"]
