"""Library AsIOTime: times of the I/O cycle, in microseconds on the controller's clock."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.controller import Controller
from plcsim.library.executable import function

if TYPE_CHECKING:
    from plcsim.core.context import Context

NS_PER_US: Final = 1000


def _as_dint(number: int) -> int:
    number &= 0xFFFF_FFFF
    return number - (number >> 31 << 32)


@function("AsIOTimeStamp")
def time_stamp(context: Context) -> int:
    """Return the time now, which goes on within a cycle on the real clock."""
    controller = Controller.of(context)
    now_ns = context.release_ns if controller is None else controller.clock.now_ns()
    return _as_dint(now_ns // NS_PER_US)
