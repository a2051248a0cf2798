"""The fixture recorder: golden runs, and recordings as tests."""

from pathlib import Path

import pytest

from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project
from plcsim.recorder.testing import RecorderFixture
from plcsim.testing.errors import ExpectationFailed, PlcTestError
from plcsim.testing.target import open_plc


@pytest.fixture
def golden(project: Path) -> Path:
    """A run in which the operator starts the cell after 100 ms."""
    with open_plc(project=project) as plc:
        recorder = RecorderFixture(plc, project, update=True)
        plc.cycles(10)
        plc["cell.start"] = True
        plc.cycles(10)
        recorder.assert_same_as("golden.bag")
    return project / "golden.bag"


def test_the_same_run_is_the_golden_one(project: Path, golden: Path) -> None:
    with open_plc(project=project) as plc:
        recorder = RecorderFixture(plc, project)
        plc.cycles(4)
        plc.cycles(6)
        plc["cell.start"] = True
        plc.cycles(10)

        recorder.assert_same_as(golden)


def test_another_input_is_named_with_its_cycle(project: Path, golden: Path) -> None:
    with open_plc(project=project) as plc:
        recorder = RecorderFixture(plc, project)
        plc.cycles(12)
        plc["cell.start"] = True
        plc.cycles(8)

        with pytest.raises(
            ExpectationFailed, match=r"cycle 11 of task class 1: cell\.start is TRUE"
        ):
            recorder.assert_same_as(golden)


def test_a_golden_bag_that_is_not_there_is_told(project: Path) -> None:
    with open_plc(project=project) as plc, pytest.raises(PlcTestError, match="--update-golden"):
        RecorderFixture(plc, project).assert_same_as("golden.bag")


def test_a_recorded_run_is_repeated(project: Path) -> None:
    given = {"record": {"file": "run.bag"}}
    with Supervisor(read_project(project, given), virtual=True, cycles=30, quiet=True) as run:
        run.wait()

    with open_plc(project=project) as plc:
        RecorderFixture(plc, project).assert_repeats("run.bag")


def test_a_program_that_has_changed_does_not_repeat_it(project: Path) -> None:
    given = {"record": {"file": "run.bag"}}
    with Supervisor(read_project(project, given), virtual=True, cycles=30, quiet=True) as run:
        run.wait()
    main = project / "cell" / "main.py"
    # not as long as before: within a second Python takes a file of equal length for the same
    main.write_text(main.read_text().replace("self.count += 1", "self.count += 1 + 1"))

    with open_plc(project=project) as plc, pytest.raises(ExpectationFailed, match="cycle"):
        RecorderFixture(plc, project).assert_repeats("run.bag")
