"""The PLCopen blocks, by the states and outputs of part 1 of PLCopen motion control."""

import pytest

from plcsim.library.motion.axis import NO_AXIS, NO_NUMBER, NOT_ALLOWED, axes_of

from .conftest import AXIS, STATES

FAST = {"Velocity": 100.0, "Acceleration": 1000.0, "Deceleration": 1000.0}


def state(plc, axis=AXIS):
    found = plc.block("MC_ReadStatus", *STATES, axis=axis)(Enable=True).on & set(STATES)
    assert len(found) == 1
    return found.pop()


def position(plc, axis=AXIS):
    return plc.block("MC_ReadActualPosition", "Position", axis=axis)(Enable=True)["Position"]


def velocity(plc, axis=AXIS):
    return plc.block("MC_ReadActualVelocity", "Velocity", axis=axis)(Enable=True)["Velocity"]


def test_power_is_on_one_call_after_enable_and_off_with_it(plc):
    power = plc.block("MC_Power")
    assert state(plc) == "Disabled"
    assert "Status" not in power(Enable=True).on
    assert "Status" in power().on
    assert state(plc) == "StandStill"
    plc.block("MC_Power")(Enable=False)  # another block that was never TRUE turns nothing off
    assert state(plc) == "StandStill"
    assert "Status" not in power(Enable=False).on
    assert state(plc) == "Disabled"


def test_a_movement_is_busy_then_done_as_long_as_execute(plc):
    plc.powered()
    move = plc.block("MC_MoveAbsolute")
    assert move(Execute=True, Position=10.0, **FAST).on == {"Busy", "Active"}
    plc.run(199, move)  # 0.1 s up to 100 units/s over 5 units, 0.1 s down over 5 units
    assert move.on == {"Busy", "Active"}
    assert state(plc) == "DiscreteMotion"
    plc.run(1, move)
    assert move.on == {"Done"}
    assert (position(plc), velocity(plc), state(plc)) == (10.0, 0.0, "StandStill")
    plc.run(5, move)
    assert move.on == {"Done"}
    assert move(Execute=False).on == set()  # so Execute may rise in the next call already
    assert move(Execute=True, Position=20.0).on == {"Busy", "Active"}


def test_the_end_shows_for_one_call_when_execute_is_false_before(plc):
    plc.powered()
    move = plc.block("MC_MoveAdditive")
    move(Execute=True, Distance=-10.0, **FAST)
    move(Execute=False)
    plc.run(199, move)
    assert move.on == {"Busy", "Active"}
    plc.run(1, move)
    assert move.on == {"Done"}
    plc.run(1, move)
    assert move.on == set()
    assert position(plc) == -10.0


def test_a_movement_aborts_the_one_before(plc):
    plc.powered()
    first, second = plc.block("MC_MoveVelocity"), plc.block("MC_MoveAbsolute")
    first(Execute=True, **FAST)
    plc.run(50, first)
    assert first.on == {"Busy", "Active"}
    plc.run(50, first)
    assert first.on == {"Busy", "Active", "InVelocity"}
    assert (state(plc), velocity(plc)) == ("ContinuousMotion", 100.0)
    second(Execute=True, Position=0.0, **FAST)
    assert first().on == {"CommandAborted"}
    assert second().on == {"Busy", "Active"}
    plc.run(1000, first, second)
    assert second.on == {"Done"}
    assert position(plc) == 0.0


def test_the_direction_of_a_velocity_counts(plc):
    plc.powered()
    move = plc.block("MC_MoveVelocity")
    move(Execute=True, Direction=1, **FAST)
    plc.run(100, move)
    assert velocity(plc) == -100.0


def test_stop_holds_the_axis_and_halt_does_not(plc):
    plc.powered()
    move, stop, halt = (plc.block(f"MC_{name}") for name in ("MoveVelocity", "Stop", "Halt"))
    move(Execute=True, **FAST)
    plc.run(200, move)
    stop(Execute=True, Deceleration=1000.0)
    assert move().on == {"CommandAborted"}
    plc.run(100, stop)
    assert (stop.on, state(plc)) == ({"Done"}, "Stopping")
    move(Execute=False)
    assert move(Execute=True).on == {"Error"}
    assert move["ErrorID"] == NOT_ALLOWED
    stop(Execute=False)
    assert state(plc) == "StandStill"
    move(Execute=False)
    assert move(Execute=True).on == {"Busy", "Active"}
    plc.run(50, move)
    halt(Execute=True, Deceleration=1000.0)
    assert halt().on == {"Busy", "Active"}
    move(Execute=False)
    assert move(Execute=True).on == {"Busy", "Active"}
    assert halt().on == {"CommandAborted"}


def test_a_stop_whose_execute_falls_early_ends_by_itself(plc):
    plc.powered()
    move, stop = plc.block("MC_MoveVelocity"), plc.block("MC_Stop")
    move(Execute=True, **FAST)
    plc.run(200, move)
    stop(Execute=True, Deceleration=1000.0)
    stop(Execute=False)
    assert state(plc) == "Stopping"
    plc.run(100, stop)
    assert state(plc) == "StandStill"


def test_without_power_or_axis_nothing_moves(plc):
    move = plc.block("MC_MoveAbsolute")
    assert move(Execute=True, Position=1.0).on == {"Error"}
    assert move["ErrorID"] == NOT_ALLOWED
    nowhere = plc.block("MC_MoveAbsolute", axis=0)
    assert nowhere(Execute=True).on == {"Error"}
    assert nowhere["ErrorID"] == NO_AXIS
    read = plc.block("MC_ReadStatus", *STATES, axis=0)
    assert read(Enable=True).on == {"Error"}
    assert read(Enable=False).on == set()


@pytest.mark.parametrize("target", [float("nan"), float("inf"), 1e30])
def test_what_is_no_position_is_refused(plc, target):
    plc.powered()
    move = plc.block("MC_MoveAbsolute")
    assert move(Execute=True, Position=target).on == {"Error"}
    assert move["ErrorID"] == NO_NUMBER
    assert state(plc) == "StandStill"


@pytest.mark.parametrize("limit", [float("nan"), float("-inf"), 0.0, 1e-45, 3e38])
def test_limits_that_cannot_be_leave_a_motion_that_ends(plc, limit):
    plc.powered()
    move = plc.block("MC_MoveAbsolute")
    move(Execute=True, Position=1e-6, Velocity=limit, Acceleration=limit, Deceleration=limit)
    plc.run(3000, move)
    assert move.on == {"Done"}


def test_power_off_ends_a_movement_where_the_axis_is(plc):
    power = plc.powered()
    move = plc.block("MC_MoveVelocity")
    move(Execute=True, **FAST)
    plc.run(200, move)
    here = position(plc)
    power(Enable=False)
    plc.run(10, move)
    assert move.on == {"CommandAborted"}
    assert (position(plc), velocity(plc), state(plc)) == (here, 0.0, "Disabled")


def test_home_sets_the_position(plc):
    plc.powered()
    home, info = plc.block("MC_Home"), plc.block("MC_ReadAxisInfo")
    home(Execute=True, Position=250.0)
    assert info(Enable=True).on == {"Valid", "Busy", "PowerOn"} | {"IsHomed"}
    plc.run(1, home)
    assert home.on == {"Done"}
    assert (position(plc), state(plc)) == (250.0, "StandStill")


def test_an_axis_in_errorstop_is_reset(plc):
    power = plc.powered()
    axes_of(plc.context).at(AXIS).fail()
    error = plc.block("MC_ReadAxisError")(Enable=True)
    assert (state(plc), error["AxisErrorID"]) == ("Errorstop", 1)
    assert "Status" in power().on
    reset = plc.block("MC_Reset")
    reset(Execute=True)
    assert reset().on == {"Done"}
    assert (state(plc), plc.block("MC_ReadAxisError")(Enable=True)["AxisErrorID"]) == (
        "StandStill",
        0,
    )


def test_gear_in_follows_the_master_and_gear_out_goes_on(plc):
    master, slave = AXIS, AXIS + 64
    plc.powered(master)
    plc.powered(slave)
    gear, out = plc.block("MC_GearIn", axis=0), plc.block("MC_GearOut", axis=0)
    gear(Execute=True, Master=master, Slave=slave, RatioNumerator=-3, RatioDenominator=2)
    plc.run(1, gear)
    assert gear.on == {"Busy", "Active", "InGear"}
    move = plc.block("MC_MoveAbsolute", axis=master)
    move(Execute=True, Position=10.0, **FAST)
    plc.run(300, move, gear)
    assert (position(plc, slave), state(plc, slave)) == (pytest.approx(-15.0), "SynchronizedMotion")
    ring = plc.block("MC_GearIn", axis=0)
    ring(Execute=True, Master=slave, Slave=master, RatioNumerator=1, RatioDenominator=1)
    assert ring.on == {"Error"}
    out(Execute=True, Slave=slave)
    plc.run(1, gear, out)
    assert (gear.on, out.on) == ({"CommandAborted"}, {"Done"})
    assert state(plc, slave) == "ContinuousMotion"


def test_a_jog_moves_while_one_input_is_true(plc):
    plc.powered()
    jog = plc.block("MC_BR_JogVelocity")
    jog(Enable=True, JogPositive=True, **FAST)
    plc.run(200, jog)
    assert "Jogging" in jog.on
    assert velocity(plc) == 100.0
    jog(JogNegative=True)
    plc.run(200, jog)
    assert ("Jogging" in jog.on, velocity(plc)) == (False, 0.0)
    jog(JogPositive=False)
    plc.run(200, jog)
    assert velocity(plc) == -100.0


def test_the_status_of_the_drive_is_written_to_an_address(plc):
    plc.powered()
    at = plc.memory.allocate(4)
    read = plc.block("MC_BR_ReadDriveStatus")
    assert "Valid" in read(Enable=True, AdrDriveStatus=at).on
    assert plc.memory.read(at, 3) == bytes([1, 1, 0])
    assert "Valid" in read(AdrDriveStatus=0).on


def test_a_restart_forgets_axes_and_commands(plc):
    plc.powered()
    move = plc.block("MC_MoveAbsolute")
    move(Execute=True, Position=10.0, **FAST)
    plc.context.restart()
    assert state(plc) == "Disabled"
    assert move(Execute=False).on == set()


def test_gear_in_pos_is_in_sync_at_the_positions_of_both(plc):
    for axis in (AXIS, AXIS + 8):
        plc.powered(axis)
    plc.block("MC_MoveVelocity")(Execute=True, Velocity=100.0, Acceleration=1e6)
    gear = plc.block("MC_GearInPos", axis=0)
    gear.set(Master=AXIS, Slave=AXIS + 8, RatioNumerator=2, RatioDenominator=1)
    gear(Execute=True, MasterSyncPosition=50.0, SlaveSyncPosition=20.0, MasterStartDistance=40.0)
    plc.run(100, gear)
    assert position(plc, AXIS + 8) == 0.0  # the master has 10, from where the slave starts
    plc.run(390, gear)
    assert "InSync" not in gear.on
    plc.run(20, gear)
    assert "InSync" in gear.on
    assert position(plc, AXIS + 8) == pytest.approx(20.0 + 2 * (position(plc) - 50.0))
    assert velocity(plc, AXIS + 8) == pytest.approx(200.0)
    assert state(plc, AXIS + 8) == "SynchronizedMotion"


def test_a_master_that_is_beyond_is_followed_at_once(plc):
    for axis in (AXIS, AXIS + 8):
        plc.powered(axis)
    plc.block("MC_Home")(Execute=True, Position=100.0)
    gear = plc.block("MC_GearInPos", axis=0)
    gear.set(Master=AXIS, Slave=AXIS + 8, RatioNumerator=1, MasterSyncPosition=50.0)
    gear(Execute=True)
    plc.run(1, gear)
    assert "InSync" in gear.on
    assert position(plc, AXIS + 8) == 0.0


def test_a_cam_is_a_line_by_its_scalings_until_cam_out(plc):
    for axis in (AXIS, AXIS + 8):
        plc.powered(axis)
    plc.block("MC_MoveVelocity")(Execute=True, Velocity=100.0, Acceleration=1e6)
    cam = plc.block("MC_CamIn", axis=0)
    cam.set(Master=AXIS, Slave=AXIS + 8, MasterScaling=2, SlaveScaling=3)
    cam(Execute=True)
    plc.run(100, cam)
    assert "InSync" in cam.on
    assert velocity(plc, AXIS + 8) == pytest.approx(150.0)
    out = plc.block("MC_CamOut", axis=0)
    out.set(Slave=AXIS + 8)
    out(Execute=True)
    plc.run(1, cam, out)
    assert "Done" in out.on
    assert "CommandAborted" in cam.on
    assert state(plc, AXIS + 8) == "ContinuousMotion"


def test_no_axis_follows_what_is_none_or_itself(plc):
    plc.powered()
    cam = plc.block("MC_CamIn", axis=0)
    cam.set(Slave=AXIS)
    assert cam(Execute=True)["ErrorID"] == NO_AXIS
    cam(Execute=False)
    assert cam(Execute=True, Master=AXIS)["ErrorID"] == NOT_ALLOWED
