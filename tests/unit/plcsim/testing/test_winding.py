"""A controller under test that is wound back."""

import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from plcsim import Program
from plcsim.recorder.testing import RecorderFixture
from plcsim.testing import Plc
from plcsim.testing.errors import ExpectationFailed, PlcTestError
from plcsim.testing.target import program_target
from st_types import LREAL, UDINT, var


class Tank(Program):
    count = var(UDINT)
    valve = var(UDINT)
    level = var(LREAL)

    def cyclic(self) -> None:
        self.count += 1
        self.level = 0.9 * self.level + self.valve


class Dice(Program):
    eyes = var(UDINT)

    def cyclic(self) -> None:
        self.eyes = random.randrange(1 << 30)


class Keeps(Program):
    kept = var(UDINT, retain=True)

    def cyclic(self) -> None:
        self.kept += 1


@pytest.fixture
def plc() -> Iterator[Plc]:
    made = Plc(program_target([Tank]))
    made.boot()
    yield made
    made.close()


def test_it_is_as_it_was_and_can_go_on_otherwise(plc: Plc) -> None:
    levels = {}
    for cycle in range(1, 31):
        if cycle % 7 == 0:
            plc["Tank.valve"] = cycle
        plc.cycles(1)
        levels[cycle] = plc["Tank.level"]

    plc.rewind(10)
    assert (plc.cycle_count, plc["Tank.count"]) == (20, 20)
    assert plc["Tank.level"] == levels[20]
    assert plc["Tank.valve"] == 14

    plc["Tank.valve"] = 0
    plc.cycles(1)
    assert plc["Tank.level"] == 0.9 * levels[20]

    plc.rewind(21)
    assert (plc.cycle_count, plc["Tank.count"], plc["Tank.level"]) == (0, 0, 0)
    plc.cycles(5)
    assert plc["Tank.count"] == 5


def test_what_is_recorded_is_the_run_that_counts(plc: Plc, tmp_path: Path) -> None:
    recorder = RecorderFixture(plc, tmp_path, update=True)
    plc.cycles(10)
    plc["Tank.valve"] = 3
    plc.cycles(10)
    recorder.assert_same_as("golden.bag")

    recorder._update = False
    plc.rewind(15)
    plc.cycles(5)
    plc["Tank.valve"] = 3
    plc.cycles(10)
    recorder.assert_same_as("golden.bag")
    plc.rewind(1)
    plc["Tank.valve"] = 4
    plc.cycles(1)
    with pytest.raises(ExpectationFailed, match=r"cycle 20 of task class 1: Tank\.valve"):
        recorder.assert_same_as("golden.bag")


@pytest.mark.parametrize("cycles", [0, -1, 4])
def test_no_more_than_there_was_can_be_wound_back(plc: Plc, cycles: int) -> None:
    plc.cycles(3)

    with pytest.raises(PlcTestError, match=f"rewind: 3 cycles can be wound back, not {cycles}"):
        plc.rewind(cycles)
    assert plc["Tank.count"] == 3


def test_a_program_that_asks_the_world_is_named() -> None:
    plc = Plc(program_target([Dice]))
    plc.boot()
    plc.cycles(5)

    with pytest.raises(
        PlcTestError, match=r"cycle 1 of task class 1 ends otherwise: Dice\.eyes is"
    ):
        plc.rewind(2)
    plc.close()


def test_forces_are_those_of_then(plc: Plc) -> None:
    plc.cycles(3)
    plc.force("Tank.count", 50)
    plc.cycles(3)
    plc.release("Tank.count")
    plc.cycles(3)
    assert plc["Tank.count"] == 53

    plc.rewind(4)
    assert (plc.cycle_count, plc["Tank.count"], len(plc.controller.forces)) == (5, 50, 1)
    plc.cycles(1)
    assert plc["Tank.count"] == 50
    plc.rewind(4)
    assert (plc["Tank.count"], len(plc.controller.forces)) == (2, 0)


def test_times_traces_and_what_is_retained_are_those_of_then() -> None:
    plc = Plc(program_target([Keeps]))
    plc.boot()
    plc.cycles(7)
    plc.restart()
    trace = plc.record("Keeps.kept")
    plc.cycles(10)
    then = plc.time_ns, plc.clock.now_ns(), plc.total_ns
    assert plc["Keeps.kept"] == 17

    plc.rewind(6)
    assert plc["Keeps.kept"] == 11
    assert trace.values("Keeps.kept") == [7, 8, 9, 10, 11]
    plc.cycles(6)
    assert trace.values("Keeps.kept") == list(range(7, 18))
    assert (plc.time_ns, plc.clock.now_ns(), plc.total_ns) == then
    plc.close()


def test_plants_act_again_up_to_there(plc: Plc) -> None:
    @plc.plant
    def fill(tags: Plc, seconds: float) -> None:
        tags["Tank.valve"] = tags["Tank.valve"] + 1

    plc.cycles(20)
    level = plc["Tank.level"]
    plc.rewind(8)
    assert plc["Tank.valve"] == 12
    plc.cycles(8)
    assert plc["Tank.level"] == level


def test_what_is_kept_is_bounded(plc: Plc, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("plcsim.testing.winding.MOST_BYTES", 1000)
    for number in range(20):
        plc["Tank.valve"] = number
        plc.cycles(1)

    with pytest.raises(PlcTestError, match="more than is kept"):
        plc.rewind(1)
    assert plc.winding._run.size < 1400
