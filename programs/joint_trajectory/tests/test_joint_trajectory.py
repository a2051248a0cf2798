"""The arm follows what another computer commands; the bridge tells how it goes."""

import math

import pytest

from crosnode.messages import Duration, Message
from crosnode.testing import Ros
from plcsim.testing import Plc


def command(ros: Ros, *points: tuple[float, float], joints: int = 6) -> None:
    """Send a trajectory of all joints alike: pairs of position and seconds."""
    ros.publish(
        "/arm/command",
        "trajectory_msgs/JointTrajectory",
        joint_names=[f"joint_{number}" for number in range(1, joints + 1)],
        points=[point(ros, position, seconds, joints) for position, seconds in points],
    )


def point(ros: Ros, position: float, seconds: float, joints: int) -> Message:
    return ros.message(
        "trajectory_msgs/JointTrajectoryPoint",
        positions=[position] * joints,
        time_from_start=Duration.from_ns(int(seconds * 1e9)),
    )


def test_the_arm_follows_a_trajectory(plc: Plc, ros: Ros) -> None:
    command(ros, (1.0, 1.0), (2.0, 3.0))
    plc.assert_within("50ms", {"arm.busy": True, "arm.trajectory.count": 2})
    plc.run("500ms")
    assert 0.4 < plc["arm.position"][0] < 0.6
    plc.until({"arm.busy": False})
    assert plc["arm.position"] == [2.0] * 6


def test_positions_come_back_as_a_message_and_into_the_monitor(plc: Plc, ros: Ros) -> None:
    states = ros.subscribe("/arm/joint_states", "sensor_msgs/JointState")
    command(ros, (2.0, 1.0))
    plc.run("2s")
    *_, last = iter(states.pop, None)
    assert list(last.name) == [f"joint_{n}" for n in range(1, 7)]
    assert list(last.position) == [2.0] * 6
    assert plc["monitor.state.position"][:6] == pytest.approx([2.0] * 6)
    assert plc["monitor.state.name"][:2] == ["joint_1", "joint_2"]
    assert plc["monitor.state.position_length"] == 6
    assert plc["monitor.heard"] > 5


def test_the_bridge_tells_when_the_arm_is_busy(plc: Plc, ros: Ros) -> None:
    busy = ros.subscribe("/arm/busy", "std_msgs/Bool")
    plc.until(lambda: busy.publishers)
    command(ros, (1.0, 1.0))
    plc.run("2s")
    assert [message.data for message in iter(busy.pop, None)] == [False, True, False]


def test_the_bridge_takes_the_override(plc: Plc, ros: Ros) -> None:
    ros.publish("/arm/override", "std_msgs/Float64", data=0.5)
    plc.assert_within("50ms", {"arm.override": 0.5})


@pytest.mark.parametrize("override", [math.nan, math.inf, -1.0, 100.0])
def test_an_override_that_makes_no_sense_stops_the_arm(plc: Plc, ros: Ros, override: float) -> None:
    command(ros, (1.0, 1.0))
    plc.run("500ms")
    ros.publish("/arm/override", "std_msgs/Float64", data=override)
    plc.run("50ms")
    position = list(plc["arm.position"])
    plc.run("1s")
    assert plc["arm.position"] == position
    assert (plc["arm.busy"], plc["arm.speed"]) == (True, 0.0)


def test_names_that_no_string_can_hold_do_not_stop_the_monitor(plc: Plc, ros: Ros) -> None:
    names = ["関節", "j\udcfc", *["x"] * 20]
    ros.publish("/arm/joint_states", "sensor_msgs/JointState", name=names, position=[1.0])
    plc.until(lambda: plc["monitor.state.name"][0] == "??")
    assert plc["monitor.state.name"][1] == "jü"
    assert (plc["monitor.state.name_length"], plc["monitor.state.position_length"]) == (16, 1)


def test_what_does_not_fit_is_refused_whole(plc: Plc, ros: Ros) -> None:
    command(ros, (1.0, 1.0), joints=5)
    plc.assert_within("50ms", {"arm.refused": 1})
    command(ros, (1.0, 1.0), (2.0, 1.0))
    plc.assert_within("50ms", {"arm.refused": 2})
    command(ros, *[(0.0, 1.0 + n) for n in range(51)])
    plc.assert_within("50ms", {"arm.refused": 3})
    command(ros, (math.nan, 1.0))
    plc.assert_within("50ms", {"arm.refused": 4})
    assert plc["arm.accepted"] == 0
    assert plc["arm.trajectory.count"] == 0
