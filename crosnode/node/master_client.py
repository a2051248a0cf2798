"""The node's side of the master: what shall be registered is kept so, whatever the master does.

Every registration is wanted until it is removed. When the connection to the master is lost, or the
master does not know the node any more (it is asked once a second), all are made again; so a master
that was started again finds everything, parameter subscriptions included, whatever its pid.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from crosnode.node.status import Status, StatusKind
from crosnode.xmlrpc.api_caller import ApiCall, ApiCaller, CallState

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.node.queues import DropOldestQueue
    from crosnode.xmlrpc import Value

PING_NS: Final = 1_000_000_000
FIRST_RETRY_NS: Final = 20_000_000
LONGEST_RETRY_NS: Final = 1_000_000_000
SETTLE_NS: Final = 5_000_000_000
"""Nanoseconds that other nodes have to register with a master that was started again."""


class Wish(Enum):
    """Where a registration stands."""

    PENDING = auto()
    CALLING = auto()
    REGISTERED = auto()
    REFUSED = auto()
    STALE = auto()
    """No longer wanted, but the master may know it: taken back when it is found again."""
    LEAVING = auto()
    GONE = auto()


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
        is_known: whether a master may know it.
    """

    name: str
    register: tuple[str, list[Value]]
    unregister: tuple[str, list[Value]]
    on_value: Callable[[Value], None] | None = None
    state: Wish = field(default=Wish.PENDING)
    is_late: bool = False
    is_known: bool = False


class MasterClient:
    """Registers with the master and sends it calls.

    Args:
        caller: makes the calls.
        uri: of the master.
        name: of the node, resolved.
        node_uri: of the node's slave API.
        statuses: where news goes.
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
        self.is_found = False
        self._caller = caller
        self._name = name
        self._node_uri = node_uri
        self._statuses = statuses
        self._registrations: list[Registration] = []
        self._now_ns = 0
        self._retry_ns = 0
        self._pause_ns = FIRST_RETRY_NS
        self._ping_ns = 0
        self._pinging = False
        self._is_dirty = False
        self._settled_ns: int | None = None
        self._was_lost = False
        self._is_missed = False
        self._is_closing = False

    @property
    def is_settling(self) -> bool:
        """Whether the master may not know again all that the one before it knew."""
        return self._settled_ns is not None and self._now_ns < self._settled_ns

    @property
    def is_clean(self) -> bool:
        """Whether nothing is registered, or about to be."""
        return not self._registrations

    @property
    def is_registered(self) -> bool:
        """Whether the master has taken all registrations."""
        return all(r.state in (Wish.REGISTERED, Wish.REFUSED) for r in self._registrations)

    def add(self, registration: Registration) -> None:
        """Register from now on."""
        self._registrations.append(registration)
        self._is_dirty = True

    def remove(self, registration: Registration) -> None:
        """Take a registration back, now or when the master is found again."""
        if registration.state in (Wish.STALE, Wish.LEAVING, Wish.GONE):
            return
        is_known = registration.state is Wish.REGISTERED and self.is_found
        if is_known or registration.state is Wish.CALLING:
            self._unregister(registration)
        elif self._may_be_known(registration):
            registration.state = Wish.STALE
        else:
            self._gone(registration)

    def _may_be_known(self, registration: Registration) -> bool:
        is_pending = registration.state is Wish.PENDING
        return is_pending and registration.is_known and not self._is_closing

    def remove_all(self) -> None:
        """Take all registrations back; a master that is away is not waited for."""
        self._is_closing = True
        for registration in list(self._registrations):
            if registration.state is Wish.STALE:
                self._gone(registration)
            else:
                self.remove(registration)

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
        if self.is_found and not self._caller.is_connected(self.uri):
            self._lost("the connection was closed")
        if now_ns < self._retry_ns:
            return
        if self._is_dirty:
            self._is_dirty = False
            for registration in sorted(self._registrations, key=lambda each: each.is_late):
                if registration.state is Wish.PENDING:
                    self._register(registration)
                elif registration.state is Wish.STALE:
                    self._unregister(registration)
        elif now_ns >= self._ping_ns and not self._pinging and self._registrations:
            self._pinging = True
            self.call("lookupNode", [self._name], self._pinged)

    def _register(self, registration: Registration) -> None:
        registration.state = Wish.CALLING
        registration.is_known = True
        method, params = registration.register
        self.call(method, params, lambda call: self._registered(registration, call))

    def _registered(self, registration: Registration, call: ApiCall) -> None:
        if registration.state is not Wish.CALLING:
            return
        if not call.was_answered:
            registration.state = Wish.PENDING
            self._lost(call.error)
            return
        self._found()
        if call.state is CallState.FAILED:
            registration.state = Wish.REFUSED
            self._tell(StatusKind.REGISTRATION_REFUSED, registration.name, call.error)
            return
        registration.state = Wish.REGISTERED
        self._tell(StatusKind.REGISTERED, registration.name, call.method)
        if registration.on_value:
            registration.on_value(call.value)

    def _unregister(self, registration: Registration) -> None:
        registration.state = Wish.LEAVING
        method, params = registration.unregister
        self.call(method, params, lambda call: self._unregistered(registration, call))

    def _unregistered(self, registration: Registration, call: ApiCall) -> None:
        if call.was_answered or self._is_closing:
            self._gone(registration)
            return
        registration.state = Wish.STALE
        self._lost(call.error)

    def _gone(self, registration: Registration) -> None:
        registration.state = Wish.GONE
        self._registrations.remove(registration)
        self._tell(StatusKind.UNREGISTERED, registration.name, registration.unregister[0])

    def _pinged(self, call: ApiCall) -> None:
        self._pinging = False
        self._ping_ns = self._now_ns + PING_NS
        if not call.was_answered:
            self._lost(call.error)
        elif call.state is CallState.FAILED:
            self._found()
            self._settled_ns = self._now_ns + SETTLE_NS
            self._register_again()
        else:
            self._found()
            if call.value != self._node_uri:
                self._tell(StatusKind.NAME_TAKEN, self._name, str(call.value))

    def _found(self) -> None:
        self._pause_ns = FIRST_RETRY_NS
        if not self.is_found:
            self.is_found = True
            self._is_missed = False
            if self._was_lost:
                self._settled_ns = self._now_ns + SETTLE_NS
            self._ping_ns = self._now_ns + PING_NS
            self._tell(StatusKind.MASTER_FOUND, self.uri)

    def _lost(self, reason: str) -> None:
        """Wait a little longer each time before the master is tried again."""
        self._register_again()
        if self.is_found:
            self._was_lost = True
            self._tell(StatusKind.MASTER_LOST, self.uri, reason)
        elif self._now_ns < self._retry_ns:
            return  # another call of the same attempt failed
        elif not self._is_missed:
            self._tell(StatusKind.MASTER_LOST, self.uri, reason)
        self._is_missed = True
        self.is_found = False
        self._retry_ns = self._now_ns + self._pause_ns
        self._pause_ns = min(2 * self._pause_ns, LONGEST_RETRY_NS)

    def _register_again(self) -> None:
        self._is_dirty = True
        for registration in self._registrations:
            if registration.state in (Wish.REGISTERED, Wish.REFUSED):
                registration.state = Wish.PENDING

    def _tell(self, kind: StatusKind, name: str, text: str = "") -> None:
        self._statuses.push(Status(kind, name, text))
