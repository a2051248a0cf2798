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
from crosnode.node.publisher import printable
from crosnode.plc.bridge_services import CalledService, FollowedParameter, TagService
from crosnode.plc.bridge_topics import BridgeStatus, Incoming, Outgoing
from crosnode.plc.project import make_node, surroundings
from plcsim.core.errors import ConfigurationError, Findings, TagError
from plcsim.core.logbook import Severity

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from crosnode.node import CrosNode, Status
    from crosnode.plc.bridge_topics import StatusChange
    from crosnode.plc.settings import (
        CallEntry,
        ParameterEntry,
        Publication,
        ServiceEntry,
        Subscription,
    )
    from plcsim.core.controller import Controller

T = TypeVar("T")
E = TypeVar("E", "Publication", "Subscription", "ParameterEntry", "ServiceEntry", "CallEntry")

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
        self._changes: Counter[tuple[str, BridgeStatus]] = Counter()
        self._controller = controller
        findings = Findings()
        self._out = self._made(findings, Outgoing, "publish", settings.table.publish)
        self._in = self._made(findings, Incoming, "subscribe", settings.table.subscribe)
        self._params = self._made(
            findings, FollowedParameter, "parameters", settings.table.parameters
        )
        self._services = self._made(findings, TagService, "services", settings.table.services)
        self._calls = self._made(findings, CalledService, "calls", settings.table.calls)
        findings.check()
        self._takers: list[Incoming | FollowedParameter | TagService | CalledService]
        self._takers = [*self._in, *self._params, *self._services, *self._calls]

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
        for taker in self._takers:
            self._checked(taker.name, taker.take)
        for incoming in self._in:
            if change := incoming.look():
                self._log_change(change)

    def publish(self, release_ns: int) -> None:
        """Send the tags that are due, and answer the calls that are done."""
        for service in self._services:
            self._checked(service.name, service.answer)
        for called in self._calls:
            self._checked(called.name, called.call)
        for outgoing in self._out:
            self._checked(outgoing.name, lambda each=outgoing: each.send(release_ns))

    def close(self) -> None:
        """End with the controller, whose sockets are closed already: take back by a new one."""
        node = self.node
        node.core.loop.end_links(self._controller.context.release_ns)
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

    def _log_change(self, change: StatusChange) -> None:
        """Tell of values that have become old or good again, or that were cut."""
        self._changes[change.name, change.status] += 1
        count = self._changes[change.name, change.status]
        if is_power_of_two(count):
            is_good = change.status is BridgeStatus.GOOD
            severity = Severity.INFORMATION if is_good else Severity.WARNING
            self._controller.log(severity, "ros", f"{change.name}: {change.text} (x{count})")

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
