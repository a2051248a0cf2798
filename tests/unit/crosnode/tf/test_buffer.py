"""What a buffer of frames knows, and what it does not guess."""

import numpy as np
import pytest

from crosnode.errors import TransformError
from crosnode.tf.buffer import CACHE_NS, MOST_FRAMES, MOST_STAMPS, TransformBuffer
from crosnode.tf.transform import Transform

SECOND = 1_000_000_000
HALF_TURN = (0.0, 0.0, 1.0, 0.0)


def at(x: float, y: float = 0.0) -> Transform:
    return Transform((x, y, 0.0))


def arm() -> TransformBuffer:
    """Return base > shoulder > hand, which move, and base > camera, which does not."""
    buffer = TransformBuffer()
    for second in range(1, 4):
        stamp_ns = second * SECOND
        buffer.add("base", "shoulder", stamp_ns, at(second), is_static=False)
        buffer.add("shoulder", "hand", stamp_ns + SECOND, at(0, second), is_static=False)
    buffer.add("/base", "/camera", 0, Transform((0.0, 0.0, 5.0), HALF_TURN), is_static=True)
    return buffer


def test_along_and_across_the_tree() -> None:
    buffer = arm()
    assert buffer.lookup("base", "base") == Transform()
    assert buffer.lookup("base", "hand", 2 * SECOND).translation == (2.0, 1.0, 0.0)
    assert buffer.lookup("hand", "base", 2 * SECOND).translation == (-2.0, -1.0, 0.0)
    found = buffer.lookup("camera", "hand", 2 * SECOND)
    assert np.allclose(found.translation, (-2.0, -1.0, -5.0))


def test_time_0_is_the_newest_that_the_whole_way_has() -> None:
    assert arm().lookup("base", "hand").translation == (3.0, 2.0, 0.0)
    assert arm().lookup("shoulder", "hand").translation == (0.0, 3.0, 0.0)


def test_between_two_stamps_is_interpolated_and_beyond_them_nothing_guessed() -> None:
    buffer = arm()
    assert buffer.lookup("base", "shoulder", SECOND * 3 // 2).translation == (1.5, 0.0, 0.0)
    for time_ns in (SECOND - 1, 3 * SECOND + 1):
        with pytest.raises(TransformError, match=f"known from {SECOND} to {3 * SECOND} ns"):
            buffer.lookup("base", "shoulder", time_ns)


def test_stamps_in_any_order() -> None:
    buffer = TransformBuffer()
    for second in (1, 4, 2, 3):
        buffer.add("a", "b", second * SECOND, at(second), is_static=False)
    assert buffer.lookup("a", "b", SECOND * 5 // 2).translation == (2.5, 0.0, 0.0)


def test_frames_that_are_unknown_or_in_another_tree() -> None:
    buffer = arm()
    buffer.add("moon", "rover", SECOND, at(1), is_static=False)
    with pytest.raises(TransformError, match="no frame 'nobody'"):
        buffer.lookup("base", "nobody")
    with pytest.raises(TransformError, match="no frame in common"):
        buffer.lookup("base", "rover", SECOND)


def test_a_ring_of_frames_is_an_error_and_not_a_hang() -> None:
    buffer = TransformBuffer()
    for parent, child in (("a", "b"), ("b", "c"), ("c", "a")):
        buffer.add(parent, child, SECOND, at(1), is_static=False)
    buffer.add("x", "y", SECOND, at(1), is_static=False)
    with pytest.raises(TransformError, match="ring"):
        buffer.lookup("y", "a", SECOND)


def test_what_is_kept_is_bounded() -> None:
    buffer = TransformBuffer()
    for number in range(3 * MOST_STAMPS):
        buffer.add("a", "b", number, at(number), is_static=False)
    assert len(buffer.frames["b"].history) == MOST_STAMPS
    buffer.add("a", "b", 3 * CACHE_NS, at(1), is_static=False)
    assert len(buffer.frames["b"].history) == 1
    buffer.add("a", "b", CACHE_NS, at(1), is_static=False)  # too old
    assert len(buffer.frames["b"].history) == 1
    for number in range(2 * MOST_FRAMES):
        buffer.add("a", f"f{number}", 1, at(1), is_static=False)
        buffer.add(f"p{number}", "b", 3 * CACHE_NS + number, at(1), is_static=False)
    assert MOST_FRAMES // 3 < len(buffer.frames) < MOST_FRAMES
    before = buffer.refused
    assert before > 2 * MOST_FRAMES
    buffer.add("a", "a", 1, at(1), is_static=False)
    assert buffer.refused == before + 1


def test_a_frame_that_gets_another_parent() -> None:
    buffer = TransformBuffer()
    buffer.add("table", "cup", SECOND, at(1), is_static=False)
    buffer.add("hand", "cup", 2 * SECOND, at(2), is_static=False)
    assert buffer.lookup("table", "cup", SECOND * 3 // 2).translation == (1.0, 0.0, 0.0)
    assert buffer.lookup("hand", "cup", 2 * SECOND).translation == (2.0, 0.0, 0.0)
