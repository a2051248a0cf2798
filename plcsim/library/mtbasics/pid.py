"""MTBasicsPID."""

from __future__ import annotations

from typing import Any

from plcsim.library.mtbasics import interface
from plcsim.library.mtbasics.block import UpdatedBlock
from plcsim.library.mtbasics.interface import (
    mtBCD_ERR_OUTPUT_LIMIT_INVALID,
    mtBCD_ERR_TIME_CONSTANT1_INVALID,
)
from plcsim.library.mtbasics.signals import BasicsBlock
from plcsim.library.mttypes import MTPIDIntegrationEnum


class MTBasicsPID(interface.MTBasicsPID, BasicsBlock, UpdatedBlock):
    """PID controller in its parallel form, with a filtered derivative and clamped integration.

    With e = SetValue - ActValue (negated by Invert), h the cycle time and the parameters Gain K,
    IntegrationTime Ti, DerivativeTime Td, FilterTime Tf::

        P = K * e
        I = I + K * e * h / Ti                      (0 for Ti = 0)
        D = (Tf * D + K * Td * (e - e before)) / (Tf + h)
        Out = P + I + D, within MinOut and MaxOut

    I is held while Out is at a limit and e would drive it further, and as HoldIntegration says.
    HoldOut keeps everything. With EnableTracking Out is TrackingValue, and I follows so that Out
    goes on from there. A rising edge of SetIntegrationPart puts I to IntegrationPartPresetValue.
    """

    Internal: Any

    def wrong(self) -> int:
        """Look at limits and times."""
        if self.MinOut >= self.MaxOut:
            return mtBCD_ERR_OUTPUT_LIMIT_INVALID
        given = self.PIDParameters
        times = (given.IntegrationTime, given.DerivativeTime, given.FilterTime)
        return mtBCD_ERR_TIME_CONSTANT1_INVALID if min(times) < 0 else 0

    def take(self) -> None:
        """Take the parameters over."""
        own, given = self.Internal, self.PIDParameters
        for name in ("Gain", "IntegrationTime", "DerivativeTime", "FilterTime"):
            setattr(own.Parameters, name, getattr(given, name))
        own.MinOut, own.MaxOut, own.Invert = self.MinOut, self.MaxOut, self.Invert

    def begin(self) -> None:
        """Begin with no past."""
        own = self.Internal
        own.Integral = own.Derivative = 0.0
        own.IsFirst = True

    def run(self, step_s: float) -> None:
        """Go one step."""
        own = self.Internal
        error = self.SetValue - self.ActValue
        self.ControlError = error
        if self.HoldOut:
            return
        error = -error if own.Invert else error
        proportional = own.Parameters.Gain * error
        self._differentiate(error, step_s)
        rest = proportional + own.Derivative
        self._integrate(error, rest, step_s)
        self.ProportionalPart, self.DerivativePart = proportional, own.Derivative
        self.IntegrationPart = own.Integral
        self.Out = min(max(rest + own.Integral, own.MinOut), own.MaxOut)
        self.TrackingActive = self.EnableTracking

    def _differentiate(self, error: float, step_s: float) -> None:
        own = self.Internal
        change = 0.0 if own.IsFirst else error - own.ErrorOld
        given, span = own.Parameters, own.Parameters.FilterTime + step_s
        if span > 0:
            part = given.Gain * given.DerivativeTime * change
            own.Derivative = (given.FilterTime * own.Derivative + part) / span
        own.ErrorOld, own.IsFirst = error, False

    def _integrate(self, error: float, rest: float, step_s: float) -> None:
        own, given = self.Internal, self.Internal.Parameters
        self.IntegrationStatus = MTPIDIntegrationEnum.mtINTEGRATION_FREE
        if self.rises(self.SetIntegrationPart):
            own.Integral = self.IntegrationPartPresetValue
        elif self.EnableTracking:
            own.Integral = min(max(self.TrackingValue, own.MinOut), own.MaxOut) - rest
        elif given.IntegrationTime > 0:
            growth = given.Gain * error * step_s / given.IntegrationTime
            self._grow(growth, rest)

    def _grow(self, growth: float, rest: float) -> None:
        own, held = self.Internal, self.HoldIntegration
        up, down = (
            MTPIDIntegrationEnum.mtHOLD_INTEGRATION_POSITIVE,
            MTPIDIntegrationEnum.mtHOLD_INTEGRATION_NEGATIVE,
        )
        sum_ = rest + own.Integral
        if growth > 0 and (sum_ >= own.MaxOut or held == up):
            self.IntegrationStatus = up
        elif growth < 0 and (sum_ <= own.MinOut or held == down):
            self.IntegrationStatus = down
        else:
            own.Integral += growth
