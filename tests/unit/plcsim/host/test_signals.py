"""Signals as something to wait for."""

import ctypes
import errno
import os
import select
import signal
import subprocess
import sys
import threading

import pytest

from plcsim.host import signals

HELD = """
import os, signal
from plcsim.host.signals import HeldSignals

held = HeldSignals([signal.SIGTERM, signal.SIGRTMAX])
assert not os.get_inheritable(held.fd)
assert not held.is_pending
os.kill(os.getpid(), {number})
assert held.is_pending and held.is_pending  # it stays
print("there")
"""


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGRTMAX])
def test_a_held_signal_is_seen_by_whoever_looks_later(number: signal.Signals) -> None:
    command = [sys.executable, "-c", HELD.format(number=int(number))]
    assert subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout == b"there\n"


def test_others_end_the_process_as_ever() -> None:
    command = [sys.executable, "-c", HELD.format(number=int(signal.SIGHUP))]
    assert subprocess.run(command, check=False).returncode == -signal.SIGHUP


def test_a_signal_between_the_last_instruction_and_the_wait_ends_the_wait() -> None:
    descriptor = signals.HeldSignals([signal.SIGUSR2]).fd
    try:
        # To this thread: others of the process (pytest-xdist has some) do not hold it back.
        signal.pthread_kill(threading.get_ident(), signal.SIGUSR2)
        assert select.select([descriptor], [], [], 100) == ([descriptor], [], [])
    finally:
        assert signal.sigwait([signal.SIGUSR2]) == signal.SIGUSR2
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGUSR2])
        os.close(descriptor)


def test_a_host_without_a_descriptor_left_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    class Full:
        @staticmethod
        def signalfd(*_arguments: object) -> int:
            ctypes.set_errno(errno.EMFILE)
            return -1

    monkeypatch.setattr(signals, "_libc", Full)
    with pytest.raises(OSError, match="Too many open files"):
        signals.HeldSignals([])
