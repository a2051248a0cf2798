"""The fixture modbus in runs of pytest, in projects elsewhere on disk."""

import shutil
import subprocess
import sys
from pathlib import Path

pytest_plugins = ["pytester"]

QUICK = ("-p", "no:hypothesispytest")
PROGRAMS = Path(__file__).parents[5] / "programs"


def test_the_fixture_modbus_is_an_hmi_of_the_project(pytester):
    shutil.copytree(PROGRAMS / "tank", pytester.path, dirs_exist_ok=True)
    pytester.makepyfile(
        """
        def test_it(plc, modbus):
            modbus.write("control.setpoint", 2.5)
            assert plc["control.setpoint"] == 2.5
        """
    )
    result = pytester.runpytest_inprocess(*QUICK, *pytester.path.glob("test_*.py"))
    result.assert_outcomes(passed=1)


def test_without_the_table_the_fixture_modbus_says_so_and_nothing_else(pytester):
    shutil.copytree(PROGRAMS / "blinky", pytester.path, dirs_exist_ok=True)
    pytester.makepyfile("def test_it(plc, modbus): pass\n")
    result = pytester.runpytest_inprocess(*QUICK, *pytester.path.glob("test_*.py"))
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["the project has no table *modbus* in its plc.toml"])


def test_a_run_that_does_not_use_the_fixture_imports_nothing_for_it():
    code = (
        "import sys, plcsim.modbus.testing.plugin\n"
        "loaded = [m for m in sys.modules if m.startswith(('plcsim', 'st_types', 'pymodbus'))]\n"
        "assert sorted(loaded) == ['plcsim', 'plcsim.core', 'plcsim.core.lazy', 'plcsim.modbus',"
        " 'plcsim.modbus.testing', 'plcsim.modbus.testing.plugin'], loaded\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
