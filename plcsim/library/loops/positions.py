"""MTProfilePositionGenerator: positions along a trapezoidal profile.

It begins at 0 when it is enabled. The jolt time counts as 0. No movement begins with a velocity or
a rate that is not above 0, nor with one or a position that is no number or beyond any machine.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Final

from plcsim.library.loops.technology import TechnologyBlock
from plcsim.library.members import rises
from plcsim.library.motion.axis import FARTHEST
from plcsim.library.motion.profile import MotionLimits, MotionProfile, to_position, to_velocity

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.loops.block import LoopBlock, LoopState
    from plcsim.library.members import BlockVariables

_RATES: Final = ("Velocity", "Acceleration", "Deceleration")

SMALLEST_RATE: Final = 1e-6
LARGEST_RATE: Final = 1e9
"""Of velocities, units/s, and accelerations, units/s²."""

ACCELERATING: Final = 1
CRUISING: Final = 2
DECELERATING: Final = 3
"""MTProfilePositionStateEnum in the positive direction; negative in the other, 0 at rest."""


class _Profiles:
    """The profiles of the blocks of a controller, by address; a restart forgets them."""

    def __init__(self, _context: Context) -> None:
        self.by_block: dict[int, MotionProfile] = {}


class PositionGenerator(TechnologyBlock):
    """MTProfilePositionGenerator: Start, Stop, Abort and SetHomePosition count at their edges."""

    outputs: ClassVar[tuple[str, ...]] = (
        *TechnologyBlock.outputs,
        *("Position", "Velocity", "Acceleration", "MotionState", "Done"),
    )
    parameters: ClassVar[tuple[str, ...]] = tuple(
        f"Parameter.{rate}{way}Direction" for rate in _RATES for way in ("Pos", "Neg")
    )

    def calculate(self, variables: BlockVariables, state: LoopState, _step_s: float) -> None:
        """Move on, and take a command."""
        profiles, now_ns = self.context.library(_Profiles).by_block, self.context.release_ns
        at_rest = MotionProfile(now_ns, 0.0, 0.0)
        profile = at_rest if state.last_ns is None else profiles.get(variables.start, at_rest)
        profile = self._commanded(variables, state, profile) or profile
        profiles[variables.start] = profile
        self._show(variables, profile)

    def _commanded(
        self, variables: BlockVariables, state: LoopState, profile: MotionProfile
    ) -> MotionProfile | None:
        """Return the profile that a command begins, None without one."""
        context, now_ns = self.context, self.context.release_ns
        position, velocity = profile.at(now_ns)
        edges = {name for name in _COMMANDS if rises(context, variables.start, variables, name)}
        if "Abort" in edges:
            return MotionProfile(now_ns, position, 0.0)
        if "Stop" in edges:
            limits = _limits(state, velocity)
            if limits is None or velocity == 0:
                return None
            target = position + velocity * abs(velocity) / (2 * limits.deceleration)
            segments = to_velocity(velocity, 0.0, limits)
            return MotionProfile(now_ns, position, velocity, segments, target)
        if "Start" in edges:
            target = variables.number("EndPosition")
            limits = _limits(state, target - position)
            if limits is None or not _is_place(target):
                return None
            segments = to_position(target - position, velocity, limits)
            return MotionProfile(now_ns, position, velocity, segments, target)
        if "SetHomePosition" in edges and velocity == 0:
            home = variables.number("HomePosition")
            return MotionProfile(now_ns, home, 0.0) if _is_place(home) else None
        return None

    def _show(self, variables: BlockVariables, profile: MotionProfile) -> None:
        now_ns = self.context.release_ns
        position, velocity = profile.at(now_ns)
        acceleration = _acceleration(profile, now_ns)
        is_done = profile.target is not None and now_ns >= profile.end_ns
        variables.set(
            Position=position,
            Velocity=velocity,
            Acceleration=acceleration,
            MotionState=_motion_state(velocity, acceleration),
            Done=is_done,
        )


def _limits(state: LoopState, direction: float) -> MotionLimits | None:
    """Return the limits in a direction, None where one of them is none."""
    way = "Pos" if direction >= 0 else "Neg"
    limits = MotionLimits(*(state[f"Parameter.{rate}{way}Direction"] for rate in _RATES))
    return limits if all(SMALLEST_RATE <= each <= LARGEST_RATE for each in limits) else None


def _is_place(position: float) -> bool:
    """Whether a position is a number that is not beyond any machine."""
    return abs(position) <= FARTHEST


def _acceleration(profile: MotionProfile, now_ns: int) -> float:
    left = (now_ns - profile.start_ns) / 1e9
    for duration, acceleration in profile.segments:
        if left < duration:
            return acceleration
        left -= duration
    return 0.0


def _motion_state(velocity: float, acceleration: float) -> int:
    """Return the state; at rest the direction is that in which it begins to move."""
    direction = math.copysign(1, velocity or acceleration) if velocity or acceleration else 0
    growth = direction * acceleration
    phase = ACCELERATING if growth > 0 else DECELERATING if growth < 0 else CRUISING
    return int(direction) * phase


_COMMANDS: Final = ("Abort", "Stop", "Start", "SetHomePosition")

BLOCKS: Final[Mapping[str, type[LoopBlock]]] = {"MTProfilePositionGenerator": PositionGenerator}
"""What runs the blocks by their names."""
