"""What the configuration of mapp says of alarms: which there are, and what follows from them."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping


class Acknowledgement(IntEnum):
    """When an alarm is to be acknowledged; the numbers are those of MpAlarmXAcknowledgeConfigEnum.

    Versions of the library number what can be acknowledged again in two ways: 2 here is what
    needs the alarm to be inactive.
    """

    DISABLED = 0
    REQUIRED = 1
    AFTER_ACTIVE = 2
    RESETTABLE = 3


@dataclass(frozen=True)
class AlarmBehavior:
    """How an alarm behaves.

    Attributes:
        auto_reset: it is inactive as soon as it was set.
        acknowledgement: when it is to be acknowledged.
        has_instances: each time it is set there is one more.
        reacts_while_pending: its reactions last until it is acknowledged, too.
    """

    auto_reset: bool = True
    acknowledgement: Acknowledgement = Acknowledgement.REQUIRED
    has_instances: bool = False
    reacts_while_pending: bool = True


@dataclass(frozen=True)
class Monitoring:
    """A variable that sets and resets an alarm.

    Attributes:
        variable: its name.
        triggers: values of it; empty where limits count.
        setpoint: the variable that its distance is taken from; "" for none.
        low: what it must not be below: a number, or the name of a variable; "" for no limit.
        high: what it must not be above, likewise.
        delay_ns: how long that must last.
    """

    variable: str
    triggers: tuple[float, ...] = ()
    setpoint: str = ""
    low: str = ""
    high: str = ""
    delay_ns: int = 0


@dataclass(frozen=True)
class AlarmConfiguration:
    """An alarm.

    Attributes:
        name: of it.
        message: for the operator.
        code: likewise.
        severity: of it.
        behavior: of it.
        monitoring: what sets it by itself; None for nothing.
    """

    name: str
    message: str = ""
    code: int = 0
    severity: int = 1
    behavior: AlarmBehavior = field(default_factory=AlarmBehavior)
    monitoring: Monitoring | None = None


@dataclass(frozen=True)
class AlarmMapping:
    """A reaction to alarms.

    Attributes:
        reaction: its name.
        alarm: the one that it follows from; "" for all of some severities.
        severities: these; empty, and no alarm, for all.
        is_escalated: it is another core's.
    """

    reaction: str
    alarm: str = ""
    severities: tuple[range, ...] = ()
    is_escalated: bool = False

    def follows_from(self, alarm: AlarmConfiguration) -> bool:
        """Whether an alarm has this reaction."""
        if self.alarm:
            return alarm.name == self.alarm
        return not self.severities or any(alarm.severity in each for each in self.severities)


@dataclass(frozen=True)
class AlarmCoreConfiguration:
    """An element of type mpalarmxcore.

    Attributes:
        alarms: by their names.
        mappings: what follows from them.
    """

    alarms: Mapping[str, AlarmConfiguration] = field(default_factory=dict)
    mappings: tuple[AlarmMapping, ...] = ()


@dataclass(frozen=True)
class MappConfiguration:
    """The configuration of mapp of a project.

    Attributes:
        cores: of alarms, by the names of their variables.
    """

    cores: Mapping[str, AlarmCoreConfiguration] = field(default_factory=dict)
