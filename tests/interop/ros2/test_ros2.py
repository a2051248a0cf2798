"""The bridge of [ros2] and a process that speaks to it by Cyclone DDS alone."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

pytest.importorskip("cyclonedds", reason="plcsim[ros2] is not installed")

HERE = Path(__file__).parent
PLCSIM = [sys.executable, "-m", "plcsim.cli.main"]
PROJECT = """
[task_class.1]
cycle = "10ms"
programs = ["tank"]

[ros2]
domain = {domain}

[ros2.publish."/tank/level"]
tag = "tank.level"
type = "std_msgs/Float64"
every = "20ms"
status = "tank.heard"

[ros2.publish."/tank/stamped"]
tag = "tank.place"
type = "geometry_msgs/PointStamped"
on_change = true

[ros2.subscribe."/tank/setpoint"]
tag = "tank.setpoint"
type = "std_msgs/Float32"
timeout = "500ms"
status = "tank.quality"
age = "tank.age"
"""
TANK = """
from plcsim import Program
from st_types import INT, LREAL, REAL, Struct, TIME, var


class Point(Struct):
    x = var(LREAL)


class Place(Struct):
    point = var(Point)


class Tank(Program):
    level = var(LREAL, 2.5)
    setpoint = var(REAL)
    place = var(Place)
    quality = var(INT)
    heard = var(INT)
    age = var(TIME)

    def cyclic(self):
        self.place.point.x = self.setpoint * 2
"""


class Site:
    """A project that runs, and peers."""

    def __init__(self, folder: Path) -> None:
        self.domain = 100 + os.getpid() % 100
        self.folder = folder / "tank"
        (self.folder / "tank").mkdir(parents=True)
        (self.folder / "plc.toml").write_text(PROJECT.format(domain=self.domain))
        (self.folder / "tank" / "main.py").write_text(TANK)
        self.log = folder / "run.log"
        self.processes: list[subprocess.Popen[bytes]] = []
        self.start([*PLCSIM, "run", str(self.folder)], self.log)

    def start(self, command: list[str], log: Path) -> subprocess.Popen[bytes]:
        with log.open("wb") as file:
            self.processes.append(subprocess.Popen(command, stdout=file, stderr=file))
        return self.processes[-1]

    def peer(self) -> tuple[subprocess.Popen[bytes], Path]:
        log = self.folder / "peer.log"
        command = [sys.executable, str(HERE / "ros2_peer.py"), str(self.domain)]
        return self.start(command, log), log

    def tag(self, path: str) -> str:
        command = [*PLCSIM, "watch", str(self.folder), path, "--once"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        return next((line.split()[1] for line in done.stdout.splitlines() if path in line), "")

    def until(self, condition: Callable[[], object], seconds: float = 100) -> None:
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, self.log.read_text()
            time.sleep(0.1)


@pytest.fixture
def site(tmp_path: Path) -> Iterator[Site]:
    found = Site(tmp_path)
    yield found
    for process in reversed(found.processes):
        process.send_signal(signal.SIGINT)
        process.wait(100)


def test_topics_go_out_and_in_and_tell_how_good_they_are(site: Site) -> None:
    site.until(lambda: "1 in" in site.log.read_text())
    peer, log = site.peer()
    site.until(lambda: "level 2.5" in log.read_text())
    site.until(lambda: "stamped 6.5 True" in log.read_text())
    for tag, value in (("setpoint", "3.25"), ("quality", "1"), ("heard", "1")):
        site.until(lambda tag=tag, value=value: site.tag(f"tank.{tag}") == value)
    peer.send_signal(signal.SIGKILL)
    peer.wait()
    site.until(lambda: site.tag("tank.quality") == "2")
    assert site.tag("tank.setpoint") == "3.25"
