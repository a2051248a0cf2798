"""Dates and durations as structures: TIMEStructure and DTStructure."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Final

from plcsim.library.astime.interface import DTStructure, TIMEStructure
from plcsim.library.executable import function

if TYPE_CHECKING:
    from plcsim.core.context import Context

NS_PER_SECOND: Final = 1_000_000_000
NS_PER_US: Final = 1000

DATE_AND_TIME_LAST: Final = 0xFFFF_FFFF
"""Seconds since 1970 of the last DATE_AND_TIME, 2106-02-07 06:28:15. It can be converted, as tests
of public projects have it on controllers; a clock goes to DATE_AND_TIME_MAX, the end of 2099."""

_EPOCH: Final = datetime(1970, 1, 1, tzinfo=UTC)
_MS_PER_UNIT: Final = (86_400_000, 3_600_000, 60_000, 1000)


def date_of(seconds: int) -> datetime:
    """Return the calendar date of a count of seconds since 1970."""
    return _EPOCH + timedelta(seconds=seconds)


def write_date(context: Context, address: int, date_ns: int) -> None:
    """Store a date, in nanoseconds since 1970, as a DTStructure.

    Raises:
        PageFault: the structure does not lie in memory.
    """
    found = context.memory.access(DTStructure, address)
    seconds, rest_ns = divmod(date_ns, NS_PER_SECOND)
    date = date_of(seconds)
    found.year, found.month, found.day = date.year, date.month, date.day
    found.wday = date.isoweekday() % 7
    found.hour, found.minute, found.second = date.hour, date.minute, date.second
    found.millisec, found.microsec = divmod(rest_ns // NS_PER_US, 1000)


def read_date(context: Context, address: int) -> int | None:
    """Return the date in a DTStructure, in nanoseconds since 1970; None for no such date.

    The day of the week is not looked at.

    Raises:
        PageFault: the structure does not lie in memory.
    """
    found = context.memory.access(DTStructure, address)
    try:
        date = datetime(
            *(found.year, found.month, found.day, found.hour, found.minute, found.second),
            tzinfo=UTC,
        )
    except ValueError:
        return None
    seconds = int((date - _EPOCH).total_seconds())
    if not 0 <= seconds <= DATE_AND_TIME_LAST or max(found.millisec, found.microsec) > 999:
        return None
    return seconds * NS_PER_SECOND + (found.millisec * 1000 + found.microsec) * NS_PER_US


@function("DT_TO_DTStructure")
def take_date_apart(context: Context, seconds: int, address: int) -> int:
    """Store a date as a structure; return its address, 0 for a null pointer."""
    if address:
        write_date(context, address, seconds * NS_PER_SECOND)
    return address


@function("DTStructure_TO_DT")
def put_date_together(context: Context, address: int) -> int:
    """Return the date of a structure in seconds since 1970, 0 where it holds none."""
    date_ns = read_date(context, address) if address else None
    return 0 if date_ns is None else date_ns // NS_PER_SECOND


@function("TIME_TO_TIMEStructure")
def take_time_apart(context: Context, milliseconds: int, address: int) -> int:
    """Store a duration as a structure; return its address, 0 for a null pointer.

    The sign of a duration below 0 stands in the day, which for less than a day can hold none.
    """
    if address:
        found = context.memory.access(TIMEStructure, address)
        day, hour, minute, second, found.millisec = duration_parts(abs(milliseconds))
        found.day = -day if milliseconds < 0 else day
        found.hour, found.minute, found.second = hour, minute, second
        found.microsec = 0
    return address


@function("TIMEStructure_TO_TIME")
def put_time_together(context: Context, address: int) -> int:
    """Return the duration of a structure in milliseconds, 0 for a null pointer."""
    if not address:
        return 0
    found = context.memory.access(TIMEStructure, address)
    units = (abs(found.day), found.hour, found.minute, found.second)
    total = sum(unit * ms for unit, ms in zip(units, _MS_PER_UNIT, strict=True)) + found.millisec
    return -total if found.day < 0 else total


def duration_parts(milliseconds: int) -> tuple[int, int, int, int, int]:
    """Return days, hours, minutes, seconds and milliseconds of a duration not below 0."""
    parts = []
    for unit_ms in _MS_PER_UNIT:
        part, milliseconds = divmod(milliseconds, unit_ms)
        parts.append(part)
    return parts[0], parts[1], parts[2], parts[3], milliseconds
