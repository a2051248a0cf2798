"""Actions: goals of a server and of a client, by handles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from crosnode.action.client import MOST_GOALS, ActionClient, ClientGoal
from crosnode.action.goal_states import GoalState, GoalTrigger
from crosnode.action.server import ActionServer, Goal
from crosnode.errors import LocalProtocolError, MessageValueError
from crosnode.interface.handles import (
    Handles,
    MessageHandle,
    OwnerHandle,
    handles_of,
    put_text,
    text_at,
)
from crosnode.interface.interface import (
    CROS_TEXT_LENGTH,
    CrosGoalState,
    crosERR_HANDLE,
    crosERR_STATE,
    crosERR_VALUE,
)
from crosnode.interface.nodes import Registered, name_at, register
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.messages import Message, MessageType, MessageTypes
    from crosnode.node import CrosNode
    from plcsim.core.context import Context

ENDS: Final = {
    GoalState.SUCCEEDED: GoalTrigger.SUCCEED,
    GoalState.ABORTED: GoalTrigger.ABORT,
    GoalState.REJECTED: GoalTrigger.REJECT,
    GoalState.PREEMPTED: GoalTrigger.CANCELED,
    GoalState.RECALLED: GoalTrigger.CANCELED,
}
"""What ends a goal in a state; whether it is preempted or recalled its state before says."""


@dataclass(eq=False)
class ServerHandle(OwnerHandle):
    """A server; its parts are its goals."""

    server: ActionServer
    types: MessageTypes


@dataclass(eq=False)
class ClientHandle(OwnerHandle):
    """A client; its parts are its goals."""

    client: ActionClient
    types: MessageTypes


@dataclass(eq=False)
class GoalHandle(OwnerHandle):
    """A goal of a server; its part is the message of it."""

    goal: Goal
    owner: ServerHandle


@dataclass(eq=False)
class ClientGoalHandle(OwnerHandle):
    """A goal of a client; its parts are messages of it.

    Attributes:
        seen: the feedback that the program has got.
        result: handle of the result, 0 before it was asked for.
    """

    goal: ClientGoal
    owner: ClientHandle
    seen: Message | None = None
    result: int = 0


@function("cRosActionServer")
def server(context: Context, node: int, name: int, type_name: int) -> int:
    """Offer an action."""

    def make(found: CrosNode) -> Registered:
        made = ActionServer(found, name_at(context, name), name_at(context, type_name))
        return Registered(ServerHandle(made, found.types), made.step)

    return register(context, node, make)


@function("cRosActionClient")
def client(context: Context, node: int, name: int, type_name: int) -> int:
    """Make ready to use an action."""

    def make(found: CrosNode) -> Registered:
        made = ActionClient(found, name_at(context, name), name_at(context, type_name))
        return Registered(ClientHandle(made, found.types), made.step)

    return register(context, node, make)


def _forget(handles: Handles, owner: OwnerHandle, handle: int) -> None:
    """Release the handle of what belongs to an owner."""
    handles.release(handle)
    if handle in owner.parts:
        owner.parts.remove(handle)


@function("cRosActionNextGoal")
def next_goal(context: Context, server: int) -> int:
    """Return the oldest new goal."""
    handles = handles_of(context)
    owner = handles.find(ServerHandle, server)
    goal = owner.server.pop() if owner else None
    if owner is None or goal is None:
        return 0
    return handles.add_part(owner, GoalHandle(goal, owner))


@function("cRosActionGoalMsg")
def goal_message(context: Context, goal: int) -> int:
    """Return the message of a goal."""
    handles = handles_of(context)
    found = handles.find(GoalHandle, goal)
    if found is None:
        return 0
    if not found.parts:
        kind = found.goal.action_type.goal
        handles.add_part(found, MessageHandle(found.owner.types, kind, found.goal.goal))
    return found.parts[0] if found.parts else 0


@function("cRosActionAccept")
def accept(context: Context, goal: int) -> int:
    """Begin a goal."""
    found = handles_of(context).find(GoalHandle, goal)
    if found is None:
        return crosERR_HANDLE
    try:
        found.goal.accept()
    except LocalProtocolError:
        return crosERR_STATE
    return ERR_OK


def _new(context: Context, goal: int, kind: Callable[[Goal], MessageType]) -> int:
    handles = handles_of(context)
    found = handles.find(GoalHandle, goal)
    if found is None:
        return 0
    message_type = kind(found.goal)
    return handles.add(MessageHandle(found.owner.types, message_type, message_type.new()))


@function("cRosActionNewFeedback")
def new_feedback(context: Context, goal: int) -> int:
    """Return a feedback message with defaults."""
    return _new(context, goal, lambda found: found.action_type.feedback)


@function("cRosActionNewResult")
def new_result(context: Context, goal: int) -> int:
    """Return a result message with defaults."""
    return _new(context, goal, lambda found: found.action_type.result)


@function("cRosActionSendFeedback")
def send_feedback(context: Context, goal: int, msg: int) -> int:
    """Send feedback of a goal."""
    handles = handles_of(context)
    found, message = handles.find(GoalHandle, goal), handles.find(MessageHandle, msg)
    if found is None or message is None or not _is(message, found.goal.action_type.feedback):
        return crosERR_HANDLE
    try:
        found.goal.send_feedback(message.message)
    except MessageValueError:
        return crosERR_VALUE
    handles.release(msg)
    return ERR_OK


def _is(message: MessageHandle, kind: MessageType) -> bool:
    """Whether a message is of a type."""
    return message.message_type.name == kind.name


@function("cRosActionEnd")
def end(context: Context, goal: int, state: int, msg: int, text: int) -> int:
    """End a goal in a state."""
    handles = handles_of(context)
    found, message = handles.find(GoalHandle, goal), handles.find(MessageHandle, msg)
    if found is None:
        return crosERR_HANDLE
    kind = found.goal.action_type.result
    if msg and (message is None or not _is(message, kind)):
        return crosERR_HANDLE
    trigger = ENDS.get(state)  # type: ignore[call-overload]  # its numbers are those of the keys
    if trigger is None:
        return crosERR_VALUE
    try:
        result = message.message if message else kind.new()
        found.goal.end(trigger, text_at(context, text, CROS_TEXT_LENGTH), result)
    except LocalProtocolError:
        return crosERR_STATE
    except MessageValueError:
        return crosERR_VALUE
    handles.release(msg)
    _forget(handles, found.owner, goal)
    return ERR_OK


@function("cRosActionConnected")
def is_connected(context: Context, client: int) -> bool:
    """Whether there is a server."""
    found = handles_of(context).find(ClientHandle, client)
    return found is not None and found.client.is_connected


@function("cRosActionNewGoal")
def new_goal(context: Context, client: int) -> int:
    """Return a goal message with defaults."""
    handles = handles_of(context)
    found = handles.find(ClientHandle, client)
    if found is None:
        return 0
    kind = found.client.action_type.goal
    return handles.add(MessageHandle(found.types, kind, kind.new()))


@function("cRosActionSendGoal")
def send_goal(context: Context, client: int, msg: int) -> int:
    """Send a goal; the oldest of a hundred is forgotten."""
    handles = handles_of(context)
    found, message = handles.find(ClientHandle, client), handles.find(MessageHandle, msg)
    if found is None or message is None or not _is(message, found.client.action_type.goal):
        return 0
    try:
        goal = found.client.send_message(message.message)
    except MessageValueError:
        return 0
    handles.release(msg)
    while len(found.parts) >= MOST_GOALS:
        handles.release(found.parts.pop(0))
    return handles.add_part(found, ClientGoalHandle(goal, found))


@function("cRosActionCancel")
def cancel(context: Context, goal: int) -> int:
    """Ask the server to stop a goal."""
    found = handles_of(context).find(ClientGoalHandle, goal)
    if found is None:
        return crosERR_HANDLE
    found.owner.client.cancel(found.goal)
    return ERR_OK


@function("cRosActionState")
def state(context: Context, goal: int) -> int:
    """Return how far a goal is."""
    handles = handles_of(context)
    own = handles.find(GoalHandle, goal)
    if own is not None:
        return int(own.goal.state)
    found = handles.find(ClientGoalHandle, goal)
    lost = found is None or found.goal.is_lost
    return int(CrosGoalState.CROS_GOAL_LOST) if lost or found is None else int(found.goal.state)


@function("cRosActionText")
def text(context: Context, goal: int, address: int, size: int) -> int:
    """Write what the server says."""
    found = handles_of(context).find(ClientGoalHandle, goal)
    if found is None:
        return crosERR_HANDLE
    put_text(context, address, size, found.goal.text)
    return ERR_OK


@function("cRosActionNextFeedback")
def next_feedback(context: Context, goal: int) -> int:
    """Return the newest feedback once; the one before is released."""
    handles = handles_of(context)
    found = handles.find(ClientGoalHandle, goal)
    newest = found.goal.feedback if found else None
    if found is None or newest is None or newest is found.seen:
        return 0
    for each in [each for each in found.parts if each != found.result]:
        _forget(handles, found, each)
    found.seen = newest
    kind = found.owner.client.action_type.feedback
    return handles.add_part(found, MessageHandle(found.owner.types, kind, newest))


@function("cRosActionResult")
def result(context: Context, goal: int) -> int:
    """Return the result, where it is there."""
    handles = handles_of(context)
    found = handles.find(ClientGoalHandle, goal)
    if found is None or found.goal.result is None:
        return 0
    if handles.find(MessageHandle, found.result) is None:
        kind = found.owner.client.action_type.result
        made = MessageHandle(found.owner.types, kind, found.goal.result)
        found.result = handles.add_part(found, made)
    return found.result


@function("cRosActionRelease")
def release(context: Context, goal: int) -> int:
    """Forget a goal of a client."""
    handles = handles_of(context)
    found = handles.find(ClientGoalHandle, goal)
    if found is None:
        return crosERR_HANDLE
    _forget(handles, found.owner, goal)
    return ERR_OK
