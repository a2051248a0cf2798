"""What came in since the last record."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.recorder.journal.record import (
    HAND_IN,
    JournalStore,
    hand_in_data,
)

if TYPE_CHECKING:
    from plcsim.core.control import Ending
    from plcsim.core.traffic import Crossing


class Journal:
    """Gathers what clock, network and writers outside give.

    `plcsim.recorder.journal.tape` makes records of it and clears what it took. Who gathers adds to
    the lists by their own methods, which are no functions of Python.

    Attributes:
        clock: answers of the clock, 64-bit numbers.
        latches: one entry for each LATCH that began.
        messages: that programs sent and received.
        network: answers of the network.
        writes: what was written from outside, see `plcsim.recorder.journal.record.entries`.
    """

    __slots__ = ("clock", "latches", "messages", "network", "writes")

    def __init__(self) -> None:
        self.clock: list[int] = []
        self.latches: list[object] = []
        self.messages: list[Crossing] = []
        self.network = bytearray()
        self.writes = bytearray()

    def wrote(self, address: int, data: bytes) -> None:
        """Note a store from outside, or with address 0 a new list of forced tags."""
        self.writes += JournalStore(len(self.latches), address, data).to_bytes()

    def handed_in(self, node: str, topic: str, body: bytes) -> None:
        """Note a message that was given to a node past the network."""
        self.wrote(HAND_IN, hand_in_data(node, topic, body))

    def asked_to_end(self, ending: Ending) -> None:
        """Note that the run shall end after this cycle: from here on nothing preempts it."""
        self.writes += JournalStore(len(self.clock), ending.value, b"").to_bytes()
