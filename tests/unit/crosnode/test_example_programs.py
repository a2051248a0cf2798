"""The ROS example programs on the virtual clock and network, with peers on the same host."""

from pathlib import Path
from typing import Any

import pytest

from crosnode.extension import EXTENSION
from crosnode.master_server import MasterOptions, MasterServer
from crosnode.messages import Duration, MessageTypes
from crosnode.names import node_settings
from crosnode.node import CrosNode
from crosnode.project import EmbeddedMaster
from plcsim.clock import VirtualClock
from plcsim.context import Context
from plcsim.controller import Controller
from plcsim.memory import Memory
from plcsim.network import VirtualNetwork
from plcsim.project import load_setup, read_project
from plcsim.system import State
from plcsim.task import TaskClass

PROGRAMS = Path(__file__).parents[3] / "programs"
MASTER_URI = "http://127.0.0.1:11311/"


class Cell:
    """A controller with a project, and a peer node (and a master) that step after each cycle."""

    def __init__(self, project: str, *, master: bool) -> None:
        folder = PROGRAMS / project
        self.clock = VirtualClock()
        self.host = VirtualNetwork(self.clock.now_ns).host("192.168.0.10")
        found = read_project(folder)
        self.plc = Controller(load_setup(found), network=self.host, clock=self.clock)
        self.context = Context(Memory(), self.host)
        self.master = (
            MasterServer(self.context, MasterOptions(host="127.0.0.1")) if master else None
        )
        self.nodes: list[CrosNode] = []
        self.plc.image.watchers.append(self._step)
        EXTENSION.attach(found.extensions["ros"], self.plc)

    def _step(self, _task_class: TaskClass) -> None:
        self.context.release_ns = self.clock.now_ns()
        if self.master:
            self.master.step()
        for node in self.nodes:
            node.do_events_loop()

    def peer(self, packages: str = "") -> CrosNode:
        settings = node_settings(
            "peer", host="127.0.0.1", environment={"ROS_MASTER_URI": MASTER_URI}
        )
        folders = [PROGRAMS / packages / "packages"] if packages else []
        node = CrosNode(self.context, settings, MessageTypes(folders))
        self.nodes.append(node)
        return node

    def run(self, cycles: int) -> None:
        if self.plc.state is State.BOOT:
            self.plc.boot()
        assert self.plc.run(cycles=cycles) is State.RUN, self.plc.fault

    def tag(self, path: str) -> Any:
        return self.plc.tags.read(self.plc.tags.find(path))


@pytest.fixture(autouse=True)
def _environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("ROS_IP", "ROS_HOSTNAME", "ROS_NAMESPACE", "ROS_PACKAGE_PATH"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("ROS_MASTER_URI", MASTER_URI)


def test_the_talker_says_its_word_once_a_second() -> None:
    cell = Cell("talker", master=True)
    subscriber = cell.peer("talker").register_subscriber("/chatter", "prova/hello")
    cell.run(3_500)
    words = []
    while (message := subscriber.pop()) is not None:
        words.append(message.aWord)  # type: ignore[attr-defined]
    assert words == ["Hello world!!!"] * 3
    assert cell.tag("talker.sent") == 4
    assert cell.tag("talker.subscribers") == 1
    cell.plc.shutdown()


def test_the_listener_hears_and_says_so_on_rosout() -> None:
    cell = Cell("listener", master=True)
    node = cell.peer("listener")
    publisher = node.register_publisher("/chatter", "prova/hello", latching=True)
    log = node.register_subscriber("/rosout", "rosgraph_msgs/Log")
    cell.run(200)
    publisher.send(publisher.new(aWord="grüß dich €"))
    cell.run(20)
    assert cell.tag("listener.word") == "grüß dich ?"
    assert cell.tag("listener.heard") == 1
    entry = log.pop()
    assert entry is not None
    assert entry.msg == "I heard: [grüß dich €]"  # type: ignore[attr-defined]
    cell.plc.shutdown()


def test_add_two_ints_runs_without_any_ros() -> None:
    cell = Cell("add_two_ints", master=False)
    cell.run(2_000)
    assert 15 <= cell.tag("caller.right") <= 20
    assert cell.tag("caller.failed") == 0
    assert cell.tag("caller.last") == 2 * cell.tag("caller.right")
    cell.plc.shutdown()


def test_a_sum_beyond_64_bits_is_refused() -> None:
    cell = Cell("add_two_ints", master=False)
    caller = cell.peer("add_two_ints").register_service_caller(
        "/add_two_ints", "roscpp_tutorials/TwoInts"
    )
    cell.run(50)
    caller.call(caller.new(a=2**63 - 1, b=1))
    cell.run(50)
    reply = caller.pop()
    assert reply
    assert "64 bits" in reply.error
    cell.plc.shutdown()


def test_after_exit_nothing_is_registered_any_more() -> None:
    cell = Cell("add_two_ints", master=False)
    cell.run(500)
    master = cell.plc.context.library(EmbeddedMaster).master
    assert "/add_two_ints" in str(master.get_system_state("/x"))
    cell.plc.shutdown()
    assert master.get_system_state("/x")[2] == [[], [], []]


class Robot(Cell):
    """The arm, and a node that commands it."""

    def __init__(self) -> None:
        super().__init__("joint_trajectory", master=False)
        node = self.peer()
        self.command = node.register_publisher("/arm/command", "trajectory_msgs/JointTrajectory")
        self.override = node.register_publisher("/arm/override", "std_msgs/Float64")
        self.busy = node.register_subscriber("/arm/busy", "std_msgs/Bool")
        self.states = node.register_subscriber("/arm/joint_states", "sensor_msgs/JointState")
        self.types = node.types
        self.run(200)

    def send(self, *points: tuple[float, float], joints: int = 6) -> None:
        """Send a trajectory of all joints alike: pairs of position and seconds."""
        point_type = self.types.message("trajectory_msgs/JointTrajectoryPoint")
        self.command.send(
            self.command.new(
                joint_names=[f"joint_{number}" for number in range(1, joints + 1)],
                points=[
                    point_type.new(
                        positions=[position] * joints,
                        time_from_start=Duration.from_ns(int(seconds * 1e9)),
                    )
                    for position, seconds in points
                ],
            )
        )


def test_the_arm_follows_a_trajectory() -> None:
    robot = Robot()
    robot.send((1.0, 1.0), (2.0, 3.0))
    robot.run(60)
    assert robot.tag("arm.trajectory.count") == 2
    assert robot.tag("arm.busy") is True
    assert 0.4 < robot.tag("arm.position")[0] < 0.7
    robot.run(300)
    assert robot.tag("arm.position") == [2.0] * 6
    assert robot.tag("monitor.state.position")[:6] == pytest.approx([2.0] * 6)
    assert robot.tag("monitor.state.name")[:2] == ["joint_1", "joint_2"]
    assert robot.tag("monitor.state.position_length") == 6
    assert robot.tag("monitor.heard") > 5
    assert robot.tag("arm.busy") is False
    state = robot.states.pop()
    assert state is not None
    assert list(state.name) == [f"joint_{n}" for n in range(1, 7)]  # type: ignore[attr-defined]
    told = []
    while (message := robot.busy.pop()) is not None:
        told.append(message.data)  # type: ignore[attr-defined]
    assert told == [False, True, False]


def test_the_bridge_takes_the_override() -> None:
    robot = Robot()
    robot.override.send(robot.override.new(data=0.5))
    robot.run(5)
    assert robot.tag("arm.override") == 0.5


def test_what_does_not_fit_is_refused_whole() -> None:
    robot = Robot()
    robot.send((1.0, 1.0), joints=5)
    robot.run(5)
    robot.send((1.0, 1.0), (2.0, 1.0))
    robot.run(5)
    robot.send(*[(0.0, 1.0 + n) for n in range(51)])
    robot.run(5)
    assert (robot.tag("arm.accepted"), robot.tag("arm.refused")) == (0, 3)
    assert robot.tag("arm.trajectory.count") == 0
