"""Service callers: requests wait in a queue, replies in another; the program waits for none."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from crosnode.errors import DecodeError, HostPendingError, InvalidNameError
from crosnode.node.period import Period
from crosnode.node.queues import DropOldestQueue
from crosnode.tcpros import (
    HeaderReceived,
    Refused,
    ReplyReceived,
    ServiceClientConnection,
    TypeInfo,
)
from crosnode.transport.connection import ConnectionState, Failed
from crosnode.xmlrpc.api_caller import ApiCall, CallState

if TYPE_CHECKING:
    from crosnode.messages import Message, ServiceType
    from crosnode.node.core import NodeCore
    from crosnode.transport.budget import StepBudget
    from crosnode.transport.connection import ConnectionEvent
    from crosnode.transport.link import PeerLink
    from plcsim.network import Address


class ServiceReply(NamedTuple):
    """What came of a call.

    Attributes:
        response: the message, None where the call went wrong.
        error: why, as the provider or the node says.
    """

    response: Message | None
    error: str = ""


class ServiceCaller:
    """A service that a node calls; made by ``CrosNode.register_service_caller``.

    Calls are made one after another. Each finds the provider anew, unless the caller is persistent
    and still connected.

    Attributes:
        service: resolved name.
        service_type: its type.
        persistent: whether the connection is kept for the next call.
        requests: calls that wait; for one too many the oldest fails, in its turn.
        replies: what came of the calls, in order of the calls.
    """

    def __init__(
        self,
        service: str,
        service_type: ServiceType,
        core: NodeCore,
        *,
        persistent: bool,
        queue_size: int,
        loop_period_ns: int,
    ) -> None:
        self.service = service
        self.service_type = service_type
        self.persistent = persistent
        self.requests: DropOldestQueue[bytes | memoryview] = DropOldestQueue(queue_size)
        self.replies: DropOldestQueue[ServiceReply] = DropOldestQueue(queue_size)
        self._core = core
        self._period = Period(loop_period_ns)
        self._packets: DropOldestQueue[Message] = DropOldestQueue(1)
        self._running: bytes | memoryview | None = None
        self._overrun = 0
        self._lookup: ApiCall | None = None
        self._address: Address | None = None
        self._link: PeerLink | None = None
        self._connection: ServiceClientConnection | None = None

    def new(self, **values: object) -> Message:
        """Return a new request with ``values``, defaults elsewhere."""
        return self.service_type.request.new(**values)

    def pop_packet(self) -> Message | None:
        """Return a new request to fill and call with, once a loop period; None in between."""
        return self._packets.pop()

    def call(self, request: Message) -> None:
        """Queue a call.

        Raises:
            MessageValueError: a field cannot hold its value; nothing is called.
        """
        dropped = self.requests.dropped
        self.requests.push(self.service_type.request.encode(request))
        self._overrun += self.requests.dropped - dropped
        if self._running is None:
            self._fail_dropped()
            self._start()

    def _start(self) -> None:
        """Send a request in this cycle, where the connection to the provider was kept."""
        if self._link and self._is_ready:
            self._running = self.requests.pop()
            assert self._running is not None
            self._request(self._running, self._core.now_ns)
            self._core.flush(self._link)

    def pop(self) -> ServiceReply | None:
        """Return the oldest reply, None where there is none yet."""
        return self.replies.pop()

    @property
    def is_idle(self) -> bool:
        """Whether no call waits or runs."""
        return self._running is None and not self.requests

    @property
    def _is_ready(self) -> bool:
        """Whether a call may begin: a connection that is about to end cannot carry it."""
        return self._connection is None or self._connection.state is ConnectionState.IDLE

    def step(self, now_ns: int, budget: StepBudget) -> None:
        """Go on with the running call, or take the next."""
        if self._period.is_due(now_ns):
            self._packets.push(self.new())
        if self._running is None and self._is_ready:
            self._running = self.requests.pop()
        if self._running is None:
            return
        if self._link is not None:
            self._request(self._running, now_ns)
        elif self._address is not None:
            self._connect(self._address, now_ns, budget)
        elif self._lookup is None:
            self._lookup = self._core.master.call("lookupService", [self.service])
        elif self._lookup.state is not CallState.WAITING:
            self._found(self._lookup)

    def close(self) -> None:
        """End the connection and forget all calls."""
        self.requests.release()
        self._running = None
        self._overrun = 0
        if self._link:
            self._link.close("the caller was released")

    def _found(self, lookup: ApiCall) -> None:
        if lookup.state is CallState.FAILED:
            self._lookup = None
            self._fail(f"no provider of {self.service}: {lookup.error}")
            return
        try:
            self._address = self._core.hosts.address(str(lookup.value), "rosrpc")
        except HostPendingError:
            return  # asked again in the next step
        except InvalidNameError as error:
            self._fail(str(error))
        self._lookup = None

    def _connect(self, address: Address, now_ns: int, budget: StepBudget) -> None:
        if not budget.start_call():
            return
        self._address = None
        self._connection = ServiceClientConnection(
            self.service,
            TypeInfo(self.service_type.name, self.service_type.md5sum),
            self._core.name,
            persistent=self.persistent,
            limits=self._core.tcpros_limits,
            now_ns=now_ns,
        )
        self._link = self._core.loop.connect(address, self._connection, self, now_ns)

    def _request(self, body: bytes | memoryview, now_ns: int) -> None:
        if self._connection and self._connection.state is ConnectionState.IDLE:
            self._connection.send_request(body, now_ns)

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Take the header, then the reply."""
        if isinstance(event, HeaderReceived) and self._running is not None:
            self._request(self._running, now_ns)
        elif isinstance(event, ReplyReceived):
            self._reply(link, event)
        elif isinstance(event, Refused):
            self._fail(event.error)
        elif isinstance(event, Failed):
            self._fail(event.reason)

    def _reply(self, link: PeerLink, event: ReplyReceived) -> None:
        if not event.ok:
            self._fail(bytes(event.body).decode(errors="replace") or "the provider failed")
            return
        try:
            response = self.service_type.response.decode(event.body)
        except DecodeError as error:
            self._fail(str(error))
            link.close(str(error))
            return
        self._end(ServiceReply(response))

    def _fail(self, error: str) -> None:
        if self._running is not None:
            self._end(ServiceReply(None, error))

    def _end(self, reply: ServiceReply) -> None:
        self._running = None
        self.replies.push(reply)
        self._fail_dropped()

    def _fail_dropped(self) -> None:
        """Tell of the calls dropped since the running one began: it was made before them."""
        for _ in range(self._overrun):
            self.replies.push(ServiceReply(None, "too many calls wait"))
        self._overrun = 0

    def expects_data(self, link: PeerLink) -> bool:
        """Whether a call waits for its header or its reply."""
        return self._running is not None

    def fill(self, link: PeerLink) -> None:
        """Requests go to the connection one by one."""

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """Fail the call that was under way."""
        self._link = self._connection = None
        self._fail(reason or "the provider closed the connection")
