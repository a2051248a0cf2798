"""MpAxisBasic: commands, parameters, and what it shows of the axis."""

import pytest

from plcsim.library.motion.axis import NO_AXIS, NOT_ALLOWED
from st_types import BOOL, DINT, LREAL, REAL, UDINT
from st_types.types.derived import (
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StructType,
)

from .conftest import AXIS

STATE = EnumerationType(
    "MpAxisPlcOpenStateEnum",
    {"mpAXIS_DISABLED": 0, "mpAXIS_STANDSTILL": 1, "mpAXIS_CONTINUOUS_MOTION": 3},
)
INFO = StructType("MpAxisBasicInfoType", [Member("PLCopenState", STATE), Member("MoveDone", BOOL)])
RATES = [Member(name, REAL) for name in ("Velocity", "Acceleration", "Deceleration")]
PARAMETERS = StructType(
    "MpAxisBasicParType",
    [
        *RATES,
        Member("Position", LREAL),
        Member("Distance", LREAL),
        Member("Direction", DINT),
        Member("Home", StructType("MpAxisHomingType", [Member("Position", LREAL)])),
        Member("Jog", StructType("MpAxisJogType", RATES)),
        Member("Stop", StructType("MpAxisStopType", [Member("Deceleration", REAL)])),
    ],
)
INPUTS = [
    "Enable",
    "ErrorReset",
    "Power",
    "Home",
    "MoveVelocity",
    "MoveAbsolute",
    "MoveAdditive",
    "Stop",
    "JogPositive",
    "JogNegative",
]
OUTPUTS = [
    "Active",
    "Error",
    "CommandBusy",
    "CommandAborted",
    "PowerOn",
    "IsHomed",
    "InVelocity",
    "InPosition",
    "MoveActive",
    "Stopped",
]
BASIC = DataBlockType(
    "MpAxisBasic",
    [
        Member("MpLink", UDINT, section=Section.INPUT),
        Member("Axis", UDINT, section=Section.INPUT),
        Member("Parameters", ReferenceType(PARAMETERS), section=Section.INPUT),
        *(Member(name, BOOL, section=Section.INPUT) for name in INPUTS),
        *(Member(name, BOOL, section=Section.OUTPUT) for name in OUTPUTS),
        Member("StatusID", DINT, section=Section.OUTPUT),
        Member("Position", LREAL, section=Section.OUTPUT),
        Member("Velocity", REAL, section=Section.OUTPUT),
        Member("Info", INFO, section=Section.OUTPUT),
    ],
)


@pytest.fixture
def axis(plc):
    """A block that is enabled, with its parameters at ``axis.parameters``."""
    plc.types["MpAxisBasic"] = BASIC
    address = plc.memory.allocate(PARAMETERS.size)
    block = plc.block("MpAxisBasic")
    block.parameters = plc.memory.access(PARAMETERS, address)
    block.parameters.Velocity = block.parameters.Jog.Velocity = 100.0
    for part in (block.parameters, block.parameters.Jog):
        part.Acceleration = part.Deceleration = 1000.0
    block.parameters.Stop.Deceleration = 1000.0
    block(Enable=True, Parameters=address)
    return block


def ready(plc, axis):
    axis(Power=True)
    plc.run(1, axis)
    axis(Home=True)
    plc.run(1, axis)
    axis(Home=False)


def test_it_is_switched_on_and_homed(plc, axis):
    assert axis.on == {"Active"}
    axis.parameters.Home.Position = 20.0
    ready(plc, axis)
    assert axis.on == {"Active", "PowerOn", "IsHomed"}
    assert (axis["Position"], axis["Info.PLCopenState"]) == (20.0, 1)
    axis(Power=False)
    assert "PowerOn" not in axis.on


def test_an_absolute_movement_ends_in_position_as_long_as_its_command(plc, axis):
    ready(plc, axis)
    axis.parameters.Position = 10.0
    assert {"MoveActive", "CommandBusy"} <= axis(MoveAbsolute=True).on
    plc.run(199, axis)
    assert {"MoveActive", "CommandBusy"} <= axis.on
    plc.run(1, axis)
    assert axis.on == {"Active", "PowerOn", "IsHomed", "InPosition"}
    assert (axis["Position"], axis["Info.MoveDone"]) == (10.0, True)
    assert "InPosition" not in axis(MoveAbsolute=False).on
    axis.parameters.Distance = -4.0
    axis(MoveAdditive=True)
    plc.run(1000, axis)
    assert axis["Position"] == 6.0


def test_a_velocity_is_held_until_stop(plc, axis):
    ready(plc, axis)
    axis.parameters.Direction = 1
    axis(MoveVelocity=True)
    plc.run(100, axis)
    assert {"InVelocity", "MoveActive"} <= axis.on
    assert (axis["Velocity"], axis["Info.PLCopenState"]) == (-100.0, 3)
    axis(MoveVelocity=False, Stop=True)
    plc.run(100, axis)
    assert axis.on >= {"Stopped", "MoveActive"}
    axis(MoveVelocity=True)  # not while Stop is TRUE
    plc.run(10, axis)
    assert axis["Velocity"] == 0.0
    axis(Stop=False, MoveVelocity=False)
    assert axis.on == {"Active", "PowerOn", "IsHomed"}


def test_a_jog_moves_as_long_as_it_is_true(plc, axis):
    ready(plc, axis)
    axis(JogNegative=True)
    plc.run(200, axis)
    assert axis["Velocity"] == -100.0
    axis(JogNegative=False)
    plc.run(200, axis)
    assert axis["Velocity"] == 0.0


def test_a_command_that_is_not_allowed_is_an_error_until_it_is_taken_away(plc, axis):
    assert axis(MoveAbsolute=True).on == {"Active", "Error"}
    assert axis["StatusID"] == NOT_ALLOWED
    axis(MoveAbsolute=False)
    assert axis().on == {"Active"}


def test_without_an_axis_it_is_an_error(axis):
    axis(Axis=0)
    assert (axis.on, axis["StatusID"]) == ({"Active", "Error"}, NO_AXIS)
    axis(MpLink=AXIS)
    assert axis.on == {"Active"}
