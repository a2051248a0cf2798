"""Real scan processes: what becomes of programs that hang, crash and fail.

Most tests supervise a scan process from here; what concerns the command line starts `plcsim run`
itself. Programs say where they are by printing or by what they have run; no test sleeps.
"""

import gc
import json
import os
import signal
import threading
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from plcsim.core.errors import PlcError
from plcsim.core.system import State
from plcsim.process import supervisor, watchdog
from plcsim.process.run_file import find_run
from plcsim.process.scan_process import DUMP
from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project
from plcsim.shared_image.status_page import StatusPage

from .conftest import QUICK, SLOW

MS = 1_000_000
IN = "print('in', flush=True)"


PATIENT_NS = 100_000 * MS


def is_in_a_program(supervised):
    """Whether a program is active."""
    return supervised.page.active is not None


def is_at_work(supervised):
    """Whether a program is active, or the cycles have begun."""
    return is_in_a_program(supervised) or supervised.page.state is State.RUN


@pytest.fixture
def supervise(monkeypatch):
    """``supervise(folder, cycles=1)``: the result of a run, killed after little patience.

    Only while ``is_there``, which on a busy machine takes its time, INIT and EXIT have 600 ms, and
    so has a scan outside a program. What is to be interrupted and not to be killed is given a large
    ``patience_ns``: on a busy machine the interruption takes its time as well.
    """

    def supervise(
        folder, look=lambda _: None, is_there=is_in_a_program, patience_ns=400 * MS, **options
    ):
        monkeypatch.setattr(watchdog, "PATIENCE_NS", patience_ns)
        project = read_project(folder)
        quick = replace(project, plc=replace(project.plc, init_timeout_ns=600 * MS))

        def look_and_shorten(supervised):
            supervised._project = quick if is_there(supervised) else project
            look(supervised)

        with Supervisor(project, **options) as supervised:
            return supervised.wait(lambda: look_and_shorten(supervised))

    return supervise


def line_of(folder, text):
    """The place of the line of the program that contains ``text``."""
    file = folder / "main" / "main.py"
    lines = file.read_text().splitlines()
    (number,) = [number for number, line in enumerate(lines, 1) if text in line]
    return f"{file}:{number}"


# programs that do not return


def test_an_endless_loop_ends_in_service(program, start):
    """Beside the default watchdog of 500 ms, with the real-time rights there are."""
    folder = program(plc="", cyclic="while True: pass")
    process = start("run", folder, "--report", folder / "report.json")
    _, err = process.communicate(timeout=100)
    assert process.returncode == 3
    assert "program main did not return" in " ".join(err.split())
    report = json.loads((folder / "report.json").read_text())
    (entry,) = [e for e in report["logbook"] if e["severity"] == "error"]
    assert entry["source"] == "task class 1"
    assert "cause program: program main did not return" in entry["text"]
    assert line_of(folder, "while True") in entry["text"]
    assert report["fault"]["location"] == line_of(folder, "while True")
    assert report["fault"]["response_ns"] > 500 * MS
    assert report["task_classes"][0]["violations"]["program"] == 1


SPIN = "def spin():\n    while True: time.monotonic()\n"
LOOP = "while True:\n    try: spin()\n    except {}: pass"


def test_a_loop_that_swallows_exceptions_is_ended_all_the_same(program, supervise):
    folder = program(plc=QUICK, before=SPIN, cyclic=LOOP.format("Exception"))
    fault = supervise(folder, patience_ns=PATIENT_NS)["fault"]
    assert fault["kind"] == "cycle_time_violation"
    assert fault["location"] == line_of(folder, "time.monotonic()")


@pytest.mark.parametrize(
    ("unit", "body"),
    [
        ("init", "sum(range(10**15))"),
        ("cyclic", "sum(range(10**15))"),
        ("exit", "sum(range(10**15))"),
        ("cyclic", LOOP.format("BaseException")),
    ],
)
def test_a_program_that_cannot_be_interrupted_is_killed(program, supervise, unit, body):
    folder = program(plc=QUICK if unit == "cyclic" else SLOW, before=SPIN, **{unit: body})
    result = supervise(folder, cycles=1)
    fault = result["fault"]
    assert (result["state"], fault["kind"]) == ("SERVICE", "program_error")
    assert (fault["program"], fault["unit"]) == ("main", unit.upper())
    assert fault["location"] == line_of(folder, "sum(" if "sum" in body else "time.monotonic()")
    assert "s and could not be interrupted" in fault["text"]
    assert fault["location"] in result["logbook"][-1]["text"]


def test_a_stack_that_takes_its_time_is_waited_for(program, supervise, monkeypatch, tmp_path):
    """The scan process stands still when it is asked for its stack, as on a busy host."""
    monkeypatch.setattr(supervisor, "DUMP_POLLS", 5000)
    is_there, woken = tmp_path / "there", []
    line = f"open({str(is_there)!r}, 'w').close() or sum(range(10**15))"
    folder = program(plc=QUICK, cyclic=line)

    def hold(supervised):
        process = supervised._process
        if is_there.exists() and "send_signal" not in vars(process):
            os.kill(process.pid, signal.SIGSTOP)
            process.send_signal = partial(send, process)

    def send(process, number):
        os.kill(process.pid, number)
        if number == DUMP and not woken:
            woken.append(threading.Timer(0.3, os.kill, (process.pid, signal.SIGCONT)))
            woken[0].start()

    assert supervise(folder, hold)["fault"]["location"] == line_of(folder, "sum(")
    woken[0].join()


def test_a_killed_program_is_exit_code_3(program, start):
    folder = program(plc=QUICK, cyclic="sum(range(10**15))")
    process = start("run", folder, "--report", folder / "report.json")
    _, err = process.communicate(timeout=100)
    assert process.returncode == 3
    assert "main CYCLIC: did not return within 100 ms and could not be interrupted" in " ".join(
        err.split()
    )
    assert json.loads((folder / "report.json").read_text())["state"] == "SERVICE"


def test_a_program_that_does_not_return_may_be_logged_only(program, supervise):
    folder = program(plc=QUICK, settings='on_violation = "log"', cyclic="while True: pass")
    result = supervise(folder, cycles=2, patience_ns=PATIENT_NS)
    assert (result["state"], result["fault"]) == ("STOPPED", None)
    violations = result["task_classes"][0]["violations"]
    assert {cause: count for cause, count in violations.items() if count} == {"program": 2}


@pytest.mark.parametrize("unit", ["init", "exit"])
def test_an_init_or_exit_that_does_not_return_is_ended(program, supervise, unit):
    folder = program(**{unit: "while True: pass"})
    fault = supervise(folder, cycles=1, patience_ns=PATIENT_NS)["fault"]
    assert (fault["program"], fault["unit"]) == ("main", unit.upper())
    assert fault["location"] == line_of(folder, "while True")
    assert fault["text"] == "the program did not return"


def test_a_blocking_call_is_ended_and_blamed_on_the_program(program, supervise):
    folder = program(plc=QUICK, cyclic="time.sleep(3600)")
    fault = supervise(folder, patience_ns=PATIENT_NS)["fault"]
    assert (fault["kind"], fault["cause"]) == ("cycle_time_violation", "program")
    assert fault["location"] == line_of(folder, "time.sleep")


def test_a_project_that_is_never_loaded_is_ended(program, supervise, tmp_path):
    is_there = tmp_path / "there"
    folder = program(before=f"open({str(is_there)!r}, 'w')\nwhile True: pass")
    result = supervise(folder, is_there=lambda _: is_there.exists())
    place = line_of(folder, "while True")
    assert result == {"error": f"{place}: the programs were not loaded within 600 ms"}


# a scan that hangs outside a program

HANGING_LATCH = """
from plcsim.core.image import ProcessImage
def hang(*_):
    while True: pass
ProcessImage.latch = hang
"""


def stops_asleep(supervised):
    """Stop the scan process; whether that was outside a program. Otherwise it goes on."""
    pid = supervised._process.pid
    os.kill(pid, signal.SIGSTOP)
    os.waitid(os.P_PID, pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
    is_asleep = supervised.page.active is None
    if not is_asleep:
        os.kill(pid, signal.SIGCONT)
    return is_asleep


@pytest.mark.parametrize("is_over", [True, False])
def test_a_scan_that_was_stopped_in_its_sleep_is_ended(program, supervise, monkeypatch, is_over):
    """After the end that was asked for at once, otherwise after ``init_timeout``."""
    monkeypatch.setattr(supervisor, "DUMP_POLLS", 1)  # it cannot tell where it is
    stopped = []

    def look(supervised):
        if not stopped and supervised.page.of_class(1).cycles > 2 and stops_asleep(supervised):
            stopped.append(supervised)
            if is_over:
                supervised._for_ns = 1  # the scan has more, or it might have ended by itself

    result = supervise(
        program(cyclic="pass"), look, is_there=lambda _: stopped, for_ns=100_000 * MS
    )
    fault = result["fault"]
    assert (fault["program"], fault["unit"]) == ("scan", "")
    limit = "400 ms" if is_over else "610 ms"
    assert fault["text"] == f"the scan did not go on for {limit}; no program was active"


def test_a_scan_that_hangs_in_latch_is_ended_with_its_place(program, supervise):
    folder = program(before=HANGING_LATCH, cyclic="pass")
    fault = supervise(folder, is_there=is_at_work)["fault"]
    assert fault["text"] == "the scan did not go on for 610 ms; no program was active"
    assert fault["location"] == line_of(folder, "while True: pass")


# programs that end the process


@pytest.mark.parametrize(
    ("body", "text"),
    [
        ("os._exit(0)", "exit code 0"),
        ("os._exit(5)", "exit code 5"),
        ("os.abort()", "SIGABRT"),
        ("ctypes.string_at(1)", "SIGSEGV"),
        ("os.kill(os.getpid(), 40)", "signal 40"),
        ("os.kill(os.getpid(), signal.SIGKILL)", "SIGKILL"),
    ],
)
def test_a_program_that_ends_the_process_is_reported(program, supervise, body, text):
    folder = program(cyclic=body)
    result = supervise(folder)
    fault = result["fault"]
    assert result["state"] == "SERVICE"
    assert (fault["program"], fault["unit"]) == ("main", "CYCLIC")
    assert fault["text"] == f"the scan process ended with {text}"
    assert fault["location"] == (line_of(folder, body) if text in ("SIGSEGV", "SIGABRT") else "")


def stop_in_run(supervised):
    """Ask once for a stop, as soon as the program has run."""
    has_run = supervised.page.state is State.RUN and supervised.page.of_class(1).cycles
    if has_run and not supervised.is_asked_to_stop:
        supervised.stop()


def test_a_crash_in_exit_is_not_taken_for_a_slow_stop(program, supervise):
    fault = supervise(program(exit="os._exit(7)"), stop_in_run)["fault"]
    assert (fault["unit"], fault["text"]) == ("EXIT", "the scan process ended with exit code 7")


def test_a_crash_while_loading_is_a_wrong_project(program, supervise):
    folder = program(before="ctypes.string_at(1)")
    place = line_of(folder, "string_at")
    assert supervise(folder) == {"error": f"{place}: the scan process ended with SIGSEGV"}


@pytest.mark.parametrize(("cyclic", "state"), [("pass", "STOPPED"), ("1 // 0", "SERVICE")])
def test_a_thread_that_a_program_left_behind_does_not_hold_up_the_end(
    program, supervise, cyclic, state
):
    thread = "threading.Thread(target=time.sleep, args=(3600,)).start()"
    result = supervise(program(init=thread, cyclic=cyclic, plc=SLOW), cycles=1)
    assert (result["state"], result["task_classes"][0]["cycles"]) == (state, 1)


# stopping


def test_ctrl_c_runs_the_exits(program, start):
    process = start("run", program(cyclic=IN, exit="print('bye')"))
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=100)
    assert process.returncode == 0
    assert out.endswith("bye\n")
    assert "STOPPED" in err
    assert "Traceback" not in err


@pytest.mark.parametrize("cyclic", ["1 // 0", "os.kill(os.getpid(), signal.SIGKILL)"])
def test_in_service_a_run_that_stays_is_watched_until_ctrl_c(program, start, cyclic):
    folder = program(cyclic=cyclic)
    process = start("run", folder, "--stay")
    assert any("until Ctrl-C" in line for line in process.stderr)
    run = find_run(folder)
    page = StatusPage(run.open(run.status_fd))
    assert page.state is State.SERVICE
    page.close()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=100)
    assert process.returncode == 3
    with pytest.raises(PlcError, match="is not running"):
        find_run(folder)


def test_a_stop_before_service_is_not_forgotten(program):
    with Supervisor(read_project(program(exit="1 // 0", cyclic=IN))) as supervised:
        supervised.wait(lambda: stop_in_run(supervised))
        supervised.stay()
        assert supervised.page.state is State.SERVICE


def test_a_termination_that_reaches_both_processes_is_one_stop(program, start):
    """As systemd does it: SIGTERM to the parent, which forwards it, and to the scan process."""
    body = "print('leaving')\nwhile not os.path.exists(f'{__file__}.both'): pass\nprint('left')"
    folder = program(cyclic="print(os.getpid(), flush=True)", exit=body)
    process = start("run", folder)
    scan = int(process.stdout.readline())
    os.kill(scan, signal.SIGTERM)
    process.send_signal(signal.SIGTERM)
    (folder / "main" / "main.py.both").touch()
    out, _ = process.communicate(timeout=100)
    assert process.returncode == 0
    assert out.endswith("leaving\nleft\n")


def test_ctrl_c_in_a_long_init_stops_after_it(program, start):
    folder = program(init=f"{IN}\ntime.sleep(0.2)\nprint('out')", exit="print('bye')")
    process = start("run", folder)
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    out = process.stdout.read()  # communicate() leaves out what has come with the first line
    assert (process.wait(100), out) == (0, "out\nbye\n")


def test_a_second_ctrl_c_ends_a_program_that_hangs(program, start):
    process = start("run", program(plc=SLOW, exit=f"{IN}\nwhile True: pass", cyclic="print(1)"))
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    assert "in\n" in iter(process.stdout.readline, "")
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=100)
    assert process.returncode == 3
    assert "main EXIT: stopped by SIGINT" in " ".join(err.split())


def test_a_third_request_kills(program, supervise):
    def ask(supervised):
        if supervised.page.active is not None:
            asked.append(supervised)
            supervised.stop()

    asked = []
    folder = program(plc=SLOW, init="sum(range(10**15))")
    fault = supervise(folder, ask)["fault"]
    assert len(asked) >= 3
    assert (fault["unit"], fault["text"]) == ("INIT", "killed because it did not stop")
    assert fault["location"] == line_of(folder, "sum(")


def test_ctrl_c_while_loading_stops(program, start):
    process = start("run", program(plc=SLOW, before=f"{IN}\nwhile True: pass"))
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=100)
    assert process.returncode == 0
    assert "STOPPED" in err


def test_the_scan_process_dies_with_its_parent(program, start):
    process = start("run", program(cyclic=IN))
    process.stdout.readline()
    process.kill()
    out, _ = process.communicate(timeout=100)  # ends when nobody can write to it any more
    assert set(out.split()) <= {"in"}


def test_leaving_early_ends_the_scan_process(program):
    with Supervisor(read_project(program(cyclic="pass"))) as supervised:
        process = supervised._process
    assert process.returncode == -signal.SIGKILL


# limits and output


@pytest.mark.parametrize("virtual", [True, False])
@pytest.mark.parametrize("limit", [{"for_ns": 100 * MS}, {"cycles": 10}])
def test_a_run_ends_at_its_limit(program, supervise, virtual, limit):
    result = supervise(program(cyclic="pass"), virtual=virtual, **limit)
    assert (result["state"], result["fault"]) == ("STOPPED", None)
    assert result["clock"] == ("virtual" if virtual else "monotonic")
    (first,) = result["task_classes"]
    assert first["cycles"] + first["missed_grid_points"] >= 10
    if virtual:
        assert first["cycles"] == 10
        assert result["elapsed_ns"] == limit.get("for_ns", 95 * MS)


DAEMON = """if not self.context.violation and not hasattr(Main, 'started'):
    Main.started = True
    for new_session in (False, True):
        child = subprocess.Popen(['sleep', '3600'], start_new_session=new_session)
        print(child.pid, flush=True)"""


@pytest.mark.parametrize("ending", ["pass", "1 // 0", "os._exit(3)"])
def test_what_programs_start_does_not_outlive_the_run(program, finish, ending):
    folder = program(before="import subprocess", cyclic=f"{DAEMON}\n{ending}")
    _, out, _ = finish("run", folder, "--cycles", "3")
    pids = out.split()
    assert len(pids) == 2
    assert not any(Path(f"/proc/{pid}").exists() for pid in pids)


def test_a_flood_of_violations_is_bounded(program, supervise):
    settings = 'on_violation = "log"\ntolerance = "0ms"'
    busy = "end = time.monotonic() + 0.0011\nwhile time.monotonic() < end: pass"
    folder = program(settings=settings, cyclic=busy)
    text = (folder / "plc.toml").read_text().replace('"10ms"', '"1ms"')
    (folder / "plc.toml").write_text(text)
    result = supervise(folder, cycles=600)
    assert result["state"] == "STOPPED"
    assert len(result["logbook"]) == 512
    assert result["logbook_dropped"] > 0
    assert len(result["violations"]) == 100
    assert sum(result["task_classes"][0]["violations"].values()) == 600


def test_a_breakpoint_says_where_it_can_be_used(program, supervise):
    folder = program(cyclic="breakpoint()")
    fault = supervise(folder)["fault"]
    assert fault["location"] == line_of(folder, "breakpoint()")
    assert "cannot be stopped in the middle of a cycle; in a test it can" in fault["text"]


def test_a_program_that_fails_is_shown_with_its_line(program, finish):
    folder = program(cyclic="1 // 0")
    code, out, err = finish("run", folder)
    assert (code, out) == (3, "")
    place = line_of(folder, "1 // 0")
    assert f"mainCYCLIC:divisionbyzero({place})" in "".join(err.split())
    assert "Traceback" not in err


@pytest.mark.parametrize(
    ("folder", "text"),
    [("nowhere", "nowhere/plc.toml: there is no such file"), ("cell", "main/main.py:1: Syntax")],
)
def test_a_wrong_project_is_one_line_and_exit_code_1(project_of, finish, tmp_path, folder, text):
    project_of("x = (\n")
    code, out, err = finish("run", tmp_path / folder)
    assert (code, out) == (1, "")
    assert err.startswith("plcsim: ")
    assert err.count("\n") == 1
    assert text in err


# surroundings


def test_modules_in_the_working_folder_do_not_get_into_the_scan(
    program, tmp_path, supervise, monkeypatch
):
    (tmp_path / "json.py").write_text("raise RuntimeError('shadowed')\n")
    monkeypatch.chdir(tmp_path)
    assert supervise(program(cyclic="pass"), cycles=1)["state"] == "STOPPED"


def test_a_folder_for_run_files_that_is_not_there_does_not_matter(
    program, supervise, monkeypatch, tmp_path
):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path / "nowhere"))
    assert supervise(program(cyclic="pass"), cycles=1)["state"] == "STOPPED"


def test_descriptors_and_processors_are_given_back(program, supervise):
    folder = program(cyclic="pass")
    supervise(folder, cycles=1)
    gc.collect()  # what others left open is not counted
    before = len(list(Path("/proc/self/fd").iterdir())), os.sched_getaffinity(0)
    supervise(folder, cycles=1)
    assert (len(list(Path("/proc/self/fd").iterdir())), os.sched_getaffinity(0)) == before
