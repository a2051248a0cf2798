"""Ends a program that never returns, so that it fails its test instead of hanging the run.

The limit counts CPU time of the thread, so a loaded machine or a debugger does not end a good
program, and other threads do not bring it nearer.
"""

from __future__ import annotations

import signal
import threading
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

from plcsim.host.thread_timer import ThreadTimer

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

    from plcsim.core.controller import Controller

LIMIT_S = 2.0
"""CPU time between two looks; a program that runs through two of them is ended."""


class _Watch:
    """Notices a program that was already running when the timer went off before."""

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self._seen: tuple[object, int] | None = None

    def look(self, _number: int, _frame: FrameType | None) -> None:
        task = self._controller.scan.active
        cycles = sum(c.cycles for c in self._controller.classes)
        seen = None if task is None else (task, cycles)
        if seen is not None and seen == self._seen:
            self._seen = None
            self._controller.abort_program("the program did not return")
        self._seen = seen


@contextmanager
def watchdog(controller: Controller, limit_s: float = LIMIT_S) -> Iterator[None]:
    """Watch the programs inside the block; only the main thread can, others run unwatched."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    timer = ThreadTimer(signal.SIGVTALRM, time.CLOCK_THREAD_CPUTIME_ID)
    before = signal.signal(signal.SIGVTALRM, _Watch(controller).look)
    try:
        timer.set(limit_s, limit_s)
        yield
    finally:
        timer.close()
        signal.signal(signal.SIGVTALRM, before)  # looks for what has come before
