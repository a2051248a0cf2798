"""Code that does not return is ended; alarms of others go on."""

import signal
import sys
import threading
import time

import pytest

from plcsim.core.errors import CycleTimeViolation
from plcsim.host import time_limit as time_limit_module
from plcsim.host.time_limit import time_limit

pytestmark = pytest.mark.timeout(method="thread")  # SIGALRM and its timer are what is tested

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


def spin_in_a_handler():
    while True:
        try:  # noqa: SIM105  # this is the case
            spin()
        except:  # noqa: E722
            pass


def spin_in_nested_handlers():
    while True:
        try:
            spin_in_a_handler()
        except BaseException:
            continue


@pytest.mark.parametrize("act", [spin_in_a_handler, spin_in_nested_handlers])
def test_what_catches_everything_in_a_loop_is_ended(act, monkeypatch):
    monkeypatch.setattr(time_limit_module, "AGAIN_S", 0.01)
    with pytest.raises(CycleTimeViolation), time_limit(SHORT_NS):
        act()
    assert signal.getitimer(signal.ITIMER_REAL) == (0, 0)


def test_what_returns_is_left_alone(alarms):
    with time_limit(10**12):
        pass
    assert signal.getitimer(signal.ITIMER_REAL) == (0, 0)
    signal.raise_signal(signal.SIGALRM)
    assert alarms == [signal.SIGALRM]


def test_an_alarm_that_comes_after_its_block_is_no_fault(alarms):
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    with pytest.raises(CycleTimeViolation), time_limit(SHORT_NS):
        spin()
    assert signal.getsignal(signal.SIGALRM) is signal.SIG_DFL  # and the process has not ended by it
    assert not alarms


def test_an_alarm_that_comes_while_it_begins_or_things_are_put_back_is_no_fault(
    alarms, monkeypatch
):
    class Late:
        """Signals, of which some come between two steps."""

        SIGALRM = signal.SIGALRM
        ITIMER_REAL = signal.ITIMER_REAL
        SIG_DFL = signal.SIG_DFL
        setitimer = staticmethod(signal.setitimer)

        @staticmethod
        def signal(number, handler):
            signal.raise_signal(number)
            found = signal.signal(number, handler)
            if handler is not before:
                signal.raise_signal(number)
            return found

    before = signal.getsignal(signal.SIGALRM)
    monkeypatch.setattr(time_limit_module, "signal", Late)
    with time_limit(10**12):
        alarms.clear()  # the one that came before was theirs
    assert signal.getsignal(signal.SIGALRM) is before
    assert not alarms


def test_an_alarm_of_somebody_else_is_on_again(alarms):
    signal.setitimer(signal.ITIMER_REAL, 1000, 5)
    with time_limit(10**12):
        pass
    left_s, interval_s = signal.getitimer(signal.ITIMER_REAL)
    assert 900 < left_s <= 1000
    assert interval_s == pytest.approx(5)
    signal.setitimer(signal.ITIMER_REAL, 1e-6)
    with time_limit(10**12):
        over_s = time.monotonic() + 0.01
        while time.monotonic() < over_s:
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
