"""Trapezoidal profiles."""

import pytest

from plcsim.library.motion.profile import MotionLimits, MotionProfile, S, to_position, to_velocity

LIMITS = MotionLimits(velocity=10.0, acceleration=5.0, deceleration=20.0)


def of(segments, position=0.0, velocity=0.0, target=None):
    return MotionProfile(0, position, velocity, segments, target)


def test_a_long_way_has_a_ramp_a_constant_velocity_and_a_ramp():
    segments = to_position(100.0, 0.0, LIMITS)
    assert [each.acceleration for each in segments] == [5.0, 0.0, -20.0]
    # 2 s to 10 units/s over 10 units, 0.5 s to rest over 2.5 units, 87.5 units between
    assert [each.duration for each in segments] == pytest.approx([2.0, 8.75, 0.5])
    profile = of(segments, target=100.0)
    assert profile.at(2 * S) == pytest.approx((10.0, 10.0))
    assert profile.at(profile.end_ns) == (100.0, 0.0)
    assert profile.at(profile.end_ns + S) == (100.0, 0.0)


def test_a_short_way_never_gets_to_the_velocity():
    segments = to_position(-1.0, 0.0, LIMITS)
    assert [each.acceleration for each in segments] == [-5.0, 20.0]
    assert of(segments).at(10 * S) == pytest.approx((-1.0, 0.0))


@pytest.mark.parametrize("velocity", [-30.0, -10.0, -1.0, 0.0, 1.0, 9.0, 10.0, 30.0])
@pytest.mark.parametrize("distance", [-50.0, -2.0, -0.01, 0.0, 0.01, 2.0, 22.5, 50.0])
def test_each_motion_ends_at_rest_at_its_target(distance, velocity):
    segments = to_position(distance, velocity, LIMITS)
    assert all(each.duration >= 0 for each in segments)
    position, left = of(segments, 7.0, velocity).at(1000 * S)
    assert position == pytest.approx(7.0 + distance, abs=1e-6)
    assert left == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ("start", "end", "seconds"),
    [(0.0, 10.0, 2.0), (10.0, 0.0, 0.5), (-10.0, 5.0, 1.5), (3.0, 3.0, 0.0), (-2.0, -4.0, 0.4)],
)
def test_a_velocity_is_reached_with_the_rate_for_faster_or_slower(start, end, seconds):
    segments = to_velocity(start, end, LIMITS)
    assert sum(each.duration for each in segments) == pytest.approx(seconds)
    assert of(segments, 0.0, start).at(100 * S)[1] == pytest.approx(end)


def test_a_motion_without_a_target_goes_on():
    profile = of(to_velocity(0.0, 10.0, LIMITS))
    assert profile.at(3 * S) == pytest.approx((20.0, 10.0))
