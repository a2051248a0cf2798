"""Records of the journal: what came in up to a PUBLISH or a step, and the variables there."""

from __future__ import annotations

import marshal
import struct
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.control import Ending
from plcsim.core.traffic import Topic

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

CYCLE: Final = 0
"""`JournalRecord.step` of a cycle; any other is a `plcsim.core.control.Step` that comes next."""

NO_CLASS: Final = 0
"""`JournalRecord.task_class` of a step."""

LIMITS: Final = struct.Struct("<qq")
"""``variables`` of the step RUN: its end on the clock and its cycles, 0 for none."""

_ENTRY: Final = struct.Struct("<III")


class ClassTiming(NamedTuple):
    """Timing of a task class, as known in PUBLISH of one of its cycles or before a step.

    Attributes:
        task_class: its number.
        cycles: begun so far.
        executed: the cycle that ``execution_ns`` is of; in PUBLISH the one before, for the time of
            this one is not over.
        missed: grid points skipped so far.
        violations: of the cycle time, so far.
        lateness_ns: from the release to the start of the latest cycle.
        execution_ns: CPU time of the programs of a cycle.
        is_service: the controller is in SERVICE.
    """

    task_class: int
    cycles: int
    executed: int
    missed: int
    violations: int
    lateness_ns: int
    execution_ns: int
    is_service: bool


class JournalRecord(NamedTuple):
    """One record.

    Attributes:
        step: `CYCLE`, or the value of the step that follows.
        task_class: number of the class whose cycle ends, `NO_CLASS` where none does.
        cycle: of that class, from 1.
        time_ns: release of the cycle on the controller's clock; of a step, the time.
        clock: answers of the clock, in nanoseconds and counts, in order: 64-bit numbers, see
            `numbers_of`.
        network: answers of the network, as `plcsim.recorder.journal.network` writes them.
        writes: what was written and forced from outside, see `entries`.
        variables: all variables afterwards, empty where they are too many; of a step see `LIMITS`.
        topics: that are described here, by their numbers; none in what is read from a bag.
        messages: that programs sent and received, with the numbers of their topics; as above.
        timings: of the class whose cycle ends; before a boot and at the end of all. As above, for a
            replay makes no use of them.
    """

    step: int
    task_class: int
    cycle: int
    time_ns: int
    clock: bytes
    network: bytes
    writes: bytes
    variables: bytes
    topics: Sequence[tuple[int, Topic]] = ()
    messages: Sequence[tuple[int, bytes]] = ()
    timings: Sequence[ClassTiming] = ()


def record_of(data: bytes) -> JournalRecord:
    """Return the record of `plcsim.recorder.journal.tape.Tape`."""
    number, *told, topics, gathered = marshal.loads(data)  # noqa: S302  # from the scan, through its own memory
    clock, network, writes, messages, variables = gathered
    if number == NO_CLASS:
        step, time_ns, given, timings = told
        cycle, variables = 0, [given]
    else:
        cycle, time_ns, *figures = told
        step, timings = CYCLE, [(number, cycle, cycle - 1, *figures)]
    return JournalRecord(
        step,
        number,
        cycle,
        time_ns,
        struct.pack(f"<{len(clock)}q", *clock),
        network,
        writes,
        b"".join(variables),
        [(number, Topic(*each)) for number, each in topics],
        messages,
        [*map(ClassTiming._make, timings)],
    )


def numbers_of(clock: bytes) -> tuple[int, ...]:
    """Return `JournalRecord.clock` as numbers."""
    return struct.unpack(f"<{len(clock) // 8}q", clock)


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
