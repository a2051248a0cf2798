"""``plcsim run``: options, exit codes, report; hard cases are in tests/scan/test_supervisor.py."""

import json
import signal

import pytest

from plcsim.cli import run
from plcsim.cli.main import main

GOOD = """
    from plcsim import Program

    class Main(Program):
        pass
"""

FAILS = """
    from plcsim import Program

    class Main(Program):
        def cyclic(self) -> None:
            self.nothing = 1
"""

VIRTUAL = ["--virtual", "--cycles", "3"]


def test_a_run_that_stops_is_exit_code_0(project_of, capsys):
    assert main(["run", str(project_of(GOOD)), *VIRTUAL]) == 0
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.startswith("cell  STOPPED  after 25 ms  (virtual clock)\n")


def test_the_project_may_be_named_by_its_file(project_of):
    assert main(["run", str(project_of(GOOD) / "plc.toml"), *VIRTUAL, "--quiet"]) == 0


def test_quiet_prints_nothing_but_errors(project_of, capsys):
    folder = project_of(GOOD)
    assert main(["run", str(folder), *VIRTUAL, "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")
    project_of(FAILS)
    assert main(["run", str(folder), *VIRTUAL, "--quiet"]) == 3
    shown = capsys.readouterr()
    assert shown.out == ""
    place = f"{folder / 'main' / 'main.py'}:6"
    assert "SERVICE: main CYCLIC: AttributeError: " in shown.err
    assert f"({place})" in shown.err


def test_the_time_is_that_of_the_controller(project_of, tmp_path):
    report = tmp_path / "report.json"
    folder = project_of(GOOD)
    assert main(["run", str(folder), "--virtual", "--for", "10min", "--report", str(report)]) == 0
    found = json.loads(report.read_text())
    assert found["elapsed_ns"] == 600_000_000_000
    assert found["task_classes"][0]["cycles"] == 60_000


def test_the_report_of_a_failed_run_is_written_too(project_of, tmp_path):
    report = tmp_path / "report.json"
    assert main(["run", str(project_of(FAILS)), *VIRTUAL, "--report", str(report)]) == 3
    found = json.loads(report.read_text())
    assert (found["state"], found["fault"]["unit"]) == ("SERVICE", "CYCLIC")


@pytest.mark.parametrize(
    ("file", "error"), [("nowhere/r.json", "there is no folder"), (".", "cannot be written")]
)
def test_a_report_that_cannot_be_written_is_found_before_the_run(
    project_of, capsys, monkeypatch, file, error
):
    monkeypatch.setattr(run, "Supervisor", None)  # nothing starts
    folder = project_of(GOOD)
    monkeypatch.chdir(folder)
    assert main(["run", str(folder), "--report", file]) == 1
    assert error in capsys.readouterr().err


def test_a_report_that_cannot_be_written_after_the_run_is_an_error(project_of, capsys):
    assert main(["run", str(project_of(GOOD)), *VIRTUAL, "--report", "/dev/full"]) == 1
    shown = capsys.readouterr().err
    assert "STOPPED" in shown
    assert shown.endswith("plcsim: --report /dev/full: No space left on device\n")


@pytest.mark.parametrize(
    ("option", "value"), [("--for", "soon"), ("--for", "10"), ("--cycles", "0"), ("--cycles", "x")]
)
def test_a_wrong_limit_is_wrong_usage(capsys, option, value):
    with pytest.raises(SystemExit) as ended:
        main(["run", "x", option, value])
    assert ended.value.code == 2
    assert f"argument {option}: '{value}' is not a" in capsys.readouterr().err


def test_a_wrong_project_is_exit_code_1(project_of, capsys):
    assert main(["run", str(project_of("1 // 0\n")), *VIRTUAL]) == 1
    assert capsys.readouterr().err.endswith("main/main.py:1: division by zero\n")


def test_the_handlers_of_signals_are_given_back(project_of):
    before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
    main(["run", str(project_of(GOOD)), *VIRTUAL, "--quiet"])
    assert [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)] == before
