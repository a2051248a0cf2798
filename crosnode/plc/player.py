"""Plays a bag: publishes its messages at the times at which they were recorded, as rosbag play."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Final

from crosnode.errors import CrosnodeError, UnknownTypeError
from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from crosnode.messages import MessageType
    from crosnode.node import CrosNode, Publisher
    from plcsim.core.traffic import Traffic
    from plcsim.recorder.bag.reading import BagMessage, BagReader, BagTopic

OWN: Final = "/plcsim/"
"""Topics of plcsim's own recordings begin so."""

QUEUE: Final = 1000

ROUND_NS: Final = 50_000_000
"""Between two rounds of a player's node that hands its messages over."""


class Player:
    """One run through a bag.

    Args:
        bag: that is played.
        node: publishes; its types may learn those of the bag.
        topics: that are played; none for all but those of plcsim's own.
        traffic: of the controller whose programs get the messages at once, past the network, when
            they are connected; None where all go over the network.

    Attributes:
        publishers: by topic.
        sent: messages so far.
        is_over: all are sent.

    Raises:
        RecordingError: a topic is not in the bag, its type is unknown or not the one of the
            programs, or the bag is damaged.
    """

    def __init__(
        self,
        bag: BagReader,
        node: CrosNode,
        topics: Collection[str] = (),
        traffic: Traffic | None = None,
    ) -> None:
        self._bag = bag
        self._traffic = traffic
        known = {topic.name: topic for topic in bag.topics}
        if missing := sorted(set(topics) - set(known)):
            raise RecordingError(f"{bag.path}: has no topic {missing[0]}")
        chosen = [known[n] for n in topics] or [
            topic for name, topic in known.items() if not name.startswith(OWN) and topic.messages
        ]
        if not chosen:
            raise RecordingError(f"{bag.path}: has no messages to be played")
        self._node = node
        self.publishers = {topic.name: self._publisher(topic) for topic in chosen}
        self.sent = 0
        self._next_round_ns = 0
        self.is_over = False
        self._messages: Iterator[BagMessage] = bag.messages(self.publishers)
        self._next: BagMessage | None = None
        self._first_ns = bag.start_ns
        self._start_ns: int | None = None

    def _publisher(self, topic: BagTopic) -> Publisher:
        package, _, name = topic.type_name.replace("/msg/", "/").partition("/")
        short = f"{package}/{name}"
        try:
            kind = self._type(short, topic)
            if len(topic.digest) == len(kind.md5sum) and kind.md5sum != topic.digest:
                raise RecordingError(
                    f"{self._bag.path}: {topic.name}: {short} has the MD5 sum {topic.digest} in "
                    f"the bag, and {kind.md5sum} here"
                )
            made = self._node.register_publisher(
                topic.name, short, queue_size=QUEUE, latching=topic.is_latching
            )
        except CrosnodeError as error:
            raise RecordingError(f"{self._bag.path}: {topic.name}: {error}") from None
        if self._traffic is not None:
            made.hand_over = partial(_hand_in, self._traffic, made.topic)
        return made

    def _type(self, name: str, topic: BagTopic) -> MessageType:
        """Return the type that is known here, otherwise that of the bag."""
        try:
            return self._node.types.message(name)
        except UnknownTypeError:
            return self._node.types.define(name, topic.definition)

    def start(self, now_ns: int) -> None:
        """Let the first message of the bag fall on ``now_ns``."""
        self._start_ns = now_ns
        self._advance()

    @property
    def due_ns(self) -> int | None:
        """When the next message is due, on the clock of `start`; None behind the last one."""
        if self._next is None or self._start_ns is None:
            return None
        return self._start_ns + self._next.time_ns - self._first_ns

    def step(self, now_ns: int) -> None:
        """Send what is due; the node itself goes round only now and then, or when it has sent."""
        before = self._sent_by_network
        self._send_due(now_ns)
        if self._sent_by_network != before or now_ns >= self._next_round_ns:
            self._next_round_ns = now_ns + ROUND_NS
            self._node.do_events_loop()

    @property
    def _sent_by_network(self) -> int:
        return sum(each.bytes_sent for each in self.publishers.values())

    def _send_due(self, now_ns: int) -> None:
        if self._start_ns is None:
            return
        last_ns, message = now_ns - self._start_ns + self._first_ns, self._next
        while message is not None and message.time_ns <= last_ns:
            self.publishers[message.topic].send_raw(message.as_ros1)
            self.sent += 1
            message = next(self._messages, None)
        self._next = message
        self.is_over = message is None

    def _advance(self) -> None:
        self._next = next(self._messages, None)
        self.is_over = self._next is None


def _hand_in(traffic: Traffic, topic: str, node: str, body: bytes | memoryview) -> bool:
    return traffic.hand_in(node, topic, bytes(body))
