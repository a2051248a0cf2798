"""Blocks that give an axis a value in every call, and overrides."""

import pytest

from plcsim.library.motion.axis import NO_AXIS, NOT_ALLOWED, axes_of
from st_types import BOOL, REAL, UDINT, UINT
from st_types.types.derived import (
    DataBlockType,
    Member,
    ReferenceType,
    Section,
    StructType,
)

from .conftest import AXIS
from .test_plcopen import FAST, position, state, velocity


def test_velocity_control_follows_its_input_and_halts_at_its_end(plc):
    plc.powered()
    control = plc.block("MC_BR_VelocityControl")
    control(Enable=True, CyclicVelocity=50.0, Acceleration=1e6, Deceleration=1e6)
    plc.run(10, control)
    assert {"Active", "Valid"} <= control.on
    assert velocity(plc) == pytest.approx(50.0)
    control(CyclicVelocity=-20.0)
    plc.run(10, control)
    assert velocity(plc) == pytest.approx(-20.0)
    assert state(plc) == "ContinuousMotion"
    control(Enable=False)
    plc.run(10, control)
    assert (velocity(plc), state(plc)) == (0.0, "StandStill")
    assert "Active" not in control.on


def test_velocity_control_is_interrupted_by_another_movement(plc):
    plc.powered()
    control = plc.block("MC_BR_VelocityControl")
    control(Enable=True, CyclicVelocity=50.0)
    plc.block("MC_MoveAbsolute")(Execute=True, Position=1.0, **FAST)
    plc.run(1, control)
    assert "CommandAborted" in control.on
    assert "Active" not in control.on
    plc.run(1000, control)
    assert position(plc) == 1.0


def test_an_axis_without_power_takes_no_velocity(plc):
    control = plc.block("MC_BR_MoveCyclicVelocity")
    assert control(Enable=True, CyclicVelocity=50.0)["ErrorID"] == NOT_ALLOWED
    assert "Error" in control.on
    assert plc.block("MC_BR_MoveCyclicVelocity", axis=0)(Enable=True)["ErrorID"] == NO_AXIS


def test_an_axis_is_at_a_cyclic_position_one_call_later(plc):
    plc.powered()
    move = plc.block("MC_BR_MoveCyclicPosition")
    read = plc.block("MC_BR_ReadCyclicPosition", "CyclicPosition")
    for step in range(10):
        move(Enable=True, CyclicPosition=step * 0.5)
        plc.run(1)
    assert read(Enable=True)["CyclicPosition"] == pytest.approx(4.5)
    assert velocity(plc) == pytest.approx(500.0)
    assert state(plc) == "SynchronizedMotion"
    move(Enable=False)
    plc.run(500, move)
    assert (velocity(plc), state(plc)) == (0.0, "StandStill")


def test_an_axis_turns_with_a_torque_at_the_velocity_that_it_may_have(plc):
    plc.powered()
    turn = plc.block("MC_TorqueControl")
    read = plc.block("MC_ReadActualTorque", "Torque")
    turn.set(Torque=-1.5, Velocity=30.0, Acceleration=1e6)
    turn(Execute=True)
    plc.run(10, turn)
    assert "InTorque" in turn.on
    assert velocity(plc) == pytest.approx(-30.0)
    assert read(Enable=True)["Torque"] == pytest.approx(-1.5)
    plc.block("MC_Halt")(Execute=True)
    plc.run(1, turn)
    assert "CommandAborted" in turn.on
    assert read()["Torque"] == 0.0


def test_an_override_changes_the_movement_under_way(plc):
    plc.powered()
    move = plc.block("MC_MoveVelocity")
    override = plc.block("MC_SetOverride", "Enabled")
    move(Execute=True, Velocity=100.0, Acceleration=1e6, Deceleration=1e6)
    plc.run(10, move)
    assert "InVelocity" in move.on
    override(Enable=True, VelFactor=0.5, AccFactor=1.0)
    plc.run(10, move, override)
    assert "Enabled" in override.on
    assert velocity(plc) == pytest.approx(50.0)
    assert "InVelocity" in move.on
    override(VelFactor=0.0)
    plc.run(10, move, override)
    assert velocity(plc) == 0.0
    override(VelFactor=1.0)
    plc.run(10, move, override)
    assert velocity(plc) == pytest.approx(100.0)


def test_with_an_override_of_zero_a_movement_waits_and_then_ends_where_it_should(plc):
    plc.powered()
    move = plc.block("MC_MoveAbsolute")
    override = plc.block("MC_SetOverride", "Enabled")
    move(Execute=True, Position=10.0, **FAST)
    override(Enable=True, VelFactor=0.0, AccFactor=1.0)
    plc.run(5000, move, override)
    assert "Busy" in move.on
    assert position(plc) < 0.01
    override(VelFactor=1.0)
    plc.run(300, move, override)
    assert (position(plc), state(plc)) == (10.0, "StandStill")
    assert "Done" in move.on


PARAMETERS = StructType("Par", [Member(n, REAL) for n in ("Velocity", "Acceleration")])


def mapp_block(plc, name, inputs, outputs):
    """A block of MpAxis that knows its axis by MpLink."""
    ins = {"MpLink": UDINT, "Parameters": ReferenceType(PARAMETERS), **inputs}
    members = [Member(each, kind, section=Section.INPUT) for each, kind in ins.items()]
    members += [Member(each, kind, section=Section.OUTPUT) for each, kind in outputs.items()]
    plc.types[name] = DataBlockType(name, [*members, Member("Axis", UDINT)])
    block = plc.block(name, axis=0)
    at = plc.memory.allocate(PARAMETERS.size)
    plc.memory.set(REAL, at, 40.0)
    plc.memory.set(REAL, at + 4, 1e6)
    block.set(MpLink=AXIS, Parameters=at)
    return block


def test_cyclic_set_moves_as_its_commands_say(plc):
    plc.powered()
    bools = ("Enable", "MoveCyclicPosition", "MoveCyclicVelocity", "TorqueControl")
    reals = ("CyclicPosition", "CyclicVelocity", "CyclicTorque")
    shown = {f"{each}Active": BOOL for each in bools[1:]}
    inputs = {**dict.fromkeys(bools, BOOL), **dict.fromkeys(reals, REAL)}
    block = mapp_block(plc, "MpAxisCyclicSet", inputs, {"Active": BOOL, **shown})
    block(Enable=True, MoveCyclicVelocity=True, CyclicVelocity=25.0)
    plc.run(10, block)
    assert block.on == {"Active", "MoveCyclicVelocityActive"}
    assert velocity(plc) == pytest.approx(25.0)
    block(MoveCyclicVelocity=False, TorqueControl=True, CyclicTorque=0.1)
    plc.run(10, block)
    assert block.on == {"Active", "TorqueControlActive"}
    assert velocity(plc) == pytest.approx(40.0)
    block(TorqueControl=False)
    plc.run(10, block)
    assert block.on == {"Active"}
    assert velocity(plc) == 0.0


def test_a_cam_sequence_follows_its_master_from_start_to_end(plc):
    plc.powered()
    plc.powered(AXIS + 8)
    bools = ("Enable", "StartSequence", "EndSequence", "ParLock")
    shown = dict.fromkeys(("Active", "Running", "InCam", "ParLockDone", "Error"), BOOL)
    inputs = {**dict.fromkeys(bools, BOOL), "MpLinkMaster": UDINT}
    block = mapp_block(plc, "MpAxisCamSequencer", inputs, {**shown, "StatusID": UINT})
    block(Enable=True, StartSequence=True)
    assert block["StatusID"] == NO_AXIS
    block(StartSequence=False, MpLinkMaster=AXIS + 8)
    block(StartSequence=True)
    axes_of(plc.context).at(AXIS + 8).place(0.0)
    plc.block("MC_MoveVelocity", axis=AXIS + 8)(Execute=True, Velocity=60.0, Acceleration=1e6)
    plc.run(10, block)
    assert {"Running", "InCam"} <= block.on
    assert velocity(plc) == pytest.approx(60.0)
    block(EndSequence=True, StartSequence=False, ParLock=True)
    plc.run(20, block)
    assert block.on == {"Active", "ParLockDone"}
    assert state(plc) == "StandStill"
