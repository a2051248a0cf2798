"""An action server and its clients, on the virtual network."""

from typing import Any

import pytest

from crosnode.action.client import ActionClient, ClientGoal
from crosnode.action.goal_states import GoalState
from crosnode.action.server import KEPT_NS, MOST_GOALS, ActionServer
from crosnode.errors import LocalProtocolError
from crosnode.messages import Time
from crosnode.node.ros_time import Epoch

from ..node.world import MS, OTHER_IP, PLC_IP, SECOND, World, drain

TYPE = "control_msgs/FollowJointTrajectory"


class Cell:
    """A server on one host, a client on another, both known to each other."""

    def __init__(self) -> None:
        self.world = world = World()
        self.node = world.node("arm", epoch=Epoch(10**18))
        self.epoch = Epoch(10**18)
        self.other = world.node("planner", OTHER_IP, epoch=self.epoch)
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


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("follow", ["follow:=/arm/follow"]),
        ("~follow", ["~follow:=/arm/follow"]),
        ("/follow", ["/follow:=/other", "/other/goal:=/arm/follow/goal"]),
    ],
)
def test_the_name_of_an_action_is_remapped(name: str, arguments: list[str]) -> None:
    world = World()
    node = world.node("cell", OTHER_IP, *arguments)
    ActionServer(node, name, TYPE)
    planner = world.node("planner", PLC_IP, *arguments)
    ActionClient(planner, name, TYPE)
    assert "/arm/follow/goal" in node.subscribers
    assert "/arm/follow/goal" in planner.publishers
    other = "/other" if name == "/follow" else "/arm/follow"
    assert set(node.publishers) >= {f"{other}/{each}" for each in ("status", "feedback", "result")}


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


def test_goals_beyond_the_bound_are_rejected_and_their_clients_told() -> None:
    cell = Cell()
    known = [cell.send() for _ in range(MOST_GOALS)]
    for _, goal in known:
        goal.accept()
    beyond, nothing = cell.send()
    assert nothing is None
    assert (beyond.state, beyond.text) == (
        GoalState.REJECTED,
        f"{MOST_GOALS} goals are under way",
    )
    assert (len(cell.server.goals), cell.server.rejected) == (MOST_GOALS, 1)
    known[7][1].succeed()
    sent, goal = cell.send()
    assert goal.goal_id == sent.goal_id
    assert (len(cell.server.goals), cell.server.rejected) == (MOST_GOALS, 1)


def test_all_goals_and_cancels_of_one_cycle_are_taken() -> None:
    cell = Cell()
    cell.world.steps.remove(cell.server.step)
    sent = [cell.client.send() for _ in range(MOST_GOALS)]
    cell.world.run(50)
    for goal in sent:
        cell.client.cancel(goal)
    cell.world.run(50)
    cell.server.step()
    taken = drain(cell.server.pop)
    assert [goal.goal_id for goal in taken] == [goal.goal_id for goal in sent]
    assert {goal.state for goal in taken} == {GoalState.RECALLING}


def test_a_goal_from_before_a_cancel_is_canceled_when_it_comes_later() -> None:
    cell = Cell()
    cancels, goals = (cell.other.publishers[f"/follow/{name}"] for name in ("cancel", "goal"))
    stamps = [Time(100, 0), Time(100, 1), Time()]
    cancels.send(cancels.new(stamp=stamps[0]))
    cell.world.run(5)
    for number, stamp in enumerate(stamps):
        message = goals.new()
        message.goal_id.id, message.goal_id.stamp = f"g{number}", stamp
        goals.send(message)
    cell.world.run(5)
    assert [goal.state for goal in drain(cell.server.pop)] == [
        GoalState.RECALLING,
        GoalState.PENDING,
        GoalState.PENDING,
    ]


def test_a_client_whose_server_has_gone_gives_up() -> None:
    cell = Cell()
    sent, goal = cell.send()
    goal.accept()
    cell.world.run(5)
    cell.world.steps.remove(cell.server.step)
    cell.world.run(6_000, step_ms=5)
    assert sent.is_lost
    assert sent.result is None


@pytest.mark.parametrize("jump_s", [-3_600, 3_600])
def test_a_clock_that_is_set_loses_no_goal_and_keeps_none_of_a_server_that_has_gone(
    jump_s: int,
) -> None:
    cell = Cell()
    sent, goal = cell.send()
    goal.accept()
    cell.world.run(5)
    cell.epoch.ns += jump_s * SECOND
    cell.world.run(2_000, step_ms=5)
    assert not sent.is_lost
    goal.succeed()
    cell.world.run(5)
    assert sent.result is not None
    lost, _ = cell.send()
    cell.world.steps.remove(cell.server.step)
    cell.epoch.ns += jump_s * SECOND
    cell.world.run(3_000, step_ms=5)
    assert not lost.is_lost
    cell.world.run(3_000, step_ms=5)
    assert lost.is_lost


def test_a_controller_that_was_halted_loses_no_goal() -> None:
    cell = Cell()
    sent, goal = cell.send()
    goal.accept()
    cell.world.run(5)
    steps = [cell.other.do_events_loop, cell.client.step]
    cell.world.steps = [step for step in cell.world.steps if step not in steps]
    cell.world.run(20_000, step_ms=5)
    cell.world.steps += reversed(steps)  # the client first: what has come is not read yet
    cell.world.run(100)
    assert not sent.is_lost
    goal.succeed()
    cell.world.run(100)
    assert sent.result is not None
