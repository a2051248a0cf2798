"""The bridge without code: tags to topics and topics to tags, as [ros] in plc.toml says.

Messages come in in LATCH and go out in PUBLISH, so a program sees its inputs stand still; how
values and messages fit is in `crosnode.plc.conversion`. What the bridge's node has to tell goes
into the logbook, for no program drains its queue.
"""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any, Final, TypeVar

from crosnode.errors import CrosnodeError, MessageValueError
from crosnode.node import StatusKind
from crosnode.node.period import Period
from crosnode.node.publisher import printable
from crosnode.plc.conversion import tag_conversion
from crosnode.plc.project import make_node, surroundings
from crosnode.transport.budget import StepBudget
from crosnode.transport.link import QUIET_TURNS
from plcsim.core.errors import ConfigurationError, Findings, TagError
from plcsim.core.logbook import Severity
from st_types.errors import ValueRangeError
from st_types.types.values import decode, encode

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from crosnode.messages import Message
    from crosnode.node import CrosNode, Publisher, Status, Subscriber
    from crosnode.plc.settings import Publication, Subscription
    from plcsim.core.controller import Controller

T = TypeVar("T")
E = TypeVar("E", "Publication", "Subscription")

NEWS: Final = {
    StatusKind.MASTER_FOUND: Severity.INFORMATION,
    StatusKind.MASTER_LOST: Severity.WARNING,
    StatusKind.REGISTRATION_REFUSED: Severity.WARNING,
    StatusKind.SHUTDOWN: Severity.WARNING,
    StatusKind.BEHIND: Severity.WARNING,
}
REPEATED_NEWS: Final = frozenset(
    (StatusKind.BAD_MESSAGE, StatusKind.NAME_TAKEN, StatusKind.PEER_REFUSED)
)
"""What a peer could fill the logbook with: warned of at the first, second, fourth, eighth..."""


class Bridge:
    """The bridge's node and its topics; one for each start of a controller.

    Args:
        controller: whose tags are bridged.

    Raises:
        ConfigurationError: an entry that cannot work.

    Attributes:
        node: the node.
        refused: messages that a tag, and values that a message, could not take.
    """

    def __init__(self, controller: Controller) -> None:
        found = surroundings(controller.context)
        assert found is not None
        settings = found.settings
        self._file = settings.file
        self.node: CrosNode = make_node(controller.context, settings.table.node)
        self.refused = 0
        self._repeated: Counter[StatusKind] = Counter()
        self._controller = controller
        findings = Findings()
        self._out = self._made(findings, Outgoing, "publish", settings.table.publish)
        self._in = self._made(findings, Incoming, "subscribe", settings.table.subscribe)
        findings.check()

    def _made(
        self,
        findings: Findings,
        cls: Callable[[Controller, CrosNode, str, E], T],
        key: str,
        topics: Mapping[str, E],
    ) -> list[T]:
        made = []
        for topic, entry in topics.items():
            try:
                made.append(cls(self._controller, self.node, topic, entry))
            except (ConfigurationError, CrosnodeError, TagError) as error:
                text = f"{self._file}: ros.{key}.{topic}: {error}"
                findings.add(ConfigurationError(text))
        return made

    def latch(self) -> None:
        """Do the node's step, then give tags the newest messages."""
        self.node.do_events_loop()
        if (status := self.node.pop_status()) is not None:
            self._log_news(status)
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
            node.core.loop.step(self._controller.context.release_ns, StepBudget(node.pace.limits))
        node.destroy()

    def _log_news(self, status: Status) -> None:
        kind, name, text = status
        line = printable(f"{kind.name.lower().replace('_', ' ')} {name}: {text}".rstrip(": "))
        if kind in NEWS:
            self._controller.log(NEWS[kind], "ros", line)
        elif kind in REPEATED_NEWS:
            self._repeated[kind] += 1
            if is_power_of_two(self._repeated[kind]):
                line += f" ({self._repeated[kind]} so far)"
                self._controller.log(Severity.WARNING, "ros", line)

    def _checked(self, name: str, act: Any) -> None:
        """Count and log what does not fit; the scan goes on."""
        try:
            act()
        except (TagError, MessageValueError) as error:
            self.refused += 1
            if is_power_of_two(self.refused):
                text = f"{name}: {error} ({self.refused} refused so far)"
                self._controller.log(Severity.WARNING, "ros", text)


def is_power_of_two(number: int) -> bool:
    """Return whether a count above 0 is the first, second, fourth, eighth..."""
    return number & (number - 1) == 0


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
        self._conversion = tag_conversion(node.types, found, data_type, self._tag.path)
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
        if self._period and not self._period.is_due(release_ns):
            return
        value = self._tags.read(self._tag)
        if self._on_change and value == self._last:
            return
        self._last = value
        message = self._conversion.to_field(value)
        if not self._on_change:
            self._publisher.send(message)
            return
        body = bytes(self._publisher.message_type.encode(message))
        if body != self._body:  # NaN is another value than itself, and yet no change
            self._body = body
            self._publisher.send(message)


class Incoming:
    """A tag that takes the newest message of a topic; arguments as for ``Outgoing``."""

    def __init__(
        self, controller: Controller, node: CrosNode, topic: str, entry: Subscription
    ) -> None:
        self.name = topic
        self._tags = controller.tags
        self._tag = controller.tags.find(entry.tag)
        self._subscriber: Subscriber = node.register_subscriber(
            topic, entry.type_name, queue_size=1
        )
        found = self._subscriber.message_type
        self._conversion = tag_conversion(node.types, found, self._tag.data_type, self._tag.path)
        try:
            encode(self._tag.data_type, self._value_of(found.new()))
        except ValueRangeError as error:
            raise ConfigurationError(f"tag {self._tag.path}: {found.name}: {error}") from None

    def take(self) -> None:
        """Write the newest message into the tag."""
        message = self._subscriber.pop()
        if message is not None:
            self._tags.write(self._tag, self._value_of(message))

    def _value_of(self, message: Message) -> object:
        return self._conversion.to_tag(message, self._tags.read(self._tag))
