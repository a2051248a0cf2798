"""The life of a node: from its start to its end, and back where it shall return."""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from crosnode.node.status import StatusKind
from crosnode.transport.transitions import Transitions, next_state
from plcsim.core.backoff import Backoff

if TYPE_CHECKING:
    from crosnode.node.core import NodeCore

CLOSING_NS: Final = 3_000_000_000
"""Nanoseconds that a node gives the master to take the registrations back, as in cROS."""

FIRST_RETURN_NS: Final = 1_000_000_000
LONGEST_RETURN_NS: Final = 60_000_000_000
"""Nanoseconds until an ended node returns; two nodes of one name end each other in turn."""

SETTLED_NS: Final = 60_000_000_000
"""Nanoseconds after which a node that returned counts as one that stays."""


class LifeState(Enum):
    """How far a node is."""

    RUNNING = auto()
    PARTING = auto()
    """Registrations are taken back; the node will return."""
    RESTING = auto()
    CLOSING = auto()
    """Registrations are taken back; the node will end."""
    ENDED = auto()


class LifeTrigger(Enum):
    """What happens to a node."""

    KILLED = "another node, the master or rosnode kill ends it, and respawn is set"
    CLOSED = "the program closes it, or it is killed and respawn is not set"
    CLEAN = "the master knows nothing of it, or does not answer"
    DUE = "its pause is over"


_State = LifeState
_Trigger = LifeTrigger

LIFE: Final[Transitions[LifeState, LifeTrigger]] = {
    _State.RUNNING: {_Trigger.KILLED: _State.PARTING, _Trigger.CLOSED: _State.CLOSING},
    _State.PARTING: {_Trigger.CLEAN: _State.RESTING, _Trigger.CLOSED: _State.CLOSING},
    _State.RESTING: {_Trigger.DUE: _State.RUNNING, _Trigger.CLOSED: _State.CLOSING},
    _State.CLOSING: {_Trigger.CLEAN: _State.ENDED},
    _State.ENDED: {},
}


class Life:
    """Ends a node, and brings it back.

    Args:
        core: of the node.
        respawns: whether a node that others end returns.

    Attributes:
        state: how far it is.
        kills: times that others ended it.
        reason: of the last of them.
    """

    def __init__(self, core: NodeCore, *, respawns: bool) -> None:
        self.state = LifeState.RUNNING
        self.kills = 0
        self.reason = ""
        self._core = core
        self._respawns = respawns
        self._backoff = Backoff(FIRST_RETURN_NS, LONGEST_RETURN_NS)
        self._since_ns = 0

    @property
    def is_over(self) -> bool:
        """Whether the node has ended, or will, for good."""
        return self.state in (LifeState.CLOSING, LifeState.ENDED)

    def kill(self, reason: str, now_ns: int) -> None:
        """End the node because others ask for it, and tell the program."""
        if self.state is not LifeState.RUNNING:
            return
        self.kills += 1
        self.reason = reason
        self._core.tell(StatusKind.SHUTDOWN, self._core.name, reason)
        self._begin(LifeTrigger.KILLED if self._respawns else LifeTrigger.CLOSED, now_ns)

    def close(self, now_ns: int) -> None:
        """End the node because its program asks for it."""
        if not self.is_over:
            self._begin(LifeTrigger.CLOSED, now_ns)

    def _begin(self, trigger: LifeTrigger, now_ns: int) -> None:
        if self.state is LifeState.RUNNING and now_ns - self._since_ns >= SETTLED_NS:
            self._backoff.succeeded()
        self._since_ns = now_ns
        self._move(trigger)
        self._core.master.take_back_all(for_good=self.is_over)

    def step(self, now_ns: int) -> None:
        """Go on to the end, or back from it."""
        if self.state is LifeState.RUNNING or self.state is LifeState.ENDED:
            return
        if self.state is not LifeState.RESTING:
            self._go_on_closing(now_ns)
        elif self._backoff.is_due(now_ns):
            self._move(LifeTrigger.DUE)
            self._since_ns = now_ns
            self._core.master.give_again()

    def _go_on_closing(self, now_ns: int) -> None:
        is_late = now_ns - self._since_ns >= CLOSING_NS
        if is_late or (self._core.master.is_clean and self._core.api.is_idle):
            self.finish(now_ns)

    def finish(self, now_ns: int) -> None:
        """End all connections now, and the ports where the node does not return."""
        if self.state is LifeState.ENDED:
            return
        self._move(LifeTrigger.CLEAN)
        if self.is_over:
            self._core.loop.close(now_ns)
            self._core.api.give_up("the node has ended")
            return
        self._core.master.give_up()
        self._core.loop.end_links(now_ns)
        self._backoff.failed(now_ns)

    def _move(self, trigger: LifeTrigger) -> None:
        self.state = next_state(LIFE, self.state, trigger, f"node {self._core.name}")
