"""An action server and its clients, on the virtual network."""

from typing import Any

import pytest

from crosnode.action.client import ActionClient, ClientGoal
from crosnode.action.goal_states import GoalState
from crosnode.action.server import KEPT_NS, MOST_GOALS, ActionServer
from crosnode.errors import LocalProtocolError
from crosnode.node.ros_time import Epoch

from ..node.world import MS, OTHER_IP, World, drain

TYPE = "control_msgs/FollowJointTrajectory"


class Cell:
    """A server on one host, a client on another, both known to each other."""

    def __init__(self) -> None:
        self.world = world = World()
        self.node = world.node("arm", epoch=Epoch(10**18))
        self.other = world.node("planner", OTHER_IP, epoch=Epoch(10**18))
        self.server = ActionServer(self.node, "/follow", TYPE)
        self.client = ActionClient(self.other, "/follow", TYPE)
        world.steps += [self.server.step, self.client.step]
        world.until(lambda: self.client.is_connected)
        world.run(250)

    def send(self, **goal: Any) -> tuple[ClientGoal, Any]:
        sent = self.client.send(**goal)
        self.world.run(5)
        return sent, self.server.pop()


def test_a_goal_is_done_with_feedback_and_a_result() -> None:
    cell = Cell()
    sent, goal = cell.send()
    assert goal.goal.trajectory.points == []
    goal.accept()
    cell.world.run(5)
    assert sent.state is GoalState.ACTIVE
    goal.feedback(joint_names=["a"])
    cell.world.run(5)
    assert sent.feedback is not None
    assert sent.feedback.joint_names == ["a"]
    goal.succeed("there", error_code=0, error_string="fine")
    cell.world.run(5)
    assert (sent.state, sent.text, sent.is_over) == (GoalState.SUCCEEDED, "there", True)
    assert sent.result is not None
    assert sent.result.error_string == "fine"


def test_a_canceled_goal_is_stopped_by_the_program() -> None:
    cell = Cell()
    sent, goal = cell.send()
    goal.accept()
    cell.client.cancel(sent)
    cell.world.run(5)
    assert goal.is_canceled
    assert sent.state is GoalState.PREEMPTING
    goal.set_canceled()
    cell.world.run(5)
    assert sent.state is GoalState.PREEMPTED
    assert sent.is_over


def test_a_cancel_may_be_faster_than_its_goal_and_may_mean_all() -> None:
    cell = Cell()
    publisher = cell.other.publishers["/follow/cancel"]
    publisher.send(publisher.new(id="late"))
    cell.world.run(5)
    goals = cell.other.publishers["/follow/goal"]
    message = goals.new()
    message.goal_id.id = "late"
    goals.send(message)
    cell.world.run(5)
    (late,) = drain(cell.server.pop)
    assert late.state is GoalState.RECALLING
    late.set_canceled()
    sent = [cell.send() for _ in range(3)]
    for _, goal in sent:
        goal.accept()
    publisher.send(publisher.new())
    cell.world.run(5)
    assert [goal.state for _, goal in sent] == [GoalState.PREEMPTING] * 3


def test_a_goal_is_rejected_and_what_is_over_stays_so() -> None:
    cell = Cell()
    sent, goal = cell.send()
    goal.reject("busy")
    cell.world.run(5)
    assert (sent.state, sent.text) == (GoalState.REJECTED, "busy")
    with pytest.raises(LocalProtocolError, match="SUCCEED in state REJECTED"):
        goal.succeed()
    goal.cancel()
    assert goal.state is GoalState.REJECTED


def test_statuses_are_told_five_times_a_second_and_ended_goals_forgotten() -> None:
    cell = Cell()
    statuses = cell.other.subscribers["/follow/status"].queue
    before = statuses.pushed
    cell.world.run(2_000)
    assert statuses.pushed - before == 10
    _, goal = cell.send()
    goal.accept()
    goal.succeed()
    assert len(cell.server.goals) == 1
    cell.world.run(KEPT_NS // MS + 300, step_ms=5)
    assert cell.server.goals == ()


def test_goals_beyond_the_bound_are_not_taken() -> None:
    cell = Cell()
    publisher = cell.other.publishers["/follow/goal"]
    for number in range(MOST_GOALS + 20):
        message = publisher.new()
        message.goal_id.id = f"g{number}"
        publisher.send(message)
        cell.world.run(2)
    assert len(cell.server.goals) == MOST_GOALS
    assert cell.server.rejected == 20


def test_a_client_whose_server_has_gone_gives_up() -> None:
    cell = Cell()
    sent, goal = cell.send()
    goal.accept()
    cell.world.run(5)
    cell.world.steps.remove(cell.server.step)
    cell.world.run(6_000, step_ms=5)
    assert sent.is_lost
    assert sent.result is None
