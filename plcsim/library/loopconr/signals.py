"""A straight line, limits, and the mean of the latest values."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final

from plcsim.library.heap import heap_of
from plcsim.library.loopconr import interface
from plcsim.library.loopconr.interface import LCR_ERR_LCRMovAvgFlt_BASE
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK

if TYPE_CHECKING:
    from typing import Any

_REAL: Final = struct.Struct("<f")
LEAST: Final = -(2**31)
MOST: Final = 2**31 - 1


def _on_line(block: Any) -> float:
    """Return y of the line through (x1, y1) and (x2, y2); y1 where they have one x."""
    if block.x2 == block.x1:
        return float(block.y1)
    slope = (block.y2 - block.y1) / (block.x2 - block.x1)
    return float(block.y1 + (block.x - block.x1) * slope)


class LCRScal(interface.LCRScal):
    """``y`` on the straight line through two points. Inputs: x, x1, y1, x2, y2. Output: y."""

    def execute(self) -> None:
        """Calculate it."""
        self.y = _on_line(self)


class LCRLimScal(interface.LCRLimScal):
    """The same, limited to what lies between y1 and y2."""

    def execute(self) -> None:
        """Calculate it."""
        low, high = sorted((self.y1, self.y2))
        self.y = min(max(_on_line(self), low), high)


class LCRLimit(interface.LCRLimit):
    """A value as a DINT, rounded, within min_value and max_value.

    Outputs: out; max_limit and min_limit tell whether it was above or below; status ERR_OK.
    """

    def execute(self) -> None:
        """Limit it."""
        value = getattr(self, "in")
        low, high = self.min_value, self.max_value
        self.max_limit, self.min_limit = value > high, value < low
        held = min(max(value, low), high) if value == value else low  # noqa: PLR0124  # not a number
        rounded = int(held + (0.5 if held >= 0 else -0.5))
        self.out = min(max(rounded, LEAST), MOST)
        self.status = ERR_OK


class LCRMovAvgFlt(interface.LCRMovAvgFlt):
    """The mean of the latest ``base`` values, of fewer while there are no more.

    Inputs: enable, x, base. Outputs: y; status (ERR_OK, ERR_FUB_ENABLE_FALSE,
    LCR_ERR_LCRMovAvgFlt_BASE where base is 0 or memory is full). With enable FALSE, or another
    base, it begins anew. The values lie on the heap, at p_xold.
    """

    def execute(self) -> None:
        """Take a value."""
        if not self.enable:
            self._forget()
            self.status = ERR_FUB_ENABLE_FALSE
            return
        if self.base != self.base_old or not self.enable_old:
            self._forget()
            self._begin()
        if not self.p_xold:
            self.status = LCR_ERR_LCRMovAvgFlt_BASE
            return
        self.status = ERR_OK
        self.y = self._taken(self.x)

    def _begin(self) -> None:
        self.p_xold = (heap_of(self.context).allocate(4 * self.base) if self.base else None) or 0
        self.base_old, self.enable_old = self.base, True
        self.i_xold = self.bootkey_old = 0

    def _forget(self) -> None:
        if self.enable_old and self.p_xold:
            heap_of(self.context).release(self.p_xold)
        self.p_xold, self.enable_old = 0, False

    def _taken(self, x: float) -> float:
        """Put a value in place of the oldest one; return the mean.

        bootkey_old counts the values that are there, i_xold is the place of the next one.
        """
        memory = self.context.memory
        memory.write(self.p_xold + 4 * self.i_xold, _REAL.pack(x))
        self.i_xold = (self.i_xold + 1) % self.base
        self.bootkey_old = count = min(self.bootkey_old + 1, self.base)
        values = memory.view(self.p_xold, 4 * count)
        return sum(values.cast("f")) / count
