"""What came in since the last record."""

from __future__ import annotations

from marshal import dumps
from typing import TYPE_CHECKING, Any, Final

from plcsim.recorder.journal.record import (
    HAND_IN,
    JournalStore,
    hand_in_data,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.control import Ending
    from plcsim.core.traffic import Crossing, Topic

TOPICS_EVERY: Final = 1000
"""Records after which all topics are described again."""

_FORMAT: Final = 2
"""Of marshal; later ones look for what is the same twice."""

_NONE: Final = ()


class Journal:
    """Gathers what clock, network and writers outside give.

    Attributes:
        clock: answers of the clock.
        network: answers of the network.
        messages: that programs sent and received; to add one is all that it costs the program.
        topics: what they go over, by number.
    """

    __slots__ = (
        "_described",
        "_latches",
        "_left",
        "_writes",
        "clock",
        "messages",
        "network",
        "topics",
    )

    def __init__(self) -> None:
        self.clock: list[int] = []
        self.network = bytearray()
        self._writes = bytearray()
        self.messages: list[Crossing] = []
        self.topics: list[Topic] = []
        self._described = 0
        self._left = TOPICS_EVERY
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

    def _descriptions(self) -> list[tuple[int, tuple[object, ...]]]:
        """Return the topics that are new; now and then all, for a recorder that came later."""
        first = self._described if self._left else 0
        self._left = self._left or TOPICS_EVERY
        self._described = len(self.topics)
        return [(n, tuple(topic)) for n, topic in enumerate(self.topics)][first:]

    def take(
        self,
        step: int,
        task_class: int,
        cycle: int,
        time_ns: int,
        variables: Sequence[bytes | memoryview],
        timings: Sequence[tuple[int, ...]] = _NONE,
    ) -> bytes:
        """Return what was gathered as the bytes of a record, and begin the next.

        Args:
            step: as of `Record`; task_class, cycle, time_ns too.
            task_class: see there.
            cycle: see there.
            time_ns: see there.
            variables: see there, in pieces.
            timings: see there, each a plain tuple.
        """
        self._left -= 1
        is_known = self._left and len(self.topics) == self._described
        topics = _NONE if is_known else self._descriptions()
        clock, network, writes, messages = self.clock, self.network, self._writes, self.messages
        gathered: Any = clock, network, writes, topics, messages, variables, timings
        # one call, for after each sleep the caches are cold, and new code costs most
        data = dumps((step, task_class, cycle, time_ns, *gathered), _FORMAT)
        clock.clear()  # the lists stay the same: clock and network hold on to them
        network.clear()
        writes.clear()
        messages.clear()
        self._latches = 0
        return data
