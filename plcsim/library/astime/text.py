"""Dates and durations as text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.astime.structures import (
    NS_PER_SECOND,
    date_of,
    duration_parts,
    put_time_together,
    read_date,
)
from plcsim.library.executable import function

if TYPE_CHECKING:
    from plcsim.core.context import Context

_DAYS: Final = ("Mon", "Tue", "Wed", "Thu", "Fri", "Sat", "Sun")
_MONTHS: Final = (
    *("Jan", "Feb", "Mar", "Apr", "May", "Jun"),
    *("Jul", "Aug", "Sep", "Oct", "Nov", "Dec"),
)


def store(context: Context, text: str, address: int, size: int) -> int:
    """Store a text that is cut to ``size`` bytes with its NUL; return its address, 0 for none."""
    if not address or not size:
        return 0
    context.memory.write(address, text.encode("ascii")[: size - 1] + b"\0")
    return address


def _date_text(seconds: int) -> str:
    """Return ``Sun Jan 3 15:14:13 1988``."""
    date = date_of(seconds)
    day = f"{_DAYS[date.weekday()]} {_MONTHS[date.month - 1]} {date.day}"
    return f"{day} {date:%H:%M:%S} {date.year}"


def _time_text(milliseconds: int) -> str:
    """Return ``15:14:13``; days count as hours."""
    day, hour, minute, second, _ = duration_parts(abs(milliseconds))
    sign = "-" if milliseconds < 0 else ""
    return f"{sign}{day * 24 + hour:02}:{minute:02}:{second:02}"


@function("ascDT")
def date_as_text(context: Context, seconds: int, text: int, size: int) -> int:
    """Store a date as text; return its address."""
    return store(context, _date_text(seconds), text, size)


@function("ascDTStructure")
def date_structure_as_text(context: Context, address: int, text: int, size: int) -> int:
    """Store the date of a structure as text; return its address, 0 where it holds none."""
    date_ns = read_date(context, address) if address else None
    if date_ns is None:
        return 0
    return store(context, _date_text(date_ns // NS_PER_SECOND), text, size)


@function("ascTIME")
def time_as_text(context: Context, milliseconds: int, text: int, size: int) -> int:
    """Store a duration as text; return its address."""
    return store(context, _time_text(milliseconds), text, size)


@function("ascTIMEStructure")
def time_structure_as_text(context: Context, address: int, text: int, size: int) -> int:
    """Store the duration of a structure as text; return its address."""
    if not address:
        return 0
    return store(context, _time_text(put_time_together(context, address)), text, size)
