"""The clock of realtime tests."""

import time
from types import SimpleNamespace

from plcsim.testing.wall_clock import WallClock


def test_time_runs_only_inside_the_block():
    clock = WallClock()
    first = clock.now_ns()
    assert clock.now_ns() == first
    with clock:
        while clock.now_ns() < first + 1_000_000:
            pass
    end = clock.now_ns()
    time.sleep(0.005)
    assert clock.now_ns() == end >= first + 1_000_000


def test_a_pause_leaves_no_gap(monkeypatch):
    host_ns = [1_000]
    clock_module = SimpleNamespace(monotonic_ns=lambda: host_ns[0])
    monkeypatch.setattr("plcsim.testing.wall_clock.time", clock_module)
    clock = WallClock()
    seen = []
    for step in (10, 500, 20, 700):
        host_ns[0] += step  # the test computes
        with clock:
            host_ns[0] += 1
            seen.append(clock.now_ns())
    assert seen == [1_001, 1_002, 1_003, 1_004]


def test_it_sleeps_on_its_own_time():
    clock = WallClock()
    time.sleep(0.01)
    with clock:
        begin = clock.now_ns()
        clock.sleep_until_ns(begin + 2_000_000)
        assert clock.now_ns() >= begin + 2_000_000
