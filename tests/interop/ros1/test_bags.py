"""Bags both ways: the tools of ROS read and play ours, and we play theirs."""

import os
import re
import shutil
import signal
import sys
import time
from pathlib import Path

import pytest

from crosnode.testing import Ros as VirtualRos
from plcsim.testing import Plc
from plcsim.testing.target import project_target

from .rig import PROGRAMS, Ros

pytest.importorskip("rosbags")


def recorded(ros: Ros, tmp_path: Path, seconds: float = 6) -> Path:
    """Run our talker with a recorder beside it; return the bag."""
    bag = tmp_path / "talker.bag"
    project = Path(shutil.copytree(PROGRAMS / "talker", tmp_path / "project"))
    with (project / "plc.toml").open("a") as file:
        file.write('[record]\ntags = ["talker"]\n')
    command = [sys.executable, "-m", "plcsim", "run", str(project)]
    process = ros.start([*command, "--record", str(bag), "--for", f"{seconds}s"])
    ros.until(lambda: not process.is_running, seconds + 60)
    return bag


def test_rosbag_reads_and_plays_our_bag(ros: Ros, tmp_path: Path) -> None:
    bag = recorded(ros, tmp_path)

    info = ros.tool("rosbag", "info", str(bag))
    assert re.search(r"/chatter +\d+ msgs +: prova/hello", info), info
    assert re.search(r"/plcsim/cycles +\d+ msgs +: plcsim_msgs/Cycle", info)
    check = ros.tool("rosbag", "check", str(bag))
    assert "Traceback" not in check
    peer = ros.rospy("listen", "/talker/word")
    ros.until(lambda: "/talker/word" in ros.tool("rostopic", "list"))
    ros.tool("rosbag", "play", "--wait-for-subscribers", "--topics", "/talker/word",
             "--bags", str(bag), seconds=40)  # fmt: skip
    ros.until(lambda: "heard Hello world!!!" in peer.text)


def test_rosbag_reindexes_the_bag_of_a_killed_recorder(ros: Ros, tmp_path: Path) -> None:
    bag = tmp_path / "talker.bag"
    active = tmp_path / "talker.bag.active"
    command = [sys.executable, "-m", "plcsim", "run", str(PROGRAMS / "talker")]
    process = ros.start([*command, "--record", str(bag), "--for", "60s"])
    ros.until(lambda: active.exists() and active.stat().st_size > 20_000, 60)
    for each in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            text = each.read_text()
        except OSError:
            continue
        if "plcsim.recorder" in text and f'"parent": {process._popen.pid}' in text:
            os.kill(int(each.parent.name), signal.SIGKILL)
    ros.until((tmp_path / "talker_1.bag.active").exists, 60)
    left = shutil.copy(active, tmp_path / "left.bag")
    process.kill(signal.SIGINT, patience_s=60)

    ros.tool("rosbag", "reindex", str(left))
    found = re.search(r"/plcsim/cycles +(\d+) msgs", ros.tool("rosbag", "info", str(left)))
    assert found is not None
    assert int(found[1]) > 100


def test_we_play_what_rosbag_has_recorded(ros: Ros, roscpp: Path, tmp_path: Path) -> None:
    bag = tmp_path / "theirs.bag"
    peer = ros.start([str(roscpp / "talker")])
    ros.until(lambda: "/chatter" in ros.tool("rostopic", "list"))
    ros.tool("rosbag", "record", "-O", str(bag), "--duration=3", "/chatter", seconds=30)
    peer.kill()
    deadline = time.monotonic() + 10
    while not bag.exists() and time.monotonic() < deadline:
        time.sleep(0.1)

    plc = Plc(project_target(PROGRAMS / "listener"))
    network = VirtualRos(plc)
    plc.boot()
    played = network.replay(bag)
    plc.run("100ms")

    assert played > 50
    assert plc["listener.heard"] == played
    assert plc["listener.word"].startswith("roscpp ")
    plc.close()
