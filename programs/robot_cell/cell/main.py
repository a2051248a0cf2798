"""The cell: its states, the action that drives the arm, and what it tells of its joints.

The arm is simulated: a joint is where the trajectory wants it. The HMI enables and stops the cell
by two coils; a goal is refused unless the cell is READY or MOVING, and a newer one takes the place
of an older one, as trajectory controllers do it.
"""

from enum import IntEnum

from crosnode.action.server import ActionServer, Goal
from crosnode.messages import Time
from crosnode.node import CrosNode, Publisher
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import ARRAY, BOOL, LREAL, UDINT, USINT, var

from .trajectory import JOINTS, NAMES, Trajectory, fault_of, fill, position_at

CYCLE_S = 0.004
STATES_EVERY = 5
"""Cycles between two messages on /joint_states: 50 a second."""


class State(IntEnum):
    """How the cell is."""

    OFF = 0
    READY = 1
    MOVING = 2
    STOPPED = 3


class Cell(Program):
    """Six joints, one action."""

    __slots__ = ("follow", "goal", "joint_states", "node")

    node: CrosNode
    follow: ActionServer
    joint_states: Publisher
    goal: Goal | None

    enable = var(BOOL)
    stop = var(BOOL)
    state = var(USINT)
    position = var(ARRAY(LREAL, (1, JOINTS)))
    trajectory = var(Trajectory)
    time_s = var(LREAL)
    cycle = var(UDINT)
    done = var(UDINT)
    stopped = var(UDINT)
    refused = var(UDINT)

    def init(self) -> None:
        """Make the node; nothing waits for the master."""
        self.node = create_node(self.context, "robot_cell")
        self.joint_states = self.node.register_publisher("/joint_states", "sensor_msgs/JointState")
        self.follow = ActionServer(
            self.node, "/follow_joint_trajectory", "control_msgs/FollowJointTrajectory"
        )
        self.goal = None

    def cyclic(self) -> None:
        """Take what ROS and the HMI want, move, and tell."""
        self.node.do_events_loop()
        self.follow.step()
        self.switch()
        while (goal := self.follow.pop()) is not None:
            self.take(goal)
        if self.goal is not None:
            self.move(self.goal)
        self.cycle += 1
        if self.cycle % STATES_EVERY == 0:
            self.tell()

    def switch(self) -> None:
        """Follow the HMI's coils."""
        if self.stop:
            if self.state == State.MOVING:
                self.end("stopped by the HMI")
            if self.state != State.OFF:
                self.state = State.STOPPED
                self.enable = False
        elif not self.enable:
            if self.state == State.MOVING:
                self.end("the drives were switched off")
            if self.state != State.STOPPED:
                self.state = State.OFF
        elif self.state in (State.OFF, State.STOPPED):
            self.state = State.READY

    def end(self, text: str) -> None:
        """Give the goal up that is under way."""
        if self.goal is not None:
            self.goal.abort(text)
            self.goal = None
            self.stopped += 1

    def take(self, goal: Goal) -> None:
        """Begin with a goal, or refuse it."""
        start = list(self.position)
        if goal.is_canceled:
            goal.set_canceled("before it began")
        elif self.state not in (State.READY, State.MOVING):
            self.refused += 1
            goal.reject("the cell is not enabled")
        elif fault := fault_of(goal.goal, start)[0]:
            self.refused += 1
            goal.reject(fault_of(goal.goal, start)[1], error_code=fault)
        else:
            if self.goal is not None:
                self.goal.cancel("a newer goal")
                self.goal.set_canceled("a newer goal")
            fill(self.trajectory, goal.goal, start)
            goal.accept()
            self.goal, self.time_s, self.state = goal, 0.0, State.MOVING

    def move(self, goal: Goal) -> None:
        """Go one cycle further on the way of a goal."""
        if goal.is_canceled:
            goal.set_canceled()
            self.goal, self.state = None, State.READY
            return
        self.time_s += CYCLE_S
        for number, at in enumerate(position_at(self.trajectory, self.time_s), 1):
            self.position[number] = at
        if self.time_s >= self.trajectory.points[self.trajectory.count - 1].time_s:
            self.done += 1
            goal.succeed("there")
            self.goal, self.state = None, State.READY
        elif self.cycle % STATES_EVERY == 0:
            goal.feedback(joint_names=NAMES)

    def tell(self) -> None:
        """Tell where the joints are."""
        message = self.joint_states.new(name=NAMES, position=list(self.position))
        message.header.stamp = Time.from_ns(self.node.now_ns)
        self.joint_states.send(message)

    def exit(self) -> None:
        """End goal and node."""
        self.end("the controller stops")
        self.node.destroy()
