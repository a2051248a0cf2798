"""What the pages are told of the border of a controller: topics of its nodes, idents in use.

Counted in the scan process, and told once a second while the scan is idle. Sockets are not asked
for their addresses here: a recording would hold the answers, and a replay has no pages to ask. The
kernel tells them to the service (`plcsim.web.service.network`).
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Final

from plcsim.library.idents import Idents
from plcsim.shared_image.events import EventKind

if TYPE_CHECKING:
    from plcsim.core.controller import Controller
    from plcsim.core.traffic import Crossing, Topic
    from plcsim.shared_image.stream import StreamWriter

PERIOD_NS: Final = 1_000_000_000
ENOUGH_NS: Final = 300_000
"""It is told where the scan sleeps so long at least; it takes some 50 us."""

MOST_TOPICS: Final = 200


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
        data = json.dumps({"topics": self._rows(), "idents": self._idents()}).encode()
        if data != self._told:
            self._told = data
            time_ns = now_ns - self._controller.origin_ns
            self._stream.write(EventKind.RECORD.value, time_ns, data)

    def _rows(self) -> list[list[object]]:
        return [
            [topic.node, topic.name, topic.type_name, topic.is_sent, *counts]
            for topic, counts in self._topics.values()
        ]

    def _idents(self) -> dict[str, int]:
        """Return how many idents each library has in use."""
        return {
            type(state).__module__.split(".")[-2]: len(state)
            for state in self._controller.context.libraries()
            if isinstance(state, Idents)
        }
