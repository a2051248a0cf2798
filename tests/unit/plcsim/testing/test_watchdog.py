"""A program that never returns fails its test."""

import signal
import threading
import time

import pytest

from plcsim.testing import ControllerFault
from plcsim.testing.watchdog import watchdog


def test_an_endless_program_is_ended_with_its_place(cell_plc, monkeypatch):
    monkeypatch.setattr("plcsim.testing.plc.watchdog", lambda c: watchdog(c, 0.05))

    def endless():
        while True:
            pass

    cell_plc.controller.tasks[0].cyclic = endless
    with pytest.raises(ControllerFault, match=r"did not return, ended at .*test_watchdog.py:\d+"):
        cell_plc.run("1s")


def test_many_short_cycles_are_not_ended(cell_plc, monkeypatch):
    monkeypatch.setattr("plcsim.testing.plc.watchdog", lambda c: watchdog(c, 0.01))
    cell_plc.run("200s")
    assert cell_plc["Cell.count"] == 20_000


def test_the_handler_of_before_is_put_back(cell_plc):
    before = signal.getsignal(signal.SIGVTALRM)
    cell_plc.run("10ms")
    assert signal.getsignal(signal.SIGVTALRM) == before


def test_what_other_threads_do_brings_the_end_no_nearer(cell_plc):
    """The signal of the limit comes to the thread of the programs, which did nothing yet."""
    is_over = threading.Event()
    other = threading.Thread(target=lambda: burn(0.05, is_over))
    with watchdog(cell_plc.controller, 0.01):
        cell_plc.controller.scan.active = cell_plc.controller.tasks[0]
        other.start()
        is_over.wait(100)
    other.join()


def burn(cpu_s: float, is_over: threading.Event) -> None:
    end_s = time.thread_time() + cpu_s
    while time.thread_time() < end_s:
        pass
    is_over.set()
