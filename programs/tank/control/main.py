"""Keeps the level of the tank between limits, runs the pump on request, raises alarms."""

from plcsim import Program, var_external
from plcsim.library.standard import TON
from st_types import BOOL, INT, REAL, STRING, TIME, UDINT, UINT, var


class Control(Program):
    """Two-point control of the inlet valve, a pump by hand, latched alarms."""

    # terminals, see Global.var
    level_raw = var_external(INT)
    overflow_switch = var_external(BOOL)
    flow_pulses = var_external(UDINT)
    valve_open = var_external(BOOL)
    pump_on = var_external(BOOL)
    pump_drive = var_external(INT)
    FULL_SCALE = var_external(INT)
    # what an operator sets
    automatic = var(BOOL, initial=True)
    valve_request = var(BOOL)
    pump_request = var(BOOL)
    alarm_acknowledge = var(BOOL)
    setpoint = var(REAL, 6.0)
    hysteresis = var(REAL, 0.2)
    pump_speed = var(INT, 60)
    batch = var(STRING(15), "water")
    # what an operator sees
    level = var(REAL)
    range = var(REAL, 10.0)
    alarm_high = var(BOOL)
    alarm_low = var(BOOL)
    any_alarm = var(BOOL)
    alarms = var(UINT)
    litres = var(UDINT)
    high_delay = var(TIME, 1000)
    high_timer = var(TON)

    def cyclic(self) -> None:
        """Read the level, decide on valve and pump, look after the alarms."""
        self.level = self.level_raw * self.range / self.FULL_SCALE
        self.litres = self.flow_pulses // 10
        self._drive_valve()
        self.pump_on = self.pump_request and self.level > 0.1
        self.pump_drive = self.pump_speed
        self._watch_alarms()

    def _drive_valve(self) -> None:
        if not self.automatic:
            self.valve_open = self.valve_request
        elif self.level < self.setpoint - self.hysteresis:
            self.valve_open = True
        elif self.level >= self.setpoint:
            self.valve_open = False
        if self.overflow_switch:
            self.valve_open = False

    def _watch_alarms(self) -> None:
        """Raise alarms, keep them until they are acknowledged and their cause has gone."""
        self.high_timer(IN=self.level > 9.0, PT=self.high_delay)
        low = self.level < 0.5
        keep = not self.alarm_acknowledge
        raised = (self.high_timer.Q and not self.alarm_high) or (low and not self.alarm_low)
        self.alarm_high = self.high_timer.Q or (self.alarm_high and keep)
        self.alarm_low = low or (self.alarm_low and keep)
        self.any_alarm = self.alarm_high or self.alarm_low
        self.alarms += int(raised)
        self.alarm_acknowledge = False
