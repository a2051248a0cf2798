"""The bridge without code: tags to topics and topics to tags, as [ros] in plc.toml says.

A tag of an elementary or string type goes with a message of one field, such as std_msgs/Float64. A
STRUCT goes with a message member by field, by name and at every level; fields without a member keep
their defaults, members without a field stay as they are. Messages come in in LATCH and go out in
PUBLISH, so a program sees its inputs stand still.

A STRING is Latin-1 and a ROS string is UTF-8; each is converted to the other. A ROS string that is
not UTF-8 is put into a STRING byte for byte.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from crosnode.budget import Budget
from crosnode.errors import MessageValueError
from crosnode.link import QUIET_TURNS
from crosnode.messages import Duration, Time
from crosnode.messages.codec import attribute_name
from crosnode.messages.text import bytes_of, is_utf8
from crosnode.node.period import Period
from crosnode.project import create_node, surroundings
from plcsim.errors import ConfigurationError, TagError
from plcsim.logbook import Severity
from st_types.derived import StructType

if TYPE_CHECKING:
    from crosnode.messages import Message, MessageType
    from crosnode.node import CrosNode, Publisher, Subscriber
    from crosnode.settings import Publication, Subscription
    from plcsim.controller import Controller
    from plcsim.tag import Tag


class Bridge:
    """The bridge's node and its topics; one for each start of a controller.

    Args:
        controller: whose tags are bridged.

    Attributes:
        node: the node.
        refused: messages that a tag, and values that a message, could not take.
    """

    def __init__(self, controller: Controller) -> None:
        found = surroundings(controller.context)
        assert found is not None
        settings = found.settings
        self.node: CrosNode = create_node(controller.context, settings.node)
        self.refused = 0
        self._controller = controller
        self._out = [Outgoing(controller, self.node, entry) for entry in settings.publish]
        self._in = [Incoming(controller, self.node, entry) for entry in settings.subscribe]

    def latch(self) -> None:
        """Do the node's step, then give tags the newest messages."""
        self.node.do_events_loop()
        for incoming in self._in:
            self._checked(incoming.name, incoming.take)

    def publish(self, release_ns: int) -> None:
        """Send the tags that are due."""
        for outgoing in self._out:
            self._checked(outgoing.name, lambda each=outgoing: each.send(release_ns))

    def close(self) -> None:
        """End with the controller, whose sockets are closed already: take back by a new one."""
        node = self.node
        for _ in range(QUIET_TURNS):
            node.core.loop.step(self._controller.context.release_ns, Budget(node.options.step))
        node.destroy()

    def _checked(self, name: str, act: Any) -> None:
        """Count and log what does not fit; the scan goes on."""
        try:
            act()
        except (TagError, MessageValueError) as error:
            self.refused += 1
            if self.refused & (self.refused - 1) == 0:  # the first, second, fourth, eighth...
                text = f"{name}: {error} ({self.refused} refused so far)"
                self._controller.log(Severity.WARNING, "ros", text)


class Outgoing:
    """A tag that is published.

    Args:
        controller: whose tag it is.
        node: publishes it.
        entry: of [ros.publish].
    """

    def __init__(self, controller: Controller, node: CrosNode, entry: Publication) -> None:
        self.name = entry.topic
        self._tags = controller.tags
        self._tag = controller.tags.find(entry.tag)
        self._publisher: Publisher = node.register_publisher(
            entry.topic, entry.type_name, latching=entry.on_change
        )
        check_pair(self._tag, self._publisher.message_type)
        self._period = Period(entry.every_ns) if entry.every_ns else None
        self._on_change = entry.on_change
        self._last: object = None

    def send(self, release_ns: int) -> None:
        """Send the tag where it is time, and where it changed if that is asked for."""
        if self._period and not self._period.is_due(release_ns):
            return
        value = self._tags.read(self._tag)
        if self._on_change and value == self._last:
            return
        self._last = value
        message = self._publisher.new()
        fill_message(message, self._publisher.message_type, value)
        self._publisher.send(message)


class Incoming:
    """A tag that takes the newest message of a topic; arguments as for ``Outgoing``."""

    def __init__(self, controller: Controller, node: CrosNode, entry: Subscription) -> None:
        self.name = entry.topic
        self._tags = controller.tags
        self._tag = controller.tags.find(entry.tag)
        self._subscriber: Subscriber = node.register_subscriber(
            entry.topic, entry.type_name, queue_size=1
        )
        check_pair(self._tag, self._subscriber.message_type)

    def take(self) -> None:
        """Write the newest message into the tag."""
        message = self._subscriber.pop()
        if message is not None:
            before = self._tags.read(self._tag)
            value = tag_value(message, self._subscriber.message_type, before)
            self._tags.write(self._tag, value)


def check_pair(tag: Tag, message_type: MessageType) -> None:
    """Check that a tag and a message type have something in common.

    Raises:
        ConfigurationError: an elementary tag with a message of other than one field, or a STRUCT
            without any member that is a field.
    """
    names = {attribute_name(field.name) for field in message_type.fields}
    if not isinstance(tag.data_type, StructType):
        if len(names) != 1:
            raise ConfigurationError(
                f"ros: tag {tag.path} is one value, {message_type.name} has {len(names)} fields"
            )
    elif not names & {member.name for member in tag.data_type.members}:
        raise ConfigurationError(
            f"ros: no member of {tag.path} is a field of {message_type.name}: {', '.join(names)}"
        )


def fill_message(message: Message, message_type: MessageType, value: object) -> None:
    """Write a tag's plain value into a message."""
    if isinstance(value, dict):
        _fill(message, value)
    else:
        (field,) = message_type.fields
        setattr(message, attribute_name(field.name), value)


def _fill(message: Any, values: dict[str, Any]) -> None:
    for name, value in values.items():
        if not hasattr(message, name):
            continue
        inner = getattr(message, name)
        if isinstance(value, dict):
            _fill(inner, value)
        else:
            setattr(message, name, value)


def tag_value(message: Message, message_type: MessageType, before: object) -> object:
    """Return a tag's plain value from a message; members that are no field stay as ``before``."""
    if isinstance(before, dict):
        return _value(message, before)
    (field,) = message_type.fields
    return _plain(getattr(message, attribute_name(field.name)), before)


def _value(message: Any, before: dict[str, Any]) -> dict[str, Any]:
    return {
        name: _plain(getattr(message, name), value) if hasattr(message, name) else value
        for name, value in before.items()
    }


def _plain(value: Any, before: object) -> object:
    """Return a field's value as its member takes it; a long array is cut, a short one filled up."""
    if isinstance(before, dict):
        return _value(value, before)
    if isinstance(before, (list, tuple)):
        found = list(value)[: len(before)]
        plain = [_plain(each, old) for each, old in zip(found, before, strict=False)]
        return [*plain, *before[len(plain) :]]
    if isinstance(value, (Time, Duration)):
        return value.to_ns()
    if isinstance(value, str):
        return value if is_utf8(value) else bytes_of(value).decode("latin-1")
    return value.item() if hasattr(value, "item") else value
