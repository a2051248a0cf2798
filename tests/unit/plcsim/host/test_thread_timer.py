"""A timer whose signal comes to one thread."""

import ctypes
import errno
import signal
import threading
import time
from collections.abc import Iterator

import pytest

from plcsim.host import thread_timer
from plcsim.host.thread_timer import ThreadTimer

NUMBER = signal.SIGUSR1


@pytest.fixture
def seen() -> Iterator[list[int]]:
    """The signals that were handled."""
    found: list[int] = []
    before = signal.signal(NUMBER, lambda number, _frame: found.append(number))
    yield found
    signal.signal(NUMBER, before)


def test_it_comes_to_no_other_thread_though_this_one_holds_it_back(seen: list[int]) -> None:
    is_over = threading.Event()
    other = threading.Thread(target=is_over.wait)
    other.start()
    signal.pthread_sigmask(signal.SIG_BLOCK, [NUMBER])
    timer = ThreadTimer(NUMBER)
    try:
        timer.set(1e-6, 1000)
        found = signal.sigtimedwait([NUMBER], 100)
    finally:
        timer.close()
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [NUMBER])
        is_over.set()
        other.join()
    assert found is not None
    assert not seen


def test_it_comes_again_and_again_until_it_is_closed(seen: list[int]) -> None:
    timer = ThreadTimer(NUMBER)
    timer.set(0, 1e-4)
    while len(seen) < 3:
        pass
    timer.close()
    count, over_s = len(seen), time.monotonic() + 0.002
    while time.monotonic() < over_s:
        pass
    assert len(seen) == count


def test_a_host_without_a_timer_left_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    class Full:
        @staticmethod
        def timer_create(*_arguments: object) -> int:
            ctypes.set_errno(errno.EAGAIN)
            return -1

    monkeypatch.setattr(thread_timer, "_libc", Full)
    with pytest.raises(OSError, match="temporarily unavailable"):
        ThreadTimer(NUMBER)
