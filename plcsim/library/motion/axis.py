"""An axis: the state machine of PLCopen motion control, and where the axis is.

Movements may interrupt one another; none is buffered, jerk is not limited.
"""

from __future__ import annotations

import math
from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from plcsim.library.motion.coupling import Coupling
from plcsim.library.motion.profile import (
    MotionLimits,
    MotionProfile,
    MotionSegment,
    S,
    to_position,
    to_velocity,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.context import Context
    from plcsim.library.motion.coupling import Approach

MOST_AXES: Final = 1024
"""Axes of one controller; what is beyond is no axis."""

FIRST_HANDLE: Final = 0x4000
"""What stands for the first axis that a program made, in its McAxisType; nothing lies there."""

FARTHEST: Final = 1e12
"""Positions and velocities that commands may ask for."""

SLOWEST: Final = 1e-6
"""Velocity with an override of 0."""

NO_AXIS: Final = 1
NOT_ALLOWED: Final = 2
NO_NUMBER: Final = 3
"""Values of ErrorID, which are not the vendor's: there is no axis, the state of the axis does not
allow the command, a parameter is no number or too large."""


class AxisState(Enum):
    """States of PLCopen motion control, part 1."""

    DISABLED = auto()
    STANDSTILL = auto()
    HOMING = auto()
    STOPPING = auto()
    DISCRETE_MOTION = auto()
    CONTINUOUS_MOTION = auto()
    SYNCHRONIZED_MOTION = auto()
    ERRORSTOP = auto()


MOVABLE: Final = frozenset(
    [
        AxisState.STANDSTILL,
        AxisState.HOMING,
        AxisState.DISCRETE_MOTION,
        AxisState.CONTINUOUS_MOTION,
        AxisState.SYNCHRONIZED_MOTION,
    ]
)
"""States in which an axis takes a movement."""


class CommandStatus(Enum):
    """What became of a command."""

    BUSY = auto()
    REACHED = auto()
    DONE = auto()
    ABORTED = auto()
    REFUSED = auto()


class MotionCommand:
    """A command to an axis.

    Attributes:
        status: of it; REACHED where it has what it was for, and goes on.
        error_id: why it was refused, 0 where it was not.
        is_shown: whether a block has shown its end.
        cyclic_value: that a block gave last, where it gives one in every call.
    """

    def __init__(self) -> None:
        self.status = CommandStatus.BUSY
        self.error_id = 0
        self.is_shown = False
        self.cyclic_value: float | None = None

    @property
    def is_in_control(self) -> bool:
        """Whether it still moves the axis."""
        return self.status in (CommandStatus.BUSY, CommandStatus.REACHED)

    def finish(self) -> None:
        """Let it be done."""
        self.status = CommandStatus.DONE

    def refuse(self, error_id: int) -> None:
        """End it with an error."""
        self.status, self.error_id = CommandStatus.REFUSED, error_id


class Axis:
    """An axis at rest at position 0, without power.

    Attributes:
        state: of PLCopen.
        position: in units of the axis.
        velocity: in units/s.
        is_powered: whether its controller is on.
        is_homed: whether its position was set once.
        parameters: of its drive, by number, as a program wrote them.
    """

    def __init__(self) -> None:
        self.parameters: dict[int, float] = {}
        self.state = AxisState.DISABLED
        self.position = 0.0
        self.velocity = 0.0
        self.is_powered = False
        self.is_homed = False
        self._now_ns = 0
        self._profile = MotionProfile(0, 0.0, 0.0)
        self._command = MotionCommand()
        self._command.finish()
        self._coupling: Coupling | None = None
        self._is_held = False
        self._has_begun = True
        self._factors = (1.0, 1.0)
        self._asked: tuple[float, MotionLimits] | None = None
        self._torque = 0.0
        self._tracked_ns = 0

    def update(self, now_ns: int) -> None:
        """Move on to a time; one that is past changes nothing."""
        is_moved = now_ns == self._now_ns and not self._has_begun
        if now_ns < self._now_ns or is_moved:
            return
        self._now_ns, self._has_begun = now_ns, False
        if self._coupling is not None:
            self._follow(self._coupling, now_ns)
            return
        self.position, self.velocity = self._profile.at(now_ns)
        if self._tracked_ns and now_ns <= self._profile.end_ns:
            self.velocity = self._profile.velocity
        if now_ns >= self._profile.end_ns and self._command.status is CommandStatus.BUSY:
            self._arrive()

    def _follow(self, coupling: Coupling, now_ns: int) -> None:
        coupling.master.update(now_ns)
        self.position, self.velocity, is_synchronous = coupling.at()
        if is_synchronous:
            self._command.status = CommandStatus.REACHED

    def _arrive(self) -> None:
        if self.state is AxisState.CONTINUOUS_MOTION:
            self._command.status = CommandStatus.REACHED
            return
        self._command.finish()
        if not (self.state is AxisState.STOPPING and self._is_held):
            self.state = AxisState.STANDSTILL

    def place(self, position: float) -> None:
        """Be at rest at a known position."""
        self.position, self.is_homed = position, True
        self._rest(self.state)

    # Commands

    def power(self, *, on: bool) -> None:
        """Turn the controller on or off; without power the axis stands."""
        self.is_powered = on
        if self.state is AxisState.ERRORSTOP:
            return
        if not on:
            self._rest(AxisState.DISABLED)
        elif self.state is AxisState.DISABLED:
            self.state = AxisState.STANDSTILL

    def fail(self) -> None:
        """Go to ERRORSTOP, as for a fault of the drive; the axis stands."""
        self._rest(AxisState.ERRORSTOP)

    def reset(self) -> None:
        """Leave ERRORSTOP."""
        if self.state is AxisState.ERRORSTOP:
            self.state = AxisState.STANDSTILL if self.is_powered else AxisState.DISABLED

    def home(self, command: MotionCommand, position: float) -> None:
        """Set the position where the axis stands."""
        if self._takes(command, [position], frozenset([AxisState.STANDSTILL])):
            self.position, self.is_homed = position, True
            self._begin(command, AxisState.HOMING, ())

    def move_to(self, command: MotionCommand, position: float, limits: MotionLimits) -> None:
        """Go to a position, and stay there."""
        if self._takes(command, [position], MOVABLE):
            distance = position - self.position
            segments = to_position(distance, self.velocity, self._overridden(limits))
            self._begin(command, AxisState.DISCRETE_MOTION, segments, position)
            self._asked = (position, limits)

    def move_by(self, command: MotionCommand, distance: float, limits: MotionLimits) -> None:
        """Go on over a distance: from the target of the movement that is under way."""
        start = self._profile.target if self.state is AxisState.DISCRETE_MOTION else None
        self.move_to(command, (self.position if start is None else start) + distance, limits)

    def move_at(self, command: MotionCommand, velocity: float, limits: MotionLimits) -> None:
        """Take a velocity, and keep it."""
        if self._takes(command, [velocity], MOVABLE):
            wanted = velocity * self._factors[0]
            segments = to_velocity(self.velocity, wanted, self._overridden(limits))
            self._begin(command, AxisState.CONTINUOUS_MOTION, segments)
            self._asked = (velocity, limits)

    def turn(
        self, command: MotionCommand, torque: float, velocity: float, limits: MotionLimits
    ) -> None:
        """Turn with a torque: nothing holds the axis, so it takes the velocity it may have."""
        self.move_at(command, math.copysign(velocity, torque) if torque else 0.0, limits)
        if command.is_in_control:
            self._torque = torque

    @property
    def torque(self) -> float:
        """The torque that was asked for last and is still in control, else 0."""
        return self._torque if self._command.is_in_control else 0.0

    def override(self, velocity: float, acceleration: float) -> None:
        """Multiply velocities and accelerations of movements, of the one under way too.

        Args:
            velocity: factor of velocities, 0 stops; what is below 0 or no number changes nothing.
            acceleration: likewise of accelerations; 0 is as 1.
        """
        factors = (velocity, acceleration or 1.0)
        if factors == self._factors or not all(0 <= each <= FARTHEST for each in factors):
            return
        self._factors = factors
        command, asked = self._command, self._asked
        if asked is None or not command.is_in_control:
            return
        if command.status is CommandStatus.REACHED:
            command.status = CommandStatus.BUSY
        torque = self._torque
        if self.state is AxisState.DISCRETE_MOTION:
            self.move_to(command, *asked)
        elif self.state is AxisState.CONTINUOUS_MOTION:
            self.move_at(command, *asked)
        self._torque = torque

    def _overridden(self, limits: MotionLimits) -> MotionLimits:
        velocity, rate = self._factors
        return MotionLimits(
            max(limits.velocity * velocity, SLOWEST),
            limits.acceleration * rate,
            limits.deceleration * rate,
        )

    def track(self, command: MotionCommand, position: float) -> None:
        """Be at a position one call later; called with one position after the other."""
        if not self._takes(command, [position], MOVABLE):
            return
        before_ns, start = self._tracked_ns, self.position
        self._begin(command, AxisState.SYNCHRONIZED_MOTION, ())
        passed_ns = self._now_ns - before_ns if before_ns else 0
        if passed_ns > 0:
            duration = passed_ns / S
            velocity = (position - start) / duration
            segments = [MotionSegment(duration, 0.0)]
            self._profile = MotionProfile(self._now_ns, start, velocity, segments, position)
            self.velocity = velocity
        self._tracked_ns = self._now_ns
        command.status = CommandStatus.REACHED

    def halt(self, command: MotionCommand, limits: MotionLimits) -> None:
        """Come to rest; another movement may interrupt that."""
        if self._takes(command, (), MOVABLE):
            segments = to_velocity(self.velocity, 0.0, limits)
            self._begin(command, AxisState.DISCRETE_MOTION, segments)

    def stop(self, command: MotionCommand, limits: MotionLimits) -> None:
        """Come to rest; no movement is taken before `end_stop`."""
        if self._takes(command, (), MOVABLE | {AxisState.STOPPING}):
            segments = to_velocity(self.velocity, 0.0, limits)
            self._begin(command, AxisState.STOPPING, segments)
            self._is_held = True

    def end_stop(self) -> None:
        """Take movements again, as soon as the axis is at rest."""
        self._is_held = False
        if self.state is AxisState.STOPPING and not self._command.is_in_control:
            self.state = AxisState.STANDSTILL

    def couple(
        self,
        command: MotionCommand,
        master: Axis,
        ratio: float,
        approach: Approach | None = None,
    ) -> None:
        """Follow another axis from here on, with its velocity times ``ratio``."""
        if not self._takes(command, [ratio, *(approach or ())], MOVABLE):
            return
        if master is self or self in master.masters():
            command.refuse(NOT_ALLOWED)
            return
        master.update(self._now_ns)
        self._begin(command, AxisState.SYNCHRONIZED_MOTION, ())
        self._coupling = Coupling(master, ratio, self.position, approach)

    def uncouple(self, command: MotionCommand) -> None:
        """Go on with the velocity that the coupled axis has."""
        if self._coupling is None:
            command.refuse(NOT_ALLOWED)
            return
        self._begin(MotionCommand(), AxisState.CONTINUOUS_MOTION, ())
        command.finish()

    def masters(self) -> Sequence[Axis]:
        """Return the axes that this one follows, and those that they follow."""
        found = []
        coupling = self._coupling
        while coupling is not None:
            found.append(coupling.master)
            coupling = coupling.master._coupling
        return found

    def _takes(
        self, command: MotionCommand, numbers: Sequence[float], states: frozenset[AxisState]
    ) -> bool:
        if self.state not in states:
            command.refuse(NOT_ALLOWED)
        elif not all(abs(number) <= FARTHEST for number in numbers):
            command.refuse(NO_NUMBER)
        return command.is_in_control

    def _begin(
        self,
        command: MotionCommand,
        state: AxisState,
        segments: Sequence[MotionSegment],
        target: float | None = None,
    ) -> None:
        if self._command.is_in_control and self._command is not command:
            self._command.status = CommandStatus.ABORTED
        self._command, self._coupling, self.state = command, None, state
        self._asked, self._torque, self._tracked_ns = None, 0.0, 0
        self._has_begun = True
        self._profile = MotionProfile(self._now_ns, self.position, self.velocity, segments, target)

    def _rest(self, state: AxisState) -> None:
        self.velocity = 0.0
        self._begin(MotionCommand(), state, ())
        self._command.finish()


class Axes:
    """The axes of a controller, by the addresses that programs name them with.

    An axis that a program made, such as a shuttle, has a handle, which programs copy with the
    structures that it stands in: at whatever address it stands, that is the axis.

    Args:
        context: of the controller.
    """

    def __init__(self, context: Context) -> None:
        self._memory = context.memory
        self._axes: dict[int, Axis] = {}
        self._made: dict[int, Axis] = {}

    def at(self, address: int) -> Axis | None:
        """Return the axis that an address stands for, None for address 0.

        Raises:
            PageFault: a program makes axes, and nothing lies at the address.
        """
        if address and self._made:
            made = self.by_handle(int.from_bytes(self._memory.read(address, 4), "little"))
            if made is not None:
                return made
        axis = self._axes.get(address)
        if axis is None and address and not self._is_full:
            axis = self._axes[address] = Axis()
        return axis

    def add(self) -> tuple[int, Axis] | None:
        """Return a new axis and its handle, None where there are too many."""
        if self._is_full:
            return None
        handle = FIRST_HANDLE + len(self._made)
        axis = self._made[handle] = Axis()
        return handle, axis

    def by_handle(self, handle: int) -> Axis | None:
        """Return the axis with a handle."""
        return self._made.get(handle)

    @property
    def _is_full(self) -> bool:
        return len(self._axes) + len(self._made) >= MOST_AXES


def axes_of(context: Context) -> Axes:
    """Return the axes of a controller."""
    return context.library(Axes)
