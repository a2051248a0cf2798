"""What the pages are told of the border of a controller: topics of its nodes, idents in use.

Counted in the scan process, and told once a second while the scan is idle. Sockets are not asked
for their addresses here: a recording would hold the answers, and a replay has no pages to ask. The
kernel tells them to the service (`plcsim.web.service.network`).
"""

from __future__ import annotations

import json
from itertools import chain, islice
from typing import TYPE_CHECKING, Final

from plcsim.core.traffic import TopicEnds
from plcsim.library import astcp
from plcsim.library.astcp.idents import IdentTable
from plcsim.library.idents import Idents
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_OK
from plcsim.shared_image.events import EventKind

if TYPE_CHECKING:
    from plcsim.core.controller import Controller
    from plcsim.core.traffic import Crossing, Topic
    from plcsim.network.protocol import Address
    from plcsim.shared_image.stream import StreamWriter

NOBODY: Final = TopicEnds((), 0)
PERIOD_NS: Final = 1_000_000_000
ENOUGH_NS: Final = 300_000
"""It is told where the scan sleeps so long at least; it takes some 50 us."""

MOST_TOPICS: Final = 200
MOST_PEERS: Final = 20
"""Of one topic that are told."""

MOST_IDENTS: Final = 200


STATUSES: Final = {
    ERR_OK: "ERR_OK",
    ERR_FUB_BUSY: "ERR_FUB_BUSY",
    **{getattr(astcp, n): n for n in vars(astcp) if n.startswith("tcpERR_")},
}
"""What AsTCP blocks answer, by its number."""


class BorderReport:
    """Counts what crosses the border of a controller.

    Args:
        controller: before its boot.
    """

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self._stream: StreamWriter | None = None
        self._topics: dict[tuple[str, str, bool], tuple[Topic, list[int]]] = {}
        self._due_ns = 0
        self._told = b""

    def connect(self, stream: StreamWriter) -> None:
        """Tell through this stream from now on."""
        self._stream = stream
        self._controller.context.traffic.followers.append(self.count)
        self._controller.scan.idlers.append(self.idle)

    def count(self, crossing: Crossing) -> None:
        """Count a message."""
        number, message = crossing
        topic = self._controller.context.traffic.topics[number]
        key = topic.node, topic.name, topic.is_sent
        found = self._topics.get(key)
        if found is None:
            if len(self._topics) >= MOST_TOPICS:
                return
            found = self._topics[key] = topic, [0, 0]
        found[1][0] += 1
        found[1][1] += len(message)

    def idle(self, idle_ns: int) -> None:
        """Tell, where something has changed and there is time."""
        now_ns = self._controller.clock.stamp_ns()
        if now_ns < self._due_ns or idle_ns < ENOUGH_NS or self._stream is None:
            return
        self._due_ns = now_ns + PERIOD_NS
        data = json.dumps(
            {"topics": self._rows(), "idents": self._idents(), "tcp": self._tcp()}
        ).encode()
        if data != self._told:
            self._told = data
            time_ns = now_ns - self._controller.origin_ns
            self._stream.write(EventKind.RECORD.value, time_ns, data)

    def _rows(self) -> list[list[object]]:
        """Return node, name, type, direction, messages, bytes, losses and peers of each topic."""
        ends = self._controller.context.traffic.ends
        known = {(t.node, t.name, t.is_sent): (t, found()) for t, found in ends.items()}
        silent = [(t, [0, 0]) for key, (t, _) in known.items() if key not in self._topics]
        rows: list[list[object]] = []
        for topic, counts in (*self._topics.values(), *silent[:MOST_TOPICS]):
            _, other = known.get((topic.node, topic.name, topic.is_sent), (topic, NOBODY))
            told = [*counts, other.lost, list(other.peers[:MOST_PEERS])]
            rows.append([topic.node, topic.name, topic.type_name, topic.is_sent, *told])
        return rows

    def _tcp(self) -> list[list[object]]:
        """Return ident, peer, and the block that was called last with its status, of AsTCP."""
        tables = (t for t in self._controller.context.libraries() if isinstance(t, IdentTable))
        return [
            [ident, _address(end.peer), end.block, STATUSES.get(end.status, str(end.status))]
            for ident, end in islice(chain.from_iterable(tables), MOST_IDENTS)
        ]

    def _idents(self) -> dict[str, int]:
        """Return how many idents each library has in use."""
        return {
            type(state).__module__.split(".")[-2]: len(state)
            for state in self._controller.context.libraries()
            if isinstance(state, Idents)
        }


def _address(address: Address | None) -> str:
    if address is None:
        return ""
    ip = f"[{address.ip}]" if ":" in address.ip else address.ip
    return f"{ip}:{address.port}"
