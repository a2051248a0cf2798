"""The blocks of AsArLog."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from plcsim.core.controller import Controller
from plcsim.core.logbook import Severity
from plcsim.core.text import escaped
from plcsim.library.areventlog.interface import arEVENTLOG_ADDFORMAT_BINARY
from plcsim.library.areventlog.logs import (
    NS_PER_SECOND,
    SYSTEM,
    USER,
    USER_SIZE,
    EventLog,
    EventLogs,
    EventRecord,
    event_id,
    severity_of,
)
from plcsim.library.asarlog import interface
from plcsim.library.asarlog.interface import (
    arlogBASE_REDUND_LOG_IDENT,
    arlogBASE_SYSTEM_LOG_IDENT,
    arlogBASE_USER_LOG_IDENT,
    arlogDRAM,
    arlogERR_ACCESS_DENIED,
    arlogERR_CREATE,
    arlogERR_EXISTING,
    arlogERR_ILL_LEN,
    arlogERR_ILL_LOGLEVEL,
    arlogERR_ILL_MEMTYPE,
    arlogERR_ILL_NAME,
    arlogERR_INVALID_IDENT,
    arlogERR_INVALID_INDEX,
    arlogERR_NOMEMORY,
    arlogERR_NOTEXISTING,
    arlogERR_READ_ASCII_BUFFER,
    arlogERR_READ_BINARY_BUFFER,
    arlogERR_READ_BUFFER,
    arlogLEVEL_FATAL,
    arlogLEVEL_INFO,
    arlogLEVEL_WARNING,
    arlogMIN_LOGDATA_SIZE,
    arlogUSRRAM,
    arlogUSRROM,
    asarlogRead,
)
from plcsim.library.astime.structures import NS_PER_US, date_of
from plcsim.library.block import ActingBlock, AsynchronousBlock, StatusError
from plcsim.library.sys_lib.tasks import running_name

FIRST_OWN: Final = arlogBASE_REDUND_LOG_IDENT
"""What an ident of a logbook that programs make is above that of ArEventLog."""

LONGEST_NAME: Final = 255
LONGEST_TEXT: Final = 1000
MOST_DATA: Final = 1000
"""Bytes of an entry."""

FORMAT: Final = 1

_LEVELS: Final = {
    arlogLEVEL_INFO: Severity.INFORMATION,
    arlogLEVEL_WARNING: Severity.WARNING,
    arlogLEVEL_FATAL: Severity.ERROR,
}


@dataclass(frozen=True, slots=True)
class ArLogRecord(EventRecord):
    """An entry; its severity as an event is its level.

    Attributes:
        number: errornr.
    """

    number: int = 0


class ArLogbook(EventLog):
    """A logbook of AsArLogCreate.

    Args:
        name: of it.
        size: bytes for its entries.
        memory_type: that it was made with.
    """

    def __init__(self, name: str, size: int, memory_type: int) -> None:
        super().__init__(name, size)
        self.size = size
        self.memory_type = memory_type


class ArLogBlock(ActingBlock):
    """Base of the blocks."""

    __slots__ = ()

    @property
    def logs(self) -> EventLogs:
        """The logbooks of the controller."""
        return self.context.library(EventLogs)

    def log(self, ident: int) -> EventLog:
        """Return a logbook.

        Raises:
            StatusError: there is none with this ident.
        """
        base = {arlogBASE_SYSTEM_LOG_IDENT: SYSTEM, arlogBASE_USER_LOG_IDENT: USER}.get(ident)
        number = ident - FIRST_OWN if base is None else self.logs.named(base)
        found = self.logs.find(number) if base or ident > FIRST_OWN else None
        if found is None or (base is None and found.name in (SYSTEM, USER)):
            raise StatusError(arlogERR_INVALID_IDENT)
        return found

    def own(self, ident: int) -> EventLog:
        """Return a logbook that programs may delete.

        Raises:
            StatusError: there is none with this ident, or it is the controller's.
        """
        if ident <= FIRST_OWN:
            raise StatusError(arlogERR_ACCESS_DENIED)
        return self.log(ident)

    def name_at(self, address: int) -> str:
        """Return the name of a logbook.

        Raises:
            StatusError: there is none, or it is too long.
        """
        name = self.context.memory.string(address, LONGEST_NAME + 1) if address else b""
        if not 0 < len(name) <= LONGEST_NAME:
            raise StatusError(arlogERR_ILL_NAME)
        return name.decode("latin-1")


class AsynchronousArLogBlock(ArLogBlock, AsynchronousBlock):
    """Base of the blocks that are BUSY in the first call."""

    __slots__ = ()

    intState: int  # noqa: N815  # as the library names it
    intResult: int  # noqa: N815  # likewise

    @property
    def i_state(self) -> int:
        """Whether the block is BUSY."""
        return self.intState

    @i_state.setter
    def i_state(self, state: int) -> None:
        self.intState = state

    @property
    def i_result(self) -> int:
        """The last status."""
        return self.intResult

    @i_result.setter
    def i_result(self, status: int) -> None:
        self.intResult = status


class AsArLogCreate(interface.AsArLogCreate, AsynchronousArLogBlock):
    """Make a logbook. Inputs: enable, pName, len, memType. Outputs: status, ident.

    A restart forgets it, whatever memType is. Where there is one of this name, ident is its.
    Status: arlogERR_ILL_NAME, _ILL_LEN, _ILL_MEMTYPE, _EXISTING, _CREATE (too many).
    """

    def act(self) -> None:
        """Make it."""
        self.ident = 0
        name = self.name_at(self.pName)
        if self.len < arlogMIN_LOGDATA_SIZE:
            raise StatusError(arlogERR_ILL_LEN)
        if self.memType not in (arlogDRAM, arlogUSRRAM, arlogUSRROM):
            raise StatusError(arlogERR_ILL_MEMTYPE)
        there = self.logs.named(name)
        if there:
            self.ident = there + FIRST_OWN
            raise StatusError(arlogERR_EXISTING)
        if self.logs.full:
            raise StatusError(arlogERR_CREATE)
        self.ident = self.logs.add(ArLogbook(name, self.len, self.memType)) + FIRST_OWN


class AsArLogDelete(interface.AsArLogDelete, AsynchronousArLogBlock):
    """Delete a logbook. Status: arlogERR_INVALID_IDENT, _ACCESS_DENIED (the controller's)."""

    def act(self) -> None:
        """Delete it."""
        self.own(self.ident)
        self.logs.remove(self.ident - FIRST_OWN)


class AsArLogClear(interface.AsArLogClear, AsynchronousArLogBlock):
    """Delete the entries of a logbook. Status: arlogERR_INVALID_IDENT, _ACCESS_DENIED."""

    def act(self) -> None:
        """Delete them."""
        self.own(self.ident).clear()


class AsArLogGetInfo(interface.AsArLogGetInfo, ArLogBlock):
    """Find a logbook by its name. Outputs: status, ident, len, memType, actualIndex, FormatVer.

    Status: arlogERR_ILL_NAME, arlogERR_NOTEXISTING.
    """

    def act(self) -> None:
        """Find it."""
        self.ident = self.actualIndex = 0
        name = self.name_at(self.pName)
        number = self.logs.named(name)
        log = self.logs.find(number)
        if log is None:
            raise StatusError(arlogERR_NOTEXISTING)
        bases = {SYSTEM: arlogBASE_SYSTEM_LOG_IDENT, USER: arlogBASE_USER_LOG_IDENT}
        self.ident = bases.get(name, number + FIRST_OWN)
        self.len, self.memType = USER_SIZE, arlogUSRROM
        if isinstance(log, ArLogbook):
            self.len, self.memType = log.size, log.memory_type
        self.actualIndex = next(reversed([*log.records]), 0)
        self.FormatVer = FORMAT


class AsArLogWrite(interface.AsArLogWrite, AsynchronousArLogBlock):
    """Write an entry, and a line of the controller's logbook.

    Inputs: enable, ident, logLevel, errornr, mem, len, asciiString. Output: status
    (arlogERR_INVALID_IDENT, arlogERR_ILL_LOGLEVEL, arlogERR_NOMEMORY: too much data).
    """

    def act(self) -> None:
        """Write it."""
        log, level = self.log(self.ident), self.logLevel
        if level not in _LEVELS:
            raise StatusError(arlogERR_ILL_LOGLEVEL)
        if self.len > MOST_DATA:
            raise StatusError(arlogERR_NOMEMORY)
        memory = self.context.memory
        data = memory.read(self.mem, self.len) if self.mem and self.len else b""
        ascii_ = memory.string(self.asciiString, LONGEST_TEXT) if self.asciiString else b""
        text, task = ascii_.decode("latin-1"), running_name(self.context)
        if not log.is_system:
            event = event_id(level, 0, self.errornr & 0xFFFF, is_customer=True)
            date_ns, format_ = self.context.date_ns, arEVENTLOG_ADDFORMAT_BINARY
            log.write(ArLogRecord(event, 0, task, format_, data, date_ns, text, self.errornr))
        controller = Controller.of(self.context)
        if controller is not None:
            told = f"{escaped(text)} (error {self.errornr} in {log.name})"
            controller.log(_LEVELS[level], task or "system", told)


class AsArLogRead(interface.AsArLogRead, AsynchronousArLogBlock):
    """Read an entry: its header, its binary data, its text.

    Status: arlogERR_INVALID_IDENT, _INVALID_INDEX, _READ_BUFFER (no place for the header),
    _READ_BINARY_BUFFER, _READ_ASCII_BUFFER (too few bytes).
    """

    def act(self) -> None:
        """Read it."""
        record = self.log(self.ident).records.get(self.index)
        if record is None:
            raise StatusError(arlogERR_INVALID_INDEX)
        if not self.arlogRead:
            raise StatusError(arlogERR_READ_BUFFER)
        text = record.text.encode("latin-1", "replace")
        if self.memBin and self.lenBin < len(record.data):
            raise StatusError(arlogERR_READ_BINARY_BUFFER)
        if self.memAscii and self.lenAscii <= len(text):
            raise StatusError(arlogERR_READ_ASCII_BUFFER)
        self._write_header(record, len(text))
        if self.memBin and record.data:
            self.context.memory.write(self.memBin, record.data)
        if self.memAscii:
            self.context.memory.write(self.memAscii, text + b"\0")

    def _write_header(self, record: EventRecord, text_length: int) -> None:
        header = self.context.memory.access(asarlogRead, self.arlogRead)
        header.lenBin, header.lenAscii = len(record.data), text_length
        header.len = type(header)._plc_type.size + len(record.data) + text_length
        header.logLevel = severity_of(record.event)
        header.errornr = record.event & 0xFFFF
        if isinstance(record, ArLogRecord):
            header.errornr = record.number
        name = record.object_id.encode("latin-1", "replace")[:35]
        for index, byte in enumerate(name.ljust(36, b"\0")):
            header.taskName[index] = byte
        seconds, rest_ns = divmod(record.date_ns, NS_PER_SECOND)
        date = date_of(seconds)
        header.errYear, header.errMonth, header.errDay = date.year, date.month, date.day
        header.errHour, header.errMinute, header.errSecond = date.hour, date.minute, date.second
        header.errMilliSec, header.errMicroSec = divmod(rest_ns // NS_PER_US, 1000)
