"""What happened, as records of the stream of events: entries of the logbook and violations."""

from __future__ import annotations

import struct
from enum import Enum
from typing import TYPE_CHECKING

from plcsim.core.logbook import Entry, Severity
from plcsim.core.task import Cause, Violation

if TYPE_CHECKING:
    from plcsim.shared_image.stream import StreamReader, StreamRecord

_SEVERITIES = tuple(Severity)
_CAUSES = tuple(Cause)
_ENTRY = struct.Struct("<BxH")
_VIOLATION = struct.Struct("<BBHqqqqqqq")


class EventKind(Enum):
    """Kinds of records in streams."""

    ENTRY = 1
    VIOLATION = 2
    SAMPLE = 3
    RECORD = 4
    CYCLE = 5
    HISTOGRAM = 6


def encode_entry(entry: Entry) -> bytes:
    """Return an entry of the logbook as data of a record; its time is the record's."""
    source = entry.source.encode("utf-8", "replace")
    head = _ENTRY.pack(_SEVERITIES.index(entry.severity), len(source))
    return head + source + entry.text.encode("utf-8", "replace")


def entry_of(record: StreamRecord) -> Entry:
    """Return the entry of the logbook in a record."""
    severity, length = _ENTRY.unpack_from(record.data)
    at = _ENTRY.size
    source, text = record.data[at : at + length], record.data[at + length :]
    return Entry(
        record.time_ns, _SEVERITIES[severity], source.decode("utf-8", "replace"),
        text.decode("utf-8", "replace"),
    )  # fmt: skip


def encode_violation(violation: Violation) -> bytes:
    """Return a violation as data of a record."""
    program = violation.program.encode("utf-8", "replace")
    head = _VIOLATION.pack(
        violation.task_class,
        _CAUSES.index(violation.cause),
        len(program),
        violation.cycle,
        violation.release_ns,
        violation.response_ns,
        violation.own_ns,
        violation.others_ns,
        violation.controller_ns,
        violation.limit_ns,
    )
    return head + program + violation.location.encode("utf-8", "replace")


def violation_of(record: StreamRecord) -> Violation:
    """Return the violation in a record."""
    number, cause, length, cycle, *durations = _VIOLATION.unpack_from(record.data)
    at = _VIOLATION.size
    program = record.data[at : at + length].decode("utf-8", "replace")
    location = record.data[at + length :].decode("utf-8", "replace")
    release_ns, response_ns, own_ns, others_ns, controller_ns, limit_ns = durations
    return Violation(
        number, program, cycle, _CAUSES[cause], release_ns, response_ns, own_ns, others_ns,
        controller_ns, limit_ns, location,
    )  # fmt: skip


class LogbookReader:
    """The logbook of a controller that runs in another process.

    Args:
        events: a reader of what happens.
    """

    def __init__(self, events: StreamReader) -> None:
        self._events = events

    @property
    def lost(self) -> int:
        """Entries, and violations between them, that were overwritten before they were read."""
        return self._events.lost

    def read(self) -> list[Entry]:
        """Return the entries that are new, the oldest first."""
        entries: list[Entry] = []
        while records := self._events.read():
            entries += (entry_of(r) for r in records if r.kind == EventKind.ENTRY.value)
        return entries
