"""MpAxisBasic: an axis by commands and parameters, as mapp has it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Final

from plcsim.library.members import ReferredStructure, changes, rises
from plcsim.library.motion.axis import NO_AXIS, AxisState, CommandStatus
from plcsim.library.motion.block import (
    MotionBlock,
    command_of,
    forget_command,
    give_command,
    limits_of,
)
from plcsim.library.motion.plcopen import NEGATIVE, jog

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables, FindType
    from plcsim.library.motion.axis import Axis
    from st_types.types.derived import StructType

MOVES: Final = ("MoveVelocity", "MoveAbsolute", "MoveAdditive")


class AxisBasic(MotionBlock):
    """MpAxisBasic: Power, Stop and the jogs count by level, the other commands by edge."""

    axis_names: ClassVar[tuple[str, ...]] = ("Axis", "MpLink")

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._parameters = ReferredStructure(data_type, "Parameters")

    def call(self, address: int, variables: BlockVariables, axis: Axis | None) -> None:
        """Take commands, and show what the axis does."""
        enable = variables.is_true("Enable")
        is_wrong = enable and axis is None
        variables.set(Error=is_wrong, StatusID=NO_AXIS if is_wrong else 0, Active=enable)
        if axis is None:
            return
        power = enable and variables.is_true("Power")
        if changes(self.context, address, "Power", power):
            axis.power(on=power)
        if rises(self.context, address, variables, "ErrorReset"):
            axis.reset()
        parameters = self._parameters.of(self.context.memory, variables)
        if enable and parameters is not None:
            self._commands(address, variables, axis, parameters)
        self._show(address, variables, axis, enable=enable)

    def _commands(
        self, address: int, inputs: BlockVariables, axis: Axis, parameters: BlockVariables
    ) -> None:
        context = self.context
        edges = {name for name in ("Home", *MOVES) if rises(context, address, inputs, name)}
        stop = inputs.is_true("Stop")
        if changes(context, address, "Stop", stop):
            if stop:
                axis.stop(give_command(context, address), limits_of(parameters, "Stop."))
            else:
                axis.end_stop()
        if not stop:
            jog(context, address, inputs, axis, parameters, "Jog.")
            self._move(address, axis, parameters, edges)

    def _move(self, address: int, axis: Axis, parameters: BlockVariables, edges: set[str]) -> None:
        limits = limits_of(parameters)
        for edge in sorted(edges):
            command = give_command(self.context, address)
            match edge:
                case "Home":
                    axis.home(command, parameters.number("Home.Position"))
                case "MoveAbsolute":
                    axis.move_to(command, parameters.number("Position"), limits)
                case "MoveAdditive":
                    axis.move_by(command, parameters.number("Distance"), limits)
                case _:
                    sign = -1 if parameters.number("Direction") == NEGATIVE else 1
                    axis.move_at(command, sign * parameters.number("Velocity"), limits)

    def _show(self, address: int, outputs: BlockVariables, axis: Axis, *, enable: bool) -> None:
        command = command_of(self.context, address) if enable else None
        status = None if command is None else command.status
        moves = axis.state not in (AxisState.DISABLED, AxisState.STANDSTILL, AxisState.ERRORSTOP)
        is_there = status is CommandStatus.DONE and any(outputs.is_true(each) for each in MOVES)
        is_wrong = axis.state is AxisState.ERRORSTOP or status is CommandStatus.REFUSED
        outputs.set(
            PowerOn=enable and axis.is_powered,
            IsHomed=enable and axis.is_homed,
            InVelocity=status is CommandStatus.REACHED and outputs.is_true("MoveVelocity"),
            InPosition=is_there,
            MoveDone=is_there,
            Info__MoveDone=is_there,
            MoveActive=enable and moves,
            Stopped=outputs.is_true("Stop") and status is CommandStatus.DONE,
            CommandBusy=status is CommandStatus.BUSY,
            CommandAborted=status is CommandStatus.ABORTED,
            Position=axis.position if enable else 0.0,
            Velocity=axis.velocity if enable else 0.0,
            UpdateDone=enable and outputs.is_true("Update"),
            Simulation=enable,
            Info__AxisInitialized=enable,
            Info__CommunicationReady=enable,
            Info__ReadyToPowerOn=enable,
            Info__DigitalInputsStatus__DriveEnable=enable,
        )
        if enable and is_wrong:
            outputs.set(Error=True, StatusID=0 if command is None else command.error_id)
        if status is CommandStatus.REFUSED and not any(map(outputs.is_true, ("Home", *MOVES))):
            forget_command(self.context, address)
        outputs.set_enumeration("Info.PLCopenState", f"AXIS_{axis.state.name}")
        outputs.set_enumeration("Info.BootState", "BLP_DONE")


BLOCKS: Final[Mapping[str, type[MotionBlock]]] = {"MpAxisBasic": AxisBasic}
"""What runs the blocks by their names."""
