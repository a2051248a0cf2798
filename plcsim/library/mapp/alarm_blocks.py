"""The blocks of MpAlarmX: the core, commands to alarms, and the list for the operator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.library.astime.structures import NS_PER_SECOND, date_of
from plcsim.library.mapp.alarm_functions import acknowledge, confirm, reset
from plcsim.library.mapp.block import MappBlock
from plcsim.library.mapp.errors import (
    MISSING_UICONNECT,
    NAME_NOT_FOUND,
)
from plcsim.library.mapp.links import links_of
from plcsim.library.mapp.monitoring import AlarmMonitor
from plcsim.library.members import BlockVariables, ReferredStructure, rises

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.mapp.alarms import AlarmCore, PendingAlarm
    from plcsim.library.mapp.configuration import AlarmConfiguration
    from plcsim.library.members import FindType
    from st_types.types.derived import StructType

NS_PER_MS: Final = 1_000_000


class _Monitors:
    """What looks at the variables of each core."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._by_core: dict[AlarmCore, AlarmMonitor] = {}

    def of(self, core: AlarmCore) -> AlarmMonitor:
        """Return what looks at the variables of a core."""
        if core not in self._by_core:
            self._by_core[core] = AlarmMonitor(self._context, core)
        return self._by_core[core]


class AlarmBlock(MappBlock):
    """A block that knows a core of alarms."""

    def call(self, address: int, variables: BlockVariables, link: int) -> None:
        """Run one call."""
        self.act(address, variables, self.core(link))

    def core(self, link: int) -> AlarmCore:
        """Return the core of an MpLink that is not 0."""
        core = links_of(self.context).at(link)
        assert core is not None
        return core

    def seen(self, _variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return how often something was done to the alarms."""
        return (self.core(link).changes,)

    def act(self, address: int, variables: BlockVariables, core: AlarmCore) -> None:
        """Run one call on the core."""
        raise NotImplementedError(type(self).__name__)

    def fail(self, variables: BlockVariables, status: int) -> None:
        """Show an error."""
        variables.set(Error=True, StatusID=status)


class AlarmXCore(AlarmBlock):
    """MpAlarmXCore: counts alarms, and sets those that variables stand for."""

    def find(self, place: int) -> int:
        """Let the core look at its variables, and return its MpLink."""
        if place:
            self.context.library(_Monitors).of(self.core(place)).look()
        return super().find(place)

    def act(self, address: int, variables: BlockVariables, core: AlarmCore) -> None:
        """Count."""
        if rises(self.context, address, variables, "AcknowledgeAll"):
            core.acknowledge(core.pending)
        variables.set(
            ActiveAlarms=sum(1 for _ in core.active),
            PendingAlarms=len(core.pending),
            UnacknowledgedAlarms=sum(1 for _ in core.unacknowledged),
            CommandDone=variables.is_true("AcknowledgeAll"),
        )

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Count nothing."""
        super().rest(address, variables)
        variables.set(ActiveAlarms=0, PendingAlarms=0, UnacknowledgedAlarms=0)


class AcknowledgeAll(AlarmBlock):
    """MpAlarmXAcknowledgeAll: at a rising edge of Execute."""

    def act(self, address: int, variables: BlockVariables, core: AlarmCore) -> None:
        """Acknowledge."""
        if rises(self.context, address, variables, "Execute"):
            core.acknowledge(core.pending)
        variables.set(
            CommandDone=variables.is_true("Execute"),
            Info__UnacknowledgedAlarms=sum(1 for _ in core.unacknowledged),
        )


_COMMANDS: Final = {"Reset": reset, "Acknowledge": acknowledge, "Confirm": confirm}
"""Inputs of MpAlarmXAlarmControl, beside Set."""


class AlarmControl(AlarmBlock):
    """MpAlarmXAlarmControl: one alarm, by Name, or by ID where that is not 0."""

    def seen(self, variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return the same, and which alarm it is."""
        return (*super().seen(variables, link), variables.text("Name"))

    def act(self, address: int, variables: BlockVariables, core: AlarmCore) -> None:
        """Take commands at their rising edges."""
        names = ("Set", *_COMMANDS)
        edges = [name for name in names if rises(self.context, address, variables, name)]
        status = 0
        for edge in edges:
            status = self._take(edge, variables, core) or status
        if edges:
            variables.set(CommandDone=status == 0)
        elif not any(map(variables.is_true, names)):
            variables.set(CommandDone=False)
        if status:
            self.fail(variables, status)

    def _take(self, edge: str, variables: BlockVariables, core: AlarmCore) -> int:
        """Take a command; return the status."""
        name, ident = variables.text("Name"), int(variables.number("ID"))
        if edge == "Set":
            made = core.set(name)
            variables.set(InstanceID=made)
            return 0 if made else NAME_NOT_FOUND
        found = core.numbered(ident) if ident else core.named(name)
        return _COMMANDS[edge](core, found)


_ASKED: Final = ("Acknowledge", "AcknowledgeAll", "AcknowledgeID", "AlarmList.SelectedIndex")
"""Members of UIConnect that the operator sets."""


class ListUI(AlarmBlock):
    """MpAlarmXListUI: the pending alarms at UIConnect, the latest first."""

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._connect = ReferredStructure(data_type, "UIConnect")

    def seen(self, variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return the same, and what the operator does."""
        screen = self._connect.of(self.context.memory, variables)
        asked = () if screen is None else tuple(map(screen.number, _ASKED))
        return (*super().seen(variables, link), *asked)

    def act(self, address: int, variables: BlockVariables, core: AlarmCore) -> None:
        """Take what the operator asks for, and show the list."""
        screen = self._connect.of(self.context.memory, variables)
        if screen is None:
            variables.set(StatusID=MISSING_UICONNECT)
            return
        room = screen.count_of("AlarmList.Name")
        size = int(variables.number("UISetup.AlarmListSize")) or room
        shown = core.pending[::-1][: min(size, room)]
        self._take(screen, core, shown)
        shown = [each for each in shown if each in core.pending]
        for index in range(min(size, room)):
            self._show(screen, index, shown[index] if index < len(shown) else None)
        screen.set(AlarmList__MaxSelection=max(len(shown) - 1, 0))

    def _take(self, screen: BlockVariables, core: AlarmCore, shown: list[PendingAlarm]) -> None:
        """Acknowledge what is selected, or all; the commands are taken back."""
        context, at = self.context, screen.start
        if rises(context, at, screen, "AcknowledgeAll"):
            core.acknowledge(core.pending)
        selected = int(screen.number("AlarmList.SelectedIndex"))
        if rises(context, at, screen, "Acknowledge") and selected < len(shown):
            core.acknowledge([shown[selected]])
        ident = int(screen.number("AcknowledgeID"))
        if ident:
            core.acknowledge(core.numbered(ident))
        screen.set(Acknowledge=False, AcknowledgeAll=False, AcknowledgeID=0)

    @staticmethod
    def _show(screen: BlockVariables, index: int, pending: PendingAlarm | None) -> None:
        alarm = None if pending is None else pending.alarm
        show_line(
            screen,
            index,
            alarm,
            InstanceID=0 if pending is None else pending.ident,
            StateActive=pending is not None and pending.is_active,
            StateAcknowledged=pending is not None and not pending.waits_for_acknowledgement,
            Timestamp="" if pending is None else date_text(pending.set_ns),
        )


def show_line(
    screen: BlockVariables, index: int, alarm: AlarmConfiguration | None, **more: float | str
) -> None:
    """Fill a line of an AlarmList, or empty it; ``more`` are the fields that not all lists have."""
    line: dict[str, float | str] = {
        "Severity": 0 if alarm is None else alarm.severity,
        "Code": 0 if alarm is None else alarm.code,
        "Message": "" if alarm is None else alarm.message,
        "Name": "" if alarm is None else alarm.name,
    }
    for name, value in (line | more).items():
        screen.set_element(f"AlarmList.{name}", index, value)


def date_text(date_ns: int) -> str:
    """Return a date as UISetup.TimeStampPattern has it unless it is set: with milliseconds."""
    seconds, rest_ns = divmod(date_ns, NS_PER_SECOND)
    return f"{date_of(seconds):%Y-%m-%d %H:%M:%S}:{rest_ns // NS_PER_MS:03}"


BLOCKS: Final[Mapping[str, type[MappBlock]]] = {
    "MpAlarmXCore": AlarmXCore,
    "MpAlarmXAcknowledgeAll": AcknowledgeAll,
    "MpAlarmXAlarmControl": AlarmControl,
    "MpAlarmXListUI": ListUI,
}
"""What runs the blocks by their names."""
