"""A limit of time for code of others that runs in our own process and may never return."""

from __future__ import annotations

import signal
import sys
import threading
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, NoReturn

from plcsim.core.duration import format_duration
from plcsim.core.errors import CycleTimeViolation

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

AGAIN_S = 0.5
"""After this time it is tried again, where the first exception was caught and forgotten."""

SOON_S = 0.001
"""An alarm of somebody else that was due meanwhile comes after this time."""


@contextmanager
def time_limit(limit_ns: int) -> Iterator[None]:
    """Raise CycleTimeViolation in the block when it has not ended in time.

    Only the main thread can be interrupted; elsewhere, and where a debugger traces it, there is no
    limit. An alarm that was set before (SIGALRM) is on again afterwards.

    Args:
        limit_ns: time of the host, not of its processor: what waits for ever counts too.
    """
    if threading.current_thread() is not threading.main_thread() or sys.gettrace() is not None:
        yield
        return

    def end(_number: int, _frame: FrameType | None) -> NoReturn:
        raise CycleTimeViolation(f"did not return within {format_duration(limit_ns)}")

    handler = signal.signal(signal.SIGALRM, end)
    start = time.monotonic()
    due_s, interval_s = signal.setitimer(signal.ITIMER_REAL, limit_ns / 1e9, AGAIN_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, handler)
        if due_s:
            left_s = due_s - (time.monotonic() - start)
            signal.setitimer(signal.ITIMER_REAL, max(SOON_S, left_s), interval_s)
