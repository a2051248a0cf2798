"""Actions with actionlib of rospy and roscpp, in both directions."""

import sys
from pathlib import Path

from crosnode.action.client import ActionClient
from crosnode.action.goal_states import GoalState
from crosnode.action.server import ActionServer, Goal
from crosnode.messages import MessageTypes

from .rig import HERE, PROGRAMS, PYTHON, Process, Ros

FOLLOW = "control_msgs/FollowJointTrajectory"


class Arm:
    """A program of two joints that follows trajectories, a thousandth of a turn a cycle."""

    def __init__(self, ros: Ros) -> None:
        self.node = ros.node("arm")
        self.server = ActionServer(self.node, "/arm/follow", FOLLOW)
        self.position = [0.0, 0.0]
        self.goal: Goal | None = None
        ros.steps.append(self.cyclic)

    def cyclic(self) -> None:
        self.server.step()
        if (new := self.server.pop()) is not None:
            new.accept()
            self.goal = new
        goal = self.goal
        if goal is None or goal.is_over:
            return
        if goal.is_canceled:
            goal.set_canceled(error_code=-5)
            return
        target = goal.goal.trajectory.points[-1].positions
        self.position = [
            at + max(-0.001, min(0.001, float(to) - at))
            for at, to in zip(self.position, target, strict=True)
        ]
        goal.feedback(joint_names=goal.goal.trajectory.joint_names)
        if self.position == [float(each) for each in target]:
            goal.succeed("there")


def peer(ros: Ros, *arguments: str) -> Process:
    return ros.start([PYTHON, str(HERE / "peers" / "action_peer.py"), *arguments])


def test_a_rospy_client_drives_our_arm(ros: Ros, tmp_path: Path) -> None:
    arm = Arm(ros)
    text = tmp_path / "action.txt"
    text.write_text(arm.node.types.message(f"{FOLLOW}Action").full_text)
    client = peer(ros, "client", str(text), "/arm/follow")
    ros.until(lambda: not client.is_running)
    # actionlib of rospy complains where an answer is faster than its own send_goal returns
    told = [line for line in client.text.splitlines() if "not tracking" not in line]
    assert told == [
        "connected True",
        "goal 0.5 SUCCEEDED 0 feedback",
        "goal 50.0 PREEMPTED -5 feedback",
        "goal 1.0 SUCCEEDED 0 feedback",
    ]


def test_our_client_drives_a_rospy_server(ros: Ros) -> None:
    node = ros.node("plc")
    client = ActionClient(node, "/test", "actionlib/Test")
    ros.steps.append(client.step)
    peer(ros, "server", "/test")
    ros.until(lambda: client.is_connected)
    goal = client.send(goal=21)
    ros.until(lambda: goal.is_over)
    assert goal.result is not None
    assert (goal.state, goal.text, goal.result.result) == (GoalState.SUCCEEDED, "twice", 42)
    assert goal.feedback is not None
    stopped = client.send(goal=5_000)
    ros.until(lambda: stopped.state is GoalState.ACTIVE)
    client.cancel(stopped)
    ros.until(lambda: stopped.is_over)
    assert stopped.state is GoalState.PREEMPTED


def test_a_roscpp_client_drives_our_server(ros: Ros, roscpp: Path) -> None:
    node = ros.node("plc")
    server = ActionServer(node, "/count", "actionlib/Test")
    running: list[tuple[Goal, int]] = []

    def cyclic() -> None:
        server.step()
        if (new := server.pop()) is not None:
            new.accept()
            running.append((new, 0))
        for goal, count in [running.pop()] if running else []:
            if goal.is_canceled:
                goal.set_canceled(result=-1)
            elif count == goal.goal.goal:
                goal.succeed(result=2 * count)
            else:
                goal.feedback(feedback=count)
                running.append((goal, count + 1))

    ros.steps.append(cyclic)
    client = ros.start([str(roscpp / "action_client"), "/count"])
    ros.until(lambda: not client.is_running)
    assert client.text.splitlines() == [
        "connected 1",
        "goal 20 SUCCEEDED 40",
        "goal 30000 PREEMPTED -1",
        "goal 10 SUCCEEDED 20",
    ]


def test_a_rospy_client_drives_an_arm_in_structured_text(ros: Ros, tmp_path: Path) -> None:
    arm = ros.program("arm_st")
    text = tmp_path / "action.txt"
    text.write_text(MessageTypes().message(f"{FOLLOW}Action").full_text)
    ros.until(lambda: "/arm/follow/goal" in ros.tool("rostopic", "list"), 60)
    client = peer(ros, "client", str(text), "/arm/follow", "a,b")
    ros.until(lambda: not client.is_running, 90)
    told = [line for line in client.text.splitlines() if "not tracking" not in line]
    assert told == [
        "connected True",
        "goal 0.5 SUCCEEDED 0 feedback",
        "goal 50.0 PREEMPTED -5 feedback",
        "goal 1.0 SUCCEEDED 0 feedback",
    ]
    assert arm.is_running
    assert 'child_frame_id: "hand"' in ros.tool("rostopic", "echo", "-n", "1", "/tf")


def test_a_rospy_client_drives_the_cell(ros: Ros, tmp_path: Path) -> None:
    cell = ros.program("robot_cell")
    text = tmp_path / "action.txt"
    text.write_text(MessageTypes().message(f"{FOLLOW}Action").full_text)
    ros.until(lambda: "/follow_joint_trajectory/goal" in ros.tool("rostopic", "list"))
    ros.start([sys.executable, "-m", "plcsim.cli.main", "set", str(PROGRAMS / "robot_cell"),
               "cell.enable", "TRUE"])  # fmt: skip
    ros.until(lambda: "data: 1" in ros.tool("rostopic", "echo", "-n", "1", "/cell/state"))
    joints = ",".join(f"joint_{number}" for number in range(1, 7))
    client = peer(ros, "client", str(text), "/follow_joint_trajectory", joints, "0.5,2.0!,1.0,9.0")
    ros.until(lambda: not client.is_running)
    told = [line for line in client.text.splitlines() if "not tracking" not in line]
    assert told == [
        "connected True",
        "goal 0.5 SUCCEEDED 0 feedback",
        "goal 2.0 PREEMPTED 0 feedback",
        "goal 1.0 SUCCEEDED 0 feedback",
        "goal 9.0 REJECTED -1 none",
    ]
    said = ros.tool("rostopic", "echo", "-n", "1", "/joint_states")
    assert "position: [1.0, 1.0, 1.0, 1.0, 1.0, 1.0]" in said
    assert cell.is_running
