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
from plcsim.recorder.bag.files import Ros1Bag
from plcsim.recorder.bag.reindex import reindex
from plcsim.recorder.bag.types import text_message
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


def test_a_bag_of_a_killed_recorder_is_reindexed(ros: Ros, tmp_path: Path) -> None:
    bag = tmp_path / "talker.bag"
    active = tmp_path / "talker.bag.active"
    command = [sys.executable, "-m", "plcsim", "run", str(PROGRAMS / "talker")]
    process = ros.start([*command, "--record", str(bag), "--for", "60s"])
    ros.until(lambda: active.exists() and recovered(active, tmp_path / "early.bag") > 100, 60)
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

    ours = recovered(active, tmp_path / "ours.bag")
    ros.tool("rosbag", "reindex", str(left))
    theirs = ros.tool("rosbag", "info", str(left))
    assert cycles_in(ros.tool("rosbag", "info", str(tmp_path / "ours.bag"))) == cycles_in(theirs)
    assert cycles_in(theirs) > 100
    assert ours > cycles_in(theirs)


def recovered(active: Path, target: Path) -> int:
    """Return how many messages are in complete chunks of a bag that is being written."""
    target.unlink(missing_ok=True)
    return reindex(active, target).messages


def cycles_in(info: str) -> int:
    found = re.search(r"/plcsim/cycles +(\d+) msgs", info)
    return int(found[1]) if found else 0


def test_rosbag_and_we_find_the_same_in_a_bag_that_is_cut(ros: Ros, tmp_path: Path) -> None:
    bag = Ros1Bag(tmp_path / "whole.bag")
    chatter = bag.add("/chatter", "std_msgs/msg/String")
    for number in range(60):
        bag.write(chatter, 10**9 + number, text_message("hello"))
        if number % 10 == 9:
            bag.flush()
    whole = (tmp_path / "whole.bag.active").read_bytes()
    chunks = whole.index(b"op=\x05")
    for part in (0.3, 0.8, 0.97):  # in a chunk, in a chunk, in the index of a chunk
        left, ours = tmp_path / f"left_{part}.bag", tmp_path / f"ours_{part}.bag"
        left.write_bytes(whole[: chunks + int(part * (len(whole) - chunks))])

        count = recovered(left, ours)
        ros.tool("rosbag", "reindex", str(left))
        info = [ros.tool("rosbag", "info", str(each)) for each in (left, ours)]
        found = [int(n) for text in info for n in re.findall(r"/chatter +(\d+) msgs", text)]
        assert found == [count - 10 if part == 0.97 else count, count]  # rosbag wants the index too
    bag.close()


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
