"""MTBasicsLimiter, MTBasicsTimeDelay, MTBasicsPT1, MTBasicsPWM."""

from __future__ import annotations

import math
import struct
from typing import Any, Final

from plcsim.library.heap import heap_of
from plcsim.library.mtbasics import interface
from plcsim.library.mtbasics.block import OK, ControlBlock, UpdatedBlock
from plcsim.library.mtbasics.interface import (
    MTBasicsPWMModeEnum,
    mtBCD_ERR_MAX_NEG_SLEW_RATE_NEG,
    mtBCD_ERR_MAX_POS_SLEW_RATE_NEG,
    mtBCD_ERR_MIN_PULSE_HIGH,
    mtBCD_ERR_MIN_PULSE_LOW,
    mtBCD_ERR_MODE_INVALID,
    mtBCD_ERR_OUTPUT_LIMIT_INVALID,
    mtBCD_ERR_PERIOD_LOW,
    mtBCD_ERR_TIME_CONSTANT1_INVALID,
)

_REAL: Final = struct.Struct("<f")
LONGEST_DELAY: Final = 100_000
"""Cycles."""


class BasicsBlock(ControlBlock):
    """Base of the blocks of MTBasics."""

    __slots__ = ()

    Internal: Any

    @property
    def common(self) -> Any:
        """What the block keeps."""
        return self.Internal.Common

    def rises(self, setting: bool) -> bool:  # a signal
        """Return whether an input has become TRUE."""
        common = self.common
        before, common.SetOld = common.SetOld, setting
        return setting and not before


class MTBasicsLimiter(interface.MTBasicsLimiter, BasicsBlock, UpdatedBlock):
    """Out follows In, within MinOut and MaxOut and by no more than the slew rates.

    The first value is taken over at once. A slew rate of 0 is no limit. A rising edge of SetOut
    puts Out to OutPresetValue.
    """

    def wrong(self) -> int:
        """Look at limits and slew rates."""
        if self.MinOut >= self.MaxOut:
            return mtBCD_ERR_OUTPUT_LIMIT_INVALID
        if self.MaxPosSlewRate < 0:
            return mtBCD_ERR_MAX_POS_SLEW_RATE_NEG
        return mtBCD_ERR_MAX_NEG_SLEW_RATE_NEG if self.MaxNegSlewRate < 0 else OK

    def take(self) -> None:
        """Take them over."""
        own = self.Internal
        own.MinOut, own.MaxOut = self.MinOut, self.MaxOut
        own.MaxPosSlewRate, own.MaxNegSlewRate = self.MaxPosSlewRate, self.MaxNegSlewRate

    def begin(self) -> None:
        """Take the first value at once."""
        self.Internal.IsFirst = True

    def run(self, step_s: float) -> None:
        """Follow In."""
        own = self.Internal
        wanted = min(max(self.In, own.MinOut), own.MaxOut)
        if self.rises(self.SetOut):
            wanted = min(max(self.OutPresetValue, own.MinOut), own.MaxOut)
        elif not own.IsFirst:
            up = own.MaxPosSlewRate * step_s or math.inf
            down = own.MaxNegSlewRate * step_s or math.inf
            wanted = min(max(wanted, own.Value - down), own.Value + up)
        own.IsFirst = False
        own.Value = self.Out = wanted


class MTBasicsPT1(interface.MTBasicsPT1, BasicsBlock, UpdatedBlock):
    """First-order lag: ``Out' = (Gain * In - Out) / TimeConstant``, exact for In held in a cycle.

    It begins at 0; a TimeConstant of 0 gives ``Gain * In``. A rising edge of SetOut puts Out to
    OutPresetValue.
    """

    def wrong(self) -> int:
        """Look at the time constant."""
        return mtBCD_ERR_TIME_CONSTANT1_INVALID if self.TimeConstant < 0 else OK

    def take(self) -> None:
        """Take gain and time constant over."""
        self.Internal.Gain, self.Internal.TimeConstant = self.Gain, self.TimeConstant

    def begin(self) -> None:
        """Begin at 0."""
        self.Internal.Value = 0.0

    def run(self, step_s: float) -> None:
        """Go one step."""
        own = self.Internal
        rest = math.exp(-step_s / own.TimeConstant) if own.TimeConstant > 0 else 0.0
        own.Value = own.Value * rest + own.Gain * self.In * (1 - rest)
        if self.rises(self.SetOut):
            own.Value = self.OutPresetValue
        self.Out = own.Value


class MTBasicsTimeDelay(interface.MTBasicsTimeDelay, BasicsBlock):
    """Out is what In was DelayTime seconds ago, in whole cycles; before that InitialValue.

    DelayTime is taken over when the block is enabled. At most `LONGEST_DELAY` cycles.
    """

    def wrong(self) -> int:
        """Look at the delay."""
        return OK if 0 <= self._cycles <= LONGEST_DELAY else mtBCD_ERR_TIME_CONSTANT1_INVALID

    @property
    def _cycles(self) -> int:
        if not (self.step_s and math.isfinite(self.DelayTime)):
            return 0 if not self.DelayTime else -1
        return round(self.DelayTime / self.step_s)

    def take(self) -> None:
        """Reserve memory for the values."""
        own = self.Internal
        own.Count, own.Next = self._cycles, 0
        own.pValues = (heap_of(self.context).allocate(4 * own.Count) if own.Count else None) or 0
        values = _REAL.pack(self.InitialValue) * own.Count
        if own.pValues:
            self.context.memory.write(own.pValues, values)

    def run(self, _step_s: float) -> None:
        """Take a value, and give the oldest one."""
        own, memory = self.Internal, self.context.memory
        if not own.pValues:
            self.Out = self.In
            return
        place = own.pValues + 4 * own.Next
        (self.Out,) = _REAL.unpack(memory.read(place, 4))
        memory.write(place, _REAL.pack(self.In))
        own.Next = (own.Next + 1) % own.Count

    def end(self) -> None:
        """Give the memory back."""
        heap_of(self.context).release(self.Internal.pValues)
        self.Internal.pValues = 0


class MTBasicsPWM(interface.MTBasicsPWM, BasicsBlock, UpdatedBlock):
    """Out is TRUE for DutyCycle per cent of every Period, in whole cycles.

    DutyCycle is taken at the start of a period, within 0 to 100. A pulse or a pause that would be
    shorter than MinPulseWidth is left out. The pulse begins the period or lies in its middle.
    """

    def wrong(self) -> int:
        """Look at mode, period and shortest pulse."""
        if self.Mode not in [*MTBasicsPWMModeEnum]:
            return mtBCD_ERR_MODE_INVALID
        if self.Period <= self.step_s:
            return mtBCD_ERR_PERIOD_LOW
        if self.MinPulseWidth < 0:
            return mtBCD_ERR_MIN_PULSE_LOW
        return mtBCD_ERR_MIN_PULSE_HIGH if self.MinPulseWidth >= self.Period else OK

    def take(self) -> None:
        """Take them over."""
        own = self.Internal
        own.Mode, own.Period, own.MinPulseWidth = self.Mode, self.Period, self.MinPulseWidth

    def begin(self) -> None:
        """Begin a period with the first call."""
        self.Internal.Elapsed = self.Internal.Period

    def run(self, step_s: float) -> None:
        """Go one step."""
        own = self.Internal
        if own.Elapsed > own.Period - step_s / 2:
            own.Elapsed = 0.0
            own.OnTime = self._on_time(own.Period, own.MinPulseWidth)
        first = 0.0
        if own.Mode == MTBasicsPWMModeEnum.mtBASICS_PULSE_MIDDLE:
            first = (own.Period - own.OnTime) / 2
        self.Out = first - step_s / 2 <= own.Elapsed < first + own.OnTime - step_s / 2
        own.Elapsed += step_s

    def _on_time(self, period: float, shortest: float) -> float:
        on_time = min(max(self.DutyCycle, 0.0), 100.0) / 100 * period
        if on_time < shortest:
            return 0.0
        return period if period - on_time < shortest else on_time
