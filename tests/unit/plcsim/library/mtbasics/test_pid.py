"""A PID controller; values by hand, a cycle is 10 ms."""

import pytest

from plcsim.library.mtbasics import (
    mtBCD_ERR_OUTPUT_LIMIT_INVALID,
    mtBCD_ERR_TIME_CONSTANT1_INVALID,
)
from plcsim.library.mtbasics.pid import MTBasicsPID
from plcsim.library.mttypes import MTPIDIntegrationEnum


@pytest.fixture
def pid(plc):
    """``pid(Gain=2)``: a controller with limits of -100 and 100."""

    def pid(**parameters):
        block = plc.new(MTBasicsPID)
        block.MinOut, block.MaxOut = -100, 100
        for name, value in parameters.items():
            setattr(block.PIDParameters, name, value)
        return block

    return pid


def test_the_proportional_part(run, pid):
    block = pid(Gain=2.0)
    assert run(block, [5.0, -5.0, 80.0], at="SetValue") == [10.0, -10.0, 100.0]
    assert (block.ProportionalPart, block.ControlError) == (160.0, 80.0)
    inverted = pid(Gain=2.0)
    assert run(inverted, [5.0], at="SetValue", Invert=True) == [-10.0]
    assert inverted.ControlError == 5.0


def test_the_integral_part(run, pid):
    block = pid(Gain=2.0, IntegrationTime=0.1)
    found = run(block, [1.0] * 10, at="SetValue", name="IntegrationPart")
    assert found == pytest.approx([0.2 * n for n in range(1, 11)])
    assert block.Out == pytest.approx(4.0)


def test_the_derivative_part(run, pid):
    block = pid(Gain=1.0, DerivativeTime=0.05)
    found = run(block, [0.0, 1.0, 1.0], at="SetValue", name="DerivativePart")
    assert found == pytest.approx([0.0, 5.0, 0.0])
    filtered = pid(Gain=1.0, DerivativeTime=0.05, FilterTime=0.01)
    found = run(filtered, [0.0, 1.0, 1.0, 1.0], at="SetValue", name="DerivativePart")
    assert found == pytest.approx([0.0, 2.5, 1.25, 0.625])


def test_the_first_cycle_has_no_derivative(run, pid):
    block = pid(Gain=1.0, DerivativeTime=0.05)
    assert run(block, [7.0], at="SetValue", name="DerivativePart") == [0.0]


def test_integration_stops_at_a_limit(run, pid):
    block = pid(Gain=1.0, IntegrationTime=0.01)
    run(block, [50.0] * 10, at="SetValue")
    assert (block.Out, block.IntegrationPart) == (100.0, 50.0)
    assert block.IntegrationStatus == MTPIDIntegrationEnum.mtHOLD_INTEGRATION_POSITIVE
    run(block, [-1.0], at="SetValue")
    assert block.IntegrationPart == 49.0
    assert block.IntegrationStatus == MTPIDIntegrationEnum.mtINTEGRATION_FREE


def test_integration_is_held_from_outside(run, pid):
    block = pid(Gain=1.0, IntegrationTime=0.01)
    up = MTPIDIntegrationEnum.mtHOLD_INTEGRATION_POSITIVE
    assert run(block, [1.0, -1.0], at="SetValue", HoldIntegration=up) == [1.0, -2.0]


def test_the_integral_part_is_set(run, pid):
    block = pid(Gain=1.0, IntegrationTime=1.0)
    given = {"SetIntegrationPart": True, "IntegrationPartPresetValue": 30.0}
    assert run(block, [0.0, 0.0], at="SetValue", **given) == [30.0, 30.0]


def test_tracking_goes_on_without_a_bump(run, pid):
    block = pid(Gain=1.0, IntegrationTime=1.0)
    assert run(block, [5.0], at="SetValue", EnableTracking=True, TrackingValue=40.0) == [40.0]
    assert block.TrackingActive
    assert run(block, [5.0], at="SetValue", EnableTracking=False) == pytest.approx([40.05])
    assert not block.TrackingActive


def test_holding_keeps_everything(run, pid):
    block = pid(Gain=1.0, IntegrationTime=1.0)
    run(block, [10.0], at="SetValue")
    held = block.Out
    assert run(block, [99.0, 50.0], at="SetValue", HoldOut=True) == [held, held]


def test_wrong_parameters(run, pid):
    block = pid(Gain=1.0)
    block.MaxOut = -100
    run(block, [0.0], at="SetValue")
    assert block.StatusID == mtBCD_ERR_OUTPUT_LIMIT_INVALID
    block = pid(IntegrationTime=-1.0)
    run(block, [0.0], at="SetValue")
    assert block.StatusID == mtBCD_ERR_TIME_CONSTANT1_INVALID


def test_it_controls_a_plant(run, pid):
    block, level = pid(Gain=4.0, IntegrationTime=0.5), 0.0
    for _ in range(1000):
        (out,) = run(block, [level], at="ActValue", SetValue=50.0)
        level += 0.01 * (out - level) / 0.3
    assert level == pytest.approx(50.0, abs=0.01)
