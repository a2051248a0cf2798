"""Both clocks: what they have in common, and what only one can do."""

import signal
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.clock import LONGEST_SLEEP_NS, MonotonicClock, VirtualClock

MS = 1_000_000


@pytest.fixture(params=[MonotonicClock, VirtualClock])
def either(request):
    return request.param()


def test_sleeping_reaches_the_time(either):
    until_ns = either.now_ns() + 2 * MS
    either.sleep_until_ns(until_ns)
    assert either.now_ns() >= until_ns


def test_the_past_is_reached_already(either):
    before_ns = either.now_ns()
    either.sleep_until_ns(before_ns - 10**15)
    assert before_ns <= either.now_ns() < before_ns + 1000 * MS


def test_cpu_time_and_waits_do_not_go_back(either):
    first = either.cpu_ns(), either.waits()
    either.sleep_until_ns(either.now_ns() + MS)
    second = either.cpu_ns(), either.waits()
    assert second >= first


def test_the_real_clock_counts_cpu_time_and_waits_apart():
    clock = MonotonicClock()
    waits, cpu_ns = clock.waits(), clock.cpu_ns()
    clock.sleep_until_ns(clock.now_ns() + 20 * MS)
    assert clock.waits() > waits
    assert clock.cpu_ns() - cpu_ns < 10 * MS
    while clock.cpu_ns() - cpu_ns < 15 * MS:
        pass


def test_a_long_sleep_is_cut_so_that_a_stop_is_seen():
    clock = MonotonicClock()
    before_ns = clock.now_ns()
    clock.sleep_until_ns(before_ns + 10**15)
    assert clock.now_ns() - before_ns >= LONGEST_SLEEP_NS


def test_a_signal_does_not_shorten_a_sleep():
    clock = MonotonicClock()
    before = signal.signal(signal.SIGALRM, lambda *_: None)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.002)
        until_ns = clock.now_ns() + 10 * MS
        clock.sleep_until_ns(until_ns)
        assert clock.now_ns() >= until_ns
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_the_real_clock_is_the_monotonic_one():
    before_ns = time.monotonic_ns()
    assert before_ns <= MonotonicClock().now_ns() <= time.monotonic_ns()


@given(
    st.lists(st.tuples(st.sampled_from(["sleep", "spend", "stall", "wait"]), st.integers(0, 99)))
)
def test_the_virtual_clock_moves_only_when_told(acts):
    clock = VirtualClock(1000)
    now_ns, cpu_ns, waits = 1000, 0, 0
    for act, duration_ns in acts:
        now_ns += duration_ns
        cpu_ns += duration_ns * (act == "spend")
        waits += act == "wait"
        if act == "sleep":
            clock.sleep_until_ns(now_ns)
        else:
            getattr(clock, f"{act}_ns")(duration_ns)
        assert (clock.now_ns(), clock.cpu_ns(), clock.waits()) == (now_ns, cpu_ns, waits)


def test_virtual_time_does_not_begin_at_0():
    assert VirtualClock().now_ns() > 0  # ROS takes 0 for "no time yet"
