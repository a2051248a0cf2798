"""Blocks that give an axis a velocity, a position or a torque in every call, or an override.

MpAxisCyclicSet and MpAxisCamSequencer of mapp are made of the same.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Final

from plcsim.library.members import ReferredStructure, changes, rises
from plcsim.library.motion.axis import NO_AXIS, CommandStatus
from plcsim.library.motion.block import (
    EnableBlock,
    ExecuteBlock,
    MotionBlock,
    command_of,
    give_command,
    limits_of,
)
from plcsim.library.motion.plcopen import couple

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables, FindType
    from plcsim.library.motion.axis import Axis, MotionCommand
    from plcsim.library.motion.profile import MotionLimits
    from st_types.types.derived import StructType


class CyclicBlock(EnableBlock):
    """A block with Enable that moves the axis as long as that is TRUE, and halts it then."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Give the value of this call."""
        status = move_cyclically(self.context, address, axis, limits_of(variables), enable=enable)
        if status is not None and status.is_in_control:
            self.move(variables, axis, status)
        is_active = enable and status is not None and status.is_in_control
        variables.set(Active=is_active, Valid=is_active)
        variables.set(CommandAborted=_is(status, CommandStatus.ABORTED) and enable)
        if enable and status is not None and status.error_id:
            variables.set(Error=True, ErrorID=status.error_id)

    def move(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Give the value to the axis."""
        raise NotImplementedError(type(self).__name__)


def move_cyclically(
    context: Context, address: int, axis: Axis, limits: MotionLimits, *, enable: bool
) -> MotionCommand | None:
    """Return the command of a block as long as it moves its axis; halt the axis at its end.

    Args:
        context: of the controller.
        address: of the block, or of the input of it that moves.
        axis: to be moved.
        limits: of the halt.
        enable: whether the block is to move it.
    """
    command = command_of(context, address)
    if changes(context, address, "moves", enable):
        if enable:
            return give_command(context, address)
        if command is not None and command.is_in_control:
            axis.halt(give_command(context, address), limits)
    return command if enable else None


def _is(command: MotionCommand | None, status: CommandStatus) -> bool:
    return command is not None and command.status is status


class VelocityControl(CyclicBlock):
    """MC_BR_VelocityControl, MC_BR_MoveCyclicVelocity."""

    def move(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Take the velocity of this call."""
        velocity = variables.number("CyclicVelocity")
        velocity += variables.number("CyclicVelocityCorrection")
        take_velocity(axis, command, velocity, limits_of(variables))


def take_velocity(
    axis: Axis, command: MotionCommand, velocity: float, limits: MotionLimits
) -> None:
    """Let an axis have a velocity; one that it is on the way to already changes nothing."""
    if command.cyclic_value != velocity:
        command.cyclic_value = velocity
        command.status = CommandStatus.BUSY
        axis.move_at(command, velocity, limits)


class MoveCyclicPosition(CyclicBlock):
    """MC_BR_MoveCyclicPosition: the axis is at the position of a call in the next one."""

    def move(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Go there."""
        axis.track(command, position_of(variables))


def position_of(variables: BlockVariables) -> float:
    """Return CyclicPosition, of ACP10_MC a STRUCT of an Integer and a Real."""
    names = ("CyclicPosition", "CyclicPosition.Integer", "CyclicPosition.Real")
    return sum(variables.number(name) for name in names)


class ReadCyclicPosition(EnableBlock):
    """MC_BR_ReadCyclicPosition: the position of the axis, whatever is asked for."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show it."""
        position = axis.position if enable else 0.0
        whole = math.floor(position)
        variables.set(CyclicPosition__Integer=whole, CyclicPosition__Real=position - whole)
        variables.set(CyclicPosition=position)


class TorqueControl(ExecuteBlock):
    """MC_TorqueControl: nothing holds the axis, which turns at the velocity that it may have."""

    reached: ClassVar[str] = "InTorque"

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Turn."""
        limits = limits_of(variables)
        axis.turn(command, variables.number("Torque"), limits.velocity, limits)


class ReadTorque(EnableBlock):
    """MC_ReadActualTorque: the torque that MC_TorqueControl asked for, else 0."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show it."""
        variables.set(Torque=axis.torque if enable else 0.0)


class SetOverride(EnableBlock):
    """MC_SetOverride: the factors stay when Enable is FALSE again."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Set them."""
        if enable:
            axis.override(variables.number("VelFactor"), variables.number("AccFactor"))


class MappAxisBlock(MotionBlock):
    """A block of MpAxis beside MpAxisBasic, which has the same axis at its MpLink."""

    axis_names: ClassVar[tuple[str, ...]] = ("MpLink", "Axis")

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._parameters = ReferredStructure(data_type, "Parameters")

    def call(self, address: int, variables: BlockVariables, axis: Axis | None) -> None:
        """Take commands, and show what became of them."""
        enable = variables.is_true("Enable")
        is_wrong = enable and axis is None
        variables.set(Active=enable, Error=is_wrong, StatusID=NO_AXIS if is_wrong else 0)
        variables.set(UpdateDone=enable and variables.is_true("Update"))
        if axis is not None:
            self.act(address, variables, axis, enable=enable)

    def parameters(self, variables: BlockVariables) -> BlockVariables:
        """Return the parameters that the block refers to, the block itself without any."""
        return self._parameters.of(self.context.memory, variables) or variables

    def act(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Do what the inputs ask for."""
        raise NotImplementedError(type(self).__name__)


class CyclicSet(MappAxisBlock):
    """MpAxisCyclicSet: its commands count by level."""

    def act(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Give the values of this call."""
        limits = limits_of(self.parameters(variables))
        names = ("MoveCyclicPosition", "MoveCyclicVelocity", "TorqueControl")
        wanted = next((each for each in names if enable and variables.is_true(each)), "")
        if wanted and changes(self.context, address, "wanted", names.index(wanted) + 1):
            move_cyclically(self.context, address, axis, limits, enable=False)
        command = move_cyclically(self.context, address, axis, limits, enable=bool(wanted))
        if command is not None and command.is_in_control:
            if wanted == names[0]:
                axis.track(command, variables.number("CyclicPosition"))
            elif wanted == names[1]:
                take_velocity(axis, command, variables.number("CyclicVelocity"), limits)
            else:
                axis.turn(command, variables.number("CyclicTorque"), limits.velocity, limits)
        is_moving = command is not None and command.is_in_control
        variables.set(**{f"{each}Active": is_moving and each == wanted for each in names})
        variables.set(CommandAborted=_is(command, CommandStatus.ABORTED))


class CamSequencer(MappAxisBlock):
    """MpAxisCamSequencer: while the sequence runs, the axis follows its master one to one."""

    DONE: ClassVar[Mapping[str, str]] = {
        "GetSequence": "GetSequenceDone",
        "ParLock": "ParLockDone",
        "OffsetShift": "OffsetDone",
        "PhaseShift": "PhasingDone",
        "CamPrepare": "CamPrepareDone",
        "Recovery": "RecoveryDone",
    }

    def act(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Start and end the sequence."""
        context = self.context
        starts = rises(context, address, variables, "StartSequence")
        ends = rises(context, address, variables, "EndSequence")
        command = command_of(context, address)
        is_running = command is not None and command.is_in_control
        if enable and starts and not is_running:
            couple(self, variables, axis, give_command(context, address), 1.0)
        elif is_running and (ends or not enable):
            axis.halt(give_command(context, address), limits_of(self.parameters(variables)))
        command = command_of(context, address)
        is_running = _is(command, CommandStatus.REACHED)
        variables.set(Running=is_running, InCam=is_running, ActualStateIndex=int(is_running))
        variables.set(CommandAborted=_is(command, CommandStatus.ABORTED))
        for given, shown in self.DONE.items():
            variables.set(**{shown: enable and variables.is_true(given)})
        if command is not None and command.error_id:
            variables.set(Error=enable, StatusID=command.error_id)


BLOCKS: Final[Mapping[str, type[MotionBlock]]] = {
    "MC_BR_VelocityControl": VelocityControl,
    "MC_BR_MoveCyclicVelocity": VelocityControl,
    "MC_BR_MoveCyclicPosition": MoveCyclicPosition,
    "MC_BR_ReadCyclicPosition": ReadCyclicPosition,
    "MC_TorqueControl": TorqueControl,
    "MC_ReadActualTorque": ReadTorque,
    "MC_SetOverride": SetOverride,
    "MpAxisCyclicSet": CyclicSet,
    "MpAxisCamSequencer": CamSequencer,
}
"""What runs the blocks by their names."""
