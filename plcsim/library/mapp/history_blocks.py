"""The history of alarms: which changed its state when, of all cores of the controller."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.library.mapp.alarm_blocks import date_text, show_line
from plcsim.library.mapp.block import MappBlock
from plcsim.library.mapp.errors import MISSING_UICONNECT, NO_ERROR
from plcsim.library.mapp.links import links_of
from plcsim.library.members import ReferredStructure

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context
    from plcsim.library.mapp.alarms import StateChange
    from plcsim.library.members import BlockVariables, FindType
    from st_types.types.derived import StructType


def history_of(context: Context) -> list[StateChange]:
    """Return the changes of alarms of a controller, the oldest first."""
    found = (each for core in links_of(context) for each in core.history)
    return sorted(found, key=lambda each: each.date_ns)


def clear_history(context: Context, _p_link: int) -> int:
    """MpAlarmXClearHistory: of all cores."""
    for core in links_of(context):
        core.clear_history()
    return NO_ERROR


class HistoryBlock(MappBlock):
    """A block that knows the history; its MpLink is that of the history, not of a core."""

    def seen(self, _variables: BlockVariables, _link: int) -> tuple[object, ...]:
        """Return how often something was done to the alarms."""
        return tuple(core.changes for core in links_of(self.context))


class AlarmHistory(HistoryBlock):
    """MpAlarmXHistory: counts entries; an export writes no file."""

    def call(self, _address: int, variables: BlockVariables, _link: int) -> None:
        """Count."""
        variables.set(
            HistoryEntries=len(history_of(self.context)),
            CommandDone=variables.is_true("Export"),
            CommandBusy=False,
        )


class HistoryUI(HistoryBlock):
    """MpAlarmXHistoryUI: the entries at UIConnect, the latest first."""

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._connect = ReferredStructure(data_type, "UIConnect")

    def call(self, _address: int, variables: BlockVariables, _link: int) -> None:
        """Show the list."""
        screen = self._connect.of(self.context.memory, variables)
        if screen is None:
            variables.set(StatusID=MISSING_UICONNECT)
            return
        room = screen.count_of("AlarmList.Name")
        size = min(int(variables.number("UISetup.AlarmListSize")) or room, room)
        shown = history_of(self.context)[::-1][:size]
        for index in range(size):
            self._show(screen, index, shown[index] if index < len(shown) else None)
        screen.set(AlarmList__MaxSelection=max(len(shown) - 1, 0))

    @staticmethod
    def _show(screen: BlockVariables, index: int, change: StateChange | None) -> None:
        alarm = None if change is None else change.alarm
        show_line(
            screen,
            index,
            alarm,
            OldState=0 if change is None else change.old,
            NewState=0 if change is None else change.new,
            Timestamp="" if change is None else date_text(change.date_ns),
        )


BLOCKS: Final[Mapping[str, type[MappBlock]]] = {
    "MpAlarmXHistory": AlarmHistory,
    "MpAlarmXHistoryUI": HistoryUI,
}
"""What runs the blocks by their names."""

FUNCTIONS: Final[Mapping[str, Callable[..., Any]]] = {"MpAlarmXClearHistory": clear_history}
"""What runs the functions by their names."""
