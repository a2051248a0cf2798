"""Follows a trajectory_msgs/JointTrajectory on /arm/command, and tells /arm/joint_states.

The message is copied into a STRUCT in PLC memory: what the motion program works on is a variable
of the controller, of fixed size, that Structured Text could follow as well. A trajectory that does
not fit is refused whole.
"""

from itertools import pairwise
from math import isfinite

from crosnode.messages import Message, Time
from crosnode.node import CrosNode, LogLevel, Publisher, Subscriber
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import ARRAY, BOOL, LREAL, UDINT, UINT, Struct, var

JOINTS = 6
POINTS = 50
CYCLE_S = 0.01
FASTEST = 2.0
"""The greatest override."""
NAMES = [f"joint_{number}" for number in range(1, JOINTS + 1)]


class Point(Struct):
    """Where the joints shall be, and when."""

    position = var(ARRAY(LREAL, (1, JOINTS)))
    time_s = var(LREAL)


class Trajectory(Struct):
    """All points of a trajectory."""

    count = var(UINT)
    points = var(ARRAY(Point, (1, POINTS)))


class Arm(Program):
    """An arm of six joints that moves in straight lines between the points."""

    __slots__ = ("commands", "node", "states")

    node: CrosNode
    commands: Subscriber
    states: Publisher

    trajectory = var(Trajectory)
    position = var(ARRAY(LREAL, (1, JOINTS)))
    start = var(ARRAY(LREAL, (1, JOINTS)))
    time_s = var(LREAL)
    override = var(LREAL, 1.0)
    speed = var(LREAL)
    busy = var(BOOL)
    accepted = var(UDINT)
    refused = var(UDINT)

    def init(self) -> None:
        """Make the node."""
        self.node = create_node(self.context, "arm")
        self.commands = self.node.register_subscriber(
            "/arm/command", "trajectory_msgs/JointTrajectory", queue_size=1
        )
        self.states = self.node.register_publisher(
            "/arm/joint_states", "sensor_msgs/JointState", loop_period_ns=50_000_000
        )

    def cyclic(self) -> None:
        """Do one step of the node, take a trajectory, move, tell where the joints are."""
        self.node.do_events_loop()
        command = self.commands.pop()
        if command is not None:
            self.take(command)
        if self.busy:
            self.move()
        state = self.states.pop()
        if state is not None:
            state.header.stamp = Time.from_ns(self.node.now_ns)
            state.name, state.position = NAMES, list(self.position)
            self.states.send(state)

    def take(self, command: Message) -> None:
        """Copy a trajectory into the STRUCT, or refuse it."""
        fault = fault_of(command)
        if fault:
            self.refused += 1
            self.node.log(LogLevel.WARN, f"trajectory refused: {fault}")
            return
        for target, point in zip(self.trajectory.points, command.points, strict=False):
            target.time_s = point.time_from_start.to_ns() / 1e9
            target.position.assign([float(value) for value in point.positions])
        self.trajectory.count = len(command.points)
        self.start.assign(self.position)
        self.time_s = 0.0
        self.busy = True
        self.accepted += 1

    def move(self) -> None:
        """Go on along the line between the two points around the present time.

        An override that makes no sense stops the arm: it comes from another computer.
        """
        override = self.override if 0.0 <= self.override <= FASTEST else 0.0
        self.time_s += CYCLE_S * override
        before_s, before = 0.0, list(self.start)
        for number in range(1, self.trajectory.count + 1):
            point = self.trajectory.points[number]
            if self.time_s < point.time_s:
                self.go(before, list(point.position), before_s, point.time_s)
                self.speed *= override
                return
            before_s, before = point.time_s, list(point.position)
        self.position.assign(before)
        self.speed = 0.0
        self.busy = False

    def go(self, before: list[float], after: list[float], before_s: float, after_s: float) -> None:
        """Set the joints on the line at the present time."""
        share = (self.time_s - before_s) / (after_s - before_s)
        line = zip(before, after, strict=True)
        self.position.assign([a + (b - a) * share for a, b in line])
        way = max(abs(b - a) for a, b in zip(before, after, strict=True))
        self.speed = way / (after_s - before_s)

    def exit(self) -> None:
        """Take the registrations back."""
        self.node.destroy()


def fault_of(command: Message) -> str:
    """Return why a trajectory cannot be followed, "" where it can."""
    if list(command.joint_names) != NAMES:
        return f"the joints must be {', '.join(NAMES)}"
    if not 1 <= len(command.points) <= POINTS:
        return f"{len(command.points)} points, 1 to {POINTS} are followed"
    if any(len(point.positions) != JOINTS for point in command.points):
        return f"a point without {JOINTS} positions"
    if not all(isfinite(value) for point in command.points for value in point.positions):
        return "a position that is no number"
    times = [point.time_from_start.to_ns() for point in command.points]
    if times[0] <= 0 or any(later <= earlier for earlier, later in pairwise(times)):
        return "the times must rise from above 0"
    return ""
