"""Messages that cross a controller's border, for those who follow them, such as a recorder.

Whoever sends and receives messages for programs tells them here; the core knows no protocol. And
who plays a recording hands its messages in here, past the network.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


class Topic(NamedTuple):
    """What messages go over.

    Attributes:
        name: such as ``/chatter``.
        type_name: such as ``std_msgs/String``.
        md5sum: of the type, as ROS 1 computes it.
        definition: text of the type with all it contains.
        node: that sends or receives them here.
        is_sent: from here, otherwise received.
        is_latching: who comes later gets the last message.
    """

    name: str
    type_name: str
    md5sum: str
    definition: str
    node: str
    is_sent: bool
    is_latching: bool


Crossing = tuple[int, "bytes | memoryview"]
"""A message that crosses the border: the number of its topic, and its bytes. They do not change."""


class TopicEnds(NamedTuple):
    """Who is at the other ends of a topic, and what did not get there.

    Attributes:
        peers: names or URIs of the nodes that are connected.
        lost: messages dropped because somebody was too slow for them.
    """

    peers: Sequence[str]
    lost: int


class Traffic:
    """The messages of one controller.

    Attributes:
        topics: what messages go over; the number of a topic is its place.
        followers: called with every message that crosses.
        hand_in_followers: called with node, topic and bytes of every message that is handed in.
        inlets: take a message as if it had come over the network, by the names of the node that
            receives it and of the topic.
        ends: tell of the other ends of each topic that is registered.
    """

    __slots__ = ("_numbers", "ends", "followers", "hand_in_followers", "inlets", "topics")

    def __init__(self) -> None:
        self.topics: list[Topic] = []
        self._numbers: dict[Topic, int] = {}
        self.followers: list[Callable[[Crossing], object]] = []
        self.hand_in_followers: list[Callable[[str, str, bytes], None]] = []
        self.inlets: dict[tuple[str, str], Callable[[bytes], None]] = {}
        self.ends: dict[Topic, Callable[[], TopicEnds]] = {}

    def number_of(self, topic: Topic) -> int:
        """Return the number of a topic, a new one where it was never seen."""
        number = self._numbers.setdefault(topic, len(self.topics))
        if number == len(self.topics):
            self.topics.append(topic)
        return number

    def hand_in(self, node: str, topic: str, body: bytes) -> bool:
        """Give a message to a node, between two cycles; return whether the node is one of here."""
        inlet = self.inlets.get((node, topic))
        if inlet is None:
            return False
        for told in self.hand_in_followers:
            told(node, topic, body)
        inlet(body)
        return True
