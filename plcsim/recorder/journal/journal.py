"""What came in since the last record."""

from __future__ import annotations

from plcsim.recorder.journal.record import Entry, Record


class Journal:
    """Gathers what clock, network and writers outside give.

    Attributes:
        clock: answers of the clock.
        network: answers of the network.
    """

    __slots__ = ("_latches", "_writes", "clock", "network")

    def __init__(self) -> None:
        self.clock: list[int] = []
        self.network = bytearray()
        self._writes = bytearray()
        self._latches = 0

    def latched(self) -> None:
        """Note that a LATCH begins."""
        self._latches += 1

    def wrote(self, address: int, data: bytes) -> None:
        """Note a store from outside, or with address 0 a new list of forced tags."""
        self._writes += Entry(self._latches, address, data).to_bytes()

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
            variables,
        )
        self.clock.clear()  # the lists stay the same: clock and network hold on to them
        self.network.clear()
        self._writes.clear()
        self._latches = 0
        return record
