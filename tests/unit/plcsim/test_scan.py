"""The loop over task classes: grid, order, phases, preemption, overruns and who is to blame."""

import pytest

from plcsim.clock import VirtualClock
from plcsim.system import State
from plcsim.task import Policy

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
