"""What came in since the last record."""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Final

from plcsim.recorder.journal.record import Entry, Record, packet

if TYPE_CHECKING:
    from plcsim.core.control import Ending
    from plcsim.core.traffic import Topic

TOPIC_EVERY: Final = 1000
"""Messages of a topic after which it is described again."""


def topic_text(topic: Topic) -> bytes:
    """Return a topic as JSON."""
    return json.dumps(topic._asdict()).encode()


class _Known:
    """A topic that has a number; it is found by its identity, which takes a tenth of the time."""

    __slots__ = ("left", "number", "topic")

    def __init__(self, topic: Topic, number: int) -> None:
        self.topic = topic  # as long as it is here, no other one has its identity
        self.number = number
        self.left = 0


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
        self._messages = bytearray()
        self._topics: dict[int, _Known] = {}
        self._latches = 0

    def latched(self) -> None:
        """Note that a LATCH begins."""
        self._latches += 1

    def wrote(self, address: int, data: bytes) -> None:
        """Note a store from outside, or with address 0 a new list of forced tags."""
        self._writes += Entry(self._latches, address, data).to_bytes()

    def asked_to_end(self, ending: Ending) -> None:
        """Note that the run shall end after this cycle: from here on nothing preempts it."""
        self._writes += Entry(len(self.clock), ending.value, b"").to_bytes()

    def crossed(self, topic: Topic, body: bytes | memoryview) -> None:
        """Note a message; now and then what it goes over, for a recorder that came later."""
        found = self._topics.get(id(topic))
        if found is None:
            found = self._topics[id(topic)] = _Known(topic, len(self._topics))
        if not found.left:
            found.left = TOPIC_EVERY
            self._messages += packet(found.number, topic_text(topic), is_topic=True)
        found.left -= 1
        self._messages += packet(found.number, body)

    def take(
        self, step: int, task_class: int, cycle: int, time_ns: int, variables: bytes
    ) -> Record:
        """Return what was gathered as a record, and begin the next; arguments as of `Record`."""
        record = Record(
            step,
            task_class,
            cycle,
            time_ns,
            struct.pack(f"<{len(self.clock)}q", *self.clock),
            bytes(self.network),
            bytes(self._writes),
            bytes(self._messages),
            variables,
        )
        self.clock.clear()  # the lists stay the same: clock and network hold on to them
        self.network.clear()
        self._writes.clear()
        self._messages.clear()
        self._latches = 0
        return record
