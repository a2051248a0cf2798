"""Rigid transforms: a rotation as a unit quaternion, then a translation; metres, right-handed."""

from __future__ import annotations

from math import acos, isfinite, sin, sqrt
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from crosnode.messages import Message

Vector: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]
"""x, y, z, w, as in geometry_msgs/Quaternion."""

NEARLY_EQUAL: Final = 0.9995
"""Cosine of half an angle below which a straight line between two quaternions is as good."""

UNIT_TOLERANCE: Final = 1e-2
"""What a quaternion's norm may be off 1: as tf2, which takes others for mistakes."""


class Transform(NamedTuple):
    """Takes coordinates in a child frame to coordinates in its parent: rotate, then translate."""

    translation: Vector = (0.0, 0.0, 0.0)
    rotation: Quaternion = (0.0, 0.0, 0.0, 1.0)

    def apply(self, point: Vector) -> Vector:
        """Return a point of the child frame in the parent frame."""
        x, y, z = rotate(self.rotation, point)
        dx, dy, dz = self.translation
        return x + dx, y + dy, z + dz

    def after(self, inner: Transform) -> Transform:
        """Return the transform that applies ``inner`` first, then this one."""
        return Transform(self.apply(inner.translation), multiply(self.rotation, inner.rotation))

    def inverse(self) -> Transform:
        """Return the transform from the parent to the child."""
        x, y, z, w = self.rotation
        back = (-x, -y, -z, w)
        dx, dy, dz = rotate(back, self.translation)
        return Transform((-dx, -dy, -dz), back)

    def towards(self, other: Transform, part: float) -> Transform:
        """Return what lies between two: 0 gives this one, 1 the other."""
        between = [
            a + part * (b - a) for a, b in zip(self.translation, other.translation, strict=True)
        ]
        return Transform(
            (between[0], between[1], between[2]), slerp(self.rotation, other.rotation, part)
        )


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the rotation that does ``b`` first, then ``a``."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotate(rotation: Quaternion, point: Vector) -> Vector:
    """Return a rotated point."""
    x, y, z, w = rotation
    px, py, pz = point
    tx, ty, tz = 2 * (y * pz - z * py), 2 * (z * px - x * pz), 2 * (x * py - y * px)
    return (
        px + w * tx + y * tz - z * ty,
        py + w * ty + z * tx - x * tz,
        pz + w * tz + x * ty - y * tx,
    )


def slerp(a: Quaternion, b: Quaternion, part: float) -> Quaternion:
    """Return a rotation between two, on the shorter way."""
    cosine = sum(m * n for m, n in zip(a, b, strict=True))
    sign = -1.0 if cosine < 0 else 1.0
    cosine *= sign
    if cosine > NEARLY_EQUAL:
        near, far = 1 - part, part
    else:
        angle = acos(cosine)
        near, far = sin((1 - part) * angle) / sin(angle), sin(part * angle) / sin(angle)
    mixed = [near * m + sign * far * n for m, n in zip(a, b, strict=True)]
    norm = sqrt(sum(each * each for each in mixed))
    return mixed[0] / norm, mixed[1] / norm, mixed[2] / norm, mixed[3] / norm


def from_message(message: Message) -> Transform | None:
    """Return the transform of a geometry_msgs/Transform, None where it is none.

    That is: a number that is not finite, or a quaternion that is no rotation.
    """
    t, r = message.translation, message.rotation
    numbers = (t.x, t.y, t.z, r.x, r.y, r.z, r.w)
    norm = sqrt(sum(each * each for each in numbers[3:])) if all(map(isfinite, numbers)) else 0.0
    if abs(norm - 1) > UNIT_TOLERANCE:
        return None
    return Transform((t.x, t.y, t.z), (r.x / norm, r.y / norm, r.z / norm, r.w / norm))


def fill_message(message: Message, transform: Transform) -> None:
    """Write a transform into a geometry_msgs/Transform."""
    t, r = message.translation, message.rotation
    t.x, t.y, t.z = transform.translation
    r.x, r.y, r.z, r.w = transform.rotation
