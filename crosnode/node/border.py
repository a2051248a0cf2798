"""The border of a controller, which every message of a topic crosses."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.traffic import Topic, TopicEnds, Traffic


class Border:
    """Where the messages of one topic are told of.

    Args:
        traffic: is told of them, None for nobody.
        topic: what they go over.
    """

    __slots__ = ("_followers", "_number", "_topic", "_traffic")

    def __init__(self, traffic: Traffic | None, topic: Topic) -> None:
        self._traffic = traffic
        self._followers = () if traffic is None else traffic.followers
        self._topic = topic
        self._number = 0 if traffic is None else traffic.number_of(topic)

    def tell_of(self, ends: Callable[[], TopicEnds]) -> None:
        """Tell of the other ends until it is closed."""
        if self._traffic is not None:
            self._traffic.ends[self._topic] = ends

    @property
    def is_followed(self) -> bool:
        """Whether anybody is told."""
        return bool(self._followers)

    def open(self, inlet: Callable[[bytes], None]) -> None:
        """Take messages that are handed in, past the network."""
        if self._traffic is not None:
            self._traffic.inlets[self._topic.node, self._topic.name] = inlet

    def close(self) -> None:
        """Take no more, and tell of nothing."""
        if self._traffic is not None:
            self._traffic.ends.pop(self._topic, None)
            if not self._topic.is_sent:
                self._traffic.inlets.pop((self._topic.node, self._topic.name), None)

    def cross(self, body: bytes | memoryview) -> None:
        """Tell of a message; its bytes must not change afterwards."""
        crossing = self._number, body
        for told in self._followers:
            told(crossing)
