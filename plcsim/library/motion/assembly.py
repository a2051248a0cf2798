"""Assemblies of shuttles and groups of axes: power, states, and which shuttles there are.

Of a track (McAcpTrak) or a plane (McAcp6D) the model knows no geometry: a shuttle is an axis of its
own, its position is that of the last command, in whatever sector. Shuttles do not meet, and pass no
process points. Groups (McAxGroup) have power and a state; their movements follow the table of
`plcsim.library.simulated`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Final

from plcsim.library.members import changes, rises
from plcsim.library.motion.axis import NO_NUMBER, AxisState
from plcsim.library.motion.block import EnableBlock, ExecuteBlock, limits_of
from plcsim.library.motion.plcopen import MoveAbsolute, MoveAdditive, MoveVelocity

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables
    from plcsim.library.motion.axis import Axes, Axis, MotionCommand
    from plcsim.library.motion.block import MotionBlock

NAMES: Final = ("Assembly", "Segment", "AxesGroup", "Controller")
"""Inputs with the address of what is powered, which the model takes for an axis."""

SHUTTLES: Final = 10
"""Shuttles of a controller, where the program adds none before it asks for them."""

LARGEST_USER_DATA: Final = 1 << 16
"""Bytes that a shuttle carries."""

SHUTTLE_DISTANCE: Final = 0.1
"""Between those, in units of an axis."""

_READY: Final[Mapping[AxisState, str]] = {
    AxisState.DISABLED: "DISABLED",
    AxisState.ERRORSTOP: "ERRORSTOP",
}


class Shuttles:
    """The shuttles of a controller, in the order in which they were added.

    Args:
        _context: of the controller.

    Attributes:
        handles: of the shuttles.
        is_powered: whether their controllers are on.
        indices: which shuttle a block shows, by its address.
        user_data: what shuttles carry.
    """

    def __init__(self, _context: Context) -> None:
        self.handles: list[int] = []
        self.is_powered = False
        self.indices: dict[int, int] = {}
        self.user_data: dict[Axis, bytes] = {}

    def add(self, axes: Axes, position: float) -> int | None:
        """Put a shuttle somewhere; return its handle, None where there are too many axes."""
        made = axes.add()
        if made is None:
            return None
        handle, shuttle = made
        shuttle.place(position)
        shuttle.power(on=self.is_powered)
        self.handles.append(handle)
        return handle

    def power(self, axes: Axes, *, on: bool) -> None:
        """Turn the controllers of all shuttles on or off."""
        self.is_powered = on
        for shuttle in filter(None, map(axes.by_handle, self.handles)):
            shuttle.power(on=on)


class PowerSwitch(ExecuteBlock):
    """MC_BR_AsmPowerOn_AcpTrak and its like: power for all of an assembly, or none."""

    axis_names: ClassVar[tuple[str, ...]] = NAMES
    is_on: ClassVar[bool] = True

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Switch, at once."""
        axis.power(on=self.is_on)
        if variables.address("Assembly", "Controller"):
            self.context.library(Shuttles).power(self.axes, on=self.is_on)
        command.finish()


class SwitchOff(PowerSwitch):
    """MC_BR_AsmPowerOff_AcpTrak and its like."""

    is_on: ClassVar[bool] = False


class GroupPower(EnableBlock):
    """MC_BR_GroupPower: with power one call after Enable."""

    axis_names: ClassVar[tuple[str, ...]] = NAMES

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Switch at an edge."""
        variables.set(Status=enable and axis.is_powered)
        if changes(self.context, address, "Enable", enable):
            axis.power(on=enable)


class GroupHome(ExecuteBlock):
    """MC_GroupHome, MC_BR_GroupHome_15: any mode, for all axes of the group."""

    axis_names: ClassVar[tuple[str, ...]] = NAMES

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Home."""
        axis.home(command, 0.0)


class AssemblyReset(ExecuteBlock):
    """MC_BR_AsmReset_AcpTrak, MC_GroupReset: out of ERRORSTOP."""

    axis_names: ClassVar[tuple[str, ...]] = NAMES

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Reset, at once."""
        axis.reset()
        command.finish()


class AssemblyStatus(EnableBlock):
    """MC_BR_AsmReadStatus_AcpTrak, MC_GroupReadStatus and their like."""

    axis_names: ClassVar[tuple[str, ...]] = NAMES

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show the state: disabled, ready or, of a group, standing by, or in ERRORSTOP."""
        is_ready = enable and axis.state not in _READY
        for name in ("Assembly", "Segment", "Group"):
            for state, shown in _READY.items():
                variables.set(**{f"{name}{shown}": enable and axis.state is state})
            variables.set(**{f"{name}Ready": is_ready, f"{name}Standby": is_ready})
        variables.set_enumeration("State", "OPERATION" if is_ready else "INACTIVE")


class AssemblyInfo(EnableBlock):
    """MC_BR_AsmReadInfo_AcpTrak, MC_BR_GroupReadInfo and their like."""

    axis_names: ClassVar[tuple[str, ...]] = NAMES
    settles: ClassVar[bool] = False

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show what there is, in the structure of the block or beside it."""
        count = len(self.context.library(Shuttles).handles)
        for place in ("", "AssemblyInfo__", "SegmentInfo__"):
            variables.set(
                **{
                    f"{place}CommunicationReady": enable,
                    f"{place}ReadyForPowerOn": enable,
                    f"{place}PowerOn": enable and axis.is_powered,
                    f"{place}IsHomed": enable and axis.is_homed,
                    f"{place}ShuttlesCount": count if enable else 0,
                }
            )
        state = _READY.get(axis.state, "READY")
        variables.set_enumeration("AssemblyInfo.PLCopenState", f"_{state}")
        variables.set_enumeration("AssemblyInfo.AssemblyState", f"_{state}")


class AddShuttle(ExecuteBlock):
    """MC_BR_SecAddShuttle_AcpTrak: a shuttle at a position of a sector."""

    axis_names: ClassVar[tuple[str, ...]] = ("Sector",)

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Add it, and show what programs name it with."""
        shuttles = self.context.library(Shuttles)
        handle = shuttles.add(self.axes, variables.number("Position"))
        if handle is not None:
            variables.set(Axis__controlif=handle, ID=len(shuttles.handles))
            command.finish()


class GetShuttle(EnableBlock):
    """MC_BR_AsmGetShuttle_AcpTrak and its like: one shuttle, and at an edge of Next another."""

    axis_names: ClassVar[tuple[str, ...]] = ("Assembly", "Sector")
    settles: ClassVar[bool] = False

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show it; all are on each assembly and in each sector."""
        shuttles = self.context.library(Shuttles)
        handles = shuttles.handles
        is_next = rises(self.context, address, variables, "Next")
        if not enable:
            shuttles.indices.pop(address, None)
            return
        for number in range(0 if handles else SHUTTLES):
            shuttles.add(self.axes, number * SHUTTLE_DISTANCE)
        if not handles:
            return
        index = shuttles.indices.get(address, 0)
        shuttles.indices[address] = index = (index + is_next) % len(handles)
        left = len(handles) - 1 - index
        variables.set(TotalCount=len(handles), RemainingCount=left)
        variables.set(Axis__controlif=handles[index], Shuttle__controlif=handles[index])


class ShuttleInfo(EnableBlock):
    """MC_BR_ShReadInfo_AcpTrak."""

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show state and place."""
        if enable:
            name = axis.state.name
            variables.set_enumeration("ShuttleInfo.PLCopenState", f"_{name}")
            variables.set(ShuttleInfo__SectorPosition=axis.position)
            variables.set(ShuttleInfo__ActualPosition=axis.position)
            variables.set(ShuttleInfo__ActualVelocity=axis.velocity)


class CopyUserData(ExecuteBlock):
    """MC_BR_ShCopyUserData_AcpTrak: a shuttle carries what a program gives it."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Copy between the shuttle and the program, by the name of the mode.

        Raises:
            PageFault: nothing lies at DataAddress.
        """
        memory, carried = self.context.memory, self.context.library(Shuttles).user_data
        address, size = variables.address("DataAddress"), int(variables.number("DataSize"))
        if not 0 <= size <= LARGEST_USER_DATA:
            command.refuse(NO_NUMBER)
            return
        if "GET" in variables.enumerator("Mode").upper():
            memory.write(address, carried.get(axis, b"")[:size].ljust(size, b"\0"))
        else:
            carried[axis] = memory.read(address, size)
        command.finish()


class RoutedMoveVelocity(MoveVelocity):
    """MC_BR_RoutedMoveVel_AcpTrak: to a position, and on with a velocity, which may be 0."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Move."""
        if variables.number("Velocity") != 0:
            super().begin(variables, axis, command)
            return
        limits = limits_of(variables)
        route = abs(variables.number("RouteVelocity")) or limits.velocity
        axis.move_to(command, variables.number("Position"), limits._replace(velocity=route))


def _names(*endings: str, kinds: tuple[str, ...] = ("AcpTrak", "Acp6D")) -> list[str]:
    return [f"MC_BR_{ending}_{kind}" for ending in endings for kind in kinds]


_KINDS: Final[Mapping[type[MotionBlock], list[str]]] = {
    PowerSwitch: [*_names("AsmPowerOn", "SysPowerOn", "SegPowerOn"), "MC_GroupEnable"],
    SwitchOff: [*_names("AsmPowerOff", "SysPowerOff", "SegPowerOff"), "MC_GroupDisable"],
    GroupPower: ["MC_BR_GroupPower"],
    GroupHome: ["MC_GroupHome", "MC_BR_GroupHome_15", "MC_BR_GroupHome_6"],
    AssemblyReset: [*_names("AsmReset"), "MC_GroupReset"],
    AssemblyStatus: [
        *_names("AsmReadStatus", "SegReadStatus", "SysReadState"),
        "MC_GroupReadStatus",
    ],
    AssemblyInfo: [*_names("AsmReadInfo"), "MC_BR_GroupReadInfo"],
    AddShuttle: _names("SecAddShuttle", kinds=("AcpTrak",)),
    GetShuttle: _names("AsmGetShuttle", "AsmGetShuttleSel", "SecGetShuttle", "SecGetShuttleSel"),
    ShuttleInfo: _names("ShReadInfo", kinds=("AcpTrak",)),
    CopyUserData: _names("ShCopyUserData", kinds=("AcpTrak",)),
    MoveAbsolute: _names("RoutedMoveAbs", "ElasticMoveAbs", "ModuloMoveAbs", kinds=("AcpTrak",)),
    MoveAdditive: _names("ElasticMoveAdd", kinds=("AcpTrak",)),
    MoveVelocity: _names("ElasticMoveVel", kinds=("AcpTrak",)),
    RoutedMoveVelocity: _names("RoutedMoveVel", kinds=("AcpTrak",)),
}

BLOCKS: Final[Mapping[str, type[MotionBlock]]] = {
    name: kind for kind, names in _KINDS.items() for name in names
}
"""What runs the blocks by their names."""
