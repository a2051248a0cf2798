"""Broadcasters and the listener of a node, as tf2_ros has them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from crosnode.errors import MessageValueError
from crosnode.messages import Time
from crosnode.tf.buffer import TransformBuffer
from crosnode.tf.transform import Transform, fill_message, from_message

if TYPE_CHECKING:
    from crosnode.messages import Message
    from crosnode.node import CrosNode, Publisher

TYPE: Final = "tf2_msgs/TFMessage"
STAMPED: Final = "geometry_msgs/TransformStamped"
MOST_STATIC: Final = 1_000
"""Static frames that a broadcaster tells."""

MOST_MESSAGES: Final = 100
"""On /tf and on /tf_static that wait for the program, as by tf2."""


def _publisher(node: CrosNode, topic: str, *, latching: bool) -> Publisher:
    """Return the node's publisher of a topic, which all its broadcasters share."""
    found = node.publishers.get(topic)
    if found is None:
        found = node.register_publisher(topic, TYPE, queue_size=MOST_MESSAGES, latching=latching)
    return found


class TransformBroadcaster:
    """Tells where frames are now, on ``/tf``.

    Args:
        node: publishes.
    """

    def __init__(self, node: CrosNode) -> None:
        self._node = node
        self._publisher = _publisher(node, "/tf", latching=False)
        self._stamped = node.types.message(STAMPED)
        self._waiting: dict[str, Message] = {}

    def add(self, parent: str, child: str, transform: Transform, stamp_ns: int = 0) -> None:
        """Tell with the next ``send`` where a frame is.

        Args:
            parent: name of the frame that it is told in.
            child: name of the frame.
            transform: from the child to the parent.
            stamp_ns: nanoseconds since 1970, 0 for the time of the cycle.
        """
        message = self._stamped.new()
        message.header.frame_id, message.child_frame_id = parent, child
        message.header.stamp = Time.from_ns(stamp_ns or self._node.now_ns)
        fill_message(message.transform, transform)
        self._waiting[child] = message

    def send(self) -> None:
        """Send what was added, in one message; nothing where nothing was."""
        if self._waiting:
            waiting, self._waiting = self._waiting, {}
            self._publisher.send(self._publisher.new(transforms=list(waiting.values())))


class StaticTransformBroadcaster:
    """Tells where frames are for good, on ``/tf_static``, which is latched.

    Args:
        node: publishes.
    """

    def __init__(self, node: CrosNode) -> None:
        self._node = node
        self._publisher = _publisher(node, "/tf_static", latching=True)
        self._stamped = node.types.message(STAMPED)
        self._told: dict[str, Any] = {}
        self._sent: bytes | memoryview | None = None

    def send(self, parent: str, child: str, transform: Transform) -> None:
        """Tell where a frame is, and all that the node has told: the last message alone is latched.

        Raises:
            MessageValueError: there are too many frames.
        """
        latched = self._publisher.latched
        if latched is not None and latched is not self._sent:  # that of another broadcaster
            transforms = self._publisher.message_type.decode(latched).transforms
            self._told = {each.child_frame_id: each for each in transforms}
        if child not in self._told and len(self._told) >= MOST_STATIC:
            raise MessageValueError(f"more than {MOST_STATIC} static frames.")
        message = self._stamped.new()
        message.header.frame_id, message.child_frame_id = parent, child
        message.header.stamp = Time.from_ns(self._node.now_ns)
        fill_message(message.transform, transform)
        self._told[child] = message
        self._publisher.send(self._publisher.new(transforms=list(self._told.values())))
        self._sent = self._publisher.latched


class TransformListener:
    """Follows ``/tf`` and ``/tf_static``; ``step`` belongs behind the node's step.

    Args:
        node: subscribes.

    Attributes:
        buffer: what is known of the frames.
    """

    def __init__(self, node: CrosNode) -> None:
        self.buffer = TransformBuffer()
        self._node = node
        self._moving = node.register_subscriber("/tf", TYPE, queue_size=MOST_MESSAGES)
        self._static = node.register_subscriber("/tf_static", TYPE, queue_size=MOST_MESSAGES)
        self._before_ns = 0

    def step(self) -> None:
        """Take what has come; time that goes back makes all that moves unknown, as in tf2."""
        now_ns = self._node.now_ns
        if now_ns < self._before_ns:
            self.buffer.clear()
        self._before_ns = now_ns
        while (message := self._static.pop()) is not None:
            self._take(message, is_static=True)
        while (message := self._moving.pop()) is not None:
            self._take(message, is_static=False)

    def _take(self, message: Any, *, is_static: bool) -> None:
        for each in message.transforms:
            transform = from_message(each.transform)
            if transform is None:
                self.buffer.refused += 1
                continue
            stamp_ns = each.header.stamp.to_ns()
            parent, child = each.header.frame_id, each.child_frame_id
            self.buffer.add(parent, child, stamp_ns, transform, is_static=is_static)

    def lookup(self, target: str, source: str, time_ns: int = 0) -> Transform:
        """See `TransformBuffer.lookup`."""
        return self.buffer.lookup(target, source, time_ns)
