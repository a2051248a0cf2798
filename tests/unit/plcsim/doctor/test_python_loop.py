"""The bare Python loop on a clock that the test moves."""

import json
import sys

import pytest

from plcsim.doctor import python_loop

MS = 1_000_000


@pytest.fixture
def host_delays(monkeypatch):
    """``host_delays([..])``: how late the host wakes each sleep, in nanoseconds."""
    now = [500]
    delays = []

    def sleep(seconds):
        now[0] += round(seconds * 1e9) + delays.pop(0)

    monkeypatch.setattr(python_loop.time, "monotonic_ns", lambda: now[0])
    monkeypatch.setattr(python_loop.time, "sleep", sleep)
    return delays.extend


def test_lateness_is_measured_from_the_grid(host_delays):
    host_delays([10, 30_000, 7])
    assert python_loop.run(MS, 3) == (0, [10, 30_000, 7])


def test_grid_points_that_passed_are_skipped_and_counted(host_delays):
    host_delays([2_500_000, 40, 0])
    assert python_loop.run(MS, 3) == (2, [2_500_000, 40, 0])


def test_a_wake_up_on_the_next_grid_point_misses_none(host_delays):
    host_delays([MS, 5])  # the second cycle starts at once, for its grid point is now
    assert python_loop.run(MS, 2) == (0, [MS, 0])


def test_the_program_writes_figures_and_rights(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["python_loop", "1000000", "2", "0", "-1"])
    assert python_loop.main() == 0
    figures = json.loads(capsys.readouterr().out)
    assert len(figures["lateness_ns"]) == 2
    assert figures["rights"] == {"granted": [], "refused": [], "cpu": None}
