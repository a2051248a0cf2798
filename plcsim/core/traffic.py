"""Messages that cross a controller's border, for those who follow them, such as a recorder.

Whoever sends and receives messages for programs tells them here; the core knows no protocol.
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
    """The messages of one controller; true where somebody follows them."""

    __slots__ = ("_followers",)

    def __init__(self) -> None:
        self._followers: list[Callable[[Topic, bytes | memoryview], None]] = []

    def __bool__(self) -> bool:
        return bool(self._followers)

    def follow(self, told: Callable[[Topic, bytes | memoryview], None]) -> None:
        """Have ``told`` called with topic and bytes of every message from now on."""
        self._followers.append(told)

    def tell(self, topic: Topic, body: bytes | memoryview) -> None:
        """Tell of a message; its bytes must not change afterwards."""
        for told in self._followers:
            told(topic, body)
