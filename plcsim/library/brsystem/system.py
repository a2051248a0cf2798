"""The task class that runs, the start of the controller, its version."""

from __future__ import annotations

import re
from importlib.metadata import version
from typing import TYPE_CHECKING, Final

from plcsim.core.controller import Controller
from plcsim.library.block import SynchronousBlock
from plcsim.library.brsystem import interface
from plcsim.library.brsystem.interface import (
    INIT_REASON_WARMSTART,
    TARGET_LITTLE_ENDIAN,
    brBATTERY_OK,
    brERR_INVALID_PARAMETER,
    brERR_NON_CYCLIC_CONTEXT,
)
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.core.task import TaskClass

NS_PER_US: Final = 1000
NS_PER_TICK: Final = 10_000_000
"""A tick of the system's counters is 10 ms."""

VERSION: Final = tuple(int(part) for part in re.findall(r"\d+", version("plcsim")))[:4]


def _running_class(context: Context) -> TaskClass | None:
    controller = Controller.of(context)
    return None if controller is None else controller.running[0]


class RTInfo(interface.RTInfo, SynchronousBlock):
    """The task class that calls. Input: enable. Outputs: status, cycle_time (us), init_reason,
    task_class.

    Every start of the controller is a warm start. Statuses: ERR_OK, brERR_NON_CYCLIC_CONTEXT (the
    exception program calls, which belongs to no task class).
    """  # noqa: D205  # the outputs do not fit one line

    def step(self) -> int:
        """Look which class runs."""
        found = _running_class(self.context)
        if found is None:
            return brERR_NON_CYCLIC_CONTEXT
        self.cycle_time = found.cycle_ns // NS_PER_US
        self.init_reason = INIT_REASON_WARMSTART
        self.task_class = found.number
        return ERR_OK


class SysInfo(interface.SysInfo, SynchronousBlock):
    """The start of the controller. Outputs: status, init_reason, init_count, tick_count, version.

    tick_count counts ticks of 10 ms, version is two numbers of the system's in hexadecimal digits.
    """

    def step(self) -> int:
        """Look at the clock."""
        self.init_reason, self.init_count = INIT_REASON_WARMSTART, 1
        self.tick_count = self.context.release_ns // NS_PER_TICK & 0xFFFF_FFFF
        self.version = _version_part(0) << 8 | _version_part(1)
        return ERR_OK


class TARGETInfo(interface.TARGETInfo, SynchronousBlock):
    """The version as text, such as P00.10, at pOSVersion, and the byte order at DataFormat."""

    def step(self) -> int:
        """Store the version."""
        if not self.pOSVersion:
            return brERR_INVALID_PARAMETER
        text = f"P{_version_part(0):02}.{_version_part(1):02}\0"
        self.context.memory.write(self.pOSVersion, text.encode("ascii"))
        self.DataFormat = TARGET_LITTLE_ENDIAN
        return ERR_OK


class BatteryInfo(interface.BatteryInfo, SynchronousBlock):
    """State of a battery, which never is empty."""

    def step(self) -> int:
        """Tell that it is full."""
        self.state = brBATTERY_OK
        return ERR_OK


def _version_part(index: int) -> int:
    return VERSION[index] if index < len(VERSION) else 0


@function("OSVersionMajor")
def version_major(_context: Context) -> int:
    """Return the first number of this version of plcsim."""
    return _version_part(0)


@function("OSVersionMinor")
def version_minor(_context: Context) -> int:
    """Return the second number."""
    return _version_part(1)


@function("OSVersionPatch")
def version_patch(_context: Context) -> int:
    """Return the third number."""
    return _version_part(2)


@function("OSVersionBuild")
def version_build(_context: Context) -> int:
    """Return the fourth number."""
    return _version_part(3)


@function("RTCycleTime")
def cycle_time_us(context: Context, task_class: int) -> int:
    """Return the cycle time of a task class in microseconds, 0 where there is no such class."""
    controller = Controller.of(context)
    classes = () if controller is None else controller.classes
    return next((c.cycle_ns // NS_PER_US for c in classes if c.number == task_class), 0)


@function("RTCylceTime")
def cycle_time_us_as_misspelt(context: Context, task_class: int) -> int:
    """Return the same under the name that B&R misspelt once."""
    return cycle_time_us(context, task_class)


@function("RTTolerance")
def tolerance_us(context: Context) -> int:
    """Return the tolerance of the task class that calls, in microseconds; 0 outside of one."""
    found = _running_class(context)
    return 0 if found is None else found.tolerance_ns // NS_PER_US
