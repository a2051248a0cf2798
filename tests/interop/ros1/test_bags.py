"""Bags both ways: the tools of ROS read and play ours, and we play theirs."""

import os
import re
import shutil
import signal
import sys
import time
from pathlib import Path

import pytest
from pymodbus.client import ModbusTcpClient

from crosnode.testing import Ros as VirtualRos
from plcsim.recorder.bag.reindex import reindex
from plcsim.recorder.bag.ros1_bag import Ros1Bag
from plcsim.recorder.bag.types import text_message
from plcsim.testing import Plc
from plcsim.testing.target import project_target
from tests.ports import free_port

from .rig import PROGRAMS, Ros

pytest.importorskip("rosbags")

one_master = pytest.mark.parametrize("ros", ["plcsim"], indirect=True)
"""For what only rosbag and we do with a file: which master stands by makes no difference."""


def recorded(ros: Ros, tmp_path: Path, seconds: float = 3) -> Path:
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


@one_master
def test_a_bag_of_a_killed_recorder_is_reindexed(ros: Ros, tmp_path: Path) -> None:
    bag = tmp_path / "talker.bag"
    active = tmp_path / "talker.bag.active"
    command = [sys.executable, "-m", "plcsim", "run", str(PROGRAMS / "talker")]
    process = ros.start([*command, "--record", str(bag), "--for", "60s"])
    early = tmp_path / "early.bag"
    ros.until(
        lambda: (
            active.exists()
            and active.stat().st_size > 5_000  # more than the head of a bag
            and recovered(active, early) > 100
            and counts(ros, early).get("/plcsim/cycles", 0) > 100
        )
    )
    for each in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            text = each.read_text()
        except OSError:
            continue
        if "plcsim.recorder" in text and f'"parent": {process._popen.pid}' in text:
            os.kill(int(each.parent.name), signal.SIGKILL)
    ros.until((tmp_path / "talker_1.bag.active").exists)
    left = shutil.copy(active, tmp_path / "left.bag")
    process.kill(signal.SIGINT, patience_s=60)

    ours = recovered(active, tmp_path / "ours.bag")
    ros.tool("rosbag", "reindex", str(left))
    theirs = counts(ros, Path(left))["/plcsim/cycles"]
    assert counts(ros, tmp_path / "ours.bag")["/plcsim/cycles"] == theirs
    assert ours > theirs > 100


def recovered(active: Path, target: Path) -> int:
    """Return how many messages are in complete chunks of a bag that is being written."""
    target.unlink(missing_ok=True)
    return reindex(active, target).messages


@one_master
def test_rosbag_and_we_find_the_same_in_a_bag_that_is_cut(ros: Ros, tmp_path: Path) -> None:
    bag = Ros1Bag(tmp_path / "whole.bag")
    chatter = bag.add("/chatter", "std_msgs/msg/String")
    for number in range(60):
        bag.write(10**9 + number, [(chatter, text_message("hello"))])
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


@pytest.fixture
def theirs(ros: Ros, roscpp: Path, tmp_path: Path) -> Path:
    """Return a bag that rosbag recorded of a roscpp and of a rospy talker."""
    bag = tmp_path / "theirs.bag"
    peers = [ros.start([str(roscpp / "talker")]), ros.rospy("talk", "/words", "")]
    ros.until(lambda: {"/chatter", "/words"} <= set(ros.tool("rostopic", "list").split()))
    ros.tool("rosbag", "record", "-O", str(bag), "--limit=60", "/chatter", "/words")
    for peer in peers:
        peer.kill()
    deadline = time.monotonic() + 100
    while not bag.exists() and time.monotonic() < deadline:
        time.sleep(0.1)
    return bag


def plcsim_replay_plays(ros: Ros, theirs: Path, out: Path, *options: str) -> None:
    """Play the bag by ``plcsim replay``, and repeat what that did."""
    command = [sys.executable, "-m", "plcsim", "replay"]
    listener = str(PROGRAMS / "listener")
    words = [str(theirs), listener, "--record", str(out), "--topic", "/chatter", *options]
    process = ros.start([*command, *words])
    ros.until(lambda: not process.is_running)
    assert counts(ros, out)["/chatter"] == counts(ros, theirs)["/chatter"] > 50, process.text

    again = ros.start([*command, str(out), listener])
    ros.until(lambda: not again.is_running)
    assert "cycles repeated exactly" in again.text


def counts(ros: Ros, bag: Path) -> dict[str, int]:
    """Return how many messages rosbag finds of each topic."""
    found = re.findall(r"(/\S+) +(\d+) msgs", ros.tool("rosbag", "info", str(bag)))
    return {topic: int(count) for topic, count in found}


def test_we_play_what_rosbag_has_recorded(ros: Ros, theirs: Path, tmp_path: Path) -> None:
    plcsim_replay_plays(ros, theirs, tmp_path / "virtual.bag")
    plcsim_replay_plays(ros, theirs, tmp_path / "real.bag", "--real-clock")

    plc = Plc(project_target(PROGRAMS / "listener"))
    network = VirtualRos(plc)
    plc.boot()
    played = network.replay(theirs)
    plc.run("100ms")

    assert played > 50
    assert plc["listener.heard"] == played
    assert plc["listener.word"].startswith("roscpp ")
    plc.close()


ECHO = """
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import STRING, UDINT, UINT, var


class Echo(Program):
    __slots__ = ("node", "words", "back")
    heard = var(UDINT)
    word = var(STRING(40))
    setpoint = var(UINT)
    total = var(UDINT)

    def init(self):
        self.node = create_node(self.context, "echo")
        self.words = self.node.register_subscriber("/words", "std_msgs/String", queue_size=100)
        self.back = self.node.register_publisher("/back", "std_msgs/String")

    def cyclic(self):
        self.node.do_events_loop()
        self.total = (self.total + self.setpoint) & 0xFFFFFFFF
        while (message := self.words.pop()) is not None:
            self.word = message.data
            self.heard += 1
            self.back.send(self.back.new(data=f"{message.data} {self.total}"))

    def exit(self):
        self.node.destroy()
"""


@one_master
def test_a_run_with_modbus_writes_and_a_real_peer_is_repeated(ros: Ros, tmp_path: Path) -> None:
    """On the real clock; PLCSIM_RECORD_S says for how long."""
    seconds = float(os.environ.get("PLCSIM_RECORD_S", "5"))
    project, port, bag = tmp_path / "echo", free_port(), tmp_path / "run.bag"
    (project / "echo").mkdir(parents=True)
    (project / "echo" / "main.py").write_text(ECHO)
    (project / "plc.toml").write_text(
        f'[task_class.1]\ncycle = "2ms"\nprograms = ["echo"]\non_violation = "log"\n'
        f"[modbus]\nport = {port}\n[ros]\n"
    )
    (project / "tags.csv").write_text(
        "tag,area,offset,type\necho.setpoint,hr,0,uint16\necho.heard,hr,1,uint32\n"
    )
    peer = ros.rospy("talk", "/words", "")
    command = [sys.executable, "-m", "plcsim"]
    process = ros.start([*command, "run", str(project), "--record", str(bag)])

    written = heard = 0
    with ModbusTcpClient("127.0.0.1", port=port, retries=0) as client:
        ros.until(client.connect)
        ros.until(lambda: not client.write_register(0, 0).isError())  # the first cycle is done
        end_s = time.monotonic() + seconds
        while time.monotonic() < end_s or heard <= 30 * seconds or written <= 20 * seconds:
            written += not client.write_register(0, written % 1000).isError()
            answer = client.read_holding_registers(1, count=2)
            if not answer.isError():  # it is while the host lets the scan stand still
                high, low = answer.registers
                heard = high << 16 | low
            time.sleep(0.01)
    process.kill(signal.SIGINT, patience_s=60)
    peer.kill()

    again = ros.start([*command, "replay", str(bag), str(project)])
    ros.until(lambda: not again.is_running, 60 + 3 * seconds)
    assert "cycles repeated exactly" in again.text
    found = counts(ros, bag)
    assert found["/back"] > 30 * seconds
