"""Signals as something to wait for.

A handler of Python's runs between two of its instructions. A signal that comes after the last of
them and before a wait in the kernel is noted, and the wait is not ended: nobody is told. A signal
that stays blocked is pending until somebody looks, and its descriptor readable.
"""

from __future__ import annotations

import ctypes
import os
import signal
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

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
