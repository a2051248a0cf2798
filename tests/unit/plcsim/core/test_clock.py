"""Both clocks: what they have in common, and what only one can do."""

import signal
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core import clock as clock_module
from plcsim.core.clock import LONGEST_SLEEP_NS, MonotonicClock, VirtualClock
from plcsim.core.control import AS_FAST_AS_POSSIBLE, REAL_TIME

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


def test_a_virtual_clock_with_a_speed_waits_as_long_as_that_takes(monkeypatch):
    slept = []
    now_ns = [5_000 * MS]

    def sleep(seconds):
        slept.append(round(seconds * 1e9))
        now_ns[0] += round(seconds * 1e9)

    monkeypatch.setattr(clock_module.time, "sleep", sleep)
    monkeypatch.setattr(clock_module.time, "monotonic_ns", lambda: now_ns[0])
    clock = VirtualClock()
    start_ns = clock.now_ns()
    clock.pace(10 * REAL_TIME)
    clock.sleep_until_ns(start_ns + 100 * MS)
    assert (clock.now_ns() - start_ns, slept) == (100 * MS, [10 * MS])
    clock.pace(REAL_TIME // 10)
    clock.sleep_until_ns(start_ns + 115 * MS)  # 150 ms of real time, in two pieces
    assert (clock.now_ns() - start_ns, slept[1:]) == (100 * MS, [100 * MS])
    clock.sleep_until_ns(start_ns + 115 * MS)
    assert (clock.now_ns() - start_ns, slept[2:]) == (115 * MS, [50 * MS])
    clock.pace(AS_FAST_AS_POSSIBLE)
    clock.sleep_until_ns(start_ns + 10_000 * MS)
    assert (clock.now_ns() - start_ns, slept[3:]) == (10_000 * MS, [])


def test_a_virtual_clock_that_fell_behind_its_speed_does_not_rush(monkeypatch):
    slept = []
    now_ns = [0]
    monkeypatch.setattr(clock_module.time, "sleep", lambda s: slept.append(round(s * 1e9)))
    monkeypatch.setattr(clock_module.time, "monotonic_ns", lambda: now_ns[0])
    clock = VirtualClock()
    start_ns = clock.now_ns()
    clock.pace(REAL_TIME)
    now_ns[0] = 1_000 * MS  # a pause, or programs that take longer than that
    clock.sleep_until_ns(start_ns + 10 * MS)
    clock.sleep_until_ns(start_ns + 20 * MS)
    assert slept == [10 * MS]
