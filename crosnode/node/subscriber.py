"""Subscribers: a connection to each publisher that the master names, kept up while it does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.errors import DecodeError
from crosnode.node.master_client import Wish
from crosnode.node.queues import DropOldestQueue
from crosnode.node.status import StatusKind
from crosnode.tcpros import (
    HeaderReceived,
    MessageReceived,
    Refused,
    SubscriberConnection,
    TypeInfo,
)
from crosnode.transport.connection import Failed
from crosnode.xmlrpc.api_caller import ApiCall, CallState

if TYPE_CHECKING:
    from crosnode.messages import Message, MessageType
    from crosnode.node.core import NodeCore
    from crosnode.node.master_client import Registration
    from crosnode.transport.budget import StepBudget
    from crosnode.transport.connection import ConnectionEvent
    from crosnode.transport.link import PeerLink
    from crosnode.xmlrpc import Value
    from plcsim.network import Address

FIRST_RETRY_NS: Final = 100_000_000
LONGEST_RETRY_NS: Final = 5_000_000_000
MAX_PUBLISHERS: Final = 200
"""Publishers of one topic that are connected to; what a master names beyond is left.

Each has its part in every step, and a controller has fewer sockets by default.
"""


class QueuedMessage(NamedTuple):
    """A message as it came, and where from."""

    body: bytes | memoryview
    peer: PublisherLink


class Subscriber:
    """A topic that a node subscribes to; made by ``CrosNode.register_subscriber``.

    Attributes:
        topic: resolved name.
        message_type: type of its messages.
        queue: messages that wait for the program; the oldest is dropped.
        bad_messages: bodies that were no message of the type.
        peers: publishers by the URI of their node.
        registration: with the master.
    """

    def __init__(
        self,
        topic: str,
        message_type: MessageType,
        registration: Registration,
        core: NodeCore,
        *,
        queue_size: int,
        tcp_nodelay: bool,
    ) -> None:
        self.topic = topic
        self.message_type = message_type
        self.registration = registration
        self.queue: DropOldestQueue[QueuedMessage] = DropOldestQueue(queue_size)
        self.bad_messages = 0
        self.peers: dict[str, PublisherLink] = {}
        self.tcp_nodelay = tcp_nodelay
        self.core = core
        self._is_overtaken = False
        self._unlisted: list[str] = []

    @property
    def publishers(self) -> int:
        """Publishers connected now."""
        return sum(peer.is_streaming for peer in self.peers.values())

    def pop(self) -> Message | None:
        """Return the oldest message, None where there is none.

        Bytes that are no message of the type are passed over, and their connection ends.
        """
        while (packet := self.queue.pop()) is not None:
            try:
                return self.message_type.decode(packet.body)
            except DecodeError as error:
                self.bad_messages += 1
                self.core.tell(StatusKind.BAD_MESSAGE, self.topic, str(error))
                packet.peer.drop(str(error))
        return None

    def pop_raw(self) -> bytes | memoryview | None:
        """Return the oldest message as bytes, None where there is none."""
        packet = self.queue.pop()
        return packet.body if packet else None

    def registered(self, uris: Value) -> None:
        """Take the publishers from the answer to the registration.

        Which is newer, the answer or a ``publisherUpdate`` that came before it, nobody can tell:
        then all that either names are taken, for one that is not there does less harm than one
        that is missed.
        """
        if self._is_overtaken and isinstance(uris, list):
            uris = [*self.peers, *uris]
        self._is_overtaken = False
        self.update(uris)

    def publisher_update(self, uris: Value) -> None:
        """Take the publishers from the master's call."""
        self._is_overtaken = self.registration.state is Wish.CALLING
        self.update(uris)

    def update(self, uris: Value) -> None:
        """Connect to the publishers at ``uris`` and part from all others, in time."""
        named = [uri for uri in uris if isinstance(uri, str)] if isinstance(uris, list) else []
        wanted = dict.fromkeys(list(dict.fromkeys(named))[:MAX_PUBLISHERS])
        self._unlisted = [uri for uri in self.peers if uri not in wanted]
        for uri in wanted:
            if uri not in self.peers:
                self.peers[uri] = PublisherLink(self, uri)
        self._part()

    def close(self) -> None:
        """Part from all publishers."""
        self._unlisted = []
        for peer in self.peers.values():
            peer.leave()
        self.peers.clear()

    def _part(self) -> None:
        """Part from publishers that the master does not name.

        A master that has just been started again names those that have registered again; an open
        connection to another one is kept until all had the time to.
        """
        is_settling = self.core.master.is_settling
        kept = [u for u in self._unlisted if is_settling and self.peers[u].is_streaming]
        for uri in self._unlisted:
            if uri not in kept:
                self.peers.pop(uri).leave()
        self._unlisted = kept

    def step(self, now_ns: int, budget: StepBudget) -> None:
        """Go on connecting."""
        if self._unlisted:
            self._part()
        for peer in self.peers.values():
            if peer.link is None:
                peer.step(now_ns, budget)

    def type_info(self) -> TypeInfo:
        """Return what the header says of the type."""
        found = self.message_type
        return TypeInfo(found.name, found.md5sum, found.full_text)


class PublisherLink:
    """One publisher: asked for its address, connected to, and again when it is lost.

    Attributes:
        uri: of its node.
        link: to it, None while there is none.
        is_streaming: whether its header came and fits.
        received: messages from it so far.
        number: of the connection in getBusInfo.
    """

    def __init__(self, subscriber: Subscriber, uri: str) -> None:
        self.uri = uri
        self.link: PeerLink | None = None
        self.is_streaming = False
        self.received = 0
        self.number = subscriber.core.next_number()
        self._subscriber = subscriber
        self._call: ApiCall | None = None
        self._address: Address | None = None
        self._retry_ns = 0
        self._pause_ns = FIRST_RETRY_NS
        self._has_left = False

    def step(self, now_ns: int, budget: StepBudget) -> None:
        """Ask for the address, then connect, each when it is time."""
        if self._address is not None:
            if budget.start_call():
                self._connect(self._address, now_ns)
                self._address = None
        elif self._call is not None:
            self._take_answer(self._call, now_ns)
        elif now_ns >= self._retry_ns:
            core = self._subscriber.core
            params = [core.name, self._subscriber.topic, [["TCPROS"]]]
            self._call = core.api.start(ApiCall(self.uri, "requestTopic", params))

    def _take_answer(self, call: ApiCall, now_ns: int) -> None:
        if call.state is CallState.WAITING:
            return
        self._call = None
        if call.state is CallState.FAILED:
            self._later(now_ns)
            return
        try:
            _, host, port = call.value
            self._address = self._subscriber.core.hosts.address(f"rosrpc://{host}:{port}", "rosrpc")
        except (ValueError, TypeError) as error:
            self._later(now_ns)
            self._tell(StatusKind.PEER_REFUSED, f"{self.uri}: {error}")

    def _connect(self, address: Address, now_ns: int) -> None:
        subscriber, core = self._subscriber, self._subscriber.core
        connection = SubscriberConnection(
            subscriber.topic,
            subscriber.type_info(),
            core.name,
            tcp_nodelay=subscriber.tcp_nodelay,
            limits=core.tcpros_limits,
            now_ns=now_ns,
        )
        self.link = core.loop.connect(address, connection, self, now_ns)

    def _later(self, now_ns: int) -> None:
        """Wait a little longer each time before the next attempt."""
        self._retry_ns = now_ns + self._pause_ns
        self._pause_ns = min(2 * self._pause_ns, LONGEST_RETRY_NS)

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Put messages into the program's queue."""
        if isinstance(event, MessageReceived):
            self.received += 1
            self._subscriber.queue.push(QueuedMessage(event.body, self))
        elif isinstance(event, HeaderReceived):
            self.is_streaming = True
            self._pause_ns = FIRST_RETRY_NS
            self._tell(StatusKind.CONNECTED, self.uri)
        elif isinstance(event, Refused):
            self._tell(StatusKind.PEER_REFUSED, event.error)
        elif isinstance(event, Failed):
            self._tell(StatusKind.BAD_MESSAGE, event.reason)

    def expects_data(self, link: PeerLink) -> bool:
        """A publisher may always send."""
        return True

    def fill(self, link: PeerLink) -> None:
        """A subscriber sends nothing after its header."""

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """Try again later, as long as the master names the publisher."""
        self.link = None
        if self.is_streaming:
            self._tell(StatusKind.DISCONNECTED, reason or self.uri)
        self.is_streaming = False
        self._later(now_ns)

    def drop(self, reason: str) -> None:
        """End the connection, which is tried again later."""
        if self.link:
            self.link.close(reason)

    def leave(self) -> None:
        """End the connection for good."""
        self.drop("no publisher any more")

    def _tell(self, kind: StatusKind, text: str) -> None:
        self._subscriber.core.tell(kind, self._subscriber.topic, text)
