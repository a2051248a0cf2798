"""Messages that cross a controller's border, for those who follow them, such as a recorder.

Whoever sends and receives messages for programs tells them here; the core knows no protocol. And
who plays a recording hands its messages in here, past the network.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable


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


class Traffic:
    """The messages of one controller.

    Attributes:
        followers: called with topic and bytes of every message, which do not change afterwards.
        hand_in_followers: called with node, topic and bytes of every message that is handed in.
        inlets: take a message as if it had come over the network, by the names of the node that
            receives it and of the topic.
    """

    __slots__ = ("followers", "hand_in_followers", "inlets")

    def __init__(self) -> None:
        self.followers: list[Callable[[Topic, bytes | memoryview], None]] = []
        self.hand_in_followers: list[Callable[[str, str, bytes], None]] = []
        self.inlets: dict[tuple[str, str], Callable[[bytes], None]] = {}

    def hand_in(self, node: str, topic: str, body: bytes) -> bool:
        """Give a message to a node, between two cycles; return whether the node is one of here."""
        inlet = self.inlets.get((node, topic))
        if inlet is None:
            return False
        for told in self.hand_in_followers:
            told(node, topic, body)
        inlet(body)
        return True
