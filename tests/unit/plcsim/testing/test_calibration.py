"""The calibration loop: when it runs and what it says."""

from types import SimpleNamespace

import pytest

from plcsim.testing.calibration import MOST_CYCLES, SHARE, Calibration, slowness


def test_the_loop_takes_cpu_time_each_time():
    calibration = Calibration()
    calibration.measure(5)
    assert len(calibration.samples_ns) == 5
    assert all(sample > 0 for sample in calibration.samples_ns)


def test_it_runs_after_enough_cycles_however_cheap_they_are():
    calibration, costs = Calibration(), SimpleNamespace(total_ns=0)
    calibration.after_cycle(costs)
    for _ in range(MOST_CYCLES - 1):
        calibration.after_cycle(costs)
    assert len(calibration.samples_ns) == 1
    calibration.after_cycle(costs)
    assert len(calibration.samples_ns) == 2


def test_it_runs_when_programs_have_used_a_multiple_of_its_time():
    calibration, costs = Calibration(), SimpleNamespace(total_ns=0)
    calibration.after_cycle(costs)
    costs.total_ns = SHARE * calibration.samples_ns[-1] - 1
    calibration.after_cycle(costs)
    assert len(calibration.samples_ns) == 1
    costs.total_ns += 1
    calibration.after_cycle(costs)
    assert len(calibration.samples_ns) == 2


@pytest.mark.parametrize(("samples", "factor"), [([10] * 9 + [90], 1.0), ([20, 90, 90], 2.0)])
def test_slowness_is_that_of_the_undisturbed_runs(samples, factor):
    assert slowness(samples, 10) == factor
