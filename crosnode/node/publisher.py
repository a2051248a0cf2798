"""Publishers: one message goes to all subscribers, each at its own pace."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from crosnode.messages.definition import HEADER
from crosnode.node.period import Period
from crosnode.node.queues import DropOldestQueue
from crosnode.node.status import StatusKind
from crosnode.tcpros import HeaderReceived, PublisherConnection, TypeInfo
from crosnode.transport.tcpip_socket import AREA_SIZE
from plcsim.core.traffic import TopicEnds

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from crosnode.messages import Message, MessageType
    from crosnode.node.border import Border
    from crosnode.node.core import NodeCore, NodeView
    from crosnode.node.registration import Registration
    from crosnode.transport.connection import ConnectionEvent
    from crosnode.transport.event_loop import Accepted
    from crosnode.transport.link import PeerLink

SEQ_MASK: Final = 0xFFFF_FFFF

MAX_TEXT: Final = 1_000
"""Characters kept of what a peer calls itself."""


class Publisher:
    """A topic that a node publishes; made by ``CrosNode.register_publisher``.

    Attributes:
        topic: resolved name.
        message_type: type of its messages.
        latching: whether a new subscriber gets the last message at once.
        queue_size: messages that wait for each subscriber; the oldest is dropped.
        sent: messages sent so far.
        bytes_sent: bytes sent to subscribers so far.
        links: connections to subscribers.
        registration: with the master.
        latched: bytes of the message that a new subscriber gets, None where there is none.
        hand_over: asked with the subscriber's name and the message before it is sent; where it
            returns True the subscriber has it already, past the network.
    """

    def __init__(
        self,
        topic: str,
        message_type: MessageType,
        registration: Registration,
        *,
        queue_size: int,
        latching: bool,
        loop_period_ns: int,
        border: Border,
    ) -> None:
        self.topic = topic
        self.message_type = message_type
        self.registration = registration
        self.latching = latching
        self.queue_size = queue_size
        self.sent = 0
        self.bytes_sent = 0
        self.hand_over: Callable[[str, bytes | memoryview], bool] | None = None
        self.links: dict[PeerLink, SubscriberLink] = {}
        DropOldestQueue[bytes](queue_size)  # a wrong size is an error now, not in the cycle
        self.latched: bytes | memoryview | None = None
        self._packets: DropOldestQueue[Message] = DropOldestQueue(1)
        self._period = Period(loop_period_ns)
        self._border = border
        border.tell_of(self._ends)
        first = message_type.fields[:1]
        self._has_header = bool(first and first[0].base == HEADER and first[0].name == "header")

    @property
    def subscribers(self) -> int:
        """Subscribers connected now."""
        return len(self.links)

    @property
    def dropped(self) -> int:
        """Messages dropped for subscribers that are connected and too slow."""
        return sum(owner.queue.dropped for owner in self.links.values())

    def _ends(self) -> TopicEnds:
        return TopicEnds([owner.subscriber for owner in self.links.values()], self.dropped)

    def close(self) -> None:
        """Tell of nothing any more; the node ends its connections."""
        self._border.close()

    def new(self, **values: object) -> Message:
        """Return a new message with ``values``, defaults elsewhere."""
        return self.message_type.new(**values)

    def pop(self) -> Message | None:
        """Return a new message to fill and send, once a loop period; None in between."""
        return self._packets.pop()

    def send(self, message: Message) -> None:
        """Send a message to all subscribers; ``header.seq`` is overwritten, as in all of ROS.

        Raises:
            MessageValueError: a field cannot hold its value; nothing is sent.
        """
        if self._has_header:
            message.header.seq = self.sent & SEQ_MASK
        self.send_raw(self.message_type.encode(message))

    def send_raw(self, body: bytes | memoryview) -> None:
        """Send the bytes of a message, which must not change any more."""
        self.sent += 1
        self._border.cross(body)
        if self.latching:
            self.latched = body
        hand_over = self.hand_over
        for link, owner in list(self.links.items()):
            if hand_over is None or not hand_over(owner.subscriber, body):
                owner.send(link, body)
                self.bytes_sent += len(body)

    def tick(self, now_ns: int) -> None:
        """Put a message into the program's queue when the loop period is over."""
        if self._period.is_due(now_ns):
            self._packets.push(self.message_type.new())

    def accept(self, link: PeerLink, owner: SubscriberLink) -> None:
        """Take a new subscriber."""
        self.links[link] = owner
        owner.queue = DropOldestQueue(self.queue_size)
        if self.latched is not None:
            owner.queue.push(self.latched)

    def type_info(self) -> TypeInfo:
        """Return what the header says of the type."""
        found = self.message_type
        return TypeInfo(found.name, found.md5sum, found.full_text)


class TopicAcceptor:
    """Takes subscribers of a node's topics.

    Args:
        node: that publishes.
    """

    def __init__(self, node: NodeView) -> None:
        self._node = node

    def accepted(self, now_ns: int) -> Accepted:
        """Serve a new subscriber."""
        core = self._node.core
        connection = PublisherConnection(core.tcpros_limits, now_ns)
        return connection, SubscriberLink(connection, self._node.publishers, core)


def printable(text: str) -> str:
    """Return a peer's text as XML-RPC, logs and screens can carry it."""
    return "".join(each if each.isprintable() else "?" for each in text[:MAX_TEXT])


class SubscriberLink:
    """Owner of the link to one subscriber.

    Attributes:
        queue: messages that wait for it.
        publisher: whom it subscribed to, None before its header.
        subscriber: name of its node.
        number: of the connection in getBusInfo.
    """

    def __init__(
        self,
        connection: PublisherConnection,
        publishers: Mapping[str, Publisher],
        core: NodeCore,
    ) -> None:
        self.queue: DropOldestQueue[bytes | memoryview] = DropOldestQueue(1)
        self.publisher: Publisher | None = None
        self.subscriber = ""
        self.number = core.next_number()
        self._connection = connection
        self._publishers = publishers
        self._core = core

    def send(self, link: PeerLink, body: bytes | memoryview) -> None:
        """Send a message: in this cycle, where the step left something of its budget."""
        self.queue.push(body)
        self._core.flush(link)

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Take or refuse the subscriber by its header."""
        if not isinstance(event, HeaderReceived):
            return
        topic = event.fields.get("topic", "")
        self.subscriber = printable(event.fields.get("callerid", ""))
        publisher = self._publishers.get(topic)
        if publisher is None and "topic" in event.fields:
            self._connection.refuse(f"{self._core.name} does not publish {topic[:100]}")
        elif publisher is None:
            self._connection.refuse("missing required 'topic' field")
        elif self._connection.accept(
            publisher.type_info(), self._core.name, latching=publisher.latching
        ):
            self.publisher = publisher
            publisher.accept(link, self)
            self._core.tell(StatusKind.CONNECTED, topic, self.subscriber)
            return
        self._core.tell(
            StatusKind.PEER_REFUSED, topic[:100], f"{self.subscriber[:100]} at {link.peer}"
        )

    def expects_data(self, link: PeerLink) -> bool:
        """A subscriber has nothing to say behind its header."""
        return self.publisher is None

    def fill(self, link: PeerLink) -> None:
        """Hand messages over until about one transfer area of them waits."""
        queue = self.queue
        if not queue:
            return
        size = link.waiting
        bodies: list[bytes | memoryview] = []
        while size < AREA_SIZE and (body := queue.pop()) is not None:
            bodies.append(body)
            size += len(body) + 4
        self._connection.send_messages(bodies)

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """Forget the subscriber."""
        if self.publisher:
            self.publisher.links.pop(link, None)
            self._core.tell(
                StatusKind.DISCONNECTED, self.publisher.topic, reason or self.subscriber
            )
