"""The plugin in a run of pytest."""

from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

TEST = """
def test_run(plc, recorder):
    plc.cycles(5)
    plc["cell.start"] = {start}
    plc.cycles(5)
    recorder.assert_same_as("golden.bag")
"""


def test_golden_bags_are_written_on_request_and_compared(
    pytester: pytest.Pytester, project: Path
) -> None:
    test = project / "test_cell.py"
    test.write_text(TEST.format(start=True))
    assert pytester.runpytest_inprocess("-q", test).ret == 1

    pytester.runpytest_inprocess("-q", "--update-golden", test).assert_outcomes(passed=1)
    pytester.runpytest_inprocess("-q", test).assert_outcomes(passed=1)

    test.write_text(TEST.format(start=False))
    result = pytester.runpytest_inprocess("-q", test)
    result.stdout.fnmatch_lines(["*cycle 6 of task class 1: cell.start is TRUE against FALSE*"])
