"""Alarms of one core: which are active, which are pending, and which reactions there are.

An alarm is set, then reset. It is pending until it is inactive and, where somebody has to, was
acknowledged.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.library.mapp.configuration import (
    Acknowledgement,
    AlarmBehavior,
    AlarmConfiguration,
    AlarmCoreConfiguration,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

MOST_PENDING: Final = 500
"""Alarms of a core that are pending at a time; what is beyond is not set."""

MOST_RECORDED: Final = 200
"""Changes of the alarms of a core that are kept; older ones make room."""


class AlarmState(IntEnum):
    """MpAlarmXStateEnum; no alarm here is to be confirmed."""

    NONE = 0
    ACTIVE = 1
    INACTIVE = 2
    ACKNOWLEDGED = 3
    UNACKNOWLEDGED = 4
    CONFIRMED = 5


class StateChange(NamedTuple):
    """An entry of the history.

    Attributes:
        alarm: whose state changed.
        old: its state before.
        new: its state since.
        date_ns: nanoseconds since 1970.
    """

    alarm: AlarmConfiguration
    old: AlarmState
    new: AlarmState
    date_ns: int


@dataclass(slots=True, eq=False)
class PendingAlarm:
    """An alarm that is active, or is not yet acknowledged.

    Attributes:
        ident: number of this instance, from 1 on.
        alarm: its configuration.
        set_ns: date when it was set last, nanoseconds since 1970.
        is_active: whether it is.
        is_acknowledged: likewise.
    """

    ident: int
    alarm: AlarmConfiguration
    set_ns: int
    is_active: bool = True
    is_acknowledged: bool = False

    @property
    def waits_for_acknowledgement(self) -> bool:
        """Whether somebody has to acknowledge it."""
        required = self.alarm.behavior.acknowledgement is not Acknowledgement.DISABLED
        return required and not self.is_acknowledged

    @property
    def reacts(self) -> bool:
        """Whether its reactions are there."""
        behavior = self.alarm.behavior
        return self.is_active or (behavior.reacts_while_pending and self.waits_for_acknowledgement)


class AlarmCore:
    """The alarms that one MpAlarmXCore collects.

    Args:
        configuration: of its alarms; without any, every name is an alarm that is active until it
            is reset.

        date: gives the date, nanoseconds since 1970.

    Attributes:
        configuration: as above.
        pending: in the order in which they were set.
        history: changes of their states, the oldest first.
        changes: how often something was done to them.
    """

    def __init__(self, configuration: AlarmCoreConfiguration, date: Callable[[], int]) -> None:
        self.configuration = configuration
        self._date = date
        self.pending: list[PendingAlarm] = []
        self.history: deque[StateChange] = deque(maxlen=MOST_RECORDED)
        self.changes = 0
        self._last = 0

    def alarm(self, name: str) -> AlarmConfiguration | None:
        """Return an alarm by its name, None where there is none."""
        known = self.configuration.alarms
        if known or not name:
            return known.get(name)
        return AlarmConfiguration(name, behavior=AlarmBehavior(auto_reset=False))

    def named(self, name: str) -> list[PendingAlarm]:
        """Return the pending alarms of a name."""
        return [each for each in self.pending if each.alarm.name == name]

    def numbered(self, ident: int) -> list[PendingAlarm]:
        """Return the pending alarm with a number, in a list, empty where there is none."""
        return [each for each in self.pending if each.ident == ident]

    @property
    def active(self) -> Iterator[PendingAlarm]:
        """Those that are active."""
        return (each for each in self.pending if each.is_active)

    @property
    def unacknowledged(self) -> Iterator[PendingAlarm]:
        """Those that somebody has to acknowledge."""
        return (each for each in self.pending if each.waits_for_acknowledgement)

    def set(self, name: str) -> int:
        """Set an alarm; return the number of its instance, 0 where there is no such alarm."""
        alarm = self.alarm(name)
        if alarm is None:
            return 0
        found = [] if alarm.behavior.has_instances else self.named(name)
        pending = found[0] if found else self._new(alarm)
        if pending is None:
            return 0
        if not pending.is_active:
            self.changes += 1
            pending.is_active, pending.set_ns = True, self._date()
            self._record(pending, AlarmState.INACTIVE, AlarmState.ACTIVE)
            if alarm.behavior.acknowledgement is Acknowledgement.RESETTABLE:
                pending.is_acknowledged = False
        if alarm.behavior.auto_reset:
            self.reset([pending])
        return pending.ident

    def _new(self, alarm: AlarmConfiguration) -> PendingAlarm | None:
        if len(self.pending) >= MOST_PENDING:
            return None
        self._last += 1
        self.changes += 1
        self.pending.append(made := PendingAlarm(self._last, alarm, self._date()))
        self._record(made, AlarmState.INACTIVE, AlarmState.ACTIVE)
        return made

    def reset(self, alarms: list[PendingAlarm]) -> None:
        """Let alarms be inactive."""
        for each in alarms:
            if each.is_active:
                self._record(each, AlarmState.ACTIVE, AlarmState.INACTIVE)
            each.is_active = False
        if alarms:
            self._forget()

    def acknowledge(self, alarms: list[PendingAlarm]) -> bool:
        """Acknowledge alarms; return whether all could be, for some must be inactive first."""
        refused = [
            each
            for each in alarms
            if each.is_active
            and each.alarm.behavior.acknowledgement is Acknowledgement.AFTER_ACTIVE
        ]
        for each in alarms:
            if each.waits_for_acknowledgement and each not in refused:
                self._record(each, AlarmState.UNACKNOWLEDGED, AlarmState.ACKNOWLEDGED)
            each.is_acknowledged = each not in refused
        if alarms:
            self._forget()
        return not refused

    def _record(self, pending: PendingAlarm, old: AlarmState, new: AlarmState) -> None:
        self.history.append(StateChange(pending.alarm, old, new, self._date()))

    def clear_history(self) -> None:
        """Forget all changes."""
        self.changes += 1
        self.history.clear()

    def _forget(self) -> None:
        """Forget what is neither active nor waits for anybody."""
        self.changes += 1
        self.pending = [
            each for each in self.pending if each.is_active or each.waits_for_acknowledgement
        ]

    def reacts(self, reaction: str, *, is_escalated: bool = False) -> bool:
        """Whether some alarm has a reaction, at this core or, escalated, at the one above it."""
        mappings = [
            each
            for each in self.configuration.mappings
            if each.reaction == reaction and each.is_escalated is is_escalated
        ]
        return any(
            each.reacts and any(mapping.follows_from(each.alarm) for mapping in mappings)
            for each in self.pending
        )
