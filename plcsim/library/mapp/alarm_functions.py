"""The functions of MpAlarmX: they take an MpLink and an alarm, by its name or its number."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.library.mapp.alarms import AlarmState
from plcsim.library.mapp.errors import ACK_NOT_ALLOWED, ALARM_NOT_ACTIVE, MPLINK_NULL, NO_ERROR
from plcsim.library.mapp.links import links_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context
    from plcsim.library.mapp.alarms import AlarmCore, PendingAlarm

    Find = Callable[[Context, AlarmCore, int], list[PendingAlarm]]
    Do = Callable[[AlarmCore, list[PendingAlarm]], int]

LONGEST_NAME: Final = 255


def _name(context: Context, address: int) -> str:
    return context.memory.string(address, LONGEST_NAME + 1).decode("latin-1")


def _named(context: Context, core: AlarmCore, p_name: int) -> list[PendingAlarm]:
    return core.named(_name(context, p_name))


def _numbered(_context: Context, core: AlarmCore, ident: int) -> list[PendingAlarm]:
    return core.numbered(ident)


def set_alarm(context: Context, p_link: int, p_name: int) -> int:
    """MpAlarmXSet: return the number of the instance, 0 where there is no such alarm."""
    core = links_of(context).at(p_link)
    return 0 if core is None else core.set(_name(context, p_name))


def reset(core: AlarmCore, found: list[PendingAlarm]) -> int:
    """Let alarms be inactive; return the status."""
    core.reset(found)
    return NO_ERROR if found else ALARM_NOT_ACTIVE


def acknowledge(core: AlarmCore, found: list[PendingAlarm]) -> int:
    """Acknowledge alarms; return the status."""
    if not found:
        return ALARM_NOT_ACTIVE
    return NO_ERROR if core.acknowledge(found) else ACK_NOT_ALLOWED


def confirm(_core: AlarmCore, found: list[PendingAlarm]) -> int:
    """Return the status; no alarm here is to be confirmed."""
    return NO_ERROR if found else ALARM_NOT_ACTIVE


def _command(find: Find, do: Do) -> Callable[[Context, int, int], int]:
    """Return a function that does something with the alarms that it finds."""

    def command(context: Context, p_link: int, alarm: int) -> int:
        core = links_of(context).at(p_link)
        return MPLINK_NULL if core is None else do(core, find(context, core, alarm))

    return command


def _check(find: Find) -> Callable[[Context, int, int, int], bool]:
    """MpAlarmXCheckState, MpAlarmXCheckStateID."""

    def check(context: Context, p_link: int, alarm: int, state: int) -> bool:
        core = links_of(context).at(p_link)
        found = [] if core is None else find(context, core, alarm)
        return any(_has_state(each, state) for each in found) if found else state == AlarmState.NONE

    return check


def _has_state(pending: PendingAlarm, state: int) -> bool:
    match state:
        case AlarmState.ACTIVE:
            return pending.is_active
        case AlarmState.INACTIVE:
            return not pending.is_active
        case AlarmState.ACKNOWLEDGED:
            return not pending.waits_for_acknowledgement
        case AlarmState.UNACKNOWLEDGED:
            return pending.waits_for_acknowledgement
        case _:
            return state == AlarmState.CONFIRMED


def check_reaction(context: Context, p_link: int, p_name: int) -> bool:
    """MpAlarmXCheckReaction: whether an alarm has it here, or escalates it from another core."""
    links = links_of(context)
    core, name = links.at(p_link), _name(context, p_name)
    if core is None:
        return False
    others = (each for each in links if each is not core)
    return core.reacts(name) or any(each.reacts(name, is_escalated=True) for each in others)


FUNCTIONS: Final[Mapping[str, Callable[..., Any]]] = {
    "MpAlarmXSet": set_alarm,
    "MpAlarmXReset": _command(_named, reset),
    "MpAlarmXResetID": _command(_numbered, reset),
    "MpAlarmXAcknowledge": _command(_named, acknowledge),
    "MpAlarmXAcknowledgeID": _command(_numbered, acknowledge),
    "MpAlarmXCheckState": _check(_named),
    "MpAlarmXCheckStateID": _check(_numbered),
    "MpAlarmXCheckReaction": check_reaction,
}
"""What runs the functions by their names: with the context, then their parameters."""
