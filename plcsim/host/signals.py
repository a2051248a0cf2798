"""Signals as something to wait for.

A handler of Python's runs between two of its instructions. A signal that comes after the last of
them and before a wait in the kernel is noted, and the wait is not ended: nobody is told. A signal
that stays blocked is pending until somebody looks, and its descriptor readable.
"""

from __future__ import annotations

import ctypes
import os
import signal
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from types import FrameType

_SIGSET_BYTES = 128
"""Size of the C library's sigset_t on Linux; signal n is bit n - 1."""

_libc = ctypes.CDLL(None, use_errno=True)


@contextmanager
def held_back(numbers: Iterable[int]) -> Iterator[None]:
    """Block signals in the block, so that a process started there begins with them blocked.

    It lets them come once it handles them; until then one that came would end it.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, numbers)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def remembered_interrupts() -> Iterator[Callable[[], None]]:
    """Remember in the block that Ctrl-C was pressed: a KeyboardInterrupt may be lost.

    It is raised wherever the main thread is, and Python drops what is raised in a destructor or in
    a callback of the collector. Where somebody else handles the signal, or in another thread,
    nothing is remembered.

    Yields:
        what raises KeyboardInterrupt where one should have ended the block.
    """
    has_come = False

    def handle(_number: int, _frame: FrameType | None) -> None:
        nonlocal has_come
        has_come = True
        raise KeyboardInterrupt

    def check() -> None:
        if has_come:
            raise KeyboardInterrupt

    is_main = threading.current_thread() is threading.main_thread()
    if not is_main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield check
        return
    signal.signal(signal.SIGINT, handle)
    try:
        yield check
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


class HeldSignals:
    """Signals that stay blocked in the thread that makes this, and in processes it starts.

    Args:
        numbers: of the signals.

    Attributes:
        fd: readable once one is pending, and from then on: nobody takes it (signalfd(2)).

    Raises:
        OSError: the host has no descriptor left.
    """

    def __init__(self, numbers: Iterable[int]) -> None:
        self._held = set(numbers)
        signal.pthread_sigmask(signal.SIG_BLOCK, self._held)
        mask = sum(1 << (number - 1) for number in self._held).to_bytes(_SIGSET_BYTES, "little")
        self.fd: int = _libc.signalfd(-1, mask, os.O_NONBLOCK | os.O_CLOEXEC)
        if self.fd < 0:
            code = ctypes.get_errno()
            raise OSError(code, os.strerror(code))

    @property
    def is_pending(self) -> bool:
        """True once one of them has come."""
        return not self._held.isdisjoint(signal.sigpending())
