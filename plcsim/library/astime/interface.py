"""Library astime as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

__all__ = [
    "DATE_AND_TIME_MAX",
    "TIME_MAX",
    "TIME_MIN",
    "DTStructure",
    "TIMEStructure",
    "timDAYLIGHT_SAVING_TIME",
    "timERR_AR",
    "timERR_INVALID_DTSTRUCTURE",
    "timERR_INVALID_LEN",
    "timERR_INVALID_PARAMETER",
    "timEXSETTIME_NO_LOGENTRY",
    "timEXSETTIME_NO_OPTION",
    "timNORMAL_TIME",
    "timNO_DST",
    "timREAL_TIME_CLOCK",
    "timREDUND_INTERFACE",
    "timTIME_SERVER",
]

_DECLARED = declared_beside(__name__)

timEXSETTIME_NO_LOGENTRY: Final = 1

timEXSETTIME_NO_OPTION: Final = 0

DATE_AND_TIME_MAX: Final = 4102444799

TIME_MIN: Final = -2073600000

TIME_MAX: Final = 2073600000

timNORMAL_TIME: Final = 1

timDAYLIGHT_SAVING_TIME: Final = 2

timNO_DST: Final = 3

timREAL_TIME_CLOCK: Final = 1

timTIME_SERVER: Final = 2

timREDUND_INTERFACE: Final = 3

timERR_INVALID_PARAMETER: Final = 33210

timERR_INVALID_LEN: Final = 33211

timERR_INVALID_DTSTRUCTURE: Final = 33212

timERR_AR: Final = 33213


class TIMEStructure(Struct):
    """TIMEStructure."""

    _plc_type = _DECLARED["TIMEStructure"]

    day: int

    hour: int

    minute: int

    second: int

    millisec: int

    microsec: int


class DTStructure(Struct):
    """DTStructure."""

    _plc_type = _DECLARED["DTStructure"]

    year: int

    month: int

    day: int

    wday: int
    """0 is Sunday."""

    hour: int

    minute: int

    second: int

    millisec: int

    microsec: int


class DTExSetTime(FunctionBlock):
    """Sets the date and time, with options."""

    _plc_type = _DECLARED["DTExSetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    DT1: int
    """Date and time."""

    Option: int
    """TimEXSETTIME_NO_LOGENTRY: no entry in the logbook."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DTSetTime(FunctionBlock):
    """Sets the date and time."""

    _plc_type = _DECLARED["DTSetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    DT1: int
    """Date and time."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DTGetTime(FunctionBlock):
    """Reads the date and time."""

    _plc_type = _DECLARED["DTGetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    DT1: int
    """Date and time."""


class UtcDTGetTime(FunctionBlock):
    """Reads the date and time in UTC."""

    _plc_type = _DECLARED["UtcDTGetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    DT1: int
    """Date and time."""


class UtcDTSetTime(FunctionBlock):
    """Sets the date and time in UTC; asynchronous."""

    _plc_type = _DECLARED["UtcDTSetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    DT1: int
    """Date and time."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UtcDTExSetTime(FunctionBlock):
    """Sets the date and time in UTC, with options; asynchronous."""

    _plc_type = _DECLARED["UtcDTExSetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    DT1: int
    """Date and time."""

    Option: int
    """TimEXSETTIME_NO_LOGENTRY: no entry in the logbook."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class DTStructureGetTime(FunctionBlock):
    """Reads the date and time as a structure."""

    _plc_type = _DECLARED["DTStructureGetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDTStructure: int
    """Address of a DTStructure."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DTStructureSetTime(FunctionBlock):
    """Sets the date and time from a structure."""

    _plc_type = _DECLARED["DTStructureSetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDTStructure: int
    """Address of a DTStructure."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DTStructureExSetTime(FunctionBlock):
    """Sets the date and time from a structure, with options."""

    _plc_type = _DECLARED["DTStructureExSetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDTStructure: int
    """Address of a DTStructure."""

    Option: int
    """TimEXSETTIME_NO_LOGENTRY: no entry in the logbook."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class UtcDTStructureGetTime(FunctionBlock):
    """Reads the date and time in UTC as a structure."""

    _plc_type = _DECLARED["UtcDTStructureGetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDTStructure: int
    """Address of a DTStructure."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class UtcDTStructureSetTime(FunctionBlock):
    """Sets the date and time in UTC from a structure; asynchronous."""

    _plc_type = _DECLARED["UtcDTStructureSetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDTStructure: int
    """Address of a DTStructure."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UtcDTStructureExSetTime(FunctionBlock):
    """Sets the date and time in UTC from a structure, with options; asynchronous."""

    _plc_type = _DECLARED["UtcDTStructureExSetTime"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDTStructure: int
    """Address of a DTStructure."""

    Option: int
    """TimEXSETTIME_NO_LOGENTRY: no entry in the logbook."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UtcDT_TO_LocalDTStructure(FunctionBlock):
    """UTC to local time; asynchronous."""

    _plc_type = _DECLARED["UtcDT_TO_LocalDTStructure"]

    enable: bool
    """Run the block; FALSE resets it."""

    DT1: int
    """Date and time."""

    pDTStructure: int
    """Address of a DTStructure."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class LocalDT_TO_UtcDTStructure(FunctionBlock):
    """Local time to UTC; asynchronous."""

    _plc_type = _DECLARED["LocalDT_TO_UtcDTStructure"]

    enable: bool
    """Run the block; FALSE resets it."""

    DT1: int
    """Date and time."""

    pDTStructure: int
    """Address of a DTStructure."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UtcDTStructure_TO_LocalDT(FunctionBlock):
    """UTC to local time; asynchronous."""

    _plc_type = _DECLARED["UtcDTStructure_TO_LocalDT"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDTStructure: int
    """Address of a DTStructure."""

    DT1: int
    """Date and time."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class LocalDTStructure_TO_UtcDT(FunctionBlock):
    """Local time to UTC; asynchronous."""

    _plc_type = _DECLARED["LocalDTStructure_TO_UtcDT"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDTStructure: int
    """Address of a DTStructure."""

    DT1: int
    """Date and time."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class TimeDeviceGetInfo(FunctionBlock):
    """What sets the clock; asynchronous."""

    _plc_type = _DECLARED["TimeDeviceGetInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pServer: int

    len: int
    """Bytes there, with the NUL."""

    timeDevice: int
    """TimREAL_TIME_CLOCK or timTIME_SERVER."""

    avgDeviation: float

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class DstGetInfo(FunctionBlock):
    """Daylight saving time at a date; asynchronous."""

    _plc_type = _DECLARED["DstGetInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDTStructure: int
    """Address of a DTStructure."""

    dstState: int
    """TimNORMAL_TIME, timDAYLIGHT_SAVING_TIME or timNO_DST."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class DstGetInfoDT(FunctionBlock):
    """Daylight saving time at a date; asynchronous."""

    _plc_type = _DECLARED["DstGetInfoDT"]

    enable: bool
    """Run the block; FALSE resets it."""

    DT1: int
    """Date and time."""

    dstState: int
    """TimNORMAL_TIME, timDAYLIGHT_SAVING_TIME or timNO_DST."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""
