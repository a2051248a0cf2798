"""MTProfilePositionGenerator."""

import math

import pytest

from st_types import BOOL, DINT, REAL, UINT
from st_types.types.derived import EnumerationType, Member, StructType

STATES = EnumerationType("MTProfilePositionStateEnum", {str(each): each for each in range(-3, 4)})
RATES = [
    f"{rate}{way}Direction"
    for way in ("Pos", "Neg")
    for rate in ("Velocity", "Acceleration", "Deceleration")
]
PARAMETER = StructType("MTProfilePositionParameterType", [Member(each, REAL) for each in RATES])
INPUTS = (
    dict.fromkeys(("Enable", "Update", "Start", "Stop", "Abort", "SetHomePosition"), BOOL)
    | {f"Parameter__{each}": REAL for each in RATES}
    | {"EndPosition": REAL, "HomePosition": REAL}
)
OUTPUTS = dict.fromkeys(("Active", "Error", "UpdateDone", "Done"), BOOL) | {
    "StatusID": DINT,
    "status": UINT,
    "Position": REAL,
    "Velocity": REAL,
    "Acceleration": REAL,
    "MotionState": STATES,
}
LIMITS = dict(zip(RATES, (10.0, 20.0, 10.0, 5.0, 10.0, 10.0), strict=True))


@pytest.fixture
def block(plc):
    inputs = {each: kind for each, kind in INPUTS.items() if "__" not in each}
    made = plc.model("MTProfilePositionGenerator", {**inputs, "Parameter": PARAMETER}, OUTPUTS)
    made(Enable=True, **{f"Parameter__{name}": value for name, value in LIMITS.items()})
    made(Enable=False)
    made(Enable=True)
    return made


@pytest.fixture
def run(plc, block):
    """``run(milliseconds)``: time goes on, and the block is called; what it shows."""

    def step(milliseconds, **inputs):
        plc.pass_ms(milliseconds)
        block(**inputs)
        shown = [block[name] for name in ("Position", "Velocity", "MotionState")]
        return [*(round(each, 4) for each in shown), bool(block["Done"])]

    return step


def test_a_profile_there_and_back(run, block):
    assert run(1) == [0, 0, 0, False]
    assert run(1, Start=True, EndPosition=20.0) == [0, 0, 1, False]
    assert run(250) == [0.625, 5, 1, False]
    assert block["Acceleration"] == 20
    assert run(1000) == [10.0, 10, 2, False]
    assert run(1000) == [18.75, 5, 3, False]
    assert run(500) == [20.0, 0, 0, True]
    assert run(1, Start=False) == [20.0, 0, 0, True]
    assert run(1, Start=True, EndPosition=0.0) == [20.0, 0, -1, False]
    assert run(1000) == [16.25, -5, -2, False]
    assert run(9000) == [0.0, 0, 0, True]


def test_a_stop_slows_down_and_an_abort_stands(run):
    run(1, Start=True, EndPosition=100.0)
    assert run(1500) == [12.5, 10, 2, False]
    assert run(0, Stop=True) == [12.5, 10, 3, False]
    assert run(1000) == [17.5, 0, 0, True]
    run(1, Start=False, Stop=False)
    run(1, Start=True)
    assert run(250)[:2] == [18.125, 5]
    assert run(0, Abort=True) == [18.125, 0, 0, False]
    assert run(1000)[:2] == [18.125, 0]


def test_the_position_is_set_at_rest(run):
    assert run(1, SetHomePosition=True, HomePosition=7.0) == [7, 0, 0, False]
    run(1, SetHomePosition=False, Start=True, EndPosition=107.0)
    assert run(250, SetHomePosition=True)[0] == 7.625


def test_parameters_are_taken_over_by_update_and_bad_ones_begin_nothing(run, block):
    bad = {"Parameter__VelocityPosDirection": 0.0, "EndPosition": 5.0}
    assert run(1, **bad) == [0, 0, 0, False]
    assert run(1, Start=True)[2] == 1
    run(10_000, Start=False)
    run(1, Update=True)
    assert block["UpdateDone"]
    assert run(1, Start=True, EndPosition=9.0) == [5, 0, 0, True]


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e20])
def test_what_is_no_position_moves_nothing(run, value):
    assert run(1, SetHomePosition=True, HomePosition=value)[0] == 0
    assert run(1, Start=True, EndPosition=value) == [0, 0, 0, False]
    assert run(1, Start=False, Update=True, Parameter__VelocityPosDirection=value)[0] == 0
    assert run(1, Start=True, EndPosition=5.0) == [0, 0, 0, False]
    assert run(1000, Stop=True) == [0, 0, 0, False]


def test_it_begins_anew_at_enable(run, block):
    run(1, Start=True, EndPosition=5.0)
    assert run(10_000)[0] == 5
    block(Enable=False)
    assert (block["Active"], block["Position"]) == (0, 0)
    assert run(1, Enable=True, Start=False) == [0, 0, 0, False]
