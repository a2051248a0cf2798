"""The fixture ros in runs of pytest, in projects elsewhere on disk."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np  # noqa: F401  # can be loaded once per process, and pytester forgets modules

pytest_plugins = ["pytester"]

PROGRAMS = Path(__file__).parents[4] / "programs"
QUICK = ("-q", "-p", "no:cacheprovider")


def test_a_copy_of_an_example_passes_its_tests_whatever_the_environment(pytester, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "http://10.9.9.9:1/")
    monkeypatch.setenv("ROS_IP", "10.9.9.8")
    monkeypatch.setenv("ROS_NAMESPACE", "/elsewhere")
    shutil.copytree(PROGRAMS / "talker", pytester.path / "my_own")
    result = pytester.runpytest_inprocess(*QUICK, "-k", "word or exit", "my_own/tests")
    assert result.ret == 0
    assert set(result.parseoutcomes()) == {"passed", "deselected"}


TUTORIAL = PROGRAMS.parent / "docs" / "testing.md"
EXAMPLE = re.compile(r"^```python\n# (\w+)\n(.*?)^```", re.DOTALL | re.MULTILINE)


def test_the_tests_in_the_tutorial_pass(pytester):
    examples = EXAMPLE.findall(TUTORIAL.read_text())
    assert [name for name, _ in examples] == ["listener", "tank"]
    for name, text in examples:
        shutil.copytree(PROGRAMS / name, pytester.path / name)
        (pytester.path / name / "tests" / "test_tutorial.py").write_text(text)
    files = pytester.path.glob("*/tests/test_tutorial.py")
    pytester.runpytest_inprocess(*QUICK, "--import-mode=importlib", *files).assert_outcomes(
        passed=4
    )


def test_a_run_without_the_fixture_imports_nothing_of_crosnode():
    code = (
        "import sys, crosnode.testing.plugin\n"
        "loaded = [m for m in sys.modules if m.startswith(('plcsim', 'crosnode', 'st_types'))]\n"
        "assert sorted(loaded) == ['crosnode', 'crosnode.testing', 'crosnode.testing.plugin',"
        " 'plcsim', 'plcsim.core', 'plcsim.core.lazy'], loaded\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_what_is_wrong_is_said_in_one_line(pytester):
    shutil.copytree(PROGRAMS / "blinky", pytester.path, dirs_exist_ok=True)
    pytester.makepyfile("def test_it(ros): pass\n")
    result = pytester.runpytest_inprocess(*QUICK, *pytester.path.glob("test_*.py"))
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["ros: the programs were booted without a table *ros* *"])
    result.stdout.no_fnmatch_line("*crosnode/testing/*")


def test_the_network_of_the_host_has_no_other_hosts(pytester):
    shutil.copytree(PROGRAMS / "talker", pytester.path, dirs_exist_ok=True)
    pytester.makepyfile(
        """
        import pytest

        @pytest.mark.plc(network="host")
        def test_it(ros): pass
        """
    )
    result = pytester.runpytest_inprocess(*QUICK, *pytester.path.glob("test_*.py"))
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["this test runs on the host's network; *"])
