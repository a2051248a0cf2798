"""Subscribers: a connection to each publisher that the master names, kept up while it does."""

from __future__ import annotations

from itertools import repeat
from typing import TYPE_CHECKING, Final, TypeAlias

from crosnode.errors import DecodeError
from crosnode.node.publisher_link import PublisherLink
from crosnode.node.queues import DropOldestQueue
from crosnode.node.registration import RegistrationState
from crosnode.node.status import StatusKind
from crosnode.tcpros import TypeInfo
from plcsim.core.traffic import TopicEnds

if TYPE_CHECKING:
    from collections.abc import Sequence

    from crosnode.messages import Message, MessageType
    from crosnode.node.border import Border
    from crosnode.node.core import NodeCore
    from crosnode.node.registration import Registration
    from crosnode.transport.budget import StepBudget
    from crosnode.xmlrpc import Value

MAX_PUBLISHERS: Final = 200
"""Publishers of one topic that are connected to; what a master names beyond is left.

Each has its part in every step, and a controller has fewer sockets by default.
"""


QueuedMessage: TypeAlias = "tuple[bytes | memoryview, PublisherLink | None]"
"""A message as it came, and where from; None for one that was handed in."""


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
        border: Border,
    ) -> None:
        self.topic = topic
        self.message_type = message_type
        self.registration = registration
        self.queue: DropOldestQueue[QueuedMessage] = DropOldestQueue(queue_size)
        self.bad_messages = 0
        self.peers: dict[str, PublisherLink] = {}
        self.tcp_nodelay = tcp_nodelay
        self.core = core
        self._border = border
        border.open(self.take)
        border.tell_of(self._ends)
        self._is_overtaken = False
        self._has_unnamed = False

    @property
    def publishers(self) -> int:
        """Publishers connected now."""
        return sum(peer.is_streaming for peer in self.peers.values())

    @property
    def dropped(self) -> int:
        """Messages dropped because the program did not take them in time."""
        return self.queue.dropped

    def pop(self) -> Message | None:
        """Return the oldest message, None where there is none.

        Bytes that are no message of the type are passed over, and their connection ends.
        """
        while (packet := self.queue.pop()) is not None:
            body, peer = packet
            try:
                return self.message_type.decode(body)
            except DecodeError as error:
                self.bad_messages += 1
                self.core.tell(StatusKind.BAD_MESSAGE, self.topic, str(error))
                if peer is not None:
                    peer.drop(str(error))
        return None

    def pop_raw(self) -> bytes | memoryview | None:
        """Return the oldest message as bytes, None where there is none."""
        packet = self.queue.pop()
        return packet[0] if packet else None

    def receive(self, bodies: Sequence[bytes | memoryview], publisher: PublisherLink) -> None:
        """Put messages into the program's queue."""
        if self._border.is_followed:
            for body in bodies:
                self._border.cross(body)
        self.queue.extend([*zip(bodies, repeat(publisher))])

    def take(self, body: bytes) -> None:
        """Put a message into the program's queue that came past the network, from a recording."""
        self._border.cross(body)
        self.queue.push((body, None))

    def registered(self, uris: Value) -> None:
        """Take the publishers from the answer to the registration.

        Which is newer, the answer or a ``publisherUpdate`` that came before it, nobody can tell:
        then all that either names are taken, for one that is not there does less harm than one
        that is missed.
        """
        if self._is_overtaken and isinstance(uris, list):
            uris = [*(uri for uri, peer in self.peers.items() if self._is_named(peer)), *uris]
        self._is_overtaken = False
        self.update(uris)

    def publisher_update(self, uris: Value) -> None:
        """Take the publishers from the master's call."""
        self._is_overtaken = self.registration.state is RegistrationState.CALLING
        self.update(uris)

    def update(self, uris: Value) -> None:
        """Connect to the publishers at ``uris``, and part from those that were taken away."""
        named = [uri for uri in uris if isinstance(uri, str)] if isinstance(uris, list) else []
        wanted = dict.fromkeys(list(dict.fromkeys(named))[:MAX_PUBLISHERS])
        for uri in [uri for uri, peer in self.peers.items() if uri not in wanted]:
            if self._is_named(self.peers[uri]):
                self.peers.pop(uri).leave()
        for uri in wanted:
            if uri not in self.peers:
                self.peers[uri] = PublisherLink(self, uri)
            self.peers[uri].life = self.core.master.life
        self._part()

    def _is_named(self, peer: PublisherLink) -> bool:
        """Whether the present master has named a publisher, and not only one before it."""
        return peer.life == self.core.master.life

    def _ends(self) -> TopicEnds:
        uris = [uri for uri, peer in self.peers.items() if peer.is_streaming]
        return TopicEnds(uris, self.dropped)

    def close(self) -> None:
        """Part from all publishers."""
        self._border.close()
        for peer in self.peers.values():
            peer.leave()
        self.peers.clear()
        self._has_unnamed = False

    def _part(self) -> None:
        """Part from publishers that the present master never named and that are not connected.

        A master that was started again knows those that have registered again; rospy does not.
        An open connection is kept as long as it lives, and one on its way is made, as in rospy and
        roscpp.
        """
        unnamed = [uri for uri, peer in self.peers.items() if not self._is_named(peer)]
        for uri in unnamed:
            if self.peers[uri].is_waiting:
                self.peers.pop(uri).leave()
        self._has_unnamed = bool(unnamed)

    def step(self, now_ns: int, budget: StepBudget) -> None:
        """Go on connecting."""
        if self._has_unnamed:
            self._part()
        for peer in self.peers.values():
            if peer.link is None:
                peer.step(now_ns, budget)

    def type_info(self) -> TypeInfo:
        """Return what the header says of the type."""
        found = self.message_type
        return TypeInfo(found.name, found.md5sum, found.full_text)
