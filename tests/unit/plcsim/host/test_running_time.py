"""CPU time without the time for which the machine stood still."""

import platform
import time

import pytest

from plcsim.host import running_time
from plcsim.host.running_time import BEAT_NS, cpu_time, tells_standstills, without_standstills

MS = 1_000_000


class Machine:
    """A kernel's count of CPU time, and its timer."""

    def __init__(self) -> None:
        self.cpu_ns = 7 * MS
        self._beaten_ns = 0
        self.beats = 3

    def run(self, duration_ns: int) -> None:
        self.cpu_ns += duration_ns
        self._beaten_ns += duration_ns
        rings, self._beaten_ns = divmod(self._beaten_ns, BEAT_NS)
        self.beats += rings

    def stand_still(self, duration_ns: int) -> None:
        """The timer that was due meanwhile rings once, at the end."""
        self.cpu_ns += duration_ns
        if self._beaten_ns + duration_ns >= BEAT_NS:
            self.beats += 1
            self._beaten_ns = 0


@pytest.fixture
def machine():
    return Machine()


@pytest.fixture
def told(machine):
    return without_standstills(lambda: machine.cpu_ns, lambda: machine.beats)


@pytest.mark.parametrize("step_ns", [1, 100_000, MS - 1, MS, MS + 1, 40 * MS + 7])
def test_a_machine_that_runs_is_told_to_the_nanosecond(machine, told, step_ns):
    first_ns, kernel_ns = told(), machine.cpu_ns
    for _ in range(300):
        machine.run(step_ns)
        assert told() - first_ns == machine.cpu_ns - kernel_ns


def test_a_standstill_counts_for_two_beats_at_most(machine, told):
    first_ns = told()
    machine.run(MS // 2)
    machine.stand_still(500 * MS)
    machine.run(MS // 4)
    assert told() - first_ns == 2 * BEAT_NS
    machine.run(3 * MS)
    assert told() - first_ns == 2 * BEAT_NS + 3 * MS


def test_a_thread_that_computes_hears_beats_and_one_that_sleeps_does_not():
    beats = running_time._beats_of_this_thread()
    if beats is None:  # an ordinary user, or a container: there is no timer to be heard
        pytest.skip("the kernel does not let its timer be watched")
    first = beats()
    time.sleep(0.02)  # what is tested: the timer must not run meanwhile
    assert beats() - first <= 2  # what is left of a beat before and behind the sleep
    until_ns = time.thread_time_ns() + 5_000 * MS
    while beats() < first + 20:
        assert time.thread_time_ns() < until_ns, "5 s of CPU time had no 20 beats of 1 ms"


def test_where_the_kernel_refuses_its_own_count_holds(monkeypatch):
    monkeypatch.setattr(platform, "machine", lambda: "pdp11")
    assert not tells_standstills()
    assert cpu_time() is time.thread_time_ns


def test_what_is_told_never_goes_back():
    told = cpu_time()
    times = [told() for _ in range(1000)]
    assert times == sorted(times)
