"""Values by hand; a cycle is 10 ms."""

import math

import pytest

from plcsim.library.heap import heap_of
from plcsim.library.mtbasics import (
    mtBCD_ERR_MAX_NEG_SLEW_RATE_NEG,
    mtBCD_ERR_MAX_POS_SLEW_RATE_NEG,
    mtBCD_ERR_MIN_PULSE_HIGH,
    mtBCD_ERR_MIN_PULSE_LOW,
    mtBCD_ERR_MODE_INVALID,
    mtBCD_ERR_PERIOD_LOW,
    mtBCD_ERR_TIME_CONSTANT1_INVALID,
)
from plcsim.library.mtbasics.signals import (
    MTBasicsLimiter,
    MTBasicsPT1,
    MTBasicsPWM,
    MTBasicsTimeDelay,
)


def test_a_limiter_with_slew_rates(plc, run):
    block = plc.new(MTBasicsLimiter)
    limits = {"MinOut": -5, "MaxOut": 5, "MaxPosSlewRate": 100, "MaxNegSlewRate": 200}
    found = run(block, [2, 9, 9, 9, 9, -9, -9, -9, -9, -9, -9], **limits)
    assert found == [2, 3, 4, 5, 5, 3, 1, -1, -3, -5, -5]


def test_a_limiter_is_set(plc, run):
    block = plc.new(MTBasicsLimiter)
    limits = {"MinOut": 0, "MaxOut": 10, "MaxPosSlewRate": 100}
    run(block, [1], **limits)
    assert run(block, [1, 9, 9], SetOut=True, OutPresetValue=7) == [7, 8, 9]
    assert run(block, [0, 0], SetOut=False) == [0, 0]
    assert run(block, [0], SetOut=True, OutPresetValue=70) == [10]


@pytest.mark.parametrize(
    ("name", "status"),
    [
        ("MaxPosSlewRate", mtBCD_ERR_MAX_POS_SLEW_RATE_NEG),
        ("MaxNegSlewRate", mtBCD_ERR_MAX_NEG_SLEW_RATE_NEG),
    ],
)
def test_slew_rates_below_0(plc, name, status):
    block = plc.new(MTBasicsLimiter)
    block(Enable=True, MaxOut=1, **{name: -1})
    assert block.StatusID == status


def test_a_lag(plc, run):
    block = plc.new(MTBasicsPT1)
    found = run(block, [1.0] * 100, Gain=2.0, TimeConstant=0.5)
    assert found[49] == pytest.approx(2 * (1 - math.exp(-1)), rel=1e-6)
    assert found[99] == pytest.approx(2 * (1 - math.exp(-2)), rel=1e-6)
    assert run(block, [1.0], SetOut=True, OutPresetValue=5.0) == [5.0]


def test_a_lag_without_time(plc, run):
    block = plc.new(MTBasicsPT1)
    assert run(block, [1.0, 3.0], Gain=2.0) == [2.0, 6.0]
    wrong = plc.new(MTBasicsPT1)
    wrong(Enable=True, TimeConstant=-1)
    assert wrong.StatusID == mtBCD_ERR_TIME_CONSTANT1_INVALID


def test_a_delay(plc, run):
    block = plc.new(MTBasicsTimeDelay)
    found = run(block, [1, 2, 3, 4, 5, 6], DelayTime=0.03, InitialValue=-1)
    assert found == [-1, -1, -1, 1, 2, 3]
    before = heap_of(plc.context).free_bytes
    block(Enable=False)
    assert heap_of(plc.context).free_bytes > before
    assert run(block, [7], DelayTime=0.0) == [7]


@pytest.mark.parametrize("delay", [-0.01, 1e6, math.inf, math.nan])
def test_delays_that_cannot_be(plc, run, delay):
    block = plc.new(MTBasicsTimeDelay)
    run(block, [1], DelayTime=delay)
    assert (block.Active, block.StatusID) == (False, mtBCD_ERR_TIME_CONSTANT1_INVALID)


def pulses(plc, run, duty, cycles=20, **inputs):
    found = run(plc.new(MTBasicsPWM), [duty] * cycles, at="DutyCycle", Period=0.1, **inputs)
    return "".join("_#"[level] for level in found)


@pytest.mark.parametrize(
    ("duty", "text"),
    [
        (0, "____________________"),
        (10, "#_________#_________"),
        (30, "###_______###_______"),
        (100, "####################"),
        (-5, "____________________"),
        (250, "####################"),
    ],
)
def test_pulses_at_the_beginning(plc, run, duty, text):
    assert pulses(plc, run, duty) == text


def test_pulses_in_the_middle(plc, run):
    assert pulses(plc, run, 40, Mode=1) == "___####______####___"


@pytest.mark.parametrize(
    ("duty", "text"), [(20, "__________"), (30, "###_______"), (80, "##########")]
)
def test_no_pulse_or_pause_is_too_short(plc, run, duty, text):
    assert pulses(plc, run, duty, 10, MinPulseWidth=0.03) == text


def test_a_new_duty_cycle_begins_with_a_period(plc, run):
    block = plc.new(MTBasicsPWM)
    duties = [20] * 3 + [90] * 17
    found = run(block, duties, at="DutyCycle", Period=0.1)
    assert "".join("_#"[level] for level in found) == "##________#########_"


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"Mode": 2}, mtBCD_ERR_MODE_INVALID),
        ({"Period": 0.01}, mtBCD_ERR_PERIOD_LOW),
        ({"MinPulseWidth": -1}, mtBCD_ERR_MIN_PULSE_LOW),
        ({"MinPulseWidth": 0.1}, mtBCD_ERR_MIN_PULSE_HIGH),
    ],
)
def test_pulses_that_cannot_be(plc, run, inputs, status):
    block = plc.new(MTBasicsPWM)
    run(block, [50], at="DutyCycle", **{"Period": 0.1} | inputs)
    assert block.StatusID == status
