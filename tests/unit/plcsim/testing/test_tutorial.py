"""The tutorial keeps its word: its files are written, its failure comes as it says."""

import re
import shutil
from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

ROOT = Path(__file__).parents[4]
TUTORIAL = ROOT / "docs" / "testing.md"
FILE = re.compile(r"^File `([^`]+)`:\n\n```\w+\n(.*?)^```", re.DOTALL | re.MULTILINE)


@pytest.fixture
def cell(pytester):
    """The folder that `plcsim new cell` makes, with the files of the tutorial."""
    shutil.copytree(ROOT / "programs" / "blinky", pytester.path, dirs_exist_ok=True)
    files = FILE.findall(TUTORIAL.read_text())
    for name, text in files:
        file = pytester.path / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
    assert len(files) >= 6
    return pytester


def run(cell, *arguments):
    return cell.runpytest_inprocess("-q", "-m", "not realtime", *arguments)


def test_all_tests_of_the_tutorial_pass(cell):
    result = run(cell)
    assert result.ret == 0
    assert result.parseoutcomes()["passed"] >= 21


def test_the_failure_is_the_one_that_is_shown(cell):
    test = cell.path / "tests" / "test_belt.py"
    test.write_text(test.read_text().replace('"50ms"', '"40ms"'))
    result = run(cell, "tests/test_belt.py")
    result.assert_outcomes(passed=1, failed=1)
    shown = re.search(r"```text\n(.*?)```", TUTORIAL.read_text(), re.DOTALL)[1]
    lines = [line for line in shown.splitlines() if line.startswith("E       belt")]
    assert len(lines) == 3
    result.stdout.no_fnmatch_line("*plcsim/testing/*")
    assert all(line in result.stdout.str() for line in lines)
