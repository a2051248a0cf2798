"""One thing that the master shall know of a node, and how far that is."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from crosnode.transport.transitions import Transitions, next_state

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.xmlrpc import Value


class RegistrationState(Enum):
    """Where a registration stands."""

    NEW = auto()
    """To be made; no master knows of it."""
    CALLING = auto()
    REGISTERED = auto()
    REFUSED = auto()
    AGAIN = auto()
    """To be made again; a master may know it, though it was lost."""
    STALE = auto()
    """No longer wanted, but a master may know it: taken back when it is found again."""
    LEAVING = auto()
    GONE = auto()


class RegistrationTrigger(Enum):
    """What happens to a registration."""

    CALLED = "the master is told"
    TAKEN = "the master took it"
    REFUSED = "the master refused it"
    UNANSWERED = "the master did not answer"
    FORGOTTEN = "the master was lost, or knows the node no more"
    REMOVED = "the program takes it back"
    LET_GO = "the master let it go"
    GIVEN_UP = "the node ends and waits for no master"
    RETURNED = "the node has returned"


_State = RegistrationState
_Trigger = RegistrationTrigger

REGISTRATION: Final[Transitions[RegistrationState, RegistrationTrigger]] = {
    _State.NEW: {_Trigger.CALLED: _State.CALLING, _Trigger.REMOVED: _State.GONE},
    _State.CALLING: {
        _Trigger.TAKEN: _State.REGISTERED,
        _Trigger.REFUSED: _State.REFUSED,
        _Trigger.UNANSWERED: _State.AGAIN,
        _Trigger.REMOVED: _State.LEAVING,
    },
    _State.REGISTERED: {_Trigger.FORGOTTEN: _State.AGAIN, _Trigger.REMOVED: _State.LEAVING},
    _State.REFUSED: {_Trigger.FORGOTTEN: _State.AGAIN, _Trigger.REMOVED: _State.GONE},
    _State.AGAIN: {_Trigger.CALLED: _State.CALLING, _Trigger.REMOVED: _State.STALE},
    _State.STALE: {_Trigger.CALLED: _State.LEAVING, _Trigger.GIVEN_UP: _State.GONE},
    _State.LEAVING: {
        _Trigger.LET_GO: _State.GONE,
        _Trigger.UNANSWERED: _State.STALE,
        _Trigger.GIVEN_UP: _State.GONE,
    },
    _State.GONE: {_Trigger.RETURNED: _State.NEW},
}


@dataclass(slots=True, eq=False)
class Registration:
    """One thing the master shall know.

    Attributes:
        name: topic, service or parameter, resolved.
        register: method and parameters behind the caller's name.
        unregister: the same for taking it back.
        on_value: called with the value of the master's answer.
        state: where it stands.
        is_late: registered after the others, where many are.
        is_hopeless: refused because the master's answer is beyond the limits, as it would be again.
    """

    name: str
    register: tuple[str, list[Value]]
    unregister: tuple[str, list[Value]]
    on_value: Callable[[Value], None] | None = None
    state: RegistrationState = field(default=RegistrationState.NEW)
    is_late: bool = False
    is_hopeless: bool = False

    @property
    def is_settled(self) -> bool:
        """Whether the master has taken or refused it."""
        return self.state in (_State.REGISTERED, _State.REFUSED)

    @property
    def is_wanted(self) -> bool:
        """Whether it was not taken back."""
        return self.state not in (_State.STALE, _State.LEAVING, _State.GONE)

    def renew(self) -> None:
        """Be made once more; one that no master ever heard of is new as it is."""
        if self.state is not _State.NEW:
            self.move(_Trigger.RETURNED)

    def move(self, trigger: RegistrationTrigger) -> RegistrationState:
        """Go where the table says; return the state that follows."""
        self.state = next_state(REGISTRATION, self.state, trigger, f"registration of {self.name}")
        return self.state
