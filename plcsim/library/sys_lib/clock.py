"""The real-time clock as an RTCtime_typ."""

from __future__ import annotations

import struct
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Final

from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK
from plcsim.library.sys_lib.interface import ERR_BUR_ILLDATE, ERR_BUR_ILLPTR, ERR_BUR_ILLTIME

if TYPE_CHECKING:
    from plcsim.core.context import Context

_EPOCH: Final = datetime(1970, 1, 1, tzinfo=UTC)
_FIRST_YEAR, _LAST_YEAR = 1970, 2099
_FORM: Final = struct.Struct("<HBBBBBBHH")
"""RTCtime_typ: year, month, day, a reserve, hour, minute, second, milliseconds, microseconds."""


@function("RTC_gettime")
def read_clock(context: Context, address: int) -> int:
    """Store the date and time; return a status."""
    if not address:
        return ERR_BUR_ILLPTR
    seconds, rest_ns = divmod(context.date_ns, 1_000_000_000)
    date = _EPOCH + timedelta(seconds=seconds)
    day = (date.year, date.month, date.day, 0, date.hour, date.minute, date.second)
    context.memory.write(address, _FORM.pack(*day, *divmod(rest_ns // 1000, 1000)))
    return ERR_OK


@function("RTC_settime")
def set_clock(context: Context, address: int) -> int:
    """Set the date and time; return a status."""
    if not address:
        return ERR_BUR_ILLPTR
    year, month, day, _, hour, minute, second, ms, us = _FORM.unpack(
        context.memory.read(address, _FORM.size)
    )
    if hour > 23 or minute > 59 or second > 59 or max(ms, us) > 999:
        return ERR_BUR_ILLTIME
    if not _FIRST_YEAR <= year <= _LAST_YEAR:
        return ERR_BUR_ILLDATE
    try:
        date = datetime(year, month, day, hour, minute, second, tzinfo=UTC)
    except ValueError:
        return ERR_BUR_ILLDATE
    seconds = int((date - _EPOCH).total_seconds())
    context.date_ns = seconds * 1_000_000_000 + (ms * 1000 + us) * 1000
    return ERR_OK


@function("SW_gettime")
def read_software_clock(context: Context, address: int) -> int:
    """Store the date and time: there is one clock."""
    return read_clock(context, address)


@function("SW_settime")
def set_software_clock(context: Context, address: int) -> int:
    """Set the date and time: there is one clock."""
    return set_clock(context, address)
