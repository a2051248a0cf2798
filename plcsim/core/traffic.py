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
    """The messages of one controller.

    Attributes:
        followers: called with topic and bytes of every message, which do not change afterwards.
    """

    __slots__ = ("followers",)

    def __init__(self) -> None:
        self.followers: list[Callable[[Topic, bytes | memoryview], None]] = []
