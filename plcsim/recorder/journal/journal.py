"""What came in since the last record."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Final

from plcsim.recorder.journal.record import Entry, Packet, Record

if TYPE_CHECKING:
    from plcsim.core.traffic import Topic

TOPIC_EVERY: Final = 1000
"""Messages of a topic after which it is described again."""


def _text(topic: Topic) -> bytes:
    return json.dumps(topic._asdict()).encode()


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
        self._topics: dict[Topic, list[int]] = {}
        self._latches = 0

    def latched(self) -> None:
        """Note that a LATCH begins."""
        self._latches += 1

    def wrote(self, address: int, data: bytes) -> None:
        """Note a store from outside, or with address 0 a new list of forced tags."""
        self._writes += Entry(self._latches, address, data).to_bytes()

    def crossed(self, topic: Topic, body: bytes | memoryview) -> None:
        """Note a message; now and then what it goes over, for a recorder that came later."""
        numbers = self._topics.get(topic)
        if numbers is None:
            numbers = self._topics[topic] = [len(self._topics), 0]
        number, count = numbers
        if count % TOPIC_EVERY == 0:
            self._messages += Packet(number, is_topic=True, data=_text(topic)).to_bytes()
        numbers[1] = count + 1
        self._messages += Packet(number, is_topic=False, data=body).to_bytes()

    def take(
        self, step: int, task_class: int, cycle: int, time_ns: int, variables: bytes
    ) -> Record:
        """Return what was gathered as a record, and begin the next; arguments as of `Record`."""
        record = Record(
            step,
            task_class,
            cycle,
            time_ns,
            tuple(self.clock),
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
