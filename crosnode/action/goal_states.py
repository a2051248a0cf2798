"""The life of a goal at an action server (actionlib: goal states of the server)."""

from __future__ import annotations

from enum import Enum, IntEnum
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from crosnode.transport.transitions import Transitions


class GoalState(IntEnum):
    """Numbers of actionlib_msgs/GoalStatus."""

    PENDING = 0
    ACTIVE = 1
    PREEMPTED = 2
    SUCCEEDED = 3
    ABORTED = 4
    REJECTED = 5
    PREEMPTING = 6
    RECALLING = 7
    RECALLED = 8


class GoalTrigger(Enum):
    """What happens to a goal."""

    ACCEPT = "the program takes it"
    REJECT = "the program does not take it"
    CANCEL = "its client cancels it, or another goal takes its place"
    SUCCEED = "the program has done it"
    ABORT = "the program cannot do it"
    CANCELED = "the program has stopped it"


_State = GoalState
_Trigger = GoalTrigger

GOAL: Final[Transitions[GoalState, GoalTrigger]] = {
    _State.PENDING: {
        _Trigger.ACCEPT: _State.ACTIVE,
        _Trigger.REJECT: _State.REJECTED,
        _Trigger.CANCEL: _State.RECALLING,
    },
    _State.ACTIVE: {
        _Trigger.SUCCEED: _State.SUCCEEDED,
        _Trigger.ABORT: _State.ABORTED,
        _Trigger.CANCEL: _State.PREEMPTING,
    },
    _State.PREEMPTING: {
        _Trigger.CANCELED: _State.PREEMPTED,
        _Trigger.SUCCEED: _State.SUCCEEDED,
        _Trigger.ABORT: _State.ABORTED,
    },
    _State.RECALLING: {
        _Trigger.ACCEPT: _State.PREEMPTING,
        _Trigger.REJECT: _State.REJECTED,
        _Trigger.CANCELED: _State.RECALLED,
    },
    _State.PREEMPTED: {},
    _State.SUCCEEDED: {},
    _State.ABORTED: {},
    _State.REJECTED: {},
    _State.RECALLED: {},
}

TERMINAL: Final = frozenset(state for state, row in GOAL.items() if not row)
