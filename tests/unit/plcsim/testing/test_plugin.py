"""The plugin in a pytest of its own: what a person sees."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import plcsim.program.structured_text.library  # inner runs would import parts of it again  # noqa: F401
from plcsim.program.structured_text.coverage import MEASURING

pytest_plugins = ["pytester"]

QUICK = ("-p", "no:hypothesispytest")
"""Hypothesis' own plugin would import it in every inner run."""

CELL = Path(__file__).with_name("cell.py").read_text()


@pytest.fixture
def suite(pytester):
    """A project with the cell, whose tests are given as text; returns the run's result."""
    pytester.makefile(".toml", plc='[task_class.1]\ncycle = "10ms"\nprograms = ["cell"]\n')
    (pytester.mkdir("cell") / "main.py").write_text(CELL)
    pytester.makeini("[pytest]\nfilterwarnings = error\n")

    def run(text, *arguments):
        pytester.makepyfile(test_cell=text)
        return pytester.runpytest_inprocess(*QUICK, *arguments)

    return run


def test_the_fixture_runs_the_project_that_the_test_belongs_to(suite):
    result = suite(
        """
        def test_count(plc):
            plc.run("100ms")
            assert plc["cell.count"] == 10
        """,
        "--strict-markers",
    )
    result.assert_outcomes(passed=1)


def test_every_test_has_a_controller_of_its_own(suite):
    result = suite(
        """
        import pytest

        @pytest.mark.parametrize("n", range(3))
        def test_count(plc, n):
            plc.cycles()
            assert plc["cell.count"] == 1
        """
    )
    result.assert_outcomes(passed=3)


def test_a_failure_shows_the_expectation_the_table_and_the_diagram_and_nothing_internal(suite):
    result = suite(
        """
        def test_late(plc):
            plc.run("300ms")
            plc.assert_within("100ms", {"cell.count": 41})
        """
    )
    result.assert_outcomes(failed=1)
    text = result.stdout.str()
    result.stdout.fnmatch_lines(
        [
            ">*plc.assert_within*",
            "E *expected cell.count = 41 within 100 ms; it held after none of 10 cycles*",
            "E *the last 20 cycles*",
            "E *cycle *time *cell.count*",
            "E * 40  395 ms * 40",
            "E *cell.count*",
            "trace: *test_late.csv and *test_late.svg",
        ]
    )
    assert "plcsim/testing" not in text
    assert "--plc-seed" not in text


def test_the_summary_is_one_line_that_says_what_was_expected(suite, monkeypatch):
    monkeypatch.setenv("CI", "1")  # pytest then cuts no line of the summary
    result = suite("def test_late(plc):\n    plc.assert_within('30ms', 'cell.start')\n")
    assert result.outlines[-2] == (
        "FAILED test_cell.py::test_late - expected cell.start within 30 ms; "
        "it held after none of 3 cycles; cell.start is FALSE"
    )


def test_a_plain_assert_shows_the_tags_that_were_read(suite):
    result = suite(
        """
        def test_count(plc):
            plc.run("300ms")
            assert plc["cell.count"] == 31
        """
    )
    result.stdout.fnmatch_lines(
        ["*assert 30 == 31", "*plc*", "the last 20 cycles", "* 295 ms * 30"]
    )


@pytest.mark.parametrize(
    ("body", "text"),
    [
        ("plc['cell.coutn']", "E *no tag 'cell.coutn'* did you mean cell.count*"),
        ("plc['cell.start'] = 'on'", "E *'on' is not a BOOL*"),
        ("plc.run('fast')", "E *run: 'fast' is not a duration*"),
        (
            "plc.plant(lambda tags, ns: 1 / 0); plc.run('1s')",
            "E *plant <lambda> raised in cycle 1*",
        ),
        ("plc['cell.crash_at'] = 2; plc.run('1s')", "E *SERVICE*division by zero*main.py:*"),
        ("plc.stimulate('none.csv')", "E *none.csv: cannot be read*"),
    ],
)
def test_bad_input_says_so_with_no_internal_traceback(suite, body, text):
    result = suite(f"def test_it(plc):\n    {body}\n")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines([text])
    assert "plcsim/testing" not in result.stdout.str()
    assert "plcsim/tag" not in result.stdout.str()


@pytest.mark.parametrize(
    ("marker", "text"),
    [
        ("project='nowhere'", "*nowhere/plc.toml: there is no such file*"),
        ("projekt='x'", "*unknown argument projekt*"),
        ("network='real'", "*network is virtual or host, not real*"),
        ("task_class=5", "*there is no task class 5; there are 1*"),
        ("program=object, project='.'", "*either a project or a program*"),
    ],
)
def test_a_project_that_does_not_load_says_so(suite, marker, text):
    result = suite(f"import pytest\n@pytest.mark.plc({marker})\ndef test_it(plc): pass\n")
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines([text])
    assert "Traceback" not in result.stdout.str()
    assert "plcsim/testing" not in result.stdout.str()


def test_a_program_that_cannot_be_imported_is_named_with_its_line(suite, pytester):
    (pytester.path / "cell" / "main.py").write_text("import plcsim\nx = = 3\n")
    result = suite("def test_it(plc): pass\n")
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*cell/main.py:2: SyntaxError: invalid syntax*"])


def test_an_init_that_fails_is_an_error_and_leaves_no_module_behind(suite, pytester):
    (pytester.path / "cell" / "main.py").write_text(
        CELL.replace("def exit(self) -> None:", "def init(self) -> None:\n        1 / 0")
    )
    before = {m for m in sys.modules if m.startswith("plcsim_project_")}
    result = suite("def test_it(plc): pass\n")
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*cell INIT: division by zero (*main.py:*)*"])
    assert {m for m in sys.modules if m.startswith("plcsim_project_")} == before


def test_an_exit_that_fails_is_an_error_of_the_test(suite, pytester):
    (pytester.path / "cell" / "main.py").write_text(
        CELL.replace("self.exits += 1", "raise ValueError('no exit')")
    )
    result = suite("def test_it(plc):\n    plc.cycles()\n")
    result.assert_outcomes(passed=1, errors=1)
    result.stdout.fnmatch_lines(["*EXIT: ValueError: no exit*"])


def test_seeds_repeat_a_test_and_a_failing_one_can_be_repeated(suite):
    text = """
        import pytest

        @pytest.mark.plc(seeds=5)
        def test_noise(plc):
            plc.faults.noise("cell.level", 10)
            plc.run("100ms")
            assert plc["cell.level"] < 0
        """
    result = suite(text)
    outcomes = result.parseoutcomes()
    assert outcomes["failed"] + outcomes["passed"] == 5
    result.stdout.fnmatch_lines(["chance was in it: repeat with --plc-seed=*"])
    failed = [line.split("::")[1].split(" ")[0] for line in result.outlines if "FAILED" in line]
    again = suite(text, "-k", failed[0])
    again.assert_outcomes(failed=1, deselected=4)


def test_a_random_seed_is_printed(suite):
    result = suite("def test_it(plc): plc.cycles()\n", "--plc-seed=random")
    result.assert_outcomes(passed=1)
    result.stdout.re_match_lines([r"plcsim: --plc-seed=\d+"])


def test_a_wrong_seed_is_an_error_of_use(suite):
    result = suite("def test_it(plc): pass\n", "--plc-seed=x")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*--plc-seed: 'x' is neither a number nor random*"])


def test_repeats_multiply_tests(suite):
    suite("def test_it(plc): plc.cycles()\n", "--plc-repeat=3").assert_outcomes(passed=3)


def test_a_program_class_is_run_without_a_project(pytester):
    pytester.makepyfile(
        """
        import pytest
        from plcsim import Program
        from st_types import DINT, var

        class Counter(Program):
            count = var(DINT)

            def cyclic(self):
                self.count += 1

        @pytest.mark.plc(program=Counter, cycle="2ms")
        def test_count(plc):
            plc.run("10ms")
            assert plc["Counter.count"] == 5
        """
    )
    pytester.runpytest_inprocess(*QUICK).assert_outcomes(passed=1)


def test_without_a_project_the_fixture_says_how_to_name_one(pytester):
    pytester.makepyfile("def test_it(plc): pass\n")
    result = pytester.runpytest_inprocess(*QUICK)
    result.stdout.fnmatch_lines(["*no plc.toml in * or above it; name the project with *"])


PROGRAMS = Path(__file__).parents[4] / "programs"


def test_a_test_imports_no_extension_that_its_project_does_not_use(pytester):
    shutil.copytree(PROGRAMS / "blinky", pytester.path, dirs_exist_ok=True)
    pytester.makepyfile(
        """
        import sys

        def test_it(plc):
            houses = ("crosnode", "plcsim.modbus", "pymodbus")
            found = [m for m in sys.modules if m.startswith(houses)]
            assert set(found) <= {
                "crosnode", "crosnode.testing", "crosnode.testing.plugin",
                "plcsim.modbus", "plcsim.modbus.testing", "plcsim.modbus.testing.plugin",
            }
        """
    )
    result = pytester.runpytest_subprocess(*QUICK, *pytester.path.glob("test_*.py"))
    result.assert_outcomes(passed=1)


def test_extensions_that_step_with_the_scan_do_so_in_tests(pytester):
    shutil.copytree(PROGRAMS / "talker", pytester.path, dirs_exist_ok=True)
    with (pytester.path / "plc.toml").open("a") as file:
        file.write('master = "embedded"\n')
    pytester.makepyfile(
        """
        def test_it(plc):
            plc.run("2s")
            assert len(plc.controller.image.inputs) > 1  # the master steps, and the test's own
        """
    )
    result = pytester.runpytest_subprocess(*QUICK, *pytester.path.glob("test_*.py"))
    result.assert_outcomes(passed=1)


def test_a_run_without_plc_tests_imports_nothing_of_plcsim():
    code = (
        "import sys, plcsim.testing.plugin\n"
        "loaded = [m for m in sys.modules if m.startswith(('plcsim', 'st_types'))]\n"
        "assert sorted(loaded) == ['plcsim', 'plcsim.core', 'plcsim.core.lazy', 'plcsim.testing',"
        " 'plcsim.testing.plugin', 'plcsim.testing.terminal'], loaded\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


COUNTING = "PROGRAM _CYCLIC\n\tcount := count + 1;\nEND_PROGRAM\n"


@pytest.fixture
def compiled_suite(pytester):
    """A project with a program in Structured Text, and one test; returns the run's result."""
    pytester.makefile(".toml", plc='[task_class.1]\ncycle = "10ms"\nprograms = ["main"]\n')
    folder = pytester.mkdir("main")
    (folder / "Main.st").write_text(COUNTING)
    (folder / "Main.var").write_text("VAR count : UDINT; END_VAR\n")
    pytester.makepyfile("def test_count(plc):\n    plc.cycles(5)\n")
    return lambda *arguments: pytester.runpytest_inprocess(*QUICK, *arguments)


def test_the_report_tells_what_lines_cost(compiled_suite, pytester):
    compiled_suite("--plc-report", "plain").assert_outcomes(passed=1)
    compiled_suite("--plc-report", "lines", "--plc-lines").assert_outcomes(passed=1)
    files = (pytester.path / folder / "report.json" for folder in ("plain", "lines"))
    reports = [json.loads(file.read_text()) for file in files]
    assert not MEASURING.is_on
    plain, counted = (report["tests"][0]["programs"][0] for report in reports)
    assert plain["instructions"] == counted["instructions"]
    assert plain["lines"] == {}
    (rows,) = counted["lines"].values()
    assert [(line, text) for line, _, text in rows][1:] == [(2, "count := count + 1;")]
    assert sum(cost for _, cost, _ in rows) == counted["instructions"]["total"]


def test_lines_without_a_report_are_an_error_of_use(compiled_suite):
    result = compiled_suite("--plc-lines")
    result.stderr.fnmatch_lines(["*--plc-lines: goes with --plc-report DIR*"])


LATER = """
import faulthandler

later = faulthandler.dump_traceback_later


def keep(_timeout, **options):
    faulthandler.from_now_on = lambda: later(0.02, **options)


faulthandler.dump_traceback_later = keep
"""
"""The last resort comes soon after a program has asked for it, however long that took."""


def test_a_project_that_stays_in_one_call_into_c_ends_pytest_and_is_named(pytester):
    pytester.makefile(".toml", plc='[task_class.1]\nprograms = ["cell"]\n')
    main = pytester.mkdir("cell") / "main.py"
    main.write_text(
        "import faulthandler, itertools\nfaulthandler.from_now_on(), all(itertools.repeat(1))\n"
    )
    pytester.makeconftest(LATER)
    pytester.makepyfile("def test_nothing(plc):\n    pass\n")
    done = subprocess.run(  # until nobody holds its standard error
        [sys.executable, "-m", "pytest", *QUICK],
        cwd=pytester.path,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr == f"plcsim: {main}:2: the programs were not loaded within 10 s\n"


@pytest.mark.parametrize("own_s", ["0", "1000"])
def test_who_lets_pytest_tell_stacks_of_hanging_tests_keeps_that(pytester, own_s):
    pytester.makeini(f"[pytest]\nfaulthandler_timeout = {own_s}\n")
    pytester.makepyfile(
        f"""
        from plcsim.testing import terminal

        def test_terminal():
            assert (terminal.errors_fd is None) is ({own_s} > 0)
        """
    )
    pytester.runpytest_subprocess(*QUICK).assert_outcomes(passed=1)


AS_FILES = {
    "x.apj": "<P/>",
    "Logical/Package.pkg": '<P><Object Type="Program">A</Object></P>',
    "Logical/A/IEC.prg": "<P><File>Main.st</File><File>Main.var</File></P>",
    "Logical/A/Main.st": "PROGRAM _CYCLIC\ncount := count + 1;\nEND_PROGRAM",
    "Logical/A/Main.var": "VAR count : UDINT; END_VAR",
    "Physical/Physical.pkg": '<P><Object Type="Configuration">Slow</Object>'
    '<Object Type="Configuration">Fast</Object></P>',
    **dict.fromkeys(
        ("Physical/Slow/Hardware.hw", "Physical/Fast/Hardware.hw"),
        '<Hardware><Module Type="CP"/></Hardware>',
    ),
    "Physical/Slow/Cpu.sw": '<S><TaskClass Name="Cyclic#4"><Task Source="A"/></TaskClass></S>',
    "Physical/Fast/Cpu.sw": '<S><TaskClass Name="Cyclic#1"><Task Source="A"/></TaskClass></S>',
}


@pytest.fixture
def automation_studio(pytester):
    """``automation_studio(body, head)``: an Automation Studio project with this test."""

    def call(body, head="", files=()):
        for name, text in {**AS_FILES, **dict(files)}.items():
            path = pytester.path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
        pytester.makepyfile(f"import pytest\n{head}\ndef test_it(plc):\n    {body}\n")

    return call


def test_programs_that_cannot_run_are_left_out_where_that_is_wanted(pytester, automation_studio):
    two = '<S><TaskClass Name="Cyclic#1"><Task Source="A"/><Task Source="Gone"/></TaskClass></S>'
    files = {"Physical/Slow/Cpu.sw": two, "Physical/Fast/Cpu.sw": two}
    automation_studio("plc.run('1s'); assert plc['A.count'] == 100", files=files)
    result = pytester.runpytest_inprocess("-p", "no:cacheprovider")
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*Cpu.sw:1: error: the logical view has no program Gone*"])
    result = pytester.runpytest_inprocess("--plc-keep-going", "-p", "no:cacheprovider")
    result.assert_outcomes(passed=1)


@pytest.mark.parametrize(
    ("marker", "options", "cycles"),
    [
        ("", [], 10),
        ("", ["--plc-config", "fast"], 100),
        ("@pytest.mark.plc(config='Fast')", [], 100),
        ("@pytest.mark.plc(config='Slow')", ["--plc-config", "Fast"], 10),
    ],
)
def test_a_configuration_of_automation_studio_by_option_and_marker(
    pytester, automation_studio, marker, options, cycles
):
    automation_studio(f"plc.run('1s'); assert plc['A.count'] == {cycles}", marker)
    result = pytester.runpytest_inprocess(*options, "-p", "no:cacheprovider")
    result.assert_outcomes(passed=1)
