"""Alarms that variables set and reset by themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.library.sys_lib.variables import find_variable

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.core.tag import Tag
    from plcsim.library.mapp.alarms import AlarmCore
    from plcsim.library.mapp.configuration import Monitoring


class AlarmMonitor:
    """Looks at the variables that the alarms of a core name.

    Args:
        context: of the controller.
        core: the alarms.
    """

    def __init__(self, context: Context, core: AlarmCore) -> None:
        self._context = context
        self._core = core
        self._watched = [
            (alarm.name, alarm.monitoring)
            for alarm in core.configuration.alarms.values()
            if alarm.monitoring is not None
        ]
        self._tags: dict[str, Tag | None] = {}
        self._since_ns: dict[str, int] = {}

    def look(self) -> None:
        """Set and reset alarms; what lasts shorter than its delay sets none."""
        now_ns = self._context.release_ns
        for name, monitoring in self._watched:
            pending = self._core.named(name)
            if not self._is_wrong(monitoring):
                self._since_ns.pop(name, None)
                if any(each.is_active for each in pending):
                    self._core.reset(pending)
            elif now_ns - self._since_ns.setdefault(name, now_ns) >= monitoring.delay_ns and not (
                any(each.is_active for each in pending)
            ):
                self._core.set(name)

    def _is_wrong(self, monitoring: Monitoring) -> bool:
        value = self._value(monitoring.variable)
        if value is None:
            return False
        if monitoring.triggers:
            return value in monitoring.triggers
        if monitoring.setpoint:
            setpoint = self._value(monitoring.setpoint)
            if setpoint is None:
                return False
            value -= setpoint
        low, high = self._value(monitoring.low), self._value(monitoring.high)
        return (low is not None and value < low) or (high is not None and value > high)

    def _value(self, name: str) -> float | None:
        """Return a number, or the value of the variable of this name; None where there is none."""
        if not name:
            return None
        try:
            return float(name)
        except ValueError:
            pass
        if name not in self._tags:
            self._tags[name] = find_variable(self._context, name)
        tag = self._tags[name]
        value = None if tag is None else self._context.memory.get(tag.data_type, tag.address)
        return value if isinstance(value, int | float) else None
