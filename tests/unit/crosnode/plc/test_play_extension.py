"""Bags of others that are played to a project on the virtual clock."""

import struct
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from crosnode.plc import playback
from crosnode.plc.extension import EXTENSION as ROS
from crosnode.plc.play_extension import EXTENSION as PLAY
from crosnode.plc.project import create_node
from plcsim import Program
from plcsim.cli.main import main
from plcsim.core.clock import VirtualClock
from plcsim.core.controller import Controller
from plcsim.core.logbook import Entry
from plcsim.network import VirtualNetwork
from plcsim.project.assembly import VIRTUAL_IP, Application, assemble
from plcsim.recorder.bag.files import create
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.types import text_message
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.replay.replay import Replay
from plcsim.recorder.settings import RecordProject, RecordSettings
from plcsim.settings.table import Table
from plcsim.testing.target import program_target
from st_types import STRING, UDINT, ULINT, var

MS = 1_000_000


class Hears(Program):
    """Counts words on /in, and notes ROS time."""

    __slots__ = ("into", "node")
    heard = var(STRING(20))
    count = var(UDINT)
    at = var(UDINT)
    ros_time = var(ULINT)

    def init(self) -> None:
        self.node = create_node(self.context, "hears")
        self.into = self.node.register_subscriber("/in", "std_msgs/String")

    def cyclic(self) -> None:
        self.node.do_events_loop()
        self.ros_time = self.node.now_ns
        while (message := self.into.pop()) is not None:
            self.heard = message.data
            self.count += 1
            self.at = self.context.release_ns // MS

    def exit(self) -> None:
        self.node.destroy()


def write(path: Path, *times_ms: int, topic: str = "/in", data: bytes = b"") -> Path:
    bag = create(path)
    into = bag.add(topic, "std_msgs/msg/String")
    for number, time_ms in enumerate(times_ms):
        bag.write((50_000 + time_ms) * MS, [(into, data or text_message(f"word {number}"))])
    bag.close()
    return path


class Play:
    """Runs `Hears` on the virtual clock beside a bag; keeps values of each cycle."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.seen: list[tuple[int, int, int]] = []
        self.told: list[str] = []
        self.record: RecordProject | None = None

    def _note(self, entry: Entry) -> None:
        if entry.source == "play":
            self.told.append(entry.text)

    def application(self, bag: Path, ros: dict[str, Any], **keys: Any) -> Application:
        file = self.folder / "plc.toml"
        play = PLAY.read(Table(file, "ros_play", {"bag": bag.name, **keys}))
        extensions = {"ros": ROS.read(Table(file, "ros", ros)), "ros_play": play}
        if self.record is not None:
            extensions["record"] = self.record
        order = dict(sorted(extensions.items()))
        made = replace(program_target([Hears]), extensions=order)
        return made.in_process(VIRTUAL_IP)

    def __call__(self, bag: Path, ros: dict[str, Any] | None = None, **keys: Any) -> Controller:
        clock = VirtualClock()
        network = VirtualNetwork(clock.now_ns).host(VIRTUAL_IP)
        controller = assemble(
            self.application(bag, ros or {}, **keys), clock=clock, network=network
        )
        tags = [controller.tags.find(f"Hears.{name}") for name in ("count", "at", "ros_time")]
        controller.image.watchers.append(
            lambda _: self.seen.append(tuple(map(controller.tags.read, tags)))
        )
        controller.logbook.follow(self._note)
        controller.boot()
        controller.start()
        controller.run(cycles=5000)
        controller.shutdown()
        controller.close()
        return controller


@pytest.fixture
def play(tmp_path: Path) -> Play:
    return Play(tmp_path)


@pytest.mark.parametrize("ros", [{}, {"master": "embedded"}])
@pytest.mark.parametrize("name", ["a.bag", "a.mcap"])
def test_programs_hear_messages_at_their_times(play: Play, name: str, ros: dict[str, Any]) -> None:
    play(write(play.folder / name, 0, 100, 250), ros)

    times = [next(at for count, at, _ in play.seen if count == n) for n in (1, 2, 3)]
    assert [each - times[0] for each in times] == [0, 100, 250]
    assert play.told == [f"plays {name}: 250 ms, /in", f"3 messages of {name}"]
    assert len(play.seen) < 200  # the run ends with the bag


HEARS = """
from crosnode.plc.project import create_node
from plcsim import Program
from st_types import UDINT, var

class Hears(Program):
    __slots__ = ("into", "node")
    count = var(UDINT)

    def init(self):
        self.node = create_node(self.context, "hears")
        self.into = self.node.register_subscriber("/in", "std_msgs/String")

    def cyclic(self):
        self.node.do_events_loop()
        while self.into.pop() is not None:
            self.count += 1
"""


def test_plcsim_replay_plays_and_records(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    project = tmp_path / "hears"
    (project / "hears").mkdir(parents=True)
    (project / "hears" / "main.py").write_text(HEARS)
    (project / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["hears"]\n')
    bag, out = write(tmp_path / "field.bag", 0, 100), tmp_path / "out.bag"

    assert main(["replay", str(bag), str(project), "--record", str(out)]) == 0
    assert main(["bag", "export", str(out), "hears.count"]) == 0
    assert capfd.readouterr().out.splitlines()[-1].endswith(",2")


def test_ros_time_is_that_of_the_bag(play: Play) -> None:
    play(write(play.folder / "a.bag", 0, 500), clock=True)

    first = next(time for count, _, time in play.seen if count == 1)
    last = next(time for count, _, time in play.seen if count == 2)
    assert first == pytest.approx(50_000 * MS, abs=30 * MS)
    assert last - first == pytest.approx(500 * MS, abs=20 * MS)


def test_a_bag_that_nobody_listens_to_is_told(play: Play, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(playback, "PATIENCE_NS", 1000 * MS)
    play(write(play.folder / "a.bag", 0, topic="/other"))

    (text,) = play.told
    assert text.endswith("a.bag: nobody subscribes to any of its topics: /other")


def test_a_bag_of_another_type_is_told(play: Play, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(playback, "PATIENCE_NS", 1000 * MS)
    bag = create(play.folder / "a.bag")
    bag.write(50_000 * MS, [(bag.add("/in", "std_msgs/msg/UInt32"), b"\1\0\0\0")])
    bag.close()
    play(play.folder / "a.bag")

    (text,) = play.told
    assert text.endswith(
        "a.bag: subscribers do not take /in (std_msgs/UInt32); is the type of the bag theirs?"
    )
    assert len(play.seen) < 500  # the run does not wait for ever


def test_a_long_bag_has_progress(play: Play, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(playback, "LONG_NS", 1000 * MS)
    play(write(play.folder / "a.bag", 0, 1000))

    assert [text for text in play.told if "%" in text][:2] == [
        "10 % of a.bag, 1 messages",
        "20 % of a.bag, 1 messages",
    ]


@pytest.mark.parametrize("change", [None, b"\xff\xff\0\0hello"])
def test_what_was_played_is_repeated_exactly(play: Play, change: bytes | None) -> None:
    play.record = RecordProject(RecordSettings(file="out.bag"), play.folder, is_in_process=True)
    bag = write(play.folder / "a.bag", 0, 100, 250, data=change or b"")
    play(bag)

    play.record = None
    application = play.application(bag, {})
    extensions = {k: v for k, v in application.extensions.items() if k != "ros_play"}
    with open_bag(play.folder / "out.bag") as reader:
        again = Replay(replace(application, extensions=extensions), reader.head(), reader.records())
        assert again.run() is None
    assert again.cycles == len(play.seen)
    count = again.controller.tags.find("Hears.count")
    assert again.controller.tags.read(count) == (0 if change else 3)


def test_a_bag_that_is_not_there_is_told_before_the_run(play: Play) -> None:
    with pytest.raises(RecordingError, match=r"b\.bag: there is no such file"):
        play(play.folder / "b.bag")


Cut = Callable[[bytes], bytes]


@pytest.mark.parametrize("cut", [lambda data: data[:-100], lambda data: data[:4300]])
def test_a_damaged_bag_ends_the_run_with_its_reason(play: Play, cut: Cut) -> None:
    bag = write(play.folder / "a.bag", 0, 100)
    bag.write_bytes(cut(bag.read_bytes()))

    with pytest.raises(RecordingError, match=r"a\.bag"):
        play(bag)


def test_a_type_that_is_another_one_here_is_told_with_both_sums(play: Play) -> None:
    from rosbags.rosbag1 import Writer

    with Writer(play.folder / "a.bag") as writer:
        theirs = writer.add_connection(
            "/in", "std_msgs/msg/String", msgdef="uint8 data\n", md5sum="0" * 32
        )
        writer.write(theirs, 1, struct.pack("<B", 1))

    play(play.folder / "a.bag")

    (text,) = play.told
    assert "/in: std_msgs/String has the MD5 sum 00000000000000000000000000000000 in" in text
    assert "992ce8a1687cec8c8bd883ec73ca41d1 here" in text
