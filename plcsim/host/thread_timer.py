"""A timer whose signal comes to one thread, and to no other of the process.

The signal of setitimer(2) is the process's. While the main thread is in a handler the kernel hands
it to another thread, which runs when the host lets it: perhaps long after the timer was stopped and
somebody else's handler is there to take it.
"""

from __future__ import annotations

import ctypes
import os
import threading
import time

_SIGEV_THREAD_ID = 4

_libc = ctypes.CDLL(None, use_errno=True)
if not hasattr(_libc, "timer_create"):
    _libc = ctypes.CDLL("librt.so.1", use_errno=True)  # before glibc 2.34


class _Event(ctypes.Structure):
    """A struct sigevent of Linux, 64 bytes."""

    _fields_ = (
        ("value", ctypes.c_void_p),
        ("number", ctypes.c_int),
        ("notify", ctypes.c_int),
        ("thread", ctypes.c_int),
        ("rest", ctypes.c_char * 44),
    )


class _Time(ctypes.Structure):
    """A struct timespec."""

    _fields_ = (("seconds", ctypes.c_long), ("nanoseconds", ctypes.c_long))


class _Setting(ctypes.Structure):
    """A struct itimerspec."""

    _fields_ = (("interval", _Time), ("first", _Time))


class ThreadTimer:
    """A timer for the thread that makes it (timer_create(2)).

    Args:
        number: of its signal.
        clock_id: of its clock; that of the thread's CPU time, for one, is
            `time.CLOCK_THREAD_CPUTIME_ID`.

    Raises:
        OSError: the host has no timer left.
    """

    def __init__(self, number: int, clock_id: int = time.CLOCK_MONOTONIC) -> None:
        event = _Event(number=number, notify=_SIGEV_THREAD_ID, thread=threading.get_native_id())
        self._timer = ctypes.c_void_p()
        _check(_libc.timer_create(clock_id, ctypes.byref(event), ctypes.byref(self._timer)))

    def set(self, first_s: float, interval_s: float) -> None:
        """Signal after a time, and again and again after another."""
        setting = _Setting(_time(interval_s), _time(first_s))
        _check(_libc.timer_settime(self._timer, 0, ctypes.byref(setting), None))

    def close(self) -> None:
        """Signal no more. What has come before has reached the thread when this returns."""
        _check(_libc.timer_delete(self._timer))


def _time(seconds: float) -> _Time:
    return _Time(*divmod(max(1, round(seconds * 1e9)), 1_000_000_000))


def _check(result: int) -> None:
    if result:
        code = ctypes.get_errno()
        raise OSError(code, os.strerror(code))
