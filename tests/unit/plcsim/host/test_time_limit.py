"""Code that does not return is ended; alarms of others go on."""

import signal
import sys
import threading

import pytest

from plcsim.core.errors import CycleTimeViolation
from plcsim.host.time_limit import time_limit

SHORT_NS = 20_000_000


@pytest.fixture
def alarms():
    """The alarms that another user of SIGALRM has got."""
    seen = []
    before = signal.signal(signal.SIGALRM, lambda number, _frame: seen.append(number))
    yield seen
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


def spin():
    while True:
        pass


@pytest.mark.parametrize("act", [spin, signal.pause, threading.Event().wait])
def test_what_does_not_return_is_ended(act):
    with (
        pytest.raises(CycleTimeViolation, match="did not return within 20 ms"),
        time_limit(SHORT_NS),
    ):
        act()


def spin_on():
    try:
        spin()
    except BaseException:
        spin()


def test_what_catches_everything_is_ended_again():
    with pytest.raises(CycleTimeViolation), time_limit(SHORT_NS):
        spin_on()


def test_what_returns_is_left_alone(alarms):
    with time_limit(SHORT_NS):
        pass
    assert signal.getitimer(signal.ITIMER_REAL) == (0, 0)
    signal.raise_signal(signal.SIGALRM)
    assert alarms == [signal.SIGALRM]


def test_an_alarm_of_somebody_else_is_on_again(alarms):
    signal.setitimer(signal.ITIMER_REAL, 1000, 5)
    with time_limit(SHORT_NS):
        pass
    left_s, interval_s = signal.getitimer(signal.ITIMER_REAL)
    assert 900 < left_s <= 1000
    assert interval_s == pytest.approx(5)
    signal.setitimer(signal.ITIMER_REAL, 1e-6)
    with time_limit(10**12):
        while signal.getitimer(signal.ITIMER_REAL)[0] > 999.99:
            pass  # until the other one is overdue
    while not alarms:
        pass
    assert set(alarms) == {signal.SIGALRM}


def test_no_limit_in_another_thread_or_under_a_debugger(monkeypatch):
    before = signal.getsignal(signal.SIGALRM)
    seen = []

    def look():
        with time_limit(SHORT_NS):
            seen.append(signal.getsignal(signal.SIGALRM))

    thread = threading.Thread(target=look)
    thread.start()
    thread.join()
    monkeypatch.setattr(sys, "gettrace", lambda: print)
    look()
    assert seen == [before, before]
