"""The logbooks of a controller."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from plcsim.core.controller import Controller
from plcsim.core.logbook import Severity
from plcsim.library.areventlog.interface import (
    arEVENTLOG_SEVERITY_ERROR,
    arEVENTLOG_SEVERITY_INFO,
    arEVENTLOG_SEVERITY_WARNING,
)
from plcsim.library.idents import Idents

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context

SYSTEM: Final = "$arlogsys"
USER: Final = "$arlogusr"

MOST_LOGS: Final = 32
RECORD_SIZE: Final = 64
"""Bytes that a record takes of the size of its logbook, without its additional data."""

USER_SIZE: Final = 64 * 1024
NS_PER_SECOND: Final = 1_000_000_000

_SEVERITIES: Final = {
    Severity.INFORMATION: arEVENTLOG_SEVERITY_INFO,
    Severity.WARNING: arEVENTLOG_SEVERITY_WARNING,
    Severity.ERROR: arEVENTLOG_SEVERITY_ERROR,
}


@dataclass(frozen=True, slots=True)
class EventRecord:
    """One record.

    Attributes:
        event: severity, area, facility and code.
        origin: number of the record that led to this one, 0 for none.
        object_id: what it is about.
        format: of the additional data.
        data: additional.
        date_ns: nanoseconds since 1970.
        text: of the event, "" where nobody has one.
    """

    event: int
    origin: int
    object_id: str
    format: int
    data: bytes
    date_ns: int
    text: str = ""


class EventLog:
    """A logbook; where it is full, the oldest records make room.

    Args:
        name: of the logbook.
        size: bytes for records.
    """

    is_system = False

    def __init__(self, name: str, size: int) -> None:
        self.name = name
        self._records: OrderedDict[int, EventRecord] = OrderedDict()
        self._size = self._free = size
        self._last = 0

    def write(self, record: EventRecord) -> int:
        """Add a record; return its number."""
        self._free -= RECORD_SIZE + len(record.data)
        while self._free < 0 and self._records:
            _, oldest = self._records.popitem(last=False)
            self._free += RECORD_SIZE + len(oldest.data)
        self._last += 1
        self._records[self._last] = record
        return self._last

    def clear(self) -> None:
        """Delete all records; numbers go on."""
        self._records.clear()
        self._free = self._size

    @property
    def records(self) -> Mapping[int, EventRecord]:
        """The records by their numbers, in order."""
        return self._records


class SystemLog(EventLog):
    """The controller's own logbook."""

    is_system = True

    def __init__(self, context: Context) -> None:
        super().__init__(SYSTEM, 0)
        self._context = context

    @property
    def records(self) -> Mapping[int, EventRecord]:
        """Its lines."""
        controller = Controller.of(self._context)
        if controller is None:
            return {}
        origin_ns = self._context.date_ns - self._context.release_ns + controller.origin_ns
        lines = enumerate(controller.logbook, controller.logbook.dropped + 1)
        return {
            number: EventRecord(
                event_id(_SEVERITIES[entry.severity], 0, 0, is_customer=False),
                *(0, entry.source, 0, b""),
                origin_ns + entry.time_ns,
                entry.text,
            )
            for number, entry in lines
        }


class EventLogs(Idents[EventLog]):
    """The logbooks of a controller."""

    def __init__(self, context: Context) -> None:
        super().__init__(context, MOST_LOGS)
        self.add(SystemLog(context))
        self.add(EventLog(USER, USER_SIZE))

    def named(self, name: str) -> int:
        """Return the ident of a logbook, 0 where there is none of this name."""
        return next((ident for ident, log in self if log.name == name), 0)


def event_id(severity: int, facility: int, code: int, *, is_customer: bool) -> int:
    """Return an event as a DINT: two bits of severity, the area, twelve of facility, the code."""
    number = (severity & 3) << 30 | is_customer << 29 | (facility & 0xFFF) << 16 | code & 0xFFFF
    return number - (number >> 31 << 32)


def severity_of(event: int) -> int:
    """Return the severity of an event."""
    return event >> 30 & 3
