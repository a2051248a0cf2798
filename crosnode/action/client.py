"""An action client: goals are sent, and what becomes of them is looked at, a cycle at a time."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Final

from crosnode.action.goal_states import TERMINAL, GoalState
from crosnode.messages import Time

if TYPE_CHECKING:
    from crosnode.messages import Message
    from crosnode.messages.registry import ActionType
    from crosnode.node import CrosNode

MOST_GOALS: Final = 100
LOST_NS: Final = 5_000_000_000
"""Nanoseconds without a word of a server after which its goals count as lost; simulated time that
stands still does not count."""

MOST_STEP_NS: Final = 1_000_000_000
"""Nanoseconds that a step counts for at most: a clock may be set, and a controller halted."""


class ClientGoal:
    """A goal that was sent; made by ``ActionClient.send``.

    Attributes:
        goal_id: its identifier.
        state: as the server told last; PENDING before it did.
        text: for people, beside the state.
        feedback: newest, None before the first.
        result: None until it is there.
        is_lost: the server has gone, or does not know the goal any more.
        heard_ns: when the server spoke of it last, by the client's own time.
    """

    def __init__(self, goal_id: str, heard_ns: int) -> None:
        self.goal_id = goal_id
        self.state = GoalState.PENDING
        self.text = ""
        self.feedback: Message | None = None
        self.result: Message | None = None
        self.is_lost = False
        self.heard_ns = heard_ns

    @property
    def is_over(self) -> bool:
        """Whether nothing more will come: it has its result, or is lost."""
        return self.result is not None or self.is_lost


class ActionClient:
    """A client of an action; arguments and errors as for `crosnode.action.server.ActionServer`."""

    def __init__(self, node: CrosNode, name: str, type_name: str) -> None:
        self.action_type: ActionType = node.types.action(type_name)
        self.action_type.warm()
        self._node = node
        self._goals: dict[str, ClientGoal] = {}
        self._numbers = count(1)
        self._passed_ns = 0  # of ROS time, but for its jumps
        self._before_ns = node.now_ns
        kinds, name = self.action_type, node.resolve_name(name)
        self._goal_out = node.register_publisher(
            f"{name}/goal", kinds.action_goal.name, queue_size=MOST_GOALS
        )
        self._cancel_out = node.register_publisher(
            f"{name}/cancel", "actionlib_msgs/GoalID", queue_size=MOST_GOALS
        )
        self._status_in = node.register_subscriber(
            f"{name}/status", "actionlib_msgs/GoalStatusArray"
        )
        self._feedback_in = node.register_subscriber(f"{name}/feedback", kinds.action_feedback.name)
        self._result_in = node.register_subscriber(
            f"{name}/result", kinds.action_result.name, queue_size=MOST_GOALS
        )

    @property
    def is_connected(self) -> bool:
        """Whether a server hears goals and cancels, and is heard."""
        inwards = (self._status_in, self._feedback_in, self._result_in)
        heard = all(subscriber.publishers for subscriber in inwards)
        return bool(self._goal_out.subscribers and self._cancel_out.subscribers and heard)

    def send(self, **goal: object) -> ClientGoal:
        """Send a goal; the fields of the goal message. The oldest of 100 goals is forgotten.

        Raises:
            MessageValueError: a field cannot hold its value; nothing is sent.
        """
        return self.send_message(self.action_type.goal.new(**goal))

    def send_message(self, goal: Message) -> ClientGoal:
        """Send a goal by a message; see ``send``."""
        now_ns = self._node.now_ns
        stamp = Time.from_ns(now_ns)
        goal_id = f"{self._node.name}-{next(self._numbers)}-{stamp.secs}.{stamp.nsecs:09}"
        message = self._goal_out.new(goal=goal)
        message.header.stamp = message.goal_id.stamp = stamp
        message.goal_id.id = goal_id
        self._goal_out.send(message)
        made = self._goals[goal_id] = ClientGoal(goal_id, self._passed_ns)
        if len(self._goals) > MOST_GOALS:
            del self._goals[next(iter(self._goals))]
        return made

    def cancel(self, goal: ClientGoal) -> None:
        """Ask the server to stop a goal."""
        self._cancel_out.send(self._cancel_out.new(id=goal.goal_id))

    def step(self) -> None:
        """Take what the server says; call it once a cycle, behind the node's step."""
        self._pass_time()
        while (message := self._status_in.pop()) is not None:
            for status in message.status_list:
                self._hear(status)
        while (message := self._feedback_in.pop()) is not None:
            if goal := self._hear(message.status):
                goal.feedback = message.feedback
        while (message := self._result_in.pop()) is not None:
            if goal := self._hear(message.status):
                goal.result = message.result
        self._look()

    def _pass_time(self) -> None:
        now_ns = self._node.now_ns
        self._passed_ns += max(0, min(now_ns - self._before_ns, MOST_STEP_NS))
        self._before_ns = now_ns

    def _hear(self, status: Message) -> ClientGoal | None:
        goal = self._goals.get(status.goal_id.id)
        if goal is None or goal.state in TERMINAL:
            return goal
        try:
            goal.state = GoalState(status.status)
        except ValueError:
            return goal
        goal.text, goal.heard_ns = status.text, self._passed_ns
        return goal

    def _look(self) -> None:
        """Forget goals that are over, and give up those that nobody speaks of."""
        for goal in list(self._goals.values()):
            if self._passed_ns - goal.heard_ns >= LOST_NS:
                goal.is_lost = goal.result is None
            if goal.is_over:
                del self._goals[goal.goal_id]
