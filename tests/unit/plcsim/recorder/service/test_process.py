"""The recorder, in a process of its own beside a scan on the real clock."""

import os
import re
import resource
import signal
import time
from pathlib import Path
from typing import Any

import pytest

from plcsim.process.supervisor import Supervisor
from plcsim.project.assembly import load
from plcsim.project.plc_toml import read_project
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.reindex import reindex
from plcsim.recorder.bag.types import DIAGNOSTICS, typestore
from plcsim.recorder.replay.replay import Replay

MAIN = """
from plcsim import Program
from st_types import UDINT, var

class Cell(Program):
    count = var(UDINT)

    def cyclic(self):
        self.count += 1
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "cell"
    (folder / "cell").mkdir(parents=True)
    (folder / "cell" / "main.py").write_text(MAIN)
    (folder / "plc.toml").write_text(
        '[plc]\nrealtime = "off"\n[task_class.1]\ncycle = "10ms"\nprograms = ["cell"]\n'
        'on_violation = "log"\n[record]\nfile = "run.bag"\ntags = ["cell.count"]\n'
    )
    return folder


def run(project: Path, look: Any = lambda _: None, for_ns: int = 500_000_000) -> dict[str, Any]:
    with Supervisor(read_project(project), for_ns=for_ns, quiet=True) as supervisor:
        return supervisor.wait(lambda: look(supervisor))


def repeat(project: Path, bag: Path) -> Replay:
    with open_bag(bag) as reader:
        again = Replay(load(read_project(project)), reader.head(), reader.records())
        assert again.run() is None
    return again


def test_a_run_on_the_real_clock_is_repeated_cycle_by_cycle(project: Path) -> None:
    report = run(project)

    again = repeat(project, project / "run.bag")
    (task_class,) = report["task_classes"]
    assert again.cycles == task_class["cycles"] > 0
    assert again.controller.classes[0].missed == task_class["missed_grid_points"]
    assert [f.name for f in project.glob("run*")] == ["run.bag"]


def test_the_timing_at_the_end_is_that_of_the_report(project: Path) -> None:
    (task_class,) = run(project)["task_classes"]

    with open_bag(project / "run.bag") as reader:
        *_, last = reader.messages([DIAGNOSTICS])
    decoded: Any = typestore().deserialize_ros1(last.data, last.type_name)
    values = {each.key: each.value for each in decoded.status[0].values}
    assert int(values["cycles"]) == task_class["cycles"]
    assert int(values["missed grid points"]) == task_class["missed_grid_points"]
    assert int(values["cycle time violations"]) == sum(task_class["violations"].values())


def test_the_bag_of_a_scan_that_was_killed_is_closed(project: Path) -> None:
    killed: list[int] = []

    def kill(supervisor: Supervisor) -> None:
        is_time = supervisor.page.of_class(1).cycles > 60 and supervisor.services.pids
        if is_time and not killed:
            killed.append(supervisor._process.pid)
            os.kill(killed[0], signal.SIGKILL)

    report = run(project, kill, for_ns=60_000_000_000)

    assert report["state"] == "SERVICE"
    assert repeat(project, project / "run.bag").cycles > 50


def test_a_recorder_that_was_killed_is_started_again_and_loses_nothing(project: Path) -> None:
    killed: list[int] = []

    def kill(supervisor: Supervisor) -> None:
        active, next_one = project / "run.bag.active", project / "run_1.bag.active"
        if not killed and active.exists() and active.stat().st_size > 10_000:
            killed.extend(supervisor.services.pids)
            os.kill(killed[0], signal.SIGKILL)
        if killed and next_one.exists() and not supervisor.is_asked_to_stop:
            supervisor.stop()

    report = run(project, kill, for_ns=200_000_000_000)

    assert len(killed) == 1
    (task_class,) = report["task_classes"]
    assert repeat(project, project / "run_1.bag").cycles == task_class["cycles"]
    assert (project / "run.bag.active").stat().st_size > 10_000


def test_a_disk_that_is_full_ends_a_file_and_not_the_scan(
    project: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    main, toml = project / "cell" / "main.py", project / "plc.toml"
    main.write_text(MAIN.replace("var(UDINT)\n", "var(UDINT)\n    large = var(STRING(8000))\n")
                    .replace("import UDINT", "import STRING, UDINT"))  # fmt: skip
    toml.write_text(toml.read_text() + 'buffer = "64KiB"\n')  # 8 cycles: the rest is lost
    left = project / "run.bag.active"
    full: list[int] = []
    looks: list[int] = []

    def fill(supervisor: Supervisor) -> None:
        size = left.stat().st_size if left.exists() else 0
        if not full and size > 5_000 and has_messages(left):  # more than the head of a bag
            (pid,) = supervisor.services.pids
            full.append(size + 10_000)
            resource.prlimit(pid, resource.RLIMIT_FSIZE, (full[0], full[0]))
        (recorder,) = supervisor.services._services
        if full and recorder.starts == 1 and recorder._process is None:
            outlast(supervisor, 50)  # more cycles than the buffer holds, before it starts again
        after = project / "run_1.bag.active"
        if after.exists() and after.stat().st_size > 10_000 and not looks:
            looks.append(supervisor.page.of_class(1).cycles)
            supervisor.stop()

    report = run(project, fill, for_ns=100_000_000_000)

    assert looks
    told = capfd.readouterr().err
    assert "run.bag: cannot be written: [Errno 27] File too large" in told
    assert f"plcsim bag reindex {left} makes readable what is there" in told
    assert re.search(r"record: \d+ records are lost", told)
    assert has_messages(left)
    before, after = (cycles_in(project / name) for name in ("left.bag", "run_1.bag"))
    (task_class,) = report["task_classes"]
    assert before
    assert after[0] > before[-1] + 1
    assert after[-1] == task_class["cycles"] >= looks[0] > 0


def outlast(supervisor: Supervisor, count: int) -> None:
    """Wait until the scan has done some more cycles."""
    cycles = supervisor.page.of_class(1).cycles + count
    while supervisor.page.of_class(1).cycles < cycles:
        time.sleep(0.005)  # the scan tells by its status page only


def has_messages(left: Path) -> bool:
    """Make a bag of what can be read of one that was left; return whether that is anything."""
    target = left.with_name("left.bag")
    target.unlink(missing_ok=True)
    return reindex(left, target).messages > 0


def cycles_in(bag: Path) -> list[int]:
    """Return the numbers of the cycles in a bag."""
    with open_bag(bag) as reader:
        return [each.cycle for _, each in reader.records() if not each.step]
