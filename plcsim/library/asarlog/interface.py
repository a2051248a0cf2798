"""Library AsArLog as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

if TYPE_CHECKING:
    from st_types import Array

__all__ = [
    "arlogBASE_FIELDBUS_LOG_IDENT",
    "arlogBASE_REDUND_LOG_IDENT",
    "arlogBASE_SAFETY_LOG_IDENT",
    "arlogBASE_SYSTEM_LOG_IDENT",
    "arlogBASE_USER_LOG_IDENT",
    "arlogDRAM",
    "arlogERR_ACCESS_DENIED",
    "arlogERR_CREATE",
    "arlogERR_DELETE",
    "arlogERR_EXISTING",
    "arlogERR_ILL_LEN",
    "arlogERR_ILL_LOGLEVEL",
    "arlogERR_ILL_MEMTYPE",
    "arlogERR_ILL_NAME",
    "arlogERR_ILL_PARAM",
    "arlogERR_INSTALL",
    "arlogERR_INVALID_ENTRY",
    "arlogERR_INVALID_IDENT",
    "arlogERR_INVALID_INDEX",
    "arlogERR_IN_ACCESS",
    "arlogERR_NOMEMORY",
    "arlogERR_NOTEXISTING",
    "arlogERR_NO_MORE_ENTRY",
    "arlogERR_READ",
    "arlogERR_READ_ASCII_BUFFER",
    "arlogERR_READ_BINARY_BUFFER",
    "arlogERR_READ_BUFFER",
    "arlogERR_WRITE",
    "arlogERR_WRITE_CALC_DATA",
    "arlogLEVEL_FATAL",
    "arlogLEVEL_INFO",
    "arlogLEVEL_WARNING",
    "arlogMIN_LOGDATA_SIZE",
    "arlogUSRRAM",
    "arlogUSRROM",
    "asarlogRead",
]

_DECLARED = declared_beside(__name__)

arlogDRAM: Final = 65
"""Memory until the power is off."""

arlogUSRRAM: Final = 3
"""USERRAM."""

arlogUSRROM: Final = 2
"""USERROM."""

arlogLEVEL_INFO: Final = 1

arlogLEVEL_WARNING: Final = 2

arlogLEVEL_FATAL: Final = 3

arlogMIN_LOGDATA_SIZE: Final = 4096
"""Least bytes of a logbook."""

arlogBASE_SYSTEM_LOG_IDENT: Final = 0
"""Ident of $arlogsys."""

arlogBASE_USER_LOG_IDENT: Final = 1
"""Ident of $arlogusr."""

arlogBASE_FIELDBUS_LOG_IDENT: Final = 2

arlogBASE_SAFETY_LOG_IDENT: Final = 3

arlogBASE_REDUND_LOG_IDENT: Final = 4

arlogERR_ILL_NAME: Final = 31400
"""No such name."""

arlogERR_ILL_MEMTYPE: Final = 31401
"""No such memory."""

arlogERR_ILL_LOGLEVEL: Final = 31402
"""No such level."""

arlogERR_ILL_PARAM: Final = 31403

arlogERR_ILL_LEN: Final = 31404
"""Less than arlogMIN_LOGDATA_SIZE."""

arlogERR_EXISTING: Final = 31405
"""There is one of this name."""

arlogERR_CREATE: Final = 31406
"""There are too many."""

arlogERR_INSTALL: Final = 31407

arlogERR_ACCESS_DENIED: Final = 31408
"""Not of $arlogsys and $arlogusr."""

arlogERR_IN_ACCESS: Final = 31409

arlogERR_INVALID_IDENT: Final = 31410

arlogERR_DELETE: Final = 31411

arlogERR_NOMEMORY: Final = 31412

arlogERR_NOTEXISTING: Final = 31416
"""There is none of this name."""

arlogERR_WRITE: Final = 31417

arlogERR_WRITE_CALC_DATA: Final = 31418

arlogERR_READ: Final = 31419

arlogERR_READ_BUFFER: Final = 31420
"""No place for the header."""

arlogERR_INVALID_INDEX: Final = 31421
"""No such entry."""

arlogERR_INVALID_ENTRY: Final = 31422

arlogERR_READ_BINARY_BUFFER: Final = 31423
"""Too few bytes for the binary data."""

arlogERR_READ_ASCII_BUFFER: Final = 31424
"""Too few bytes for the text."""

arlogERR_NO_MORE_ENTRY: Final = 31425


class asarlogRead(Struct):
    """What is read of an entry."""

    _plc_type = _DECLARED["asarlogRead"]

    len: int
    """Bytes of all of it."""

    lenBin: int
    """Of its binary data."""

    lenAscii: int
    """Of its text."""

    logLevel: int

    errornr: int

    taskName: Array[int]

    errYear: int

    errMonth: int

    errDay: int

    errHour: int

    errMinute: int

    errSecond: int

    errMilliSec: int

    errMicroSec: int


class AsArLogCreate(FunctionBlock):
    """Makes a logbook; asynchronous."""

    _plc_type = _DECLARED["AsArLogCreate"]

    enable: bool
    """Run the block; FALSE resets it."""

    pName: int
    """Address of its name."""

    len: int
    """Bytes of it."""

    memType: int
    """ArlogDRAM, arlogUSRRAM or arlogUSRROM."""

    intResult: int

    intState: int

    intRes: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """Of the logbook."""


class AsArLogDelete(FunctionBlock):
    """Deletes a logbook; asynchronous."""

    _plc_type = _DECLARED["AsArLogDelete"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """Of the logbook."""

    intResult: int

    intState: int

    intRes: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class AsArLogWrite(FunctionBlock):
    """Writes an entry; asynchronous."""

    _plc_type = _DECLARED["AsArLogWrite"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """Of the logbook."""

    logLevel: int
    """ArlogLEVEL_INFO, _WARNING or _FATAL."""

    errornr: int

    mem: int
    """Address of binary data, 0 for none."""

    len: int
    """Bytes of it."""

    asciiString: int
    """Address of a text, 0 for none."""

    intResult: int

    intState: int

    intRes: int

    intTaskName: Array[int]

    intRtkTime: Array[int]

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class AsArLogRead(FunctionBlock):
    """Reads an entry; asynchronous."""

    _plc_type = _DECLARED["AsArLogRead"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """Of the logbook."""

    index: int
    """Of the entry."""

    arlogRead: int
    """Address of an asarlogRead."""

    memBin: int
    """Where the binary data goes, 0 for nowhere."""

    lenBin: int
    """Bytes there are for it."""

    memAscii: int
    """Where the text goes, 0 for nowhere."""

    lenAscii: int
    """Bytes there are for it."""

    intResult: int

    intState: int

    intRes: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class AsArLogClear(FunctionBlock):
    """Deletes all entries; asynchronous."""

    _plc_type = _DECLARED["AsArLogClear"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """Of the logbook."""

    intResult: int

    intState: int

    intRes: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class AsArLogGetInfo(FunctionBlock):
    """Finds a logbook by its name."""

    _plc_type = _DECLARED["AsArLogGetInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pName: int
    """Address of its name."""

    intResult: int

    intState: int

    intRes: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """Of the logbook."""

    len: int
    """Bytes of it."""

    memType: int
    """Of it."""

    actualIndex: int
    """Of the latest entry."""

    FormatVer: int
    """Of its entries."""
