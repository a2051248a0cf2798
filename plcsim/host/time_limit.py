"""A limit of time for code of others that runs in our own process and may never return."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

from plcsim.core.duration import format_duration
from plcsim.core.errors import CycleTimeViolation
from plcsim.host.thread_timer import ThreadTimer

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

_OWN_FILES = (__file__, contextlib.__file__)

AGAIN_S = 0.5
"""After this time it is tried again, where the first exception was caught and forgotten."""

TRIES = 3
"""Code that has caught so many exceptions in a row catches them in a loop, and gets a hail."""

HAIL_S = 20e-6
"""Between two exceptions of a hail. One raised in what handles the last, or between two rounds of
the loop, is not caught; with so many, one soon is."""

SOON_S = 0.001
"""An alarm of somebody else that was due meanwhile comes after this time."""


def can_be_limited() -> bool:
    """Whether this is the main thread, which can be interrupted, and no debugger traces it."""
    return threading.current_thread() is threading.main_thread() and sys.gettrace() is None


@contextmanager
def time_limit(limit_ns: int) -> Iterator[None]:
    """Raise CycleTimeViolation in the block when it has not ended in time.

    Only the main thread can be interrupted; elsewhere, and where a debugger traces it, there is no
    limit. An alarm that was set before (SIGALRM) is on again afterwards.

    Args:
        limit_ns: time of the host, not of its processor: what waits for ever counts too.

    Raises:
        OSError: the host has no timer left.
    """
    if not can_be_limited():
        yield
        return

    tries = 0
    is_open = False

    def end(_number: int, frame: FrameType | None) -> None:
        nonlocal tries
        if not is_open or (frame is not None and frame.f_code.co_filename in _OWN_FILES):
            return  # it begins or ends, and what prepares it and puts things back calls others
        tries += 1
        if tries == TRIES:
            timer.set(HAIL_S, HAIL_S)
        raise CycleTimeViolation(f"did not return within {format_duration(limit_ns)}")

    due_s, interval_s = signal.setitimer(signal.ITIMER_REAL, 0)
    start = time.monotonic()
    timer = ThreadTimer(signal.SIGALRM)
    handler = signal.signal(signal.SIGALRM, end)
    try:
        timer.set(limit_ns / 1e9, AGAIN_S)
        is_open = True
        yield
    finally:
        is_open = False
        timer.close()
        signal.signal(signal.SIGALRM, handler)  # looks for what has come before
        if due_s:
            left_s = due_s - (time.monotonic() - start)
            signal.setitimer(signal.ITIMER_REAL, max(SOON_S, left_s), interval_s)
