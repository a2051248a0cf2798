"""Errors that programs report: into the logbook, or as the end of the application."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.controller import Controller
from plcsim.core.errors import ApplicationError
from plcsim.core.logbook import Severity
from plcsim.core.text import escaped
from plcsim.library.executable import function
from plcsim.library.runtime import ERR_OK
from plcsim.library.sys_lib.tasks import running_name

if TYPE_CHECKING:
    from plcsim.core.context import Context

LONGEST_TEXT: Final = 33
"""Characters of a text that an entry takes."""


def _described(context: Context, number: int, info: int, p_text: int) -> str:
    """Return an error in one line."""
    text = f"error {number}, info 16#{info:08X}"
    if p_text:
        own = context.memory.string(p_text, LONGEST_TEXT).decode("latin-1")
        text = f"{escaped(own)} ({text})"
    return text


@function("ERRxfatal")
def end_with_text(context: Context, number: int, info: int, p_text: int) -> int:
    """End the application: the controller goes to SERVICE.

    Raises:
        ApplicationError: always.
    """
    raise ApplicationError(_described(context, number, info, p_text))


@function("ERR_fatal")
def end(context: Context, number: int, info: int) -> int:
    """End the application, likewise.

    Raises:
        ApplicationError: always.
    """
    raise ApplicationError(_described(context, number, info, 0))


@function("ERRxwarning")
def warn_with_text(context: Context, number: int, info: int, p_text: int) -> int:
    """Write a warning into the logbook; return a status."""
    controller = Controller.of(context)
    if controller is not None:
        text = _described(context, number, info, p_text)
        controller.log(Severity.WARNING, running_name(context) or "system", text)
    return ERR_OK


@function("ERR_warning")
def warn(context: Context, number: int, info: int) -> int:
    """Write a warning into the logbook; return a status."""
    return warn_with_text(context, number, info, 0)
