"""The signal handlers by which traps come, kept where others take them away.

wasmtime sets them once a process. Python's faulthandler, when it is switched off, sets back what
was there before it; a test run inside a test run does that. The next trap would end the process.
"""

from __future__ import annotations

import ctypes
import signal

_SIGNALS = (signal.SIGSEGV, signal.SIGILL, signal.SIGFPE, signal.SIGBUS)

_SIZE = 256
"""Bytes; a struct sigaction is smaller on every system."""

_kept: dict[int, ctypes.Array[ctypes.c_char]] = {}


def keep_handlers() -> None:
    """Remember the handlers that are set at the first call; set them again at later ones."""
    for number in _SIGNALS:
        _kept.setdefault(number, _handler_of(number))
    set_again()


def set_again() -> None:
    """Set the handlers that are remembered, where others have taken them away; do else nothing."""
    for number, kept in _kept.items():
        if _handler_of(number).raw != kept.raw:
            _sigaction(number, kept, None)


def _handler_of(number: int) -> ctypes.Array[ctypes.c_char]:
    found = ctypes.create_string_buffer(_SIZE)
    _sigaction(number, None, found)
    return found


def _sigaction(number: int, new: object, old: object) -> None:
    if ctypes.CDLL(None, use_errno=True).sigaction(number, new, old):
        raise OSError(ctypes.get_errno(), f"sigaction of signal {number}")
