"""The three loops, run for a few cycles, and what they are made from."""

import json
import sys

import pytest

from plcsim.doctor import loops
from plcsim.doctor.errors import MeasurementError
from plcsim.doctor.loops import (
    CLoop,
    LoopOrder,
    PythonLoop,
    ScanLoop,
    compile_floor,
    floor_loop,
    measure,
    probe_rights,
    write_project,
)
from plcsim.project.plc_toml import read_project

MS = 1_000_000
ORDER = LoopOrder(cycle_ns=MS, cycles=20, realtime=False)


@pytest.fixture(scope="module")
def floor(tmp_path_factory):
    binary = compile_floor(tmp_path_factory.mktemp("floor"))
    if binary is None:
        pytest.skip("there is no C compiler here")
    return binary


@pytest.mark.parametrize("name", ["C", "Python", "plcsim"])
def test_every_loop_wakes_as_often_as_ordered_and_never_early(tmp_path, request, name):
    loop = {"Python": PythonLoop, "plcsim": lambda: ScanLoop(tmp_path)}.get(
        name, lambda: CLoop(request.getfixturevalue("floor"))
    )()
    measurement = measure(loop, ORDER)
    assert measurement.loop == name
    assert measurement.order is ORDER
    assert measurement.lateness.minimum_ns > 0
    assert measurement.as_json()["lateness"]["entries"] == ORDER.cycles
    assert json.dumps(measurement.as_json())


def test_the_floor_skips_what_it_missed(floor):
    grid = LoopOrder(cycle_ns=1, cycles=5, realtime=False)  # no host wakes within a nanosecond
    figures = CLoop(floor).run(grid)
    assert figures.missed >= grid.cycles
    assert figures.lateness.maximum_ns < 100_000_000_000


@pytest.mark.parametrize("realtime", [False, True])
def test_the_empty_project_asks_for_the_rights_it_is_measured_with(tmp_path, realtime):
    project = read_project(write_project(tmp_path, LoopOrder(MS, 1, realtime)))
    assert project.plc.realtime == ("require" if realtime else "off")
    assert (project.plc.tick_ns, project.classes[0].cycle_ns) == (MS, MS)
    assert project.plc.priority == loops.PRIORITY


def test_the_compiler_in_the_environment_comes_first(tmp_path, monkeypatch):
    fake = tmp_path / "fake-cc"
    fake.write_text('#!/bin/sh\nwhile [ "$1" != -o ]; do shift; done\necho made > "$2"\n')
    fake.chmod(0o755)
    monkeypatch.setenv("CC", str(fake))
    binary = compile_floor(tmp_path)
    assert binary is not None
    assert binary.read_text() == "made\n"


def test_without_a_compiler_the_python_loop_is_the_floor(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    assert compile_floor(tmp_path) is None
    assert isinstance(floor_loop(tmp_path), PythonLoop)


def test_a_compiler_that_fails_is_passed_over(tmp_path, monkeypatch):
    monkeypatch.delenv("CC", raising=False)
    assert compile_floor(tmp_path, ["false"]) is None


def test_a_loop_that_fails_is_named_with_what_it_said(tmp_path):
    broken = tmp_path / "broken"
    broken.write_text("#!/bin/sh\necho first words >&2\necho no luck >&2\nexit 4\n")
    broken.chmod(0o755)
    with pytest.raises(MeasurementError, match="the C loop ended with 4: no luck"):
        CLoop(broken).run(ORDER)


def test_a_loop_that_cannot_be_started_is_an_error(tmp_path):
    with pytest.raises(MeasurementError, match=r"the C loop: .*No such file"):
        CLoop(tmp_path / "nothing").run(ORDER)


def test_the_rights_of_a_fresh_process_are_either_given_or_refused():
    rights = probe_rights()
    named = [right for right in (*rights.granted, *rights.refused) if "SCHED_FIFO" in right]
    assert len(named) == 1


def test_a_scan_that_is_refused_its_rights_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(loops, "PRIORITY", 0)  # SCHED_FIFO has none below 1
    with pytest.raises(MeasurementError, match="priority: 0 is outside"):
        ScanLoop(tmp_path).run(LoopOrder(MS, 1, realtime=True))


def test_bare_loops_get_no_priority_without_rights():
    assert LoopOrder(MS, 5, realtime=False).arguments()[:3] == ["1000000", "5", "0"]
    assert LoopOrder(MS, 5, realtime=True).arguments()[2] == str(loops.PRIORITY)


def test_modules_run_with_this_interpreter(monkeypatch):
    seen = []

    def run(command, **_):
        seen.append(command)
        raise OSError("stop here")

    monkeypatch.setattr(loops.subprocess, "run", run)
    with pytest.raises(MeasurementError, match="stop here"):
        PythonLoop().run(ORDER)
    assert seen[0][:4] == [sys.executable, "-P", "-m", "plcsim.doctor.python_loop"]
