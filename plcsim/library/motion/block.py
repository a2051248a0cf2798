"""What the blocks share: they find their axis, and report as PLCopen has it.

A block with Execute takes its command at the rising edge, is Busy (and Active) until that is done,
aborted or refused, and shows the end as long as Execute is TRUE, for one call at least.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Final

from plcsim.library.members import changes
from plcsim.library.motion.axis import NO_AXIS, CommandStatus, MotionCommand, axes_of
from plcsim.library.motion.profile import MotionLimits
from plcsim.library.settling import SettlingBlock

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables
    from plcsim.library.motion.axis import Axes, Axis

DEFAULT: Final = MotionLimits(1_000.0, 5_000.0, 5_000.0)
"""Limits of an axis, for parameters that are 0."""


class MotionBlock(SettlingBlock["Axis | None"]):
    """Runs the blocks of one type on one controller; they are about their axis.

    Attributes:
        axis_names: inputs that name it, of which the first that is not 0 counts.
    """

    axis_names: ClassVar[tuple[str, ...]] = ("Axis",)

    def place(self, variables: BlockVariables) -> int:
        """Return the address of the axis."""
        return variables.address(*self.axis_names)

    def find(self, place: int) -> Axis | None:
        """Return the axis as it is now, None where the block names none."""
        axis = self.axes.at(place)
        if axis is not None:
            axis.update(self.context.release_ns)
        return axis

    def look(self, address: int, subject: Axis | None) -> tuple[object, ...]:
        """Return what a call depends on: the command and the axis."""
        seen = _seen(command_of(self.context, address))
        if subject is None:
            return seen
        state = (subject.state, subject.is_powered, subject.is_homed)
        return (*seen, *state, subject.position, subject.velocity, subject.torque)

    def execute(self, address: int, variables: BlockVariables, subject: Axis | None) -> None:
        """Run one call."""
        self.call(address, variables, subject)

    def call(self, address: int, variables: BlockVariables, axis: Axis | None) -> None:
        """Run one call; the axis is as it is now, None where the block names none."""
        raise NotImplementedError(type(self).__name__)

    @property
    def axes(self) -> Axes:
        """The axes of the controller."""
        return axes_of(self.context)


class _Calls:
    """Commands of blocks, by address; a restart forgets them."""

    def __init__(self, _context: Context) -> None:
        self.commands: dict[int, MotionCommand] = {}


def _seen(command: MotionCommand | None) -> tuple[object, ...]:
    return () if command is None else (command, command.status, command.is_shown)


def command_of(context: Context, address: int) -> MotionCommand | None:
    """Return the last command of a block, None before the first and after its end was shown."""
    return context.library(_Calls).commands.get(address)


def give_command(context: Context, address: int) -> MotionCommand:
    """Return a new command of a block."""
    made = context.library(_Calls).commands[address] = MotionCommand()
    return made


def forget_command(context: Context, address: int) -> None:
    """Let a block have no command."""
    context.library(_Calls).commands.pop(address, None)


class ExecuteBlock(MotionBlock):
    """A block with Execute.

    Attributes:
        reached: the output for REACHED, or DONE.
    """

    reached: ClassVar[str] = "Done"

    def call(self, address: int, variables: BlockVariables, axis: Axis | None) -> None:
        """Take a command, or tell of the last."""
        execute, context = variables.is_true("Execute"), self.context
        is_edge = changes(context, address, "Execute", execute)
        if is_edge and execute:
            command = give_command(context, address)
            if axis is None:
                command.refuse(NO_AXIS)
            else:
                self.begin(variables, axis, command)
            self._show(
                variables, command if command.status is CommandStatus.REFUSED else MotionCommand()
            )
            return
        if is_edge and axis is not None:
            self.end(axis)
        found = command_of(context, address)
        if found is not None and found.is_shown and not execute:
            forget_command(context, address)
            found = None
        self._show(variables, found)

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Give the command to the axis."""
        raise NotImplementedError(type(self).__name__)

    def end(self, axis: Axis) -> None:
        """Do what the end of Execute means; for most, nothing."""

    def look(self, address: int, subject: Axis | None) -> tuple[object, ...]:
        """Return what a call depends on: the command alone, as an edge is in the data block."""
        return _seen(command_of(self.context, address))

    def _show(self, variables: BlockVariables, command: MotionCommand | None) -> None:
        status = None if command is None else command.status
        is_busy = command is not None and command.is_in_control
        if command is not None:
            command.is_shown = not is_busy
        is_reached = status in (CommandStatus.REACHED, CommandStatus.DONE)
        variables.set(**{self.reached: is_reached, "PositionReached": is_reached})
        variables.set(Busy=is_busy, Active=is_busy, CommandAborted=status is CommandStatus.ABORTED)
        error_id = 0 if command is None else command.error_id
        variables.set(Acknowledge=is_busy or status is CommandStatus.DONE)
        variables.set(Error=error_id != 0, ErrorID=error_id)


class EnableBlock(MotionBlock):
    """A block with Enable that reads or switches as long as that is TRUE."""

    def call(self, address: int, variables: BlockVariables, axis: Axis | None) -> None:
        """Read, or show nothing."""
        enable = variables.is_true("Enable")
        is_wrong = enable and axis is None
        variables.set(Error=is_wrong, ErrorID=NO_AXIS if is_wrong else 0)
        is_valid = enable and axis is not None
        variables.set(Valid=is_valid, Busy=is_valid, Enabled=is_valid)
        if axis is not None:
            self.read(address, variables, axis, enable=enable)

    def read(self, address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Show what the axis has."""
        raise NotImplementedError(type(self).__name__)


def limits_of(variables: BlockVariables, prefix: str = "") -> MotionLimits:
    """Return the limits in a block's inputs, or in a part of its parameters."""
    given = (variables.number(f"{prefix}{name}") for name in ("Velocity", *_RATES))
    return MotionLimits(*(_positive(*each) for each in zip(given, DEFAULT, strict=True)))


_RATES: Final = ("Acceleration", "Deceleration")


def _positive(value: float, default: float) -> float:
    usable = math.isfinite(value) and value != 0
    return min(max(abs(value), 1e-6), 1e9) if usable else default
