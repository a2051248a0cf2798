"""The node's side of the master: what shall be registered is kept so, whatever the master does.

Every registration is wanted until it is removed. When the connection to the master is lost, or the
master does not know the node any more (it is asked once a second), all are made again; so a master
that was started again finds everything, parameter subscriptions included, whatever its pid.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from crosnode.node.registration import Registration, RegistrationState, RegistrationTrigger
from crosnode.node.status import Status, StatusKind
from crosnode.transport.transitions import Transitions, next_state
from crosnode.xmlrpc.api_caller import ApiCall, ApiCaller, CallState
from plcsim.core.backoff import Backoff

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.node.queues import DropOldestQueue
    from crosnode.xmlrpc import Value

PING_NS: Final = 1_000_000_000
FIRST_RETRY_NS: Final = 20_000_000
LONGEST_RETRY_NS: Final = 1_000_000_000
LATE_NS: Final = 20_000_000
"""Nanoseconds that what is late waits behind the other registrations, for the connections that come
of them need the steps."""


class MasterState(Enum):
    """What the node knows of its master."""

    SEARCHED = auto()
    """It was not there yet, and nobody was told so."""
    FOUND = auto()
    MISSED = auto()


class MasterTrigger(Enum):
    """What a call of the master comes to."""

    ANSWERED = "it answers"
    UNREACHABLE = "it cannot be reached, or the connection to it ends"


MASTER: Final[Transitions[MasterState, MasterTrigger]] = {
    MasterState.SEARCHED: {
        MasterTrigger.ANSWERED: MasterState.FOUND,
        MasterTrigger.UNREACHABLE: MasterState.MISSED,
    },
    MasterState.FOUND: {
        MasterTrigger.ANSWERED: MasterState.FOUND,
        MasterTrigger.UNREACHABLE: MasterState.MISSED,
    },
    MasterState.MISSED: {
        MasterTrigger.ANSWERED: MasterState.FOUND,
        MasterTrigger.UNREACHABLE: MasterState.MISSED,
    },
}

_WAITING: Final = (RegistrationState.NEW, RegistrationState.AGAIN, RegistrationState.STALE)

_NEWS: Final = {
    MasterState.FOUND: StatusKind.MASTER_FOUND,
    MasterState.MISSED: StatusKind.MASTER_LOST,
}


class MasterClient:
    """Registers with the master and sends it calls.

    Args:
        caller: makes the calls.
        uri: of the master.
        name: of the node, resolved.
        node_uri: of the node's slave API.
        statuses: where news goes.

    Attributes:
        uri: of the master.
        state: what the node knows of it.
        life: counts the masters that were lost or forgot the node: the next one may not know what
            the one before it has told.
    """

    def __init__(
        self,
        caller: ApiCaller,
        uri: str,
        name: str,
        node_uri: str,
        statuses: DropOldestQueue[Status],
    ) -> None:
        self.uri = uri
        self.state = MasterState.SEARCHED
        self.life = 0
        self._caller = caller
        self._name = name
        self._node_uri = node_uri
        self._statuses = statuses
        self._registrations: list[Registration] = []
        self._now_ns = 0
        self._backoff = Backoff(FIRST_RETRY_NS, LONGEST_RETRY_NS)
        self._losses = 0
        self._ping: ApiCall | None = None
        self._ping_ns = 0
        self._is_dirty = False
        self._late_ns = 0
        self._is_closing = False
        self._resting: list[Registration] = []

    @property
    def is_found(self) -> bool:
        """Whether the master answered, and the connection to it is there."""
        return self.state is MasterState.FOUND

    @property
    def is_calm(self) -> bool:
        """Whether the master was found, and what is late need not wait."""
        return self.is_found and self._now_ns >= self._late_ns

    @property
    def is_clean(self) -> bool:
        """Whether nothing is registered, or about to be."""
        return not self._registrations

    @property
    def is_registered(self) -> bool:
        """Whether the master has taken all registrations, those that rest included."""
        return not self._resting and all(
            registration.is_settled for registration in self._registrations
        )

    def add(self, registration: Registration) -> None:
        """Register from now on, or when the node has returned."""
        if self._is_closing:
            self._resting.append(registration)
        else:
            self._registrations.append(registration)
            self._is_dirty = True

    def remove(self, registration: Registration) -> None:
        """Take a registration back, now or when the master is found again."""
        if registration in self._resting:
            self._resting.remove(registration)
        elif registration.is_wanted:
            self._move(registration, RegistrationTrigger.REMOVED)

    def take_back_all(self, *, for_good: bool) -> None:
        """Take all registrations back; a master that is away is not waited for.

        Args:
            for_good: False where ``give_again`` shall make them again.
        """
        self._is_closing = True
        self._resting = [] if for_good else [r for r in self._registrations if r.is_wanted]
        for registration in list(self._registrations):
            if registration.is_wanted:
                self._move(registration, RegistrationTrigger.REMOVED)
            if registration.state is RegistrationState.STALE:
                self._move(registration, RegistrationTrigger.GIVEN_UP)

    def give_up(self) -> None:
        """Wait no longer for the master to let registrations go."""
        for registration in list(self._registrations):
            self._move(registration, RegistrationTrigger.GIVEN_UP)

    def give_again(self) -> None:
        """Make the registrations again that were taken back, not for good."""
        self._is_closing, again = False, self._resting
        self._resting = []
        for registration in again:
            registration.renew()
            self.add(registration)

    def call(
        self, method: str, params: list[Value], on_end: Callable[[ApiCall], None] | None = None
    ) -> ApiCall:
        """Call a method of the master; the caller's name goes before ``params``."""
        return self._caller.start(
            ApiCall(self.uri, method, [self._name, *params], on_end), keep=True
        )

    def step(self, now_ns: int) -> None:
        """Send what is due."""
        self._now_ns = now_ns
        losses, self._losses = self._losses, self._caller.losses(self.uri)
        if self.is_found and losses != self._losses:  # the next master may be there already
            self._unreachable("the connection was closed")
        if not self._backoff.is_due(now_ns):
            return
        if self._is_dirty:
            self._tell_master()
        elif now_ns >= self._ping_ns and self._ping is None and self._registrations:
            self._ping = self.call("lookupNode", [self._name], self._pinged)

    def _tell_master(self) -> None:
        """Make the calls of the registrations that wait for theirs; what is late waits longer."""
        waiting = [each for each in self._registrations if each.state in _WAITING]
        early = [each for each in waiting if not each.is_late]
        is_early_under_way = any(
            not each.is_late and each.state is RegistrationState.CALLING
            for each in self._registrations
        )
        if early or is_early_under_way:
            self._late_ns = self._now_ns + LATE_NS
        self._is_dirty = False
        if self._now_ns < self._late_ns:
            self._is_dirty = len(early) < len(waiting)
            waiting = early
        for registration in waiting:
            self._move(registration, RegistrationTrigger.CALLED)

    def _move(self, registration: Registration, trigger: RegistrationTrigger) -> None:
        """Let something happen to a registration, and do what the state that follows asks for."""
        state = registration.move(trigger)
        if state is RegistrationState.CALLING:
            self.call(*registration.register, lambda call: self._registered(registration, call))
        elif state is RegistrationState.LEAVING:
            self.call(*registration.unregister, lambda call: self._unregistered(registration, call))
        elif state is RegistrationState.GONE:
            self._registrations.remove(registration)
            self._tell(StatusKind.UNREGISTERED, registration.name, registration.unregister[0])
        elif state in (RegistrationState.AGAIN, RegistrationState.STALE):
            self._is_dirty = True

    def _registered(self, registration: Registration, call: ApiCall) -> None:
        if registration.state is not RegistrationState.CALLING:
            return  # taken back meanwhile
        if not call.was_answered:
            self._move(registration, RegistrationTrigger.UNANSWERED)
            self._unreachable(call.error)
            return
        self._answered()
        if call.state is CallState.FAILED:
            self._move(registration, RegistrationTrigger.REFUSED)
            registration.is_hopeless = call.is_unreadable
            self._tell(StatusKind.REGISTRATION_REFUSED, registration.name, call.error)
            return
        self._move(registration, RegistrationTrigger.TAKEN)
        self._tell(StatusKind.REGISTERED, registration.name, call.method)
        if registration.on_value:
            registration.on_value(call.value)

    def _unregistered(self, registration: Registration, call: ApiCall) -> None:
        if registration.state is not RegistrationState.LEAVING:
            return  # given up meanwhile
        if call.was_answered:
            self._move(registration, RegistrationTrigger.LET_GO)
        elif self._is_closing:
            self._move(registration, RegistrationTrigger.GIVEN_UP)
        else:
            self._move(registration, RegistrationTrigger.UNANSWERED)
            self._unreachable(call.error)

    def _pinged(self, call: ApiCall) -> None:
        self._ping = None
        self._ping_ns = self._now_ns + PING_NS
        if not call.was_answered:
            self._unreachable(call.error)
            return
        self._answered()
        if call.state is CallState.FAILED:  # it does not know the node
            self.life += 1
            self._register_again()
        elif call.value != self._node_uri:
            self._tell(StatusKind.NAME_TAKEN, self._name, str(call.value))

    def _answered(self) -> None:
        self._backoff.succeeded()
        if self._enter(MasterTrigger.ANSWERED, ""):
            self._ping_ns = self._now_ns + PING_NS

    def _unreachable(self, reason: str) -> None:
        """Wait a little longer each time before the master is tried again."""
        self._register_again()
        if not self.is_found and not self._backoff.is_due(self._now_ns):
            return  # another call of the same attempt failed
        self.life += self.is_found
        self._enter(MasterTrigger.UNREACHABLE, reason)
        self._backoff.failed(self._now_ns)

    def _enter(self, trigger: MasterTrigger, reason: str) -> bool:
        """Go where the table says, and tell the program; return whether the state is another."""
        before, self.state = self.state, next_state(MASTER, self.state, trigger, "master")
        if self.state is not before:
            self._tell(_NEWS[self.state], self.uri, reason)
        return self.state is not before

    def _register_again(self) -> None:
        self._is_dirty = True
        for registration in self._registrations:
            if registration.is_settled and not registration.is_hopeless:
                self._move(registration, RegistrationTrigger.FORGOTTEN)

    def _tell(self, kind: StatusKind, name: str, text: str = "") -> None:
        self._statuses.push(Status(kind, name, text))
