"""The blocks MC_... of ACP10_MC (Automation Studio 3, 4) and McAxis (mapp Motion).

ErrorID is not the vendor's number; see `plcsim.library.motion.axis`. Axes need not be homed to
move, and have no end: Direction counts for velocities only.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Final

from plcsim.library.members import BlockVariables, StructMembers, changes
from plcsim.library.motion.axis import NO_AXIS, AxisState
from plcsim.library.motion.block import (
    EnableBlock,
    ExecuteBlock,
    MotionBlock,
    give_command,
    limits_of,
)
from plcsim.library.motion.coupling import Approach
from st_types.types.derived import StructType

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.members import FindType
    from plcsim.library.motion.axis import Axis, MotionCommand

NEGATIVE: Final = 1
"""mcNEGATIVE_DIR, mcDIR_NEGATIVE."""

DRIVE_STATUS: Final = "MC_DRIVESTATUS_TYP"


class Power(EnableBlock):
    """MC_Power: with power one call after Enable."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Switch at an edge; several blocks may know one axis."""
        variables.set(Status=enable and axis.is_powered)
        if changes(self.context, address, "Enable", enable):
            axis.power(on=enable)


class Home(ExecuteBlock):
    """MC_Home: any mode sets the position where the axis stands."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Set it."""
        axis.home(command, variables.number("Position"))


class MoveAbsolute(ExecuteBlock):
    """MC_MoveAbsolute."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Move."""
        axis.move_to(command, variables.number("Position"), limits_of(variables))


class MoveAdditive(ExecuteBlock):
    """MC_MoveAdditive."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Move."""
        axis.move_by(command, variables.number("Distance"), limits_of(variables))


class MoveRelative(ExecuteBlock):
    """MC_MoveRelative: from where the axis is."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Move."""
        target = axis.position + variables.number("Distance")
        axis.move_to(command, target, limits_of(variables))


class MoveVelocity(ExecuteBlock):
    """MC_MoveVelocity."""

    reached: ClassVar[str] = "InVelocity"

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Move."""
        sign = -1 if variables.number("Direction") == NEGATIVE else 1
        axis.move_at(command, sign * variables.number("Velocity"), limits_of(variables))


class Halt(ExecuteBlock):
    """MC_Halt."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Slow down."""
        axis.halt(command, limits_of(variables))


class Stop(ExecuteBlock):
    """MC_Stop: the axis takes no movement as long as Execute is TRUE."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Slow down."""
        axis.stop(command, limits_of(variables))

    def end(self, axis: Axis) -> None:
        """Take movements again."""
        axis.end_stop()


class Reset(ExecuteBlock):
    """MC_Reset: out of ERRORSTOP."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Reset."""
        axis.reset()
        command.finish()


class GearIn(ExecuteBlock):
    """MC_GearIn: coupled at once, without a phase of synchronization."""

    axis_names: ClassVar[tuple[str, ...]] = ("Slave",)
    reached: ClassVar[str] = "InGear"

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Couple."""
        ratio = variables.number("RatioNumerator") / (variables.number("RatioDenominator") or 1)
        couple(self, variables, axis, command, ratio)


class GearInPos(ExecuteBlock):
    """MC_GearInPos: over a straight line to the synchronous positions."""

    axis_names: ClassVar[tuple[str, ...]] = ("Slave",)
    reached: ClassVar[str] = "InSync"

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Couple."""
        approach = Approach(
            variables.number("MasterSyncPosition"),
            variables.number("SlaveSyncPosition"),
            variables.number("MasterStartDistance"),
        )
        ratio = variables.number("RatioNumerator") / (variables.number("RatioDenominator") or 1)
        couple(self, variables, axis, command, ratio, approach)


class CamIn(ExecuteBlock):
    """MC_CamIn: every cam is a straight line, by the scalings of slave and master."""

    axis_names: ClassVar[tuple[str, ...]] = ("Slave",)
    reached: ClassVar[str] = "InSync"

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Couple."""
        scalings = (variables.number(f"{each}Scaling") or 1 for each in ("Slave", "Master"))
        couple(self, variables, axis, command, next(scalings) / next(scalings))


def couple(
    block: MotionBlock,
    variables: BlockVariables,
    axis: Axis,
    command: MotionCommand,
    ratio: float,
    approach: Approach | None = None,
) -> None:
    """Let an axis follow the one at the input Master, or MpLinkMaster of mapp."""
    master = block.axes.at(variables.address("Master", "MpLinkMaster"))
    if master is None:
        command.refuse(NO_AXIS)
    else:
        axis.couple(command, master, ratio, approach)


class GearOut(ExecuteBlock):
    """MC_GearOut and MC_CamOut: the slave keeps its velocity."""

    axis_names: ClassVar[tuple[str, ...]] = ("Slave",)

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Uncouple."""
        axis.uncouple(command)


class JogVelocity(EnableBlock):
    """MC_BR_JogVelocity."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Move while one of the inputs is TRUE."""
        is_jogging = enable and jog(self.context, address, variables, axis, variables, "")
        variables.set(Active=enable, Ready=enable, Jogging=is_jogging)


def jog(
    context: Context,
    address: int,
    inputs: BlockVariables,
    axis: Axis,
    given: BlockVariables,
    prefix: str,
) -> bool:
    """Move an axis while JogPositive or JogNegative is TRUE; return whether it does.

    Args:
        context: of the controller.
        address: of the block.
        inputs: of the block.
        axis: to be moved.
        given: where velocity and rates stand.
        prefix: of their names.
    """
    sign = inputs.is_true("JogPositive") - inputs.is_true("JogNegative")
    if changes(context, address, "jog", sign):
        command, limits = give_command(context, address), limits_of(given, prefix)
        if sign:
            axis.move_at(command, sign * given.number(f"{prefix}Velocity"), limits)
        else:
            axis.halt(command, limits)
    return sign != 0


class ReadPosition(EnableBlock):
    """MC_ReadActualPosition."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show it."""
        variables.set(Position=axis.position if enable else 0.0)


class ReadVelocity(EnableBlock):
    """MC_ReadActualVelocity."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show it."""
        variables.set(Velocity=axis.velocity if enable else 0.0)


class ReadStatus(EnableBlock):
    """MC_ReadStatus."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show the state."""
        for state in AxisState:
            name = state.name.replace("_", "")
            variables.set(**{name: enable and axis.state is state})


class ReadAxisInfo(EnableBlock):
    """MC_ReadAxisInfo."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show it."""
        variables.set(Simulation=enable, CommunicationReady=enable, ReadyForPowerOn=enable)
        variables.set(PowerOn=enable and axis.is_powered, IsHomed=enable and axis.is_homed)


class ReadAxisError(EnableBlock):
    """MC_ReadAxisError: the model has no faults of a drive but the state ERRORSTOP."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show that there is none."""
        is_wrong = enable and axis.state is AxisState.ERRORSTOP
        variables.set(AxisErrorID=int(is_wrong), AxisErrorCount=int(is_wrong))


class ReadDriveStatus(EnableBlock):
    """MC_BR_ReadDriveStatus: into the structure at AdrDriveStatus."""

    settles: ClassVar[bool] = False

    def __init__(
        self,
        data_type: StructType[Any],
        context: Context,
        find_type: FindType,
    ) -> None:
        super().__init__(data_type, context, find_type)
        found = find_type(DRIVE_STATUS)
        self._status = StructMembers(found) if isinstance(found, StructType) else None

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Write it; an address that is wild is a page fault."""
        at = variables.address("AdrDriveStatus")
        if not (enable and at) or self._status is None:
            return
        BlockVariables(self.context.memory, self._status, at).set(
            Simulation=True,
            NetworkInit=True,
            DriveEnable=True,
            ControllerReady=True,
            ControllerStatus=axis.is_powered,
            HomingOk=axis.is_homed,
            AxisError=axis.state is AxisState.ERRORSTOP,
        )


BLOCKS: Final[Mapping[str, type[MotionBlock]]] = {
    "MC_Power": Power,
    "MC_Home": Home,
    "MC_MoveAbsolute": MoveAbsolute,
    "MC_MoveAdditive": MoveAdditive,
    "MC_MoveRelative": MoveRelative,
    "MC_MoveVelocity": MoveVelocity,
    "MC_Halt": Halt,
    "MC_Stop": Stop,
    "MC_Reset": Reset,
    "MC_GearIn": GearIn,
    "MC_GearInPos": GearInPos,
    "MC_CamIn": CamIn,
    "MC_GearOut": GearOut,
    "MC_CamOut": GearOut,
    "MC_BR_JogVelocity": JogVelocity,
    "MC_BR_JogLimitPosition": JogVelocity,
    "MC_ReadActualPosition": ReadPosition,
    "MC_ReadActualVelocity": ReadVelocity,
    "MC_ReadStatus": ReadStatus,
    "MC_ReadAxisInfo": ReadAxisInfo,
    "MC_ReadAxisError": ReadAxisError,
    "MC_BR_ReadDriveStatus": ReadDriveStatus,
}
"""What runs the blocks by their names."""
