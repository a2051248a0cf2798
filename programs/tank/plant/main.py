"""The tank itself: what flows in raises the level, what is pumped lowers it."""

from __future__ import annotations

from plcsim import Program
from st_types import LREAL, REAL, UDINT, var

from ..wiring import Wiring  # noqa: TID252  # the project is a package without a name

FULL_SCALE = 27648
NANOSECONDS = 1e-9


class Plant(Program):
    """A tank of one square metre and ten metres, with an overflow."""

    __slots__ = ("_before_ns", "_control")

    level = var(LREAL, 4.0)
    inflow = var(REAL, 0.25)
    outflow = var(REAL, 0.4)
    pumped = var(LREAL)
    spilled = var(LREAL)
    steps = var(UDINT)

    def init(self) -> None:
        """Find the controller's terminals; the sensor shows the level before the first cycle."""
        self._control = self.context.library(Wiring).control
        self._before_ns = self.context.release_ns
        self._show()

    def cyclic(self) -> None:
        """Let the time since the last cycle pass in the tank."""
        now_ns = self.context.release_ns
        self._flow((now_ns - self._before_ns) * NANOSECONDS)
        self._before_ns = now_ns
        self.steps += 1
        self._show()

    def _flow(self, seconds: float) -> None:
        control = self._control
        if control.valve_open:
            self.level += self.inflow * seconds
        if control.pump_on:
            taken = min(self.level, self.outflow * control.pump_speed / 100 * seconds)
            self.level -= taken
            self.pumped += taken
        if self.level > 10.0:
            self.spilled += self.level - 10.0
            self.level = 10.0

    def _show(self) -> None:
        """Drive the controller's inputs, a pulse for each tenth of a litre pumped."""
        control = self._control
        control.level_raw = round(self.level / 10.0 * FULL_SCALE)
        control.overflow_switch = self.level > 9.9
        control.flow_pulses = int(self.pumped * 10_000)
