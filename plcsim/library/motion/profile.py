"""Trapezoidal profiles: motion in segments of constant acceleration.

Positions are in units of the axis, velocities in units/s, accelerations in units/s².
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

S: Final = 1_000_000_000
"""Nanoseconds of a second."""


class MotionLimits(NamedTuple):
    """What a motion keeps to; all above 0."""

    velocity: float
    acceleration: float
    deceleration: float


class MotionSegment(NamedTuple):
    """A part of a motion: how long, in seconds, and with which acceleration."""

    duration: float
    acceleration: float


class MotionProfile(NamedTuple):
    """A motion.

    Attributes:
        start_ns: time at which it begins.
        position: there.
        velocity: there.
        segments: one after the other; behind them the velocity stays as it is.
        target: where it ends, None for a motion that goes on.
    """

    start_ns: int
    position: float
    velocity: float
    segments: Sequence[MotionSegment] = ()
    target: float | None = None

    @property
    def end_ns(self) -> int:
        """Time at which the last segment ends."""
        return self.start_ns + math.ceil(sum(each.duration for each in self.segments) * S)

    def at(self, time_ns: int) -> tuple[float, float]:
        """Return position and velocity at a time from ``start_ns`` on."""
        if self.target is not None and time_ns >= self.end_ns:
            return self.target, 0.0
        left = (time_ns - self.start_ns) / S
        position, velocity = self.position, self.velocity
        for duration, acceleration in self.segments:
            passed = min(left, duration)
            position += velocity * passed + acceleration * passed * passed / 2
            velocity += acceleration * passed
            left -= passed
            if left <= 0:
                return position, velocity
        return position + velocity * left, velocity


def to_velocity(start: float, end: float, limits: MotionLimits) -> list[MotionSegment]:
    """Return the segments that take an axis from one velocity to another."""
    if start * end < 0:
        return [*to_velocity(start, 0.0, limits), *to_velocity(0.0, end, limits)]
    change = abs(end) - abs(start)
    if change == 0:
        return []
    rate = limits.acceleration if change > 0 else limits.deceleration
    return [MotionSegment(abs(change) / rate, math.copysign(rate, end - start))]


def to_position(distance: float, velocity: float, limits: MotionLimits) -> list[MotionSegment]:
    """Return the segments that take an axis over a distance, and end at rest.

    Args:
        distance: from here to the target.
        velocity: that the axis has.
        limits: of the motion; an axis that is faster slows down first.
    """
    stop = velocity * abs(velocity) / (2 * limits.deceleration)
    if velocity * (distance - stop) < 0 or distance == stop:  # it cannot but pass, or turn round
        halt = to_velocity(velocity, 0.0, limits)
        return [*halt, *_from(distance - stop, 0.0, limits)]
    return _from(distance, velocity, limits)


def _from(distance: float, velocity: float, limits: MotionLimits) -> list[MotionSegment]:
    """Return the segments of a motion that needs no turning round."""
    sign, length = math.copysign(1.0, distance), abs(distance)
    if length == 0:
        return []
    a, d, start = limits.acceleration, limits.deceleration, abs(velocity)
    peak = math.sqrt((2 * a * d * length + d * start * start) / (a + d))
    top = min(peak, limits.velocity)
    first = to_velocity(sign * start, sign * top, limits)
    ramp = sum(abs(start * start - top * top) / (2 * abs(rate)) for _, rate in first)
    cruise = length - ramp - top * top / (2 * d)
    between = [MotionSegment(cruise / top, 0.0)] if cruise > 0 else []
    return [*first, *between, MotionSegment(top / d, -sign * d)]
