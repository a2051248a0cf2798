"""Calls that would change nothing are left out, and no other."""

import pytest

from plcsim.library.motion.axis import MotionCommand, axes_of
from plcsim.library.motion.block import DEFAULT
from plcsim.library.motion.plcopen import MoveAbsolute, ReadDriveStatus, ReadPosition

from .conftest import AXIS, STATES

FAST = {"Velocity": 100.0, "Acceleration": 1000.0, "Deceleration": 1000.0}


@pytest.fixture
def calls(monkeypatch):
    """How often blocks of some kinds really ran."""
    counts = {}

    def counted(kind):
        run = kind.call

        def call(self, *arguments):
            counts[kind] = counts.get(kind, 0) + 1
            run(self, *arguments)

        monkeypatch.setattr(kind, "call", call)

    for kind in (MoveAbsolute, ReadPosition, ReadDriveStatus):
        counted(kind)
    return counts


def test_blocks_with_nothing_to_do_do_not_run(plc, calls):
    plc.powered()
    move, position = plc.block("MC_MoveAbsolute"), plc.block("MC_ReadActualPosition", "Position")
    position(Enable=True)
    plc.run(50, move, position)
    assert calls[MoveAbsolute] == 1
    assert calls[ReadPosition] <= 3
    move(Execute=True, Position=10.0, **FAST)
    plc.run(100, move, position)  # half of the movement
    assert calls[MoveAbsolute] <= 4
    assert position["Position"] == pytest.approx(5.0)
    plc.run(100, move, position)
    assert "Done" in move.on
    assert position["Position"] == 10.0


def test_what_another_block_did_is_seen(plc):
    status = plc.block("MC_ReadStatus", *STATES)
    status(Enable=True)
    plc.run(10, status)
    assert "Disabled" in status.on
    plc.powered()
    assert "StandStill" in status().on


def test_another_torque_at_the_same_velocity_is_seen(plc):
    plc.powered()
    read = plc.block("MC_ReadActualTorque", "Torque")
    axis, command = axes_of(plc.context).at(AXIS), MotionCommand()
    axis.turn(command, 2.0, 0.0, DEFAULT)
    read(Enable=True)
    plc.run(10, read)
    assert read["Torque"] == 2.0
    axis.turn(command, 3.0, 0.0, DEFAULT)
    assert read()["Torque"] == 3.0


def test_an_output_that_a_program_wrote_is_written_again(plc):
    plc.powered()
    move = plc.block("MC_MoveAbsolute")
    plc.run(10, move)
    move.set(Done=True)
    assert move().on == set()


def test_another_axis_at_the_same_block_is_seen(plc):
    position = plc.block("MC_ReadActualPosition", "Position")
    position(Enable=True)
    plc.run(10, position)
    axes_of(plc.context).at(AXIS + 64).place(7.0)
    assert position(Axis=AXIS + 64)["Position"] == 7.0


def test_a_restart_forgets_what_is_settled(plc):
    plc.powered()
    status = plc.block("MC_ReadStatus", *STATES)
    status(Enable=True)
    plc.run(10, status)
    assert "StandStill" in status.on
    plc.context.restart()
    assert "Disabled" in status().on


def test_a_block_that_writes_elsewhere_runs_in_each_call(plc, calls):
    status = plc.block("MC_BR_ReadDriveStatus")
    place = plc.memory.allocate(8)
    status(Enable=True, AdrDriveStatus=place)
    plc.run(10, status)
    assert calls[ReadDriveStatus] == 11
    plc.memory.write(place, b"\0" * 8)
    status()
    assert any(plc.memory.read(place, 3))
