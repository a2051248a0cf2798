"""Transforms against the matrices that they stand for."""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from crosnode.messages import MessageTypes
from crosnode.tf.transform import Quaternion, Transform, Vector, fill_message, from_message, slerp

NUMBERS = st.floats(-100, 100)
VECTORS = st.tuples(NUMBERS, NUMBERS, NUMBERS)
PARTS = st.floats(-1, 1)


@st.composite
def rotations(draw: st.DrawFn) -> Quaternion:
    numbers = [draw(PARTS) for _ in range(4)]
    norm = sqrt(sum(each * each for each in numbers))
    assume(norm > 0.1)
    x, y, z, w = (each / norm for each in numbers)
    return x, y, z, w


TRANSFORMS = st.builds(Transform, VECTORS, rotations())


def matrix(transform: Transform) -> np.ndarray:
    """Return the matrix of a transform, by the formula of any book on kinematics."""
    x, y, z, w = transform.rotation
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, 3] = transform.translation
    return made


def about_z(angle: float) -> Quaternion:
    return 0.0, 0.0, sin(angle / 2), cos(angle / 2)


@given(TRANSFORMS, TRANSFORMS, VECTORS)
def test_transforms_are_their_matrices(a: Transform, b: Transform, point: Vector) -> None:
    assert np.allclose(matrix(a.after(b)), matrix(a) @ matrix(b), atol=1e-6)
    assert np.allclose(matrix(a.inverse()), np.linalg.inv(matrix(a)), atol=1e-6)
    assert np.allclose(a.apply(point), (matrix(a) @ [*point, 1])[:3], atol=1e-6)


@pytest.mark.parametrize("angle", [0.001, 1.0, 3.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_halfway_is_half_the_angle_on_the_shorter_way(angle: float, sign: int) -> None:
    x, y, z, w = about_z(angle)
    half = slerp(about_z(0), (sign * x, sign * y, sign * z, sign * w), 0.5)
    assert np.allclose(half, about_z(angle / 2), atol=1e-9)


def test_between_two_transforms() -> None:
    turned = Transform((2.0, 4.0, 6.0), about_z(pi / 2))
    half = Transform().towards(turned, 0.5)
    assert half.translation == (1.0, 2.0, 3.0)
    assert np.allclose(half.rotation, about_z(pi / 4))


def test_messages_and_what_is_no_transform() -> None:
    message = MessageTypes().message("geometry_msgs/Transform").new()
    assert from_message(message) is None  # a quaternion of zeros
    given_transform = Transform((1.0, 2.0, 3.0), about_z(1.0))
    fill_message(message, given_transform)
    found = from_message(message)
    assert found is not None
    assert np.allclose(found.rotation, given_transform.rotation)
    assert found.translation == given_transform.translation
    message.translation.x = float("nan")
    assert from_message(message) is None
