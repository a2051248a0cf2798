"""An action server: goals wait in a queue, the program does them, a cycle at a time.

The five topics of actionlib (goal, cancel, status, feedback, result) are publishers and subscribers
of the node; the server's ``step`` belongs behind the node's step. Nothing calls back.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from crosnode.action.goal_states import GOAL, TERMINAL, GoalState, GoalTrigger
from crosnode.messages import Time
from crosnode.node.queues import DropOldestQueue
from crosnode.transport.transitions import next_state

if TYPE_CHECKING:
    from crosnode.messages import Message
    from crosnode.messages.registry import ActionType
    from crosnode.node import CrosNode

STATUS_NS: Final = 200_000_000
"""Nanoseconds between two statuses that nothing asks for: five a second, as actionlib's servers."""

KEPT_NS: Final = 5_000_000_000
"""Nanoseconds that a goal stays in the status after its end, as at actionlib's servers."""

MOST_GOALS: Final = 100
"""Goals that are known at once. Those that are over make room early; beyond that, new ones are
rejected."""


class Goal:
    """A goal; made by `ActionServer`.

    Attributes:
        goal: the message.
        goal_id: its identifier, unique among all clients.
        state: how far it is.
        text: for people, beside the state.
    """

    def __init__(self, server: ActionServer, goal: Message, goal_id: str, stamp: Time) -> None:
        self.goal = goal
        self.goal_id = goal_id
        self.stamp = stamp
        self.state = GoalState.PENDING
        self.text = ""
        self.ended_ns: int | None = None
        self._server = server

    @property
    def action_type(self) -> ActionType:
        """The type of its action."""
        return self._server.action_type

    @property
    def is_canceled(self) -> bool:
        """Whether the program should stop it: its client or a newer goal asks for that."""
        return self.state in (GoalState.PREEMPTING, GoalState.RECALLING)

    @property
    def is_over(self) -> bool:
        """Whether it has its result."""
        return self.state in TERMINAL

    def accept(self, text: str = "") -> None:
        """Begin to do it.

        Raises:
            LocalProtocolError: as all of these: its state does not allow it.
        """
        self._move(GoalTrigger.ACCEPT, text)

    def reject(self, text: str = "", **result: object) -> None:
        """Do not take it."""
        self._end(GoalTrigger.REJECT, text, result)

    def succeed(self, text: str = "", **result: object) -> None:
        """It is done; ``result`` are the fields of the result message."""
        self._end(GoalTrigger.SUCCEED, text, result)

    def abort(self, text: str = "", **result: object) -> None:
        """It cannot be done."""
        self._end(GoalTrigger.ABORT, text, result)

    def set_canceled(self, text: str = "", **result: object) -> None:
        """It was stopped, as was asked."""
        self._end(GoalTrigger.CANCELED, text, result)

    def feedback(self, **feedback: object) -> None:
        """Tell its client how far it is; the fields of the feedback message."""
        self.send_feedback(self.action_type.feedback.new(**feedback))

    def send_feedback(self, feedback: Message) -> None:
        """Tell its client how far it is by a message; see ``feedback``."""
        self._server.publish_feedback(self, feedback)

    def cancel(self, text: str = "") -> None:
        """Ask the program to stop it; nothing where it is over or asked already."""
        if self.state in (GoalState.PENDING, GoalState.ACTIVE):
            self._move(GoalTrigger.CANCEL, text)

    def _move(self, trigger: GoalTrigger, text: str) -> None:
        self.state = next_state(GOAL, self.state, trigger, f"goal {self.goal_id}")
        self.text = text
        self._server.has_news = True

    def _end(self, trigger: GoalTrigger, text: str, result: dict[str, object]) -> None:
        self.end(trigger, text, self.action_type.result.new(**result))

    def end(self, trigger: GoalTrigger, text: str, result: Message) -> None:
        """End it with a result message; the others say what the triggers mean.

        Raises:
            LocalProtocolError: its state does not allow it.
            MessageValueError: the result cannot be sent; the goal goes on.
        """
        self.action_type.result.encode(result)
        self._move(trigger, text)
        self._server.publish_result(self, result)


class ActionServer:
    """An action that a node offers.

    Args:
        node: of the program.
        name: of the action, resolved and remapped by the node before its topics are, as in
            rospy and roscpp.
        type_name: ``pkg/Name``.

    Raises:
        InvalidNameError: not a legal name, or one of its topics is taken.
        MessageTypeError: the type cannot be had.

    Attributes:
        action_type: the type.
        has_news: a status is due.
        rejected: goals that came while too many were under way; their clients are told.
    """

    def __init__(self, node: CrosNode, name: str, type_name: str) -> None:
        self.action_type: ActionType = node.types.action(type_name)
        self.action_type.warm()
        self.has_news = False
        self.rejected = 0
        self._node = node
        self._goals: dict[str, Goal] = {}
        self._canceled: dict[str, int] = {}
        self._canceled_until_ns = 0
        self._new: DropOldestQueue[Goal] = DropOldestQueue(MOST_GOALS)
        self._status_ns = 0
        kinds, name = self.action_type, node.resolve_name(name)
        self._goal_in = node.register_subscriber(
            f"{name}/goal", kinds.action_goal.name, queue_size=MOST_GOALS
        )
        self._cancel_in = node.register_subscriber(
            f"{name}/cancel", "actionlib_msgs/GoalID", queue_size=MOST_GOALS
        )
        self._status_out = node.register_publisher(
            f"{name}/status", "actionlib_msgs/GoalStatusArray", latching=True
        )
        self._feedback_out = node.register_publisher(f"{name}/feedback", kinds.action_feedback.name)
        self._result_out = node.register_publisher(
            f"{name}/result", kinds.action_result.name, queue_size=MOST_GOALS
        )

    @property
    def goals(self) -> tuple[Goal, ...]:
        """Those that are under way, and those that ended in the last seconds."""
        return tuple(self._goals.values())

    def pop(self) -> Goal | None:
        """Return the oldest new goal, to be accepted or rejected; None where there is none."""
        return self._new.pop()

    def step(self) -> None:
        """Take goals and cancels, and tell the status where it is due; call it once a cycle."""
        now_ns = self._node.now_ns
        while (message := self._goal_in.pop()) is not None:
            self._take(message, now_ns)
        while (message := self._cancel_in.pop()) is not None:
            self._cancel(message, now_ns)
        if self.has_news or not 0 <= now_ns - self._status_ns < STATUS_NS:
            self._tell(now_ns)

    def _take(self, message: Message, now_ns: int) -> None:
        goal_id = message.goal_id.id or f"{self._node.name}-{now_ns}"
        stamp = message.goal_id.stamp
        if goal_id in self._goals:
            return
        goal = Goal(self, message.goal, goal_id, stamp if stamp.to_ns() else Time.from_ns(now_ns))
        if not self._has_room():
            self.rejected += 1
            goal.reject(f"{MOST_GOALS} goals are under way")
            return
        self._goals[goal_id] = goal
        self._new.push(goal)
        self.has_news = True
        if goal_id in self._canceled or 0 < stamp.to_ns() <= self._canceled_until_ns:
            goal.cancel()  # the cancel was faster

    def _has_room(self) -> bool:
        """Return whether one more goal may be known, after the first that is over is forgotten."""
        if len(self._goals) >= MOST_GOALS:
            over = next((goal for goal in self._goals.values() if goal.is_over), None)
            if over is None:
                return False
            del self._goals[over.goal_id]
        return True

    def _cancel(self, message: Message, now_ns: int) -> None:
        """Cancel the goal that is named, or those that are older than a time, or all."""
        goal_id, stamp_ns = message.id, message.stamp.to_ns()
        self._canceled_until_ns = max(self._canceled_until_ns, stamp_ns)
        for goal in self._goals.values():
            is_all = not goal_id and not stamp_ns
            if is_all or goal.goal_id == goal_id or (stamp_ns and goal.stamp.to_ns() <= stamp_ns):
                goal.cancel()
        if goal_id and goal_id not in self._goals:
            self._canceled[goal_id] = now_ns
            while len(self._canceled) > MOST_GOALS:
                del self._canceled[next(iter(self._canceled))]

    def _tell(self, now_ns: int) -> None:
        self._status_ns, self.has_news = now_ns, False
        for goal in [goal for goal in self._goals.values() if goal.ended_ns is not None]:
            assert goal.ended_ns is not None
            if now_ns - goal.ended_ns >= KEPT_NS:
                del self._goals[goal.goal_id]
        status = self._status_out.new()
        status.header.stamp = Time.from_ns(now_ns)
        status.status_list = [self._status(goal) for goal in self._goals.values()]
        self._status_out.send(status)

    def _status(self, goal: Goal) -> Message:
        types = self._node.types
        status = types.message("actionlib_msgs/GoalStatus").new(
            status=int(goal.state), text=goal.text
        )
        status.goal_id.id, status.goal_id.stamp = goal.goal_id, goal.stamp
        return status

    def publish_feedback(self, goal: Goal, feedback: Message) -> None:
        """Send feedback of a goal."""
        message = self._filled(self._feedback_out.new(), goal)
        message.feedback = feedback
        self._feedback_out.send(message)

    def publish_result(self, goal: Goal, result: Message) -> None:
        """Send the result of a goal."""
        goal.ended_ns = self._node.now_ns
        message = self._filled(self._result_out.new(), goal)
        message.result = result
        self._result_out.send(message)

    def _filled(self, message: Message, goal: Goal) -> Message:
        message.header.stamp = Time.from_ns(self._node.now_ns)
        message.status = self._status(goal)
        return message
