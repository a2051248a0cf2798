"""Bags that are played to the programs under test."""

import hashlib
import struct
from pathlib import Path

import pytest
from rosbags.rosbag1 import Writer

from crosnode.plc.project import create_node
from crosnode.testing import Ros
from plcsim import Program
from plcsim.recorder.bag.files import create
from plcsim.recorder.bag.types import text_message
from plcsim.testing import Plc, PlcTestError
from plcsim.testing.target import program_target
from st_types import STRING, UDINT, var

TEXT = "std_msgs/msg/String"
MS = 1_000_000


class Cell(Program):
    """Hears words on /in, and notes when."""

    __slots__ = ("into", "node")
    heard = var(STRING(20))
    count = var(UDINT)
    at = var(UDINT)

    def init(self) -> None:
        self.node = create_node(self.context, "cell")
        self.into = self.node.register_subscriber("/in", "std_msgs/String")

    def cyclic(self) -> None:
        self.node.do_events_loop()
        if (message := self.into.pop()) is not None:
            self.heard = message.data
            self.count += 1
            self.at = self.context.release_ns // MS

    def exit(self) -> None:
        self.node.destroy()


def write(path: Path, *times_ms: int, topic: str = "/in") -> Path:
    bag = create(path)
    into = bag.add(topic, TEXT)
    for number, time_ms in enumerate(times_ms):
        bag.write((1000 + time_ms) * MS, [(into, text_message(f"word {number}"))])
    bag.close()
    return path


@pytest.fixture
def plc():
    plc = Plc(program_target([Cell]))
    ros = Ros(plc)
    plc.boot()
    plc.ros = ros
    yield plc
    plc.close()


@pytest.mark.parametrize("name", ["a.bag", "a.mcap"])
def test_messages_come_at_their_times(plc: Plc, tmp_path: Path, name: str) -> None:
    bag = write(tmp_path / name, 0, 100, 250)
    seen = []

    def note() -> None:
        if plc["Cell.count"] and (not seen or seen[-1][0] != plc["Cell.count"]):
            seen.append((plc["Cell.count"], plc["Cell.at"], plc["Cell.heard"]))

    plc.after_cycle.append(note)

    assert plc.ros.replay(bag) == 3
    plc.cycles(3)

    assert [word for _, _, word in seen] == ["word 0", "word 1", "word 2"]
    first = seen[0][1]
    assert [at - first for _, at, _ in seen] == [0, 100, 250]


def test_a_topic_that_the_bag_does_not_have_is_told(plc: Plc, tmp_path: Path) -> None:
    with pytest.raises(PlcTestError, match="has no topic /other"):
        plc.ros.replay(write(tmp_path / "a.bag", 0), ["/other"])


def test_a_damaged_bag_is_told(plc: Plc, tmp_path: Path) -> None:
    (tmp_path / "a.bag").write_bytes(b"#ROSBAG V2.0\n" + bytes(100))

    with pytest.raises(PlcTestError, match=r"a\.bag"):
        plc.ros.replay(tmp_path / "a.bag")


def of_another_type(path: Path, definition: str) -> Path:
    """Write a bag with a message of a type that the project does not know."""
    with Writer(path) as writer:
        load = writer.add_connection(
            "/load", "cell_msgs/msg/Load", msgdef=definition, md5sum="1" * 32
        )
        writer.write(load, 1, struct.pack("<f", 1.5))
    return path


def test_a_type_that_is_not_known_is_the_one_of_the_bag(plc: Plc, tmp_path: Path) -> None:
    bag = of_another_type(tmp_path / "a.bag", "float32 kg  # of the load\n")

    with pytest.raises(PlcTestError, match=r"cell_msgs/Load has the MD5 sum 1{32} in") as told:
        plc.ros.replay(bag, ["/load"])
    assert hashlib.md5(b"float32 kg").hexdigest() in str(told.value)


@pytest.mark.parametrize("definition", ["other_msgs/Part part\n", "float32\n"])
def test_a_type_that_the_bag_does_not_describe_is_told(
    plc: Plc, tmp_path: Path, definition: str
) -> None:
    bag = of_another_type(tmp_path / "a.bag", definition)

    with pytest.raises(PlcTestError, match=r"a\.bag: .*(other_msgs/Part|cell_msgs/Load)"):
        plc.ros.replay(bag, ["/load"])
