"""Tasks by ident: ST_name, ST_ident, ST_info, and stopping them; SYSreset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.control import Action, Request
from plcsim.core.controller import Controller
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK
from plcsim.library.sys_lib.interface import (
    ERR_BUR_ILLIDENT,
    ERR_BUR_ILLPAR,
    ERR_BUR_ILLPTR,
    ERR_BUR_MO_NOTFOUND,
    ERR_BUR_TOOLONG_PVNAME,
    SYSLIB_COLDSTART,
    SYSLIB_COLDSTART_NO_REBOOT,
    SYSLIB_WARMSTART,
    SYSLIB_WARMSTART_NO_REBOOT,
    Z_ST_running,
    Z_ST_tmp_suspended,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.context import Context
    from plcsim.core.task import Task

LONGEST_NAME: Final = 255

_RESTARTS: Final = {
    SYSLIB_WARMSTART: Action.WARM_RESTART,
    SYSLIB_WARMSTART_NO_REBOOT: Action.WARM_RESTART,
    SYSLIB_COLDSTART: Action.COLD_RESTART,
    SYSLIB_COLDSTART_NO_REBOOT: Action.COLD_RESTART,
}
_EXCEPTION_CLASS: Final = 0xF8
"""Number of the exception program's class: -8 in a byte."""


def name_at(context: Context, address: int) -> str | None:
    """Return the name at an address, None where it is too long.

    Raises:
        PageFault: it does not lie in memory.
    """
    name = context.memory.string(address, LONGEST_NAME + 1)
    return None if len(name) > LONGEST_NAME else name.decode("latin-1")


def running_name(context: Context) -> str:
    """Return the name of the task that calls, "" outside of one."""
    controller = Controller.of(context)
    task = None if controller is None else controller.running[1]
    return "" if task is None else task.name


def _task(context: Context, ident: int) -> Task | None:
    """Return a task by its ident, the one that calls for 0."""
    controller = Controller.of(context)
    if controller is None:
        return None
    if ident == 0:
        return controller.running[1]
    return controller.tasks[ident - 1] if ident <= len(controller.tasks) else None


@function("ST_name")
def name_of_task(context: Context, ident: int, p_name: int, p_group: int) -> int:
    """Store the name of a task, and 0 as its group; return a status."""
    task = _task(context, ident)
    if task is None:
        return ERR_BUR_ILLIDENT
    if not p_name:
        return ERR_BUR_ILLPTR
    context.memory.write(p_name, task.name.encode("latin-1", "replace") + b"\0")
    if p_group:
        context.memory.write(p_group, b"\0")
    return ERR_OK


@function("ST_ident")
def ident_of_task(context: Context, p_name: int, _group: int, p_ident: int) -> int:
    """Store the ident of a task; return a status."""
    if not p_name or not p_ident:
        return ERR_BUR_ILLPTR
    name = name_at(context, p_name)
    if name is None:
        return ERR_BUR_TOOLONG_PVNAME
    controller = Controller.of(context)
    tasks = [] if controller is None else controller.tasks
    for number, task in enumerate(tasks, 1):
        if task.name == name:
            context.memory.write(p_ident, number.to_bytes(4, "little"))
            return ERR_OK
    return ERR_BUR_MO_NOTFOUND


@function("ST_info")
def info_of_task(context: Context, ident: int, p_state: int, p_class: int) -> int:
    """Store the state of a task (USINT) and the number of its class (SINT); return a status."""
    controller, task = Controller.of(context), _task(context, ident)
    if controller is None or task is None:
        return ERR_BUR_ILLIDENT
    if not p_state or not p_class:
        return ERR_BUR_ILLPTR
    state = Z_ST_tmp_suspended if task.is_suspended else Z_ST_running
    numbers = [c.number for c in controller.classes if task in c.tasks]
    context.memory.write(p_state, bytes([state]))
    context.memory.write(p_class, bytes([*numbers, _EXCEPTION_CLASS][:1]))
    return ERR_OK


def _act(context: Context, ident: int, act: Callable[[Task], None]) -> int:
    task = _task(context, ident)
    if task is None:
        return ERR_BUR_ILLIDENT
    act(task)
    return ERR_OK


@function("ST_tmp_suspend")
def suspend_until_restart(context: Context, ident: int) -> int:
    """Leave CYCLIC of a task out, from its next cycle until the controller starts again."""
    return _act(context, ident, lambda task: task.suspend())


@function("ST_tmp_resume")
def resume_before_restart(context: Context, ident: int) -> int:
    """Let a suspended task go on."""
    return _act(context, ident, lambda task: task.resume())


@function("ST_suspend")
def suspend(context: Context, ident: int) -> int:
    """Do what ST_tmp_suspend does: no start of this controller knows what was before."""
    return suspend_until_restart(context, ident)


@function("ST_resume")
def resume(context: Context, ident: int) -> int:
    """Do what ST_tmp_resume does."""
    return resume_before_restart(context, ident)


@function("SYSreset")
def restart(context: Context, enable: bool, mode: int) -> int:  # as declared
    """Restart the controller after this cycle; return a status."""
    if not enable:
        return ERR_FUB_ENABLE_FALSE
    action, controller = _RESTARTS.get(mode), Controller.of(context)
    if action is None or controller is None:
        return ERR_BUR_ILLPAR
    controller.request(Request(action, source=running_name(context)))
    return ERR_OK
