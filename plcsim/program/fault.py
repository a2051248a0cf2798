"""What something that a program raised means, and where in the program's own source it was."""

from __future__ import annotations

import builtins
import contextlib
import os
import site
import sysconfig
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.core.errors import Fault
from plcsim.core.suggestion import did_you_mean
from plcsim.core.text import escaped
from plcsim.program.refused_store import refused_store

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import TracebackType

_OWN = (Path(__file__).parents[2] / name for name in ("plcsim", "st_types", "crosnode"))
_LIBRARIES = (
    *(sysconfig.get_path(name) for name in ("stdlib", "platstdlib")),
    *site.getsitepackages(),
    site.getusersitepackages(),
)
_NOT_A_PROGRAM = ("<", *(f"{folder}{os.sep}" for folder in (*_OWN, *_LIBRARIES)))
"""How paths begin that are no programs; "<frozen importlib>" and "<string>" are no files."""

LONGEST_TEXT = 300
"""Characters of an exception's text that are kept."""


def fault_of(error: BaseException) -> Fault:
    """Return what something that a program raised means."""
    return Fault(location_of(error), describe(error), tuple(_calls(error)))


def location_of(error: BaseException) -> str:
    """Return "file:line" of the innermost frame that is neither ours, Python's nor a package's.

    A syntax error in a file gives the line it was found at; "" where there is no such frame.
    """
    if isinstance(error, SyntaxError) and error.filename and not error.filename.startswith("<"):
        return f"{error.filename}:{error.lineno}"
    return next((line for line, _ in reversed(list(frames(error.__traceback__)))), "")


def _calls(error: BaseException) -> Iterator[str]:
    for line, function in frames(error.__traceback__):
        yield f"{line} in {function}"


def frames(trace: TracebackType | None) -> Iterator[tuple[str, str]]:
    """Iterate over "file:line" and function of the frames of programs, the outermost first."""
    while trace is not None:
        code = trace.tb_frame.f_code
        path = code.co_filename
        if not path.startswith(_NOT_A_PROGRAM) or "/_examples/" in path:
            yield f"{path}:{trace.tb_lineno}", code.co_name
        trace = trace.tb_next


def describe(error: BaseException) -> str:
    """Return in one line what an exception means on a controller."""
    if isinstance(error, ZeroDivisionError):
        return "division by zero"
    refused = refused_store(error)
    if refused:
        return refused
    text = _text_of(error) + _nearest(error)
    name = type(error).__name__
    if type(error).__module__.startswith(("plcsim", "st_types")):
        return text or name
    return f"{name}: {text}" if text else name


def _nearest(error: BaseException) -> str:
    """Return "; did you mean ...?" for a name that a program misspelt, as Python itself tells it.

    Before 3.12 Python does not say which object it was whose attribute was to be set.
    """
    with contextlib.suppress(Exception):  # a program's own class may have a __dir__ that fails
        match error:
            case AttributeError(name=str(name), obj=obj) if obj is not None:
                return did_you_mean(name, (known for known in dir(obj) if known[0] != "_"))
            case NameError(name=str(name), __traceback__=trace) if trace is not None:
                return did_you_mean(name, _names_in(trace))
    return ""


def _names_in(trace: TracebackType) -> list[str]:
    """Return the names that there are where something was raised."""
    while trace.tb_next is not None:
        trace = trace.tb_next
    frame = trace.tb_frame
    return [*frame.f_locals, *frame.f_globals, *dir(builtins)]


def _text_of(error: BaseException) -> str:
    """Return the text of an exception in one line that fits into a logbook."""
    try:
        text = str(error)
    except Exception:  # a program's own exception may have a __str__ that fails
        return ""
    line = escaped(" ".join(text[: 2 * LONGEST_TEXT].split()))
    return line if len(line) <= LONGEST_TEXT else f"{line[:LONGEST_TEXT]}..."
