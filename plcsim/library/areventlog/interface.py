"""Library ArEventLog as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

if TYPE_CHECKING:
    from plcsim.library.runtime import ArFBAsyFuMaInternalType, ArFBStateInternalType

__all__ = [
    "ArEventLogAsyncInternalType",
    "ArEventLogInternalType",
    "ArEventLogTimeStampType",
    "arEVENTLOG_ADDFORMAT_BINARY",
    "arEVENTLOG_ADDFORMAT_CODED",
    "arEVENTLOG_ADDFORMAT_CUST_BASE",
    "arEVENTLOG_ADDFORMAT_CUST_MAX",
    "arEVENTLOG_ADDFORMAT_TEXT",
    "arEVENTLOG_ERR_ADDDATA_NULL",
    "arEVENTLOG_ERR_DESCRIPTION_NULL",
    "arEVENTLOG_ERR_EVENTID_INVALID",
    "arEVENTLOG_ERR_EXISTING",
    "arEVENTLOG_ERR_FORMAT_INVALID",
    "arEVENTLOG_ERR_IDENT_INVALID",
    "arEVENTLOG_ERR_IDENT_SYSTEM",
    "arEVENTLOG_ERR_INTERNAL",
    "arEVENTLOG_ERR_LOGBOOK_EXISTS",
    "arEVENTLOG_ERR_LOGBOOK_NOT_FOUND",
    "arEVENTLOG_ERR_MODULE_EXISTS",
    "arEVENTLOG_ERR_NAME_INVALID",
    "arEVENTLOG_ERR_NO_DESCRIPTION",
    "arEVENTLOG_ERR_NO_ERRORNUMBER",
    "arEVENTLOG_ERR_PARAMETER",
    "arEVENTLOG_ERR_PERSISTENCE_INVAL",
    "arEVENTLOG_ERR_RECORDID_INVALID",
    "arEVENTLOG_ERR_SIZE_INVALID",
    "arEVENTLOG_INF_SIZE",
    "arEVENTLOG_PERSISTENCE_PERSIST",
    "arEVENTLOG_PERSISTENCE_REMANENT",
    "arEVENTLOG_PERSISTENCE_VOLATILE",
    "arEVENTLOG_SEVERITY_ERROR",
    "arEVENTLOG_SEVERITY_INFO",
    "arEVENTLOG_SEVERITY_SUCCESS",
    "arEVENTLOG_SEVERITY_WARNING",
    "arEVENTLOG_WRN_ADDDATA_NULL",
    "arEVENTLOG_WRN_FORMAT_INVALID",
    "arEVENTLOG_WRN_NO_EVENTID",
]

_DECLARED = declared_beside(__name__)

arEVENTLOG_ERR_PARAMETER: Final = -1070586096

arEVENTLOG_ERR_RECORDID_INVALID: Final = -1070586096

arEVENTLOG_ERR_EXISTING: Final = -1070586095

arEVENTLOG_ERR_LOGBOOK_EXISTS: Final = -1070586095

arEVENTLOG_ERR_INTERNAL: Final = -1070586094

arEVENTLOG_ERR_NAME_INVALID: Final = -1070586093

arEVENTLOG_ERR_SIZE_INVALID: Final = -1070586092

arEVENTLOG_ERR_PERSISTENCE_INVAL: Final = -1070586091

arEVENTLOG_ERR_IDENT_INVALID: Final = -1070586090

arEVENTLOG_ERR_IDENT_SYSTEM: Final = -1070586089

arEVENTLOG_ERR_EVENTID_INVALID: Final = -1070586088

arEVENTLOG_ERR_LOGBOOK_NOT_FOUND: Final = -1070586087

arEVENTLOG_ERR_ADDDATA_NULL: Final = -1070586086

arEVENTLOG_ERR_NO_ERRORNUMBER: Final = -1070586085

arEVENTLOG_ERR_MODULE_EXISTS: Final = -1070586084

arEVENTLOG_ERR_NO_DESCRIPTION: Final = -1070586083

arEVENTLOG_ERR_DESCRIPTION_NULL: Final = -1070586082

arEVENTLOG_ERR_FORMAT_INVALID: Final = -1070586081

arEVENTLOG_WRN_NO_EVENTID: Final = -2144327920

arEVENTLOG_WRN_FORMAT_INVALID: Final = -2144327919

arEVENTLOG_WRN_ADDDATA_NULL: Final = -2144327918

arEVENTLOG_INF_SIZE: Final = 1076897555

arEVENTLOG_SEVERITY_SUCCESS: Final = 0

arEVENTLOG_SEVERITY_INFO: Final = 1

arEVENTLOG_SEVERITY_WARNING: Final = 2

arEVENTLOG_SEVERITY_ERROR: Final = 3

arEVENTLOG_PERSISTENCE_VOLATILE: Final = 0

arEVENTLOG_PERSISTENCE_REMANENT: Final = 1

arEVENTLOG_PERSISTENCE_PERSIST: Final = 2

arEVENTLOG_ADDFORMAT_BINARY: Final = 0

arEVENTLOG_ADDFORMAT_TEXT: Final = 1

arEVENTLOG_ADDFORMAT_CODED: Final = 2

arEVENTLOG_ADDFORMAT_CUST_BASE: Final = 100

arEVENTLOG_ADDFORMAT_CUST_MAX: Final = 150


class ArEventLogTimeStampType(Struct):
    """ArEventLogTimeStampType."""

    _plc_type = _DECLARED["ArEventLogTimeStampType"]

    sec: int

    nsec: int


class ArEventLogAsyncInternalType(Struct):
    """ArEventLogAsyncInternalType."""

    _plc_type = _DECLARED["ArEventLogAsyncInternalType"]

    FBStateCtx: ArFBStateInternalType

    AsyFuMaCtx: ArFBAsyFuMaInternalType


class ArEventLogInternalType(Struct):
    """ArEventLogInternalType."""

    _plc_type = _DECLARED["ArEventLogInternalType"]

    FBStateCtx: ArFBStateInternalType


class ArEventLogCreate(FunctionBlock):
    """Makes a logbook; asynchronous."""

    _plc_type = _DECLARED["ArEventLogCreate"]

    Execute: bool
    """A rising edge starts the block."""

    Name: str
    """Of the logbook."""

    Size: int

    Persistence: int

    Info: int

    Done: bool
    """Finished."""

    Busy: bool
    """At work."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    Ident: int
    """The logbook."""

    Internal: ArEventLogAsyncInternalType


class ArEventLogDelete(FunctionBlock):
    """Deletes a logbook; asynchronous."""

    _plc_type = _DECLARED["ArEventLogDelete"]

    Execute: bool
    """A rising edge starts the block."""

    Ident: int
    """The logbook."""

    Done: bool
    """Finished."""

    Busy: bool
    """At work."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    Internal: ArEventLogAsyncInternalType


class ArEventLogGetIdent(FunctionBlock):
    """Finds a logbook by its name."""

    _plc_type = _DECLARED["ArEventLogGetIdent"]

    Execute: bool
    """A rising edge starts the block."""

    Name: str
    """Of the logbook."""

    Done: bool
    """Finished."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    Ident: int
    """The logbook."""

    Internal: ArEventLogInternalType


class ArEventLogWrite(FunctionBlock):
    """Writes a record."""

    _plc_type = _DECLARED["ArEventLogWrite"]

    Execute: bool
    """A rising edge starts the block."""

    Ident: int
    """The logbook."""

    EventID: int
    """Severity, area, facility and code."""

    OriginRecordID: int
    """Record that led to this one, 0 for none."""

    ObjectID: str
    """What the event is about."""

    AddDataSize: int
    """Bytes."""

    AddDataFormat: int
    """ArEVENTLOG_ADDFORMAT_."""

    AddData: int
    """Address of the additional data."""

    TimeStamp: int
    """Address of an ArEventLogTimeStampType, 0 for now."""

    Done: bool
    """Finished."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    RecordID: int
    """Number of the record, 0 for none."""

    Internal: ArEventLogInternalType


class ArEventLogGetLatestRecordID(FunctionBlock):
    """The latest record."""

    _plc_type = _DECLARED["ArEventLogGetLatestRecordID"]

    Execute: bool
    """A rising edge starts the block."""

    Ident: int
    """The logbook."""

    Done: bool
    """Finished."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    RecordID: int
    """Number of the record, 0 for none."""

    Internal: ArEventLogInternalType


class ArEventLogGetPreviousRecordID(FunctionBlock):
    """The record before another."""

    _plc_type = _DECLARED["ArEventLogGetPreviousRecordID"]

    Execute: bool
    """A rising edge starts the block."""

    Ident: int
    """The logbook."""

    RecordID: int
    """Number of the record, 0 for none."""

    Done: bool
    """Finished."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    PrevRecordID: int
    """Number of the record before, 0 for none."""

    Internal: ArEventLogInternalType


class ArEventLogRead(FunctionBlock):
    """Reads a record."""

    _plc_type = _DECLARED["ArEventLogRead"]

    Execute: bool
    """A rising edge starts the block."""

    Ident: int
    """The logbook."""

    RecordID: int
    """Number of the record, 0 for none."""

    Done: bool
    """Finished."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    EventID: int
    """Severity, area, facility and code."""

    OriginRecordID: int
    """Record that led to this one, 0 for none."""

    AddDataFormat: int
    """ArEVENTLOG_ADDFORMAT_."""

    AddDataSize: int
    """Bytes."""

    TimeStamp: ArEventLogTimeStampType
    """Seconds since 1970, and nanoseconds."""

    Internal: ArEventLogInternalType


class ArEventLogReadDescription(FunctionBlock):
    """Text of an event; asynchronous."""

    _plc_type = _DECLARED["ArEventLogReadDescription"]

    Execute: bool
    """A rising edge starts the block."""

    Ident: int
    """The logbook."""

    RecordID: int
    """Number of the record, 0 for none."""

    LanguageCode: str

    Qualifier: str

    TextBuffer: int
    """Address for the text."""

    TextBufferSize: int
    """Bytes there."""

    Done: bool
    """Finished."""

    Busy: bool
    """At work."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    TextSize: int
    """Bytes of the text, with the NUL."""

    Internal: ArEventLogAsyncInternalType


class ArEventLogReadErrorNumber(FunctionBlock):
    """Code and severity of a record."""

    _plc_type = _DECLARED["ArEventLogReadErrorNumber"]

    Execute: bool
    """A rising edge starts the block."""

    Ident: int
    """The logbook."""

    RecordID: int
    """Number of the record, 0 for none."""

    Done: bool
    """Finished."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    ErrorNumber: int
    """Code of the event."""

    Severity: int
    """ArEVENTLOG_SEVERITY_."""

    Internal: ArEventLogInternalType


class ArEventLogReadAddData(FunctionBlock):
    """Additional data of a record."""

    _plc_type = _DECLARED["ArEventLogReadAddData"]

    Execute: bool
    """A rising edge starts the block."""

    Ident: int
    """The logbook."""

    RecordID: int
    """Number of the record, 0 for none."""

    AddData: int
    """Address of the additional data."""

    BytesToRead: int
    """Bytes at most."""

    Done: bool
    """Finished."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    AddDataSize: int
    """Bytes."""

    Internal: ArEventLogInternalType


class ArEventLogReadObjectID(FunctionBlock):
    """What a record is about."""

    _plc_type = _DECLARED["ArEventLogReadObjectID"]

    Execute: bool
    """A rising edge starts the block."""

    Ident: int
    """The logbook."""

    RecordID: int
    """Number of the record, 0 for none."""

    Done: bool
    """Finished."""

    Error: bool
    """Failed, StatusID tells why."""

    StatusID: int
    """0 or an error."""

    ObjectID: str
    """What the event is about."""

    Internal: ArEventLogInternalType
