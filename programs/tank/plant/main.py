"""The tank itself: what flows in raises the level, what is pumped lowers it."""

from __future__ import annotations

from plcsim import Program, var_external
from st_types import BOOL, INT, LREAL, REAL, UDINT, var

NANOSECONDS = 1e-9


class Plant(Program):
    """A tank of one square metre and ten metres, with an overflow."""

    __slots__ = ("_before_ns",)

    # terminals, see Global.var
    level_raw = var_external(INT)
    overflow_switch = var_external(BOOL)
    flow_pulses = var_external(UDINT)
    valve_open = var_external(BOOL)
    pump_on = var_external(BOOL)
    pump_drive = var_external(INT)
    FULL_SCALE = var_external(INT)

    level = var(LREAL, 4.0)
    inflow = var(REAL, 0.25)
    outflow = var(REAL, 0.4)
    pumped = var(LREAL)
    spilled = var(LREAL)
    steps = var(UDINT)

    def init(self) -> None:
        """Let the sensor show the level before the first cycle."""
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
        if self.valve_open:
            self.level += self.inflow * seconds
        if self.pump_on:
            taken = min(self.level, self.outflow * self.pump_drive / 100 * seconds)
            self.level -= taken
            self.pumped += taken
        if self.level > 10.0:
            self.spilled += self.level - 10.0
            self.level = 10.0

    def _show(self) -> None:
        """Drive the controller's inputs, a pulse for each tenth of a litre pumped."""
        self.level_raw = round(self.level / 10.0 * self.FULL_SCALE)
        self.overflow_switch = self.level > 9.9
        self.flow_pulses = int(self.pumped * 10_000)
