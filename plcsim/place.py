"""Where in a program's own source something was raised."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import TracebackType

_OWN = tuple(
    str(Path(__file__).resolve().parents[1] / p) for p in ("plcsim", "st_types", "crosnode")
)
_STANDARD = (sys.prefix, sys.base_prefix, "<frozen")


def place_of(error: BaseException) -> str:
    """Return "file:line" of the innermost frame that is neither ours nor Python's own.

    A syntax error gives the place it was found at; "" where there is no such frame.
    """
    if isinstance(error, SyntaxError) and error.filename:
        return f"{error.filename}:{error.lineno}"
    place = ""
    trace: TracebackType | None = error.__traceback__
    while trace is not None:
        path = trace.tb_frame.f_code.co_filename
        if not path.startswith((*_OWN, *_STANDARD)) or "/_examples/" in path:
            place = f"{path}:{trace.tb_lineno}"
        trace = trace.tb_next
    return place


def describe(error: BaseException) -> str:
    """Return in one line what an exception means on a controller."""
    if isinstance(error, ZeroDivisionError):
        return "division by zero"
    text = " ".join(str(error).split())
    name = type(error).__name__
    if type(error).__module__.startswith(("plcsim", "st_types")):
        return text or name
    return f"{name}: {text}" if text else name
