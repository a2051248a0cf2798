"""Records of the journal: what came in up to a PUBLISH or a step, and the variables there."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.control import Ending

if TYPE_CHECKING:
    from collections.abc import Iterator

CYCLE: Final = 0
"""`JournalRecord.step` of a cycle; any other is a `plcsim.core.control.Step` that comes next."""

LIMITS: Final = struct.Struct("<qq")
"""``variables`` of the step RUN: its end on the clock and its cycles, 0 for none."""

_HEAD: Final = struct.Struct("<BBxxIIIIqq")
_ENTRY: Final = struct.Struct("<III")
_PACKET: Final = struct.Struct("<H?xI")


class JournalRecord(NamedTuple):
    """One record.

    Attributes:
        step: `CYCLE`, or the value of the step that follows.
        task_class: number of the class whose cycle ends, 0 where none does.
        cycle: of that class, from 1.
        time_ns: release of the cycle on the controller's clock; of a step, the time.
        clock: answers of the clock, in nanoseconds and counts, in order: 64-bit numbers, see
            `numbers_of`.
        network: answers of the network, as `plcsim.recorder.journal.network` writes them.
        writes: what was written and forced from outside, see `entries`.
        messages: that programs sent and received, see `packets`.
        variables: all variables afterwards, empty where they are too many; of a step see `LIMITS`.
    """

    step: int
    task_class: int
    cycle: int
    time_ns: int
    clock: bytes
    network: bytes
    writes: bytes
    messages: bytes
    variables: bytes


def record_head(
    step: int, task_class: int, sizes: tuple[int, int, int, int], cycle: int, time_ns: int
) -> bytes:
    """Return what stands before clock, network, writes, messages and variables of a record.

    Args:
        step: as of `JournalRecord`; task_class, cycle, time_ns too.
        task_class: see there.
        sizes: bytes of clock, network, writes and messages.
        cycle: see there.
        time_ns: see there.
    """
    return _HEAD.pack(step, task_class, *sizes, cycle, time_ns)


def record_of(data: bytes) -> JournalRecord:
    """Return the record of `plcsim.recorder.journal.journal.Journal.take`."""
    step, task_class, *sizes, cycle, time_ns = _HEAD.unpack_from(data)
    at = _HEAD.size
    parts = []
    for size in sizes:
        parts.append(data[at : at + size])
        at += size
    clock, network, writes, messages = parts
    return JournalRecord(
        step, task_class, cycle, time_ns, clock, network, writes, messages, data[at:]
    )


def numbers_of(clock: bytes) -> tuple[int, ...]:
    """Return `JournalRecord.clock` as numbers."""
    return struct.unpack(f"<{len(clock) // 8}q", clock)


class JournalMessage(NamedTuple):
    """A message that crossed the border, or what it goes over.

    Attributes:
        topic: number of the topic.
        is_topic: ``data`` is the `plcsim.core.traffic.Topic` as JSON, not a message.
        data: the bytes.
    """

    topic: int
    is_topic: bool
    data: bytes


def packet_head(topic: int, size: int, *, is_topic: bool = False) -> bytes:
    """Return what stands before the ``size`` bytes of a `JournalMessage`."""
    return _PACKET.pack(topic, is_topic, size)


def packets(messages: bytes) -> Iterator[JournalMessage]:
    """Return the packets of `JournalRecord.messages`."""
    at = 0
    while at < len(messages):
        topic, is_topic, size = _PACKET.unpack_from(messages, at)
        at += _PACKET.size
        yield JournalMessage(topic, is_topic, messages[at : at + size])
        at += size


class JournalStore(NamedTuple):
    """What was written from outside.

    Attributes:
        latch: in which LATCH since the last record, from 1; 0 between two cycles. Of an ending, how
            many answers the clock had given since.
        address: of the bytes; 0 where ``data`` is the whole list of forced tags, and the values of
            `plcsim.core.control.Ending` where a run was asked to end, and `HAND_IN`.
        data: the bytes.
    """

    latch: int
    address: int
    data: bytes

    def to_bytes(self) -> bytes:
        """Return the entry as `entries` reads it."""
        return _ENTRY.pack(self.latch, self.address, len(self.data)) + self.data


HAND_IN: Final = 16
"""Address of an entry for a message that was handed to a node, see `hand_in_data`."""


def hand_in_data(node: str, topic: str, body: bytes) -> bytes:
    """Return the data of an entry at `HAND_IN`."""
    return b"\0".join((node.encode(), topic.encode(), body))


def handed_in(data: bytes) -> tuple[str, str, bytes]:
    """Return node, topic and message of `hand_in_data`."""
    node, topic, body = data.split(b"\0", 2)
    return node.decode(), topic.decode(), body


ENDINGS: Final = {each.value: each for each in Ending}
"""Addresses of entries that are no writes."""


def entries(writes: bytes) -> Iterator[JournalStore]:
    """Return the entries of `JournalRecord.writes`."""
    at = 0
    while at < len(writes):
        latch, address, size = _ENTRY.unpack_from(writes, at)
        at += _ENTRY.size
        yield JournalStore(latch, address, writes[at : at + size])
        at += size
