"""The border of a controller, which every message of a topic crosses."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from plcsim.core.traffic import Topic, Traffic


class Border(NamedTuple):
    """Where the messages of one topic are told of.

    Attributes:
        traffic: is told of them, None for nobody.
        topic: what they go over.
    """

    traffic: Traffic | None
    topic: Topic

    def cross(self, body: bytes | memoryview) -> None:
        """Tell of a message."""
        if self.traffic:
            self.traffic.tell(self.topic, body)
