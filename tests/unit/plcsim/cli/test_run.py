"""``plcsim run``: options, exit codes, report; hard cases are in tests/scan."""

import json
import os
import signal
import subprocess
import sys
from textwrap import dedent

import pytest

from plcsim.cli import run
from plcsim.cli.main import main
from plcsim.core.system import State
from plcsim.process.service_processes import ServiceProcesses

GOOD = """
    from plcsim import Program

    class Main(Program):
        pass
"""

FAILS = """
    from plcsim import Program

    class Main(Program):
        def cyclic(self) -> None:
            int("ten")
"""

KILLED = """
    import os
    import signal

    from plcsim import Program

    class Main(Program):
        def cyclic(self) -> None:
            os.kill(os.getpid(), signal.SIGKILL)
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
    assert "SERVICE: main CYCLIC: ValueError: " in shown.err
    assert f"({place})" in shown.err


def test_a_processor_that_is_not_there_is_noted(project_of, capsys):
    folder = project_of(FAILS, plc="cpu = 1023")
    for options, noted in (([], True), (["--quiet"], False), (["--virtual"], False)):
        assert main(["run", str(folder), *options]) == 3
        assert ("on this host: plc.cpu: there is no" in capsys.readouterr().err) is noted


def test_in_service_a_run_can_stay_until_ctrl_c(project_of, capsys, monkeypatch):
    stayed = []
    wait = run.Supervisor.wait

    def wait_and_interrupt(supervisor, look):
        def interrupt():
            look()
            if supervisor.page.state is State.SERVICE and not stayed:
                stayed.append(supervisor.page.stays)
                supervisor.stop()

        return wait(supervisor, interrupt)

    monkeypatch.setattr(run.Supervisor, "wait", wait_and_interrupt)
    folder = project_of(FAILS)
    assert main(["run", str(folder), *VIRTUAL, "--stay"]) == 3
    assert stayed == [True]
    assert "until Ctrl-C" not in capsys.readouterr().err  # it has been pressed


def test_what_a_scan_process_that_died_has_left_can_be_read_until_ctrl_c(
    project_of, capsys, monkeypatch
):
    stayed = []
    monkeypatch.setattr(run.Supervisor, "stay", lambda each: stayed.append(each.page.state.name))
    folder = project_of(KILLED)
    assert main(["run", str(folder), *VIRTUAL, "--stay"]) == 3
    *_, last = capsys.readouterr().err.splitlines()
    assert last == "the values of the last cycle can be read until Ctrl-C"
    assert main(["run", str(folder), *VIRTUAL, "--stay", "--quiet"]) == 3
    assert "until Ctrl-C" not in capsys.readouterr().err
    assert main(["run", str(folder), *VIRTUAL]) == 3
    project_of(GOOD)
    assert main(["run", str(folder), *VIRTUAL, "--stay"]) == 0
    assert stayed == ["SERVICE", "SERVICE"]


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
    assert main(["run", str(project_of(FAILS)), *VIRTUAL, "--report", "/dev/full"]) == 3
    shown = capsys.readouterr().err
    assert "SERVICE: main CYCLIC: ValueError: " in shown
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


def test_with_several_programs_it_is_told_that_the_others_could_run(project_of, capsys):
    folder = project_of("1 // 0\n")
    settings = folder / "plc.toml"
    settings.write_text(settings.read_text("utf-8").replace('"main"', '"main", "other"'), "utf-8")
    (folder / "other").mkdir()
    (folder / "other" / "main.py").write_text(dedent(GOOD), "utf-8")
    assert main(["run", str(folder), *VIRTUAL]) == 1
    assert "\nplcsim run --keep-going leaves out the programs" in capsys.readouterr().err
    assert main(["run", str(folder), *VIRTUAL, "--keep-going"]) == 0
    settings.write_text(settings.read_text("utf-8") + "\n[operator.inputs]\ngone = 1\n", "utf-8")
    (folder / "main" / "main.py").write_text(dedent(GOOD), "utf-8")
    assert main(["run", str(folder), *VIRTUAL]) == 1
    shown = capsys.readouterr().err
    assert "operator.inputs: no program 'gone' for tag 'gone'" in shown
    assert "--keep-going" not in shown


def test_the_handlers_of_signals_are_given_back(project_of):
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    before = [signal.getsignal(number) for number in numbers]
    main(["run", str(project_of(GOOD)), *VIRTUAL, "--quiet"])
    assert [signal.getsignal(number) for number in numbers] == before


@pytest.mark.parametrize("full", [False, True])
def test_a_run_that_nobody_reads_keeps_its_report_and_exit_code(project_of, tmp_path, full):
    report = tmp_path / "report.json"
    command = [sys.executable, "-P", "-m", "plcsim", "run", str(project_of(FAILS)), *VIRTUAL]
    reader, broken = os.pipe()
    os.close(reader)
    if full:
        os.close(broken)
        broken = os.open("/dev/full", os.O_WRONLY)
    buffered = {k: v for k, v in os.environ.items() if k != "PYTHONUNBUFFERED"}
    done = subprocess.run([*command, "--report", report], stderr=broken, env=buffered, check=False)
    os.close(broken)
    assert done.returncode == 3
    assert json.loads(report.read_text())["state"] == "SERVICE"


EXITS = """
    from pathlib import Path
    from plcsim import Program

    class Main(Program):
        def init(self) -> None:
            print("RUN", flush=True)

        def exit(self) -> None:
            Path(__file__).with_name("exited").touch()
"""


@pytest.mark.parametrize("ignored", [False, True])
def test_the_end_of_the_terminal_stops_the_run_unless_under_nohup(project_of, tmp_path, ignored):
    folder, report = project_of(EXITS), tmp_path / "report.json"
    command = [sys.executable, "-P", "-m", "plcsim", "run", str(folder), "--report", str(report)]
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN if ignored else signal.SIG_DFL)
    with subprocess.Popen([*command, "--quiet"], stdout=subprocess.PIPE) as running:
        signal.signal(signal.SIGHUP, before)
        assert running.stdout.readline() == b"RUN\n"
        running.send_signal(signal.SIGHUP)
        if ignored:
            with pytest.raises(subprocess.TimeoutExpired):
                running.wait(0.3)
            running.terminate()
        assert running.wait(100) == 0
    assert (folder / "main" / "exited").exists()
    assert json.loads(report.read_text())["state"] == "STOPPED"


def test_a_service_that_never_served_is_exit_code_1(project_of, monkeypatch, capsys):
    folder = str(project_of(GOOD))
    monkeypatch.setattr(ServiceProcesses, "never_served", property(lambda _: ["modbus"]))
    assert main(["run", folder, *VIRTUAL, "--quiet"]) == 1
    assert capsys.readouterr().err == ("plcsim: [modbus] never served; the reason stands above\n")
    project_of(FAILS)
    assert main(["run", folder, *VIRTUAL, "--quiet"]) == 3
