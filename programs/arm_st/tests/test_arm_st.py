"""An action server in Structured Text with its client in C, and with others of the network."""

import pytest

from crosnode.action.client import ActionClient
from crosnode.action.goal_states import GoalState
from crosnode.testing import Ros
from plcsim.testing import Plc

FOLLOW = "control_msgs/FollowJointTrajectory"
PENDING, PREEMPTED, SUCCEEDED = 0, 2, 3


@pytest.fixture(name="ready")
def _ready(plc: Plc, ros: Ros) -> Plc:
    plc.until({"panel.connected": True})
    return plc


def test_the_panel_in_c_sends_the_arm_in_st(ready: Plc) -> None:
    ready["panel.target"] = 0.5
    ready["panel.send"] = True
    ready.until({"panel.state": SUCCEEDED})
    ready.cycles(2)
    assert ready["arm.position"] == pytest.approx([0.5, 0.5])
    assert ready["panel.text"] == "the arm says so"
    assert ready["panel.feedbacks"] > 10
    assert ready["arm.goals"] == 1


def test_the_panel_stops_the_arm(ready: Plc) -> None:
    ready["panel.target"] = 50.0
    ready["panel.send"] = True
    ready.until(lambda: ready["panel.feedbacks"] > 3)
    ready["panel.cancel"] = True
    ready.until({"panel.state": PREEMPTED})
    ready.cycles(2)
    assert ready["panel.error_code"] == -5
    assert 0.0 < ready["arm.position"][0] < 50.0


def test_the_panel_knows_where_the_hand_is(ready: Plc) -> None:
    ready.until({"panel.lookup": 0})
    assert (ready["panel.hand.x"], ready["panel.hand.z"]) == (0.0, 1.0)
    ready["panel.target"] = 0.25
    ready["panel.send"] = True
    ready.until({"panel.state": SUCCEEDED})
    ready.until(lambda: ready["panel.hand.x"] == pytest.approx(0.25))


def test_a_client_of_another_host(plc: Plc, ros: Ros) -> None:
    client = ActionClient(ros.tester, "/arm/follow", FOLLOW)
    plc.after_cycle.append(client.step)
    plc.until(lambda: client.is_connected)
    point = ros.message("trajectory_msgs/JointTrajectoryPoint", positions=[0.1, -0.1])
    trajectory = ros.message("trajectory_msgs/JointTrajectory", joint_names=["a", "b"])
    empty = client.send(trajectory=trajectory)
    plc.until(lambda: empty.is_over)
    assert empty.state is GoalState.REJECTED
    assert empty.result is not None
    assert empty.result.error_code == -1
    trajectory.points = [point]
    goal = client.send(trajectory=trajectory)
    plc.until(lambda: goal.is_over)
    assert (goal.state, goal.text) == (GoalState.SUCCEEDED, "the arm says so")
    assert goal.feedback is not None
    assert goal.feedback.joint_names == ["a", "b"]
    assert plc["arm.position"] == pytest.approx([0.1, -0.1])
    trajectory.points = [point] * 7
    longer = client.send(trajectory=trajectory)
    plc.until(lambda: longer.is_over)
    assert longer.state is GoalState.REJECTED  # the STRUCT has room for six points


def test_others_change_the_speed(plc: Plc, ros: Ros) -> None:
    config = ros.message(
        "dynamic_reconfigure/Config",
        doubles=[ros.message("dynamic_reconfigure/DoubleParameter", name="speed", value=7.0)],
    )
    plc.until({"arm.step": 0.02})
    answer = ros.call("/arm_st/set_parameters", "dynamic_reconfigure/Reconfigure", config=config)
    assert [each.value for each in answer.config.doubles] == [0.1]  # the greatest
    plc.until({"arm.step": 0.1})


def test_it_says_how_it_is(plc: Plc, ros: Ros) -> None:
    told = ros.subscribe("/diagnostics", "diagnostic_msgs/DiagnosticArray")
    plc.until(lambda: told.queue)
    message = told.pop()
    assert message is not None
    (status,) = message.status
    assert (status.name, status.level, status.message) == ("arm_st: joints", 0, "follow")
    assert (status.hardware_id, status.values[0].key) == ("arm-1", "first")
