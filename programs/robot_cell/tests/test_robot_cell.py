"""The cell with a planner on another computer and an HMI."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest

from crosnode.action.client import ActionClient, ClientGoal
from crosnode.action.goal_states import GoalState
from crosnode.messages import Duration, Message
from crosnode.testing import Ros
from plcsim.testing import Plc

OFF, READY, MOVING, STOPPED = range(4)
NAMES = [f"joint_{number}" for number in range(1, 7)]


class Planner:
    """Sends goals from another host."""

    def __init__(self, plc: Plc, ros: Ros) -> None:
        self.plc = plc
        self.node = ros.node("planner")
        self.client = ActionClient(
            self.node, "/follow_joint_trajectory", "control_msgs/FollowJointTrajectory"
        )
        plc.after_cycle.append(lambda *_: self.client.step())
        plc.until(lambda: self.client.is_connected)

    def send(self, *points: tuple[float, float], names: list[str] = NAMES) -> ClientGoal:
        """Send a goal of points: seconds, and the position of all joints."""
        return self.client.send(trajectory=self.trajectory(*points, names=names))

    def trajectory(self, *points: tuple[float, float], names: list[str] = NAMES) -> Message:
        """Return a trajectory of such points."""
        new = self.node.types.message("trajectory_msgs/JointTrajectoryPoint").new
        rows = [
            new(positions=[at] * 6, time_from_start=Duration.from_ns(round(s * 1e9)))
            for s, at in points
        ]
        kind = self.node.types.message("trajectory_msgs/JointTrajectory")
        return kind.new(joint_names=names, points=rows)


@pytest.fixture
def planner(plc: Plc, ros: Ros) -> Planner:
    return Planner(plc, ros)


def test_a_goal_moves_the_arm_in_its_time(plc: Plc, planner: Planner) -> None:
    states = planner.node.register_subscriber(
        "/joint_states", "sensor_msgs/JointState", queue_size=1000
    )
    plc["cell.enable"] = True
    plc.until({"cell.state": READY})
    goal = planner.send((0.5, 1.0), (1.0, 0.5))
    plc.until({"cell.state": MOVING})
    plc.run("480ms")
    assert plc["cell.position[6]"] == pytest.approx(0.97, abs=0.03)
    plc.until(lambda: goal.is_over)
    assert (goal.state, goal.text) == (GoalState.SUCCEEDED, "there")
    assert goal.feedback is not None
    assert plc["cell.position[1]"] == 0.5
    plc.run("100ms")
    told: list[Any] = [message.position[0] for message in iter(states.pop, None)]
    assert max(told) == pytest.approx(1.0, abs=0.05)
    assert told[-1] == 0.5
    assert max(abs(b - a) for a, b in pairwise(told)) < 0.05


def test_a_canceled_goal_stops_the_arm_where_it_is(plc: Plc, planner: Planner) -> None:
    plc["cell.enable"] = True
    goal = planner.send((2.0, 2.0))
    plc.until({"cell.state": MOVING})
    plc.run("500ms")
    planner.client.cancel(goal)
    plc.until(lambda: goal.is_over)
    assert goal.state is GoalState.PREEMPTED
    position = plc["cell.position[1]"]
    assert 0.4 < position < 0.7
    plc.run("200ms")
    assert plc["cell.position[1]"] == position
    assert plc["cell.state"] == READY


def test_a_newer_goal_takes_the_place_of_an_older_one(plc: Plc, planner: Planner) -> None:
    plc["cell.enable"] = True
    first = planner.send((2.0, 2.0))
    plc.until({"cell.state": MOVING})
    plc.run("200ms")
    second = planner.send((0.5, 0.0))
    plc.until(lambda: second.is_over)
    assert (first.state, second.state) == (GoalState.PREEMPTED, GoalState.SUCCEEDED)


@pytest.mark.parametrize(
    ("act", "state", "text"),
    [
        (lambda plc: plc.__setitem__("cell.stop", True), STOPPED, "stopped by the HMI"),
        (lambda plc: plc.__setitem__("cell.enable", False), OFF, "the drives were switched off"),
    ],
)
def test_the_hmi_stops_the_arm(
    plc: Plc, planner: Planner, act: Callable[[Plc], None], state: int, text: str
) -> None:
    plc["cell.enable"] = True
    goal = planner.send((2.0, 2.0))
    plc.until({"cell.state": MOVING})
    act(plc)
    plc.until(lambda: goal.is_over)
    assert (goal.state, goal.text, plc["cell.state"]) == (GoalState.ABORTED, text, state)
    plc["cell.stop"] = False
    plc.run("100ms")
    assert plc["cell.state"] == state  # it must be enabled anew
    plc["cell.enable"] = True
    plc.until({"cell.state": READY})


@pytest.mark.parametrize(
    ("points", "names", "text"),
    [
        ([(1.0, 0.5)], NAMES[:5], "joints are joint_1"),
        ([], NAMES, "1 to 100 points"),
        ([(1.0, 0.5), (1.0, 0.6)], NAMES, "each point is later"),
        ([(0.1, 1.0)], NAMES, "no joint is faster"),
        ([(9.0, 7.0)], NAMES, "no joint goes beyond"),
        ([(1.0, float("nan"))], NAMES, "each point has 6 positions"),
    ],
)
def test_what_the_arm_cannot_follow_is_refused(
    plc: Plc, planner: Planner, points: list[tuple[float, float]], names: list[str], text: str
) -> None:
    plc["cell.enable"] = True
    plc.until({"cell.state": READY})
    goal = planner.send(*points, names=names)
    plc.until(lambda: goal.is_over)
    assert goal.state is GoalState.REJECTED
    assert goal.text.startswith(text)
    assert plc["cell.state"] == READY


def test_without_enable_nothing_moves(plc: Plc, planner: Planner) -> None:
    goal = planner.send((1.0, 0.5))
    plc.until(lambda: goal.is_over)
    assert (goal.state, goal.text) == (GoalState.REJECTED, "the cell is not enabled")
    assert plc["cell.position[1]"] == 0.0


def test_a_planner_that_is_lost_stops_nothing_and_finds_the_end(
    plc: Plc, ros: Ros, planner: Planner
) -> None:
    plc["cell.enable"] = True
    planner.send((1.0, 1.0))
    plc.until({"cell.state": MOVING})
    plc.faults.reset(planner.node.host)
    plc.run("2s")
    assert (plc["cell.done"], plc["cell.state"]) == (1, READY)


class Streamer:
    """A planner that streams, and hears the robot's status."""

    def __init__(self, plc: Plc, planner: Planner) -> None:
        self.plc = plc
        self.planner = planner
        node = planner.node
        self.out = node.register_publisher("/joint_path_command", "trajectory_msgs/JointTrajectory")
        self.status = node.register_subscriber("/robot_status", "industrial_msgs/RobotStatus")
        plc.until(lambda: self.out.subscribers and self.status.publishers)

    def send(self, *points: tuple[float, float]) -> None:
        self.out.send(self.planner.trajectory(*points))

    def newest(self) -> tuple[int, ...]:
        """Return stop, drives, possible and motion of the newest status."""
        self.plc.run("150ms")
        (*_, last) = iter(self.status.pop, None)
        assert last.mode.val == 2
        found = (last.e_stopped, last.drives_powered, last.motion_possible, last.in_motion)
        return tuple(each.val for each in found)


@pytest.fixture
def streamer(plc: Plc, planner: Planner) -> Streamer:
    return Streamer(plc, planner)


def test_a_stream_of_single_points_is_followed(plc: Plc, streamer: Streamer) -> None:
    plc["cell.enable"] = True
    plc.until({"cell.state": READY})
    for number in range(1, 51):  # 50 a second, each 40 ms ahead
        streamer.send((0.04, 0.02 * number))
        plc.run("20ms")
    assert plc["cell.streamed"] == 50
    assert plc["cell.position[3]"] == pytest.approx(1.0, abs=0.03)
    plc.until({"cell.state": READY})
    assert plc["cell.position[3]"] == 1.0
    assert plc["cell.refused"] == 0


def test_a_streamed_trajectory_takes_the_place_of_a_goal_and_one_without_points_stops(
    plc: Plc, streamer: Streamer
) -> None:
    plc["cell.enable"] = True
    goal = streamer.planner.send((2.0, 2.0))
    plc.until({"cell.state": MOVING})
    streamer.send((2.0, -1.0))
    plc.until(lambda: goal.is_over)
    assert (goal.state, goal.text) == (GoalState.PREEMPTED, "a streamed trajectory")
    plc.run("500ms")
    streamer.send()
    plc.until({"cell.state": READY})
    assert -0.4 < plc["cell.position[1]"] < -0.1


def test_what_is_streamed_while_the_cell_is_off_or_is_too_fast_moves_nothing(
    plc: Plc, streamer: Streamer
) -> None:
    streamer.send((1.0, 0.5))
    plc.until({"cell.refused": 1})
    plc["cell.enable"] = True
    plc.until({"cell.state": READY})
    streamer.send((0.1, 2.0))
    plc.until({"cell.refused": 2})
    assert plc["cell.position[1]"] == 0.0


def test_the_status_of_the_robot(plc: Plc, streamer: Streamer) -> None:
    assert streamer.newest() == (0, 0, 0, 0)
    plc["cell.enable"] = True
    assert streamer.newest() == (0, 1, 1, 0)
    streamer.send((1.0, 0.5))
    assert streamer.newest() == (0, 1, 1, 1)
    plc["cell.stop"] = True
    assert streamer.newest() == (1, 0, 0, 0)
