"""A project of the cell that the tests of plcsim.testing use."""

from pathlib import Path

import pytest

CELL = Path(__file__).parents[2] / "testing" / "cell.py"


@pytest.fixture
def project(tmp_path):
    """A project on disk with the cell as its only program."""
    folder = tmp_path / "press"
    (folder / "cell").mkdir(parents=True)
    (folder / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["cell"]\n')
    (folder / "cell" / "main.py").write_text(CELL.read_text())
    return folder
