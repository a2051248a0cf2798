"""Blocks that write and read records."""

from __future__ import annotations

import struct
from typing import Final

from plcsim.core.controller import Controller
from plcsim.core.logbook import Severity
from plcsim.core.text import escaped
from plcsim.library.areventlog import interface
from plcsim.library.areventlog.block import (
    AsynchronousEventLogBlock,
    EventLogBlock,
)
from plcsim.library.areventlog.interface import (
    arEVENTLOG_ADDFORMAT_CODED,
    arEVENTLOG_ADDFORMAT_CUST_BASE,
    arEVENTLOG_ADDFORMAT_CUST_MAX,
    arEVENTLOG_ADDFORMAT_TEXT,
    arEVENTLOG_ERR_ADDDATA_NULL,
    arEVENTLOG_ERR_DESCRIPTION_NULL,
    arEVENTLOG_ERR_FORMAT_INVALID,
    arEVENTLOG_ERR_IDENT_SYSTEM,
    arEVENTLOG_ERR_NO_DESCRIPTION,
    arEVENTLOG_ERR_RECORDID_INVALID,
    arEVENTLOG_ERR_SIZE_INVALID,
    arEVENTLOG_SEVERITY_ERROR,
    arEVENTLOG_SEVERITY_WARNING,
)
from plcsim.library.areventlog.logs import NS_PER_SECOND, EventRecord, severity_of
from plcsim.library.block import StatusError

MOST_DATA: Final = 1000
"""Bytes of additional data."""

_TIME: Final = struct.Struct("<II")
_LEVELS: Final = {
    arEVENTLOG_SEVERITY_WARNING: Severity.WARNING,
    arEVENTLOG_SEVERITY_ERROR: Severity.ERROR,
}


def _is_format(number: int) -> bool:
    return (
        number <= arEVENTLOG_ADDFORMAT_CODED
        or arEVENTLOG_ADDFORMAT_CUST_BASE <= number <= arEVENTLOG_ADDFORMAT_CUST_MAX
    )


class ArEventLogWrite(interface.ArEventLogWrite, EventLogBlock):
    """Write a record, and a line of the controller's logbook. Output: RecordID.

    StatusID: arEVENTLOG_ERR_IDENT_INVALID, _IDENT_SYSTEM (the controller's own logbook),
    _FORMAT_INVALID, _ADDDATA_NULL, _SIZE_INVALID (more than `MOST_DATA` bytes of it).
    """

    def act(self) -> None:
        """Write it."""
        self.RecordID = 0
        if self.log.is_system:
            raise StatusError(arEVENTLOG_ERR_IDENT_SYSTEM)
        date_ns = self.context.date_ns
        if self.TimeStamp:
            seconds, rest_ns = _TIME.unpack(self.context.memory.read(self.TimeStamp, _TIME.size))
            date_ns = seconds * NS_PER_SECOND + rest_ns
        record = EventRecord(
            *(self.EventID, self.OriginRecordID, self.ObjectID, self.AddDataFormat),
            self._data(),
            date_ns,
        )
        self.RecordID = self.log.write(record)
        self._tell(record)

    def _data(self) -> bytes:
        """Return the additional data.

        Raises:
            StatusError: it cannot be had.
        """
        if not _is_format(self.AddDataFormat):
            raise StatusError(arEVENTLOG_ERR_FORMAT_INVALID)
        if not self.AddDataSize:
            return b""
        if not self.AddData:
            raise StatusError(arEVENTLOG_ERR_ADDDATA_NULL)
        if self.AddDataSize > MOST_DATA:
            raise StatusError(arEVENTLOG_ERR_SIZE_INVALID)
        return self.context.memory.read(self.AddData, self.AddDataSize)

    def _tell(self, record: EventRecord) -> None:
        controller = Controller.of(self.context)
        if controller is None:
            return
        text = f"event 16#{record.event & 0xFFFF_FFFF:08X} in {self.log.name}"
        if record.format == arEVENTLOG_ADDFORMAT_TEXT and record.data:
            own = record.data.partition(b"\0")[0].decode("latin-1")
            text = f"{escaped(own)} ({text})"
        _, task = controller.running
        source = record.object_id or (task.name if task else "system")
        level = _LEVELS.get(severity_of(record.event), Severity.INFORMATION)
        controller.log(level, escaped(source), text)


class ArEventLogGetLatestRecordID(interface.ArEventLogGetLatestRecordID, EventLogBlock):
    """The number of the latest record, 0 where there is none. StatusID: _IDENT_INVALID."""

    def act(self) -> None:
        """Look for it."""
        self.RecordID = 0
        self.RecordID = next(reversed([*self.log.records]), 0)


class ArEventLogGetPreviousRecordID(interface.ArEventLogGetPreviousRecordID, EventLogBlock):
    """The number of the record before, 0 for none. StatusID: _IDENT_INVALID, _RECORDID_INVALID."""

    def act(self) -> None:
        """Look for it."""
        self.PrevRecordID = 0
        numbers = [*self.log.records]
        if self.RecordID not in numbers:
            raise StatusError(arEVENTLOG_ERR_RECORDID_INVALID)
        place = numbers.index(self.RecordID)
        self.PrevRecordID = numbers[place - 1] if place else 0


class ArEventLogRead(interface.ArEventLogRead, EventLogBlock):
    """A record. Outputs: EventID, OriginRecordID, AddDataFormat, AddDataSize, TimeStamp.

    StatusID, here and below: arEVENTLOG_ERR_IDENT_INVALID, _RECORDID_INVALID.
    """

    def act(self) -> None:
        """Read it."""
        record = self.record
        self.EventID, self.OriginRecordID = record.event, record.origin
        self.AddDataFormat, self.AddDataSize = record.format, len(record.data)
        self.TimeStamp.sec, self.TimeStamp.nsec = divmod(record.date_ns, NS_PER_SECOND)


class ArEventLogReadAddData(interface.ArEventLogReadAddData, EventLogBlock):
    """Additional data of a record, at AddData. Output: AddDataSize. StatusID: _ADDDATA_NULL too."""

    def act(self) -> None:
        """Read it."""
        self.AddDataSize = 0
        data = self.record.data
        if not self.AddData:
            raise StatusError(arEVENTLOG_ERR_ADDDATA_NULL)
        self.context.memory.write(self.AddData, data[: self.BytesToRead])
        self.AddDataSize = len(data)


class ArEventLogReadObjectID(interface.ArEventLogReadObjectID, EventLogBlock):
    """What a record is about. Output: ObjectID."""

    def act(self) -> None:
        """Read it."""
        self.ObjectID = self.record.object_id[:36]


class ArEventLogReadErrorNumber(interface.ArEventLogReadErrorNumber, EventLogBlock):
    """Code and severity of a record. Outputs: ErrorNumber, Severity."""

    def act(self) -> None:
        """Read them."""
        event = self.record.event
        self.ErrorNumber, self.Severity = event & 0xFFFF, severity_of(event)


class ArEventLogReadDescription(interface.ArEventLogReadDescription, AsynchronousEventLogBlock):
    """Text of an event: lines of the controller's own logbook have one, those of programs none.

    Output: TextSize, with the NUL. StatusID: arEVENTLOG_ERR_NO_DESCRIPTION, _DESCRIPTION_NULL too.
    """

    def act(self) -> None:
        """Store it."""
        self.TextSize = 0
        text = self.record.text
        if not text:
            raise StatusError(arEVENTLOG_ERR_NO_DESCRIPTION)
        if not self.TextBuffer or not self.TextBufferSize:
            raise StatusError(arEVENTLOG_ERR_DESCRIPTION_NULL)
        stored = text.encode("latin-1", "replace")[: self.TextBufferSize - 1] + b"\0"
        self.context.memory.write(self.TextBuffer, stored)
        self.TextSize = len(stored)
