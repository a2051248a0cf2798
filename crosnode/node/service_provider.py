"""Service providers: requests wait in a queue, and the program answers each when it likes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from crosnode.errors import DecodeError
from crosnode.node.queues import DropOldestQueue
from crosnode.node.status import StatusKind
from crosnode.tcpros import (
    HeaderReceived,
    RequestReceived,
    ServiceServerConnection,
    TypeInfo,
)
from crosnode.transport.connection import ConnectionState, Failed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from crosnode.messages import Message, MessageType, ServiceType
    from crosnode.node.core import NodeCore, NodeView
    from crosnode.node.registration import Registration
    from crosnode.transport.connection import ConnectionEvent
    from crosnode.transport.event_loop import Accepted
    from crosnode.transport.link import PeerLink


class ServiceRequest:
    """A request that waits for its answer; answering one whose caller has gone does nothing.

    Attributes:
        request: the message.
        caller: name of the calling node.
        is_open: whether an answer still goes to it.
    """

    def __init__(self, request: Message, caller: str, owner: CallerLink) -> None:
        self.request = request
        self.caller = caller
        self._owner = owner
        self._is_open = True

    @property
    def is_open(self) -> bool:
        """Whether it was not answered and its caller is still there."""
        return self._is_open and self._owner.connection.state is ConnectionState.REPLY

    @property
    def response_type(self) -> MessageType:
        """Type of its response."""
        return self._owner.response_type

    def respond(self, **values: object) -> None:
        """Answer with a response of ``values``, defaults elsewhere.

        Raises:
            MessageValueError: a field cannot hold its value; the request is still to be answered.
        """
        response = self._owner.response_type
        self.respond_with(response.new(**values))

    def respond_with(self, response: Message) -> None:
        """Answer with a response; raises as ``respond`` does."""
        body = self._owner.response_type.encode(response)
        if self._take():
            self._owner.connection.send_response(body)
            self._owner.flush()

    def fail(self, reason: str) -> None:
        """Answer that the call went wrong, and why."""
        if self._take():
            self._owner.connection.send_error(reason)
            self._owner.flush()

    def _take(self) -> bool:
        is_open, self._is_open = self._is_open, False
        return is_open and self._owner.connection.state is ConnectionState.REPLY


class ServiceProvider:
    """A service of a node; made by ``CrosNode.register_service_provider``.

    Attributes:
        service: resolved name.
        service_type: its type.
        requests: requests so far.
        bytes_in: bytes of requests so far.
        queue_size: requests that may wait for the program; further ones are refused.
        registration: with the master.
    """

    def __init__(
        self,
        service: str,
        service_type: ServiceType,
        registration: Registration,
        *,
        queue_size: int,
    ) -> None:
        self.service = service
        self.service_type = service_type
        self.registration = registration
        self.queue_size = queue_size
        self.requests = 0
        self.bytes_in = 0
        self._queue: DropOldestQueue[ServiceRequest] = DropOldestQueue(queue_size)

    def pop(self) -> ServiceRequest | None:
        """Return the oldest request, None where there is none."""
        return self._queue.pop()

    def push(self, request: ServiceRequest) -> None:
        """Let a request wait for the program, or refuse it where too many do."""
        self.requests += 1
        if len(self._queue) == self.queue_size:
            request.fail("too many requests wait")
        else:
            self._queue.push(request)

    def type_info(self) -> TypeInfo:
        """Return what the header says of the type."""
        return TypeInfo(self.service_type.name, self.service_type.md5sum)


class ServiceAcceptor:
    """Takes callers of a node's services.

    Args:
        node: that provides.
    """

    def __init__(self, node: NodeView) -> None:
        self._node = node

    def accepted(self, now_ns: int) -> Accepted:
        """Serve a new caller."""
        core = self._node.core
        connection = ServiceServerConnection(core.tcpros_limits, now_ns)
        return connection, CallerLink(connection, self._node.providers, core)


class CallerLink:
    """Owner of the link to one caller.

    Attributes:
        connection: the protocol.
        provider: of the service that is called, None before the header.
    """

    def __init__(
        self,
        connection: ServiceServerConnection,
        providers: Mapping[str, ServiceProvider],
        core: NodeCore,
    ) -> None:
        self.connection = connection
        self.provider: ServiceProvider | None = None
        self._providers = providers
        self._core = core
        self._link: PeerLink | None = None

    def flush(self) -> None:
        """Send the answer in this cycle, where the step left something of its budget."""
        if self._link:
            self._core.flush(self._link)

    @property
    def response_type(self) -> MessageType:
        """Type of the responses."""
        assert self.provider is not None
        return self.provider.service_type.response

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Take or refuse the caller, then its requests."""
        self._link = link
        if isinstance(event, HeaderReceived):
            self._decide(link, event.fields)
        elif isinstance(event, RequestReceived) and self.provider:
            self._request(self.provider, link, event.body)
        elif isinstance(event, Failed) and self.provider:
            self._core.tell(StatusKind.BAD_MESSAGE, self.provider.service, event.reason)

    def _decide(self, link: PeerLink, fields: dict[str, str]) -> None:
        service = fields.get("service", "")
        provider = self._providers.get(service)
        if provider is None and "service" in fields:
            self.connection.refuse(f"{self._core.name} does not provide {service[:100]}")
        elif provider is None:
            self.connection.refuse("missing required 'service' field")
        elif self.connection.accept(provider.type_info(), self._core.name):
            self.provider = provider
            return
        self._core.tell(StatusKind.PEER_REFUSED, service[:100], link.peer)

    def _request(self, provider: ServiceProvider, link: PeerLink, body: bytes | memoryview) -> None:
        provider.bytes_in += len(body)
        try:
            request = provider.service_type.request.decode(body)
        except DecodeError as error:
            self._core.tell(StatusKind.BAD_MESSAGE, provider.service, str(error))
            self.connection.send_error(str(error))
            link.close(str(error))
            return
        provider.push(ServiceRequest(request, self.connection.header.get("callerid", ""), self))

    def expects_data(self, link: PeerLink) -> bool:
        """A caller may always ask."""
        return True

    def fill(self, link: PeerLink) -> None:
        """Answers go to the connection at once."""

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """A request of this caller may still wait; its answer will do nothing."""
