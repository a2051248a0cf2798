"""The verdict on tests on the wall clock, and what the plugin makes of it."""

import pytest

from plcsim.core.task import Cause, Policy
from plcsim.testing.realtime import RealtimeVerdict, figures, judge

pytest_plugins = ["pytester"]

MS = 1_000_000


@pytest.fixture
def controller(new_plc):
    return new_plc(10, policy=Policy.LOG).controller


def test_all_well(controller):
    assert judge(controller, failed=False) is RealtimeVerdict.PASSED


def test_a_failed_assertion_is_the_programs_fault_where_the_host_held(controller):
    assert judge(controller, failed=True) is RealtimeVerdict.FAILED


@pytest.mark.parametrize("cause", [Cause.PROGRAM, Cause.PREEMPTED])
@pytest.mark.parametrize("failed", [True, False])
def test_a_violation_by_programs_is_their_fault_whatever_else(controller, cause, failed):
    controller.classes[0].violations[cause] = 1
    controller.classes[0].violations[Cause.HOST] = 1
    assert judge(controller, failed=failed) is RealtimeVerdict.FAILED


@pytest.mark.parametrize("failed", [True, False])
def test_a_violation_by_the_host_takes_the_meaning_from_both(controller, failed):
    controller.classes[0].violations[Cause.HOST] = 1
    assert judge(controller, failed=failed) is RealtimeVerdict.HOST


def test_missed_grid_points_are_the_hosts_where_the_programs_fit_into_a_cycle(controller):
    controller.classes[0].missed = 1
    controller.classes[0].execution.record(9 * MS)
    assert judge(controller, failed=False) is RealtimeVerdict.HOST
    controller.classes[0].execution.record(11 * MS)
    assert judge(controller, failed=False) is RealtimeVerdict.PASSED


def test_the_figures_say_what_the_host_did(controller):
    controller.classes[0].missed = 3
    controller.classes[0].lateness.record(14 * MS)
    assert "task class 1 (10 ms): 3 of 3 grid points missed, woken up to 14 ms" in figures(
        controller
    )


PROJECT = """
    import time
    import pytest
    from plcsim import Program
    from st_types import DINT, var

    class Worker(Program):
        x = var(DINT)

        def cyclic(self):
            self.x += 1

    pytestmark = [pytest.mark.realtime, pytest.mark.plc(program=Worker, cycle="20ms")]
"""


@pytest.fixture
def realtime_run(pytester):
    def run(body, *arguments):
        pytester.makepyfile(PROJECT + body)
        return pytester.runpytest_inprocess("-p", "no:hypothesispytest", "-rs", *arguments)

    return run


PAUSED_HOST = """
    def test_it(plc):
        seen = plc.clock.now_ns
        plc.at_cycle(2, lambda: time.sleep(0.1))  # the host takes the CPU away outside the programs
        plc.run("200ms")
        assert plc["Worker.x"] == 10
"""


def test_a_host_that_cannot_hold_the_tick_skips_the_test_with_figures(realtime_run):
    result = realtime_run(PAUSED_HOST)
    result.assert_outcomes(skipped=1)
    result.stdout.fnmatch_lines(["SKIPPED*host could not hold the tick: task class 1 (20 ms)*"])


def test_require_realtime_makes_it_a_failure(realtime_run):
    result = realtime_run(PAUSED_HOST, "--require-realtime")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*host could not hold the tick: *"])


def test_a_program_that_computes_too_long_fails(realtime_run):
    result = realtime_run(
        """
    class Slow(Program):
        x = var(DINT)

        def cyclic(self):
            self.x += 1
            begin = time.thread_time()
            while self.x == 2 and time.thread_time() < begin + 0.06:
                pass

    @pytest.mark.plc(program=Slow)
    def test_it(plc):
        plc.run("200ms")
"""
    )
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*cause program: program Slow used *"])


def test_time_stands_still_while_the_test_itself_computes(realtime_run):
    result = realtime_run(
        """
    def test_it(plc):
        plc.run("60ms")
        time.sleep(0.1)
        plc.run("60ms")
        assert plc.time_ns < 160_000_000
        assert plc.controller.classes[0].missed * 20_000_000 < 100_000_000
""",
    )
    assert result.parseoutcomes().keys() <= {"passed", "skipped"}
