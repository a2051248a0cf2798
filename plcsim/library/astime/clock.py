"""Blocks that read and set the controller's date and time."""

from __future__ import annotations

from typing import Final

from plcsim.core.context import Context  # noqa: TC001  # the type of a parameter people look up
from plcsim.core.controller import Controller
from plcsim.core.logbook import Severity
from plcsim.library.astime import interface
from plcsim.library.astime.interface import (
    timERR_INVALID_DTSTRUCTURE,
    timERR_INVALID_PARAMETER,
    timEXSETTIME_NO_LOGENTRY,
    timNO_DST,
    timREAL_TIME_CLOCK,
)
from plcsim.library.astime.settings import AsTimeSettings
from plcsim.library.astime.structures import (
    DATE_AND_TIME_LAST,
    NS_PER_SECOND,
    date_of,
    read_date,
    write_date,
)
from plcsim.library.block import AsynchronousBlock, SynchronousBlock
from plcsim.library.runtime import ERR_OK

_LAST_SECOND: Final = interface.DATE_AND_TIME_MAX


def _offset_ns(context: Context) -> int:
    """Return by how much local time is ahead of UTC."""
    settings = context.settings(AsTimeSettings) or AsTimeSettings()
    return settings.utc_offset * 60 * NS_PER_SECOND


def _set_date(context: Context, date_ns: int, option: int = 0) -> None:
    """Set the controller's date, and tell the logbook unless that is not wanted."""
    context.date_ns = date_ns
    controller = Controller.of(context)
    if controller is not None and option != timEXSETTIME_NO_LOGENTRY:
        date = date_of(date_ns // NS_PER_SECOND)
        text = f"date and time set to {date:%Y-%m-%d %H:%M:%S}"
        controller.log(Severity.INFORMATION, "system", text)


class _Setter(SynchronousBlock):
    """Sets the clock to DT1, or to a structure; ``_is_utc`` says whether it stands in UTC."""

    __slots__ = ()

    _is_utc = False

    def _set_seconds(self, seconds: int, option: int = 0) -> int:
        if seconds > _LAST_SECOND:
            return timERR_INVALID_PARAMETER
        return self._set_ns(seconds * NS_PER_SECOND, option)

    def _set_structure(self, address: int, option: int = 0) -> int:
        if not address:
            return timERR_INVALID_PARAMETER
        date_ns = read_date(self.context, address)
        if date_ns is None or date_ns // NS_PER_SECOND > _LAST_SECOND:
            return timERR_INVALID_DTSTRUCTURE
        return self._set_ns(date_ns, option)

    def _set_ns(self, date_ns: int, option: int) -> int:
        if self._is_utc:
            date_ns += _offset_ns(self.context)
        if not 0 <= date_ns // NS_PER_SECOND <= _LAST_SECOND:
            return timERR_INVALID_PARAMETER
        _set_date(self.context, date_ns, option)
        return ERR_OK


class UtcDTGetTime(interface.UtcDTGetTime, SynchronousBlock):
    """The date and time now in UTC. Input: enable. Outputs: status, DT1."""

    def step(self) -> int:
        """Read the clock."""
        self.DT1 = (self.context.date_ns - _offset_ns(self.context)) // NS_PER_SECOND
        return ERR_OK


class DTStructureGetTime(interface.DTStructureGetTime, SynchronousBlock):
    """The date and time now, to the microsecond. Inputs: enable, pDTStructure. Output: status."""

    def step(self) -> int:
        """Read the clock."""
        if not self.pDTStructure:
            return timERR_INVALID_PARAMETER
        write_date(self.context, self.pDTStructure, self.context.date_ns)
        return ERR_OK


class UtcDTStructureGetTime(interface.UtcDTStructureGetTime, SynchronousBlock):
    """The same in UTC."""

    def step(self) -> int:
        """Read the clock."""
        if not self.pDTStructure:
            return timERR_INVALID_PARAMETER
        date_ns = self.context.date_ns - _offset_ns(self.context)
        write_date(self.context, self.pDTStructure, date_ns)
        return ERR_OK


class DTSetTime(interface.DTSetTime, _Setter):
    """Set the date and time. Inputs: enable, DT1. Output: status."""

    def step(self) -> int:
        """Set the clock."""
        return self._set_seconds(self.DT1)


class DTExSetTime(interface.DTExSetTime, _Setter):
    """Set the date and time. Inputs: enable, DT1, Option. Output: status."""

    def step(self) -> int:
        """Set the clock."""
        return self._set_seconds(self.DT1, self.Option)


class DTStructureSetTime(interface.DTStructureSetTime, _Setter):
    """Set the date and time. Inputs: enable, pDTStructure. Output: status."""

    def step(self) -> int:
        """Set the clock."""
        return self._set_structure(self.pDTStructure)


class DTStructureExSetTime(interface.DTStructureExSetTime, _Setter):
    """Set the date and time. Inputs: enable, pDTStructure, Option. Output: status."""

    def step(self) -> int:
        """Set the clock."""
        return self._set_structure(self.pDTStructure, self.Option)


class _UtcSetter(AsynchronousBlock, _Setter):
    """Sets the clock in UTC; the controller does it asynchronously."""

    __slots__ = ()

    _is_utc = True


class UtcDTSetTime(interface.UtcDTSetTime, _UtcSetter):
    """Set the date and time in UTC. Inputs: enable, DT1. Output: status."""

    def step(self) -> int:
        """Set the clock."""
        return self._set_seconds(self.DT1)


class UtcDTExSetTime(interface.UtcDTExSetTime, _UtcSetter):
    """Set the date and time in UTC. Inputs: enable, DT1, Option. Output: status."""

    def step(self) -> int:
        """Set the clock."""
        return self._set_seconds(self.DT1, self.Option)


class UtcDTStructureSetTime(interface.UtcDTStructureSetTime, _UtcSetter):
    """Set the date and time in UTC. Inputs: enable, pDTStructure. Output: status."""

    def step(self) -> int:
        """Set the clock."""
        return self._set_structure(self.pDTStructure)


class UtcDTStructureExSetTime(interface.UtcDTStructureExSetTime, _UtcSetter):
    """Set the date and time in UTC. Inputs: enable, pDTStructure, Option. Output: status."""

    def step(self) -> int:
        """Set the clock."""
        return self._set_structure(self.pDTStructure, self.Option)


class _Converter(AsynchronousBlock):
    """Converts between UTC and local time; ``_sign`` is that of the offset that is added."""

    __slots__ = ()

    _sign = 1

    def _to_structure(self, seconds: int, address: int) -> int:
        date_ns = seconds * NS_PER_SECOND + self._sign * _offset_ns(self.context)
        if not address or date_ns < 0:
            return timERR_INVALID_PARAMETER
        write_date(self.context, address, date_ns)
        return ERR_OK

    def _converted(self, address: int) -> tuple[int, int]:
        """Return the status, and the seconds since 1970 of a structure on the other side."""
        if not address:
            return timERR_INVALID_PARAMETER, 0
        date_ns = read_date(self.context, address)
        if date_ns is None:
            return timERR_INVALID_DTSTRUCTURE, 0
        seconds = (date_ns + self._sign * _offset_ns(self.context)) // NS_PER_SECOND
        if not 0 <= seconds <= DATE_AND_TIME_LAST:
            return timERR_INVALID_PARAMETER, 0
        return ERR_OK, seconds


class UtcDT_TO_LocalDTStructure(interface.UtcDT_TO_LocalDTStructure, _Converter):  # noqa: N801  # the controller's name
    """UTC to local time. Inputs: enable, DT1, pDTStructure. Output: status."""

    def step(self) -> int:
        """Convert."""
        return self._to_structure(self.DT1, self.pDTStructure)


class LocalDT_TO_UtcDTStructure(interface.LocalDT_TO_UtcDTStructure, _Converter):  # noqa: N801  # the controller's name
    """Local time to UTC. Inputs: enable, DT1, pDTStructure. Output: status."""

    _sign = -1

    def step(self) -> int:
        """Convert."""
        return self._to_structure(self.DT1, self.pDTStructure)


class UtcDTStructure_TO_LocalDT(interface.UtcDTStructure_TO_LocalDT, _Converter):  # noqa: N801  # the controller's name
    """UTC to local time. Inputs: enable, pDTStructure. Outputs: DT1, status."""

    def step(self) -> int:
        """Convert."""
        status, self.DT1 = self._converted(self.pDTStructure)
        return status


class LocalDTStructure_TO_UtcDT(interface.LocalDTStructure_TO_UtcDT, _Converter):  # noqa: N801  # the controller's name
    """Local time to UTC. Inputs: enable, pDTStructure. Outputs: DT1, status."""

    _sign = -1

    def step(self) -> int:
        """Convert."""
        status, self.DT1 = self._converted(self.pDTStructure)
        return status


class TimeDeviceGetInfo(interface.TimeDeviceGetInfo, AsynchronousBlock):
    """What sets the clock: nothing but the clock itself."""

    def step(self) -> int:
        """Tell that there is no time server."""
        self.timeDevice, self.avgDeviation = timREAL_TIME_CLOCK, 0.0
        return ERR_OK


class DstGetInfo(interface.DstGetInfo, AsynchronousBlock):
    """Daylight saving time at a date: there is none."""

    def step(self) -> int:
        """Tell so."""
        self.dstState = timNO_DST
        return ERR_OK


class DstGetInfoDT(interface.DstGetInfoDT, AsynchronousBlock):
    """Daylight saving time at a date: there is none."""

    def step(self) -> int:
        """Tell so."""
        self.dstState = timNO_DST
        return ERR_OK
