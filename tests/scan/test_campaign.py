"""``plcsim campaign`` as a person runs it: on this machine, interrupted, on a cluster of Dask."""

import json
import os
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest

for package in ("distributed", "matplotlib", "pyarrow", "scipy"):
    pytest.importorskip(package, reason="the extra campaign is not installed")

from pyarrow import parquet  # noqa: E402  # where it is installed

PROGRAM = """
    import os
    from plcsim import Program
    from st_types import DINT, REAL, var

    class Ramp(Program):
        step = var(REAL, 1.0)
        value = var(REAL)
        trouble = var(DINT)

        def cyclic(self):
            self.value += self.step
            if self.trouble == 1:
                os._exit(7)
            if self.trouble == 2:
                os.system("sleep 60")
"""
CAMPAIGN = """
    import time
    from pathlib import Path
    from plcsim.campaign import *

    SLOW = Path("SLOW_FILE")
    campaign = Campaign(
        variables={
            "ramp.step": Uniform(0, 10), "ramp.trouble": Choice(*TROUBLE), "pause": Choice(PAUSE)
        },
        sampling=Random(RUNS),
        require=[Always("stays below 500", lambda plc: 500 - plc["ramp.value"])],
        measure=[Final("ramp.value")],
        time_limit="LIMIT",
    )

    @campaign.scenario
    def run(plc, values):
        if SLOW.exists():
            time.sleep(values["pause"])  # a slow run is what the test needs
        plc.faults.noise("ramp.value", 0.5)
        plc.run("1s")
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Give the folder of a project with a campaign."""
    (tmp_path / "ramp").mkdir()
    (tmp_path / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["ramp"]\n')
    (tmp_path / "ramp" / "main.py").write_text(textwrap.dedent(PROGRAM))
    return tmp_path


def slow_file(folder: Path) -> Path:
    """Return the file while which is there runs pause; it is no part of the project."""
    return folder.with_name(f"{folder.name}-slow")


def write(
    folder: Path, runs: int, pause: float = 0, trouble: str = "0,", limit: str = "100s"
) -> None:
    text = textwrap.dedent(CAMPAIGN).replace("RUNS", str(runs)).replace("PAUSE", str(pause))
    text = text.replace("LIMIT", limit).replace("SLOW_FILE", str(slow_file(folder)))
    slow_file(folder).touch()
    (folder / "ramps.py").write_text(text.replace("TROUBLE", f"({trouble})"))


def command(*words: str) -> list[str]:
    return [sys.executable, "-m", "plcsim", "campaign", *words]


def plcsim(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command(*words), cwd=folder, capture_output=True, text=True, timeout=300, check=False
    )


def table(folder: Path, name: str = "ramps.results") -> list[dict[str, object]]:
    """Return what came of the runs, without what the host has to do with."""
    rows = parquet.read_table(folder / name / "results.parquet").to_pylist()
    return [{key: cell for key, cell in row.items() if key != "host_s"} for row in rows]


def test_a_campaign_from_first_to_last(folder: Path) -> None:
    write(folder, 30)
    done = plcsim(folder, "ramps.py")
    assert done.returncode == 1, done.stderr
    assert "30 runs: " in done.stdout
    assert "stays below 500" in done.stdout
    assert (folder / "ramps.results" / "picture.png").read_bytes().startswith(b"\x89PNG")
    first = next(row for row in table(folder) if row["outcome"] == "failed")
    again = plcsim(folder, "repeat", "ramps.py", str(first["number"]))
    assert again.returncode == 1
    assert f"failed: {first['message']}" in again.stdout
    assert "plcsim campaign repeat ramps.py --set ramp.step=" in done.stdout
    pytest.importorskip("rosbags", reason="the extra record is not installed")
    plcsim(folder, "repeat", "ramps.py", str(first["number"]), "--bag", "failure.bag")
    assert (folder / "failure.bag").read_bytes().startswith(b"#ROSBAG")
    assert "30 runs are done already" in plcsim(folder, "ramps.py").stdout
    shown = plcsim(folder, "show", "ramps.py")
    assert (shown.returncode, "smaller" in shown.stderr) == (1, False)
    assert done.stdout.splitlines()[-5:] == shown.stdout.splitlines()[-5:]


def test_runs_that_crash_or_hang_cost_nothing_but_themselves(folder: Path) -> None:
    write(folder, 12, trouble="2, 0, 1, 0, 1", limit="20s")
    done = plcsim(folder, "ramps.py", "--no-shrink")
    rows = table(folder)
    assert len(rows) == 12, done.stderr
    # what does not hang has the time that a process on a busy host takes for its first run
    outcomes = {0: {"passed", "failed"}, 1: {"crashed"}, 2: {"hung"}}
    assert {row["value ramp.trouble"] for row in rows} == {0, 1, 2}
    for row in rows:
        assert row["outcome"] in outcomes[int(str(row["value ramp.trouble"]))]
    assert "its process ended: exit code 7" in done.stdout
    assert "took longer than 20 s" in done.stdout


def test_an_interrupted_campaign_goes_on_where_it_was(folder: Path) -> None:
    write(folder, 150, pause=0.2)
    running = subprocess.Popen(
        command("ramps.py"), cwd=folder, stdout=subprocess.PIPE, text=True, start_new_session=True
    )
    wait_for(lambda: list((folder / "ramps.results").glob("part-*.parquet")))
    os.killpg(running.pid, signal.SIGINT)
    assert "the same command goes on from here" in running.communicate(timeout=200)[0]
    assert running.returncode == 130
    slow_file(folder).unlink()
    done = plcsim(folder, "ramps.py")
    assert "runs are done already" in done.stdout
    rows = table(folder)
    assert [row["number"] for row in rows] == list(range(150))
    whole = plcsim(folder, "ramps.py", "-o", "whole")
    assert "done already" not in whole.stdout
    assert table(folder, "whole") == rows


def test_a_cluster_gives_the_same_results_whatever_dies(folder: Path) -> None:
    write(folder, 60, pause=0.05)
    plcsim(folder, "ramps.py", "-o", "here", "--no-shrink")
    with Cluster(folder) as cluster:
        running = subprocess.Popen(
            command("ramps.py", "--no-shrink", "--scheduler", cluster.address),
            cwd=folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        wait_for(lambda: list((folder / "ramps.results").glob("part-*.parquet")))
        cluster.workers[0].kill()
        output = running.communicate(timeout=240)[0]
    assert running.returncode == 1, output
    assert table(folder) == table(folder, "here")


def test_a_scheduler_that_is_not_there_is_told(folder: Path) -> None:
    write(folder, 2)
    done = plcsim(folder, "ramps.py", "--scheduler", "tcp://127.0.0.1:1")
    assert done.returncode == 1
    assert "plcsim: --scheduler tcp://127.0.0.1:1: cannot be reached" in done.stderr
    assert "Traceback" not in done.stderr


def wait_for(condition) -> None:
    """Wait until a condition holds, two minutes at most."""
    for _ in range(1200):
        if condition():
            return
        time.sleep(0.1)
    raise AssertionError("it did not happen")


class Cluster:
    """A scheduler of Dask and two workers, processes of their own."""

    def __init__(self, folder: Path) -> None:
        self._file = folder / "scheduler.json"

    def __enter__(self) -> "Cluster":
        self.scheduler = self._start(
            "scheduler",
            "--host",
            "127.0.0.1",
            "--port",
            "0",
            "--no-dashboard",
            "--scheduler-file",
            str(self._file),
        )
        wait_for(self._address)
        self.address = self._address()
        self.workers = [
            self._start(
                "worker",
                self.address,
                "--nthreads",
                "1",
                "--no-nanny",
                "--no-dashboard",
                "--local-directory",
                str(self._file.parent / f"worker{n}"),
            )
            for n in range(2)
        ]
        return self

    def _address(self) -> str:
        """Return where the scheduler is, "" before it has written that to the end."""
        try:
            return str(json.loads(self._file.read_text())["address"])
        except (OSError, ValueError):
            return ""

    def _start(self, *words: str) -> subprocess.Popen[bytes]:
        return subprocess.Popen(
            [sys.executable, "-m", "distributed.cli.dask_" + words[0], *words[1:]],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def __exit__(self, *_: object) -> None:
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()
