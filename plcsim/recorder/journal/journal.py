"""What came in since the last record."""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Final

from plcsim.recorder.journal.record import (
    HAND_IN,
    JournalStore,
    hand_in_data,
    packet_head,
    record_head,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.control import Ending
    from plcsim.core.traffic import Topic

TOPIC_EVERY: Final = 1000
"""Messages of a topic after which it is described again."""


def topic_text(topic: Topic) -> bytes:
    """Return a topic as JSON."""
    return json.dumps(topic._asdict()).encode()


class _Known:
    """A topic that has a number; it is found by its identity, which takes a tenth of the time."""

    __slots__ = ("head", "left", "number", "size", "topic")

    def __init__(self, topic: Topic, number: int) -> None:
        self.topic = topic  # as long as it is here, no other one has its identity
        self.number = number
        self.left = 0
        self.size = 0
        self.head = packet_head(number, 0)


class Journal:
    """Gathers what clock, network and writers outside give.

    Attributes:
        clock: answers of the clock.
        network: answers of the network.
    """

    __slots__ = ("_latches", "_messages", "_topics", "_writes", "clock", "network")

    def __init__(self) -> None:
        self.clock: list[int] = []
        self.network = bytearray()
        self._writes = bytearray()
        self._messages: list[bytes | memoryview] = []
        self._topics: dict[int, _Known] = {}
        self._latches = 0

    def latched(self) -> None:
        """Note that a LATCH begins."""
        self._latches += 1

    def wrote(self, address: int, data: bytes) -> None:
        """Note a store from outside, or with address 0 a new list of forced tags."""
        self._writes += JournalStore(self._latches, address, data).to_bytes()

    def handed_in(self, node: str, topic: str, body: bytes) -> None:
        """Note a message that was given to a node past the network."""
        self.wrote(HAND_IN, hand_in_data(node, topic, body))

    def asked_to_end(self, ending: Ending) -> None:
        """Note that the run shall end after this cycle: from here on nothing preempts it."""
        self._writes += JournalStore(len(self.clock), ending.value, b"").to_bytes()

    def crossed(self, topic: Topic, body: bytes | memoryview) -> None:
        """Note a message; now and then what it goes over, for a recorder that came later."""
        found = self._topics.get(id(topic))
        if found is None or not found.left:
            found = self._described(topic, found)
        found.left -= 1
        size = len(body)
        if size != found.size:
            found.size = size
            found.head = packet_head(found.number, size)
        self._messages += found.head, body

    def _described(self, topic: Topic, found: _Known | None) -> _Known:
        """Note a topic; return what is known of it."""
        if found is None:
            found = self._topics[id(topic)] = _Known(topic, len(self._topics))
        found.left = TOPIC_EVERY
        text = topic_text(topic)
        self._messages += packet_head(found.number, len(text), is_topic=True), text
        return found

    def take(
        self,
        step: int,
        task_class: int,
        cycle: int,
        time_ns: int,
        variables: Sequence[bytes | memoryview],
    ) -> bytes:
        """Return what was gathered as the bytes of a record, and begin the next.

        Args:
            step: as of `Record`; task_class, cycle, time_ns too.
            task_class: see there.
            cycle: see there.
            time_ns: see there.
            variables: see there, in pieces.
        """
        clock, network, writes = self.clock, self.network, self._writes
        messages = b"".join(self._messages)
        sizes = (8 * len(clock), len(network), len(writes), len(messages))
        head = record_head(step, task_class, sizes, cycle, time_ns)
        numbers = struct.pack(f"<{len(clock)}q", *clock)
        data = b"".join((head, numbers, network, writes, messages, *variables))
        clock.clear()  # the lists stay the same: clock and network hold on to them
        network.clear()
        writes.clear()
        self._messages.clear()
        self._latches = 0
        return data
