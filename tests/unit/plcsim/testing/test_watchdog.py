"""A program that never returns fails its test."""

import signal

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
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)
