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


@pytest.fixture
def plc() -> Iterator[Plc]:
    made = Plc(program_target([Tank]))
    made.boot()
    yield made
    made.close()


def test_it_is_as_it_was_and_can_go_on_otherwise(plc: Plc, tmp_path: Path) -> None:
    recorder = RecorderFixture(plc, tmp_path)
    levels = {}
    for cycle in range(1, 31):
        if cycle % 7 == 0:
            plc["Tank.valve"] = cycle
        plc.cycles(1)
        levels[cycle] = plc["Tank.level"]

    recorder.rewind(10)
    assert (plc.cycle_count, plc["Tank.count"]) == (20, 20)
    assert plc["Tank.level"] == levels[20]
    assert plc["Tank.valve"] == 14

    plc["Tank.valve"] = 0
    plc.cycles(1)
    assert plc["Tank.level"] == 0.9 * levels[20]

    recorder.rewind(21)
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
    recorder.rewind(15)
    plc.cycles(5)
    plc["Tank.valve"] = 3
    plc.cycles(10)
    recorder.assert_same_as("golden.bag")
    recorder.rewind(1)
    plc["Tank.valve"] = 4
    plc.cycles(1)
    with pytest.raises(ExpectationFailed, match=r"cycle 20 of task class 1: Tank\.valve"):
        recorder.assert_same_as("golden.bag")


@pytest.mark.parametrize("cycles", [0, -1, 4])
def test_no_more_than_there_was_can_be_wound_back(plc: Plc, tmp_path: Path, cycles: int) -> None:
    recorder = RecorderFixture(plc, tmp_path)
    plc.cycles(3)

    with pytest.raises(PlcTestError, match=f"rewind: 3 cycles can be wound back, not {cycles}"):
        recorder.rewind(cycles)
    assert plc["Tank.count"] == 3


def test_a_program_that_asks_the_world_is_named(tmp_path: Path) -> None:
    plc = Plc(program_target([Dice]))
    plc.boot()
    recorder = RecorderFixture(plc, tmp_path)
    plc.cycles(5)

    with pytest.raises(PlcTestError, match=r"cycle 1 of task class 1: Dice\.eyes is"):
        recorder.rewind(2)
    plc.close()
