"""Tests of blinky. Each runs on a controller of its own that starts at time 0.

The clock is virtual: a minute of blinking takes a few milliseconds and is the same every time.
"""

import pytest

from plcsim.testing import Plc


def test_lamp_is_off_at_first(plc: Plc) -> None:
    plc.run("499ms")
    assert plc["blinky.lamp"] is False


def test_lamp_goes_on_after_half_a_second(plc: Plc) -> None:
    plc.assert_within("510ms", "blinky.lamp")
    plc.assert_stable("blinky.lamp", for_="490ms")


def test_lamp_keeps_its_period(plc: Plc) -> None:
    on, off = (True, "500ms"), (False, "500ms")
    plc.until("blinky.lamp")
    plc.assert_sequence("blinky.lamp", [on, off, on, off, on, off, True], tolerance="0ms")


def test_no_half_period_is_lost_in_a_minute(plc: Plc) -> None:
    plc.run("60s")
    assert plc["blinky.changes"] == 119


def test_half_period_can_be_changed(plc: Plc) -> None:
    plc["blinky.half_period"] = 100
    plc.run("1s")
    assert plc["blinky.changes"] == 9


def test_lamp_starts_anew_after_a_restart(plc: Plc) -> None:
    plc.until("blinky.lamp")
    plc.restart()
    assert plc["blinky.lamp"] is False
    plc.assert_within("510ms", "blinky.lamp")


def test_a_cycle_costs_the_same_everywhere(plc: Plc) -> None:
    """Compiled programs are counted in instructions, which no machine changes."""
    plc.run("10s")
    plc.assert_cost("blinky", worst=400)


@pytest.mark.realtime
def test_lamp_on_the_wall_clock(plc: Plc) -> None:
    plc.assert_within("510ms", "blinky.lamp")
