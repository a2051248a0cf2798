"""The cell: its states, what drives the arm, and what it tells of its joints and of itself.

The arm is simulated: a joint is where the trajectory wants it. Trajectories come as goals of an
action, or are streamed: a newer one takes the place of an older one, whichever way they came, as
trajectory controllers do it, and a streamed one without points stops the arm. The HMI enables and
stops the cell by two coils; nothing is taken unless the cell is READY or MOVING.
"""

from enum import IntEnum

from crosnode.action.server import ActionServer, Goal
from crosnode.messages import Message, Time
from crosnode.node import CrosNode, Publisher, Subscriber
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import ARRAY, BOOL, LREAL, UDINT, USINT, var

from .trajectory import JOINTS, NAMES, Trajectory, fault_of, fill, position_at

CYCLE_S = 0.004
STATES_EVERY = 5
"""Cycles between two messages on /joint_states: 50 a second."""
STATUS_EVERY = 25
"""Cycles between two messages on /robot_status: 10 a second."""
AUTO = 2
"""Of industrial_msgs/RobotMode."""


class State(IntEnum):
    """How the cell is."""

    OFF = 0
    READY = 1
    MOVING = 2
    STOPPED = 3


class Cell(Program):
    """Six joints, one action, one stream."""

    __slots__ = ("commands", "follow", "goal", "joint_states", "node", "robot_status")

    node: CrosNode
    follow: ActionServer
    commands: Subscriber
    joint_states: Publisher
    robot_status: Publisher
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
    streamed = var(UDINT)

    def init(self) -> None:
        """Make the node; nothing waits for the master."""
        self.node = create_node(self.context, "robot_cell")
        self.joint_states = self.node.register_publisher("/joint_states", "sensor_msgs/JointState")
        self.follow = ActionServer(
            self.node, "/follow_joint_trajectory", "control_msgs/FollowJointTrajectory"
        )
        self.commands = self.node.register_subscriber(
            "/joint_path_command", "trajectory_msgs/JointTrajectory"
        )
        self.robot_status = self.node.register_publisher(
            "/robot_status", "industrial_msgs/RobotStatus"
        )
        self.goal = None

    def cyclic(self) -> None:
        """Take what ROS and the HMI want, move, and tell."""
        self.node.do_events_loop()
        self.follow.step()
        self.switch()
        while (goal := self.follow.pop()) is not None:
            self.take(goal)
        while (trajectory := self.commands.pop()) is not None:
            self.stream(trajectory)
        if self.state == State.MOVING:
            self.move()
        self.cycle += 1
        if self.cycle % STATES_EVERY == 0:
            self.tell()
        if self.cycle % STATUS_EVERY == 0:
            self.tell_status()

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
        elif fault := fault_of(goal.goal.trajectory, start)[0]:
            self.refused += 1
            goal.reject(fault_of(goal.goal.trajectory, start)[1], error_code=fault)
        else:
            goal.accept()
            self.begin(goal.goal.trajectory, goal, "a newer goal")

    def stream(self, trajectory: Message) -> None:
        """Begin with a streamed trajectory, or pass it over; one without points stops the arm."""
        if self.state not in (State.READY, State.MOVING):
            self.refused += 1
        elif not trajectory.points:
            self.give_way("a streamed stop")
            self.state = State.READY
        elif fault_of(trajectory, list(self.position))[0]:
            self.refused += 1
        else:
            self.streamed += 1
            self.begin(trajectory, None, "a streamed trajectory")

    def begin(self, trajectory: Message, goal: Goal | None, text: str) -> None:
        """Let a trajectory take the place of the one that is under way."""
        self.give_way(text)
        fill(self.trajectory, trajectory, list(self.position))
        self.goal, self.time_s, self.state = goal, 0.0, State.MOVING

    def give_way(self, text: str) -> None:
        """End the goal that is under way, for something newer."""
        if self.goal is not None:
            self.goal.cancel(text)
            self.goal.set_canceled(text)
            self.goal = None

    def move(self) -> None:
        """Go one cycle further on the way."""
        goal = self.goal
        if goal is not None and goal.is_canceled:
            goal.set_canceled()
            self.goal, self.state = None, State.READY
            return
        self.time_s += CYCLE_S
        for number, at in enumerate(position_at(self.trajectory, self.time_s), 1):
            self.position[number] = at
        if self.time_s >= self.trajectory.points[self.trajectory.count - 1].time_s:
            self.state = State.READY
            if goal is not None:
                self.done += 1
                goal.succeed("there")
                self.goal = None
        elif goal is not None and self.cycle % STATES_EVERY == 0:
            goal.feedback(joint_names=NAMES)

    def tell(self) -> None:
        """Tell where the joints are."""
        message = self.joint_states.new(name=NAMES, position=list(self.position))
        message.header.stamp = Time.from_ns(self.node.now_ns)
        self.joint_states.send(message)

    def tell_status(self) -> None:
        """Tell how the cell is, as industrial robots do it."""
        message = self.robot_status.new()
        message.header.stamp = Time.from_ns(self.node.now_ns)
        message.mode.val = AUTO
        message.e_stopped.val = int(self.state == State.STOPPED)
        message.drives_powered.val = int(self.state in (State.READY, State.MOVING))
        message.motion_possible.val = int(self.state in (State.READY, State.MOVING))
        message.in_motion.val = int(self.state == State.MOVING)
        self.robot_status.send(message)

    def exit(self) -> None:
        """End goal and node."""
        self.end("the controller stops")
        self.node.destroy()
