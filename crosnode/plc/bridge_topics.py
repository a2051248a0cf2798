"""Topics of the bridge: a tag that is published, a tag that takes the newest message."""

from __future__ import annotations

from collections import Counter
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Final, Generic, NamedTuple, TypeVar

from crosnode.errors import MessageValueError
from crosnode.messages import Time
from crosnode.messages.definition import HEADER
from crosnode.node.period import Period
from crosnode.plc.conversion import ConversionContext, tag_conversion
from plcsim.core.errors import ConfigurationError
from st_types.errors import ValueRangeError
from st_types.types.derived import StructType, resolve_alias
from st_types.types.elementary import BOOL, TIME
from st_types.types.values import decode, encode

if TYPE_CHECKING:
    from crosnode.messages import Message
    from crosnode.node import CrosNode, Publisher, Subscriber
    from crosnode.plc.settings import Publication, Subscription
    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag, TagTable
    from st_types.types.elementary import DataType

NS_PER_MS: Final = 1_000_000
LONGEST_MS: Final = 2**31 - 1


class BridgeStatus(IntEnum):
    """What the status tag of an entry holds."""

    NONE = 0
    """Nothing has come yet; of a published tag: nobody listens."""
    GOOD = 1
    STALE = 2
    """The last message is older than its time-out, or its publisher has gone."""
    CUT = 3
    """Good, but a list or a text was longer than the tag that took it."""


class StatusChange(NamedTuple):
    """The status of an entry is another one.

    Attributes:
        name: of the topic.
        status: that is left or entered.
        text: what happened, for people.
    """

    name: str
    status: BridgeStatus
    text: str


S = TypeVar("S", bound=IntEnum)


class StatusTag(Generic[S]):
    """Tells a tag how an entry does, where one is named.

    Args:
        tags: of the controller.
        path: of the tag, None for none.
        first: status before anything is told; the tag has its number, 0, by itself.

    Raises:
        ConfigurationError: the tag cannot hold the numbers 0 to 3.
        TagError: there is no such tag.

    Attributes:
        status: told last.
    """

    def __init__(self, tags: TagTable, path: str | None, first: S) -> None:
        self.status = first
        self._tags = tags
        self._tag = tags.find(path) if path else None
        if self._tag:
            data_type = resolve_alias(self._tag.data_type)
            if data_type is BOOL or not _holds(data_type, BridgeStatus.CUT):
                raise ConfigurationError(f"status: tag {path} is {data_type}, which holds no 0..3")

    def tell(self, status: S) -> bool:
        """Write a status; return whether it is another one."""
        is_new, self.status = status is not self.status, status
        if self._tag and is_new:
            self._tags.write(self._tag, int(status))
        return is_new


def _holds(data_type: DataType[Any], value: object) -> bool:
    try:
        encode(data_type, value)
    except (ValueRangeError, TypeError):
        return False
    return True


class Outgoing:
    """A tag that is published.

    Args:
        controller: whose tag it is.
        node: publishes it.
        topic: name, resolved by the node.
        entry: of [ros.publish].
    """

    def __init__(
        self, controller: Controller, node: CrosNode, topic: str, entry: Publication
    ) -> None:
        self.name = topic
        self._tags = controller.tags
        self._tag = controller.tags.find(entry.tag)
        self._publisher: Publisher = node.register_publisher(
            topic, entry.type_name, latching=entry.on_change
        )
        found = self._publisher.message_type
        data_type = self._tag.data_type
        surroundings = ConversionContext(node.types, Counter())
        self._conversion = tag_conversion(surroundings, found, data_type, self._tag.path)
        self._status = StatusTag(controller.tags, entry.status, BridgeStatus.NONE)
        self._node = node
        self._is_stamped = _needs_stamp(self._publisher, data_type)
        self._period = Period(entry.every_ns) if entry.every_ns else None
        self._on_change = entry.on_change
        self._last: object = None
        self._body = b""
        try:  # nothing at all fits where 0 does not
            found.encode(self._conversion.to_field(decode(data_type, bytes(data_type.size))))
        except MessageValueError as error:
            raise ConfigurationError(f"tag {self._tag.path}: {error}") from None

    def send(self, release_ns: int) -> None:
        """Send the tag where it is time, and where it changed if that is asked for."""
        listened = self._publisher.subscribers > 0
        self._status.tell(BridgeStatus.GOOD if listened else BridgeStatus.NONE)
        if self._period and not self._period.is_due(release_ns):
            return
        value = self._tags.read(self._tag)
        if self._on_change and value == self._last:
            return
        self._last = value
        message = self._conversion.to_field(value)
        if self._on_change:
            body = bytes(self._publisher.message_type.encode(message))
            if body == self._body:  # NaN is another value than itself, and yet no change
                return
            self._body = body
        if self._is_stamped:
            message.header.stamp = Time.from_ns(self._node.now_ns)
        self._publisher.send(message)


def _needs_stamp(publisher: Publisher, data_type: DataType[Any]) -> bool:
    """Return whether messages have a header whose stamp no member of the STRUCT gives."""
    fields = publisher.message_type.fields
    if not fields or (fields[0].name, fields[0].base) != ("header", HEADER):
        return False
    return not _has_member(data_type, "header", "stamp")


def _has_member(data_type: DataType[Any], *path: str) -> bool:
    for name in path:
        struct = resolve_alias(data_type)
        if not isinstance(struct, StructType):
            return False
        inner = next((each.data_type for each in struct.members if each.name == name), None)
        if inner is None:
            return False
        data_type = inner
    return True


class Incoming:
    """A tag that takes the newest message of a topic; arguments as for ``Outgoing``.

    Attributes:
        name: of the topic.
        cuts: lists and texts that were longer than what took them, by path of tag.
    """

    def __init__(
        self, controller: Controller, node: CrosNode, topic: str, entry: Subscription
    ) -> None:
        self.name = topic
        self.cuts: Counter[str] = Counter()
        self._tags = controller.tags
        self._tag = controller.tags.find(entry.tag)
        self._timeout_ns = entry.timeout_ns
        self._status = StatusTag(controller.tags, entry.status, BridgeStatus.NONE)
        self._age = age_tag(controller.tags, entry.age)
        self._controller = controller
        self._since_ns = controller.context.release_ns
        self._received = BridgeStatus.NONE
        self._subscriber: Subscriber = node.register_subscriber(
            topic, entry.type_name, queue_size=1
        )
        found = self._subscriber.message_type
        surroundings = ConversionContext(node.types, self.cuts)
        self._conversion = tag_conversion(surroundings, found, self._tag.data_type, self._tag.path)
        try:
            encode(self._tag.data_type, self._value_of(found.new()))
        except ValueRangeError as error:
            raise ConfigurationError(f"tag {self._tag.path}: {found.name}: {error}") from None

    def take(self) -> None:
        """Write the newest message into the tag.

        Raises:
            TagError: the tag cannot take it.
        """
        now_ns = self._controller.context.release_ns
        message = self._subscriber.pop()
        if message is not None:
            cuts = self.cuts.total()
            self._tags.write(self._tag, self._value_of(message))
            self._since_ns = now_ns
            self._received = BridgeStatus.CUT if self.cuts.total() > cuts else BridgeStatus.GOOD

    def look(self) -> StatusChange | None:
        """Tell the tags how good and how old the value is; return a status that is worth a line."""
        age_ns = self._controller.context.release_ns - self._since_ns
        if self._age:
            self._tags.write(self._age, min(age_ns // NS_PER_MS, LONGEST_MS))
        before = self._status.status
        if not self._status.tell(self._status_now(age_ns)):
            return None
        if self._status.status is BridgeStatus.STALE:
            text = f"no publisher, the last message is {age_ns // NS_PER_MS} ms old"
            if self._subscriber.publishers:
                text = f"no message for {age_ns // NS_PER_MS} ms"
            return StatusChange(self.name, BridgeStatus.STALE, text)
        if self._status.status is BridgeStatus.CUT:
            where = ", ".join(f"{path} {count} times" for path, count in self.cuts.items())
            return StatusChange(self.name, BridgeStatus.CUT, f"longer than what takes it: {where}")
        if before is BridgeStatus.STALE:
            return StatusChange(self.name, BridgeStatus.GOOD, "messages come again")
        return None

    def _status_now(self, age_ns: int) -> BridgeStatus:
        if self._received is BridgeStatus.NONE:
            return BridgeStatus.NONE
        has_gone = not self._subscriber.publishers
        is_old = age_ns > self._timeout_ns if self._timeout_ns else has_gone
        return BridgeStatus.STALE if is_old else self._received

    def _value_of(self, message: Message) -> object:
        return self._conversion.to_tag(message, self._tags.read(self._tag))


def age_tag(tags: TagTable, path: str | None) -> Tag | None:
    """Return the tag that is told how old a value is, None where none is named.

    Raises:
        ConfigurationError: it is no TIME.
        TagError: there is no such tag.
    """
    if path is None:
        return None
    tag = tags.find(path)
    if resolve_alias(tag.data_type) is not TIME:
        raise ConfigurationError(f"age: tag {path} is {tag.data_type}, not TIME")
    return tag
