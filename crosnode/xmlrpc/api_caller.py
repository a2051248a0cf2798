"""Calls of the master and slave APIs: queued, in order for each node, never waited for."""

from __future__ import annotations

from collections import deque
from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from crosnode.errors import HostPendingError, InvalidNameError, MessageValueError
from crosnode.transport.budget import ALONE_WORK, CALL_WORK, TRANSFER_WORK
from crosnode.transport.connection import ConnectionState, Silent
from crosnode.transport.link import LinkState
from crosnode.xmlrpc import (
    FaultReceived,
    LastUse,
    ResponseReceived,
    Unreadable,
    Value,
    XmlRpcClientConnection,
    XmlRpcLimits,
)
from plcsim.core.backoff import Backoff

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from crosnode.graph.hosts import HostTable
    from crosnode.transport.budget import StepBudget
    from crosnode.transport.connection import ConnectionEvent
    from crosnode.transport.event_loop import EventLoop
    from crosnode.transport.link import PeerLink

MAX_WAITING: Final = 1000
"""Calls that wait for one node; the oldest one fails for the next."""

SUCCESS: Final = 1

FIRST_RETRY_NS: Final = 500_000_000
LONGEST_RETRY_NS: Final = 8_000_000_000
"""Nanoseconds between two attempts to reach a node that patience is had with."""


class CallState(Enum):
    """How far a call is."""

    WAITING = auto()
    DONE = auto()
    FAILED = auto()


class ApiCall:
    """A call, and its result when it is there.

    Attributes:
        uri: of the node or master.
        method: of its API.
        params: as they go on the wire.
        patience_ns: nanoseconds that it waits for a node which cannot be reached.
        state: WAITING, DONE or FAILED.
        value: the value of the answer once DONE.
        error: why it failed once FAILED.
        was_answered: False where the node could not be reached.
        is_unreadable: the answer was no document, or one beyond the limits: asked again it would be
            the same.
        reply: the answer as it came, code and message included.
    """

    __slots__ = ("error", "is_unreadable", "method", "on_end", "params", "patience_ns", "reply",
                 "state", "uri", "value", "was_answered")  # fmt: skip

    def __init__(
        self,
        uri: str,
        method: str,
        params: Sequence[Value],
        on_end: Callable[[ApiCall], None] | None = None,
        *,
        patience_ns: int = 0,
    ) -> None:
        self.uri = uri
        self.patience_ns = patience_ns
        self.method = method
        self.params = list(params)
        self.on_end = on_end
        self.state = CallState.WAITING
        self.value: Value = None
        self.reply: Value = None
        self.error = ""
        self.was_answered = False
        self.is_unreadable = False

    def __repr__(self) -> str:
        return f"ApiCall({self.method} {self.params} {self.state.name} {self.error or self.value})"

    def answer(self, value: Value) -> None:
        """Take the answer ``[code, message, value]``; another form is the value itself."""
        self.was_answered = True
        self.reply = value
        if not isinstance(value, list) or len(value) != 3 or type(value[0]) is not int:
            self._end(CallState.DONE, value)
        elif value[0] == SUCCESS:
            self._end(CallState.DONE, value[2])
        else:
            self.error = str(value[1])
            self._end(CallState.FAILED, value[2])

    def fail(self, error: str, *, was_answered: bool = False) -> None:
        """End the call without a value."""
        self.error = error
        self.was_answered = was_answered
        self._end(CallState.FAILED, None)

    def _end(self, state: CallState, value: Value) -> None:
        self.state, self.value = state, value
        if self.on_end:
            self.on_end(self)


class ApiCaller:
    """All calls that a node or a master makes.

    Args:
        loop: whose connections are used.
        hosts: finds the hosts in URIs.
        limits: of each connection.
    """

    def __init__(self, loop: EventLoop, hosts: HostTable, limits: XmlRpcLimits) -> None:
        self._loop = loop
        self._hosts = hosts
        self._limits = limits
        self._last_use = LastUse()
        self._last_call = LastUse()
        self._channels: dict[str, _Channel] = {}
        self._is_first = False
        self._turn = 0

    @property
    def is_idle(self) -> bool:
        """Whether no call waits for its answer."""
        return not any(channel.calls for channel in self._channels.values())

    def is_connected(self, uri: str) -> bool:
        """Whether there is a connection to a node now."""
        channel = self._channels.get(uri)
        return channel is not None and channel.link is not None

    def losses(self, uri: str) -> int:
        """Return how often a connection to a node was lost that was to be kept."""
        channel = self._channels.get(uri)
        return channel.losses if channel else 0

    def start(self, call: ApiCall, *, keep: bool = False) -> ApiCall:
        """Queue a call; ``keep`` leaves the connection open for the next one."""
        channel = self._channel(call.uri)
        channel.keep = channel.keep or keep
        channel.calls.append(call)
        if len(channel.calls) > MAX_WAITING:
            index = 1 if channel.is_calling else 0
            oldest = channel.calls[index]
            del channel.calls[index]
            oldest.fail("too many calls wait for this node")
        return call

    def _channel(self, uri: str) -> _Channel:
        if uri not in self._channels:
            self._channels[uri] = _Channel(self._last_call)
        return self._channels[uri]

    def open(self, uri: str, now_ns: int, budget: StepBudget) -> None:
        """Begin a connection for calls to a node before there are any, in INIT."""
        channel = self._channel(uri)
        channel.keep = True
        self._connect(uri, channel, now_ns, budget)

    def settle(self, now_ns: int) -> None:
        """In the first step, end what ``open`` began and is not there yet: calls connect anew."""
        for channel in self._channels.values():
            link, channel.link = channel.link, None
            if link is not None and link.is_there(now_ns):
                channel.link = link
            elif link is not None:
                channel.connection = None
                link.abort("", now_ns)

    def give_up(self, reason: str) -> None:
        """Fail all calls, for nobody will make them."""
        for channel in list(self._channels.values()):
            channel.fail_all(reason)

    def step_first(self, now_ns: int, budget: StepBudget) -> None:
        """Go before the connections in every other step, so that these cannot use up all of it."""
        self._is_first = not self._is_first
        if self._is_first:
            self.step(now_ns, budget)

    def step(self, now_ns: int, budget: StepBudget) -> None:
        """Make connections for waiting calls, and send the next call of each, in turn."""
        channels = list(self._channels.items())
        self._turn = (self._turn + 1) % max(1, len(channels))
        for uri, channel in channels[self._turn :] + channels[: self._turn]:
            if channel.calls and channel.link is None and channel.is_due(now_ns):
                self._connect(uri, channel, now_ns, budget)
            elif not channel.calls and channel.link is None and not channel.keep:
                del self._channels[uri]
            if channel.link is not None:
                channel.advance(now_ns, budget)

    def _connect(self, uri: str, channel: _Channel, now_ns: int, budget: StepBudget) -> None:
        try:
            address = self._hosts.address(uri, "http")
        except HostPendingError:
            return  # asked again in the next step
        except InvalidNameError as error:
            channel.fail_all(str(error))
            return
        if not budget.start_call():
            return
        connection = XmlRpcClientConnection(
            f"{address.ip}:{address.port}", self._limits, now_ns, self._last_use
        )
        channel.begin(self._loop.connect(address, connection, channel, now_ns), connection)


class _Channel:
    """The calls to one node; the first one may be running. Owner of the link to it.

    Args:
        last_call: when the node called any other one last.

    Attributes:
        calls: those that wait, the running one first.
        link: to the node, None while there is none.
        connection: of the link.
        keep: whether the connection stays open for calls to come.
        is_calling: whether the first call was sent and has no answer yet.
        losses: connections that were to be kept, carried calls, and ended without a word of the
            node that it would end them.
    """

    def __init__(self, last_call: LastUse) -> None:
        self._last_call = last_call
        self._backoff = Backoff(FIRST_RETRY_NS, LONGEST_RETRY_NS)
        self._missed_ns: int | None = None  # since then it cannot be reached
        self.calls: deque[ApiCall] = deque()
        self.link: PeerLink | None = None
        self.connection: XmlRpcClientConnection | None = None
        self.keep = False
        self.is_calling = False
        self.losses = 0
        self._is_used = False

    def is_due(self, now_ns: int) -> bool:
        """Whether it is time to connect: at once, but for a node that was not reached."""
        return self._backoff.is_due(now_ns)

    def begin(self, link: PeerLink, connection: XmlRpcClientConnection) -> None:
        """Use a connection that was begun."""
        self.link, self.connection = link, connection
        self.is_calling = self._is_used = False

    def advance(self, now_ns: int, budget: StepBudget) -> None:
        """Send the next call, or close a connection that is needed no more."""
        connection = self.connection
        if connection is None or connection.state is not ConnectionState.IDLE:
            return
        if self.link and self.link.state is LinkState.CONNECTING:
            return
        if not self.calls:
            if not self.keep and self.link:
                self.link.close()
                self.link = self.connection = None  # a later call makes another
            return
        price = ALONE_WORK if self._last_call.is_long_ago(now_ns) else CALL_WORK
        if not budget.affords(price):
            return
        self._last_call.note(now_ns)
        budget.work -= price
        try:
            connection.call(self.calls[0].method, self.calls[0].params, now_ns)
        except MessageValueError as error:
            self.calls.popleft().fail(str(error), was_answered=True)
        else:
            self.is_calling = self._is_used = True
            self._be_patient_anew()
            if self.link and budget.work >= TRANSFER_WORK:  # it leaves in this step
                self.link.flush(now_ns, budget)

    def _be_patient_anew(self) -> None:
        self._missed_ns = None
        self._backoff.succeeded()

    def fail_all(self, reason: str) -> None:
        """End all calls."""
        self.is_calling = False
        self._be_patient_anew()
        calls, self.calls = self.calls, deque()
        for call in calls:
            call.fail(reason)

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Take the answer to the running call; a node that gives none in time gives none to any."""
        if isinstance(event, ResponseReceived):
            self._take().answer(event.value)
        elif isinstance(event, FaultReceived):
            self._take().fail(event.text, was_answered=True)
        elif isinstance(event, Unreadable):
            call = self._take()
            call.is_unreadable = True
            call.fail(event.reason, was_answered=True)
        elif isinstance(event, Silent):
            self.fail_all(event.reason)

    def _take(self) -> ApiCall:
        """Take the running call out."""
        self.is_calling = False
        return self.calls.popleft()

    def expects_data(self, link: PeerLink) -> bool:
        """Whether a call waits for its answer."""
        return bool(self.calls)

    def fill(self, link: PeerLink) -> None:
        """Nothing waits beside the call that was sent."""

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """Fail the running call; those behind it are made by another connection.

        A node that cannot be reached, or ends a connection before it has carried a call, fails all
        that have no patience.
        """
        if link is not self.link:
            return
        is_told = self.connection is not None and self.connection.is_last_call
        self.losses += self.keep and self._is_used and not is_told
        self.link = self.connection = None
        reason = reason or "the connection was closed"
        if not self._is_used:
            self._not_reached(reason, now_ns)
        elif self.is_calling:
            self._take().fail(reason)

    def _not_reached(self, reason: str, now_ns: int) -> None:
        """Fail the calls that have no patience with the node, or had it for long enough."""
        if self._missed_ns is None:
            self._missed_ns = now_ns
        missed_ns, calls = now_ns - self._missed_ns, self.calls
        self.calls = deque(call for call in calls if missed_ns < call.patience_ns)
        if self.calls:
            self._backoff.failed(now_ns)
        else:
            self._be_patient_anew()
        for call in calls:
            if missed_ns >= call.patience_ns:
                call.fail(reason)
