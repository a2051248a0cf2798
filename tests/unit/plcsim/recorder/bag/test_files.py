import hashlib
import resource
import tracemalloc
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from rosbags.rosbag1 import Reader

from plcsim.recorder.bag.files import create
from plcsim.recorder.bag.names import ACTIVE
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.reindex import reindex
from plcsim.recorder.bag.ros1_bag import Ros1Bag
from plcsim.recorder.bag.types import text_message
from plcsim.recorder.errors import RecordingError

TEXT = "std_msgs/msg/String"


def write(path: Path, count: int = 3) -> None:
    bag = create(path)
    chatter = bag.add("/chatter", TEXT, latching=True)
    for number in range(count):
        bag.write(1_000_000_000 + number, [(chatter, text_message(f"hello {number}"))])
    bag.close()


@pytest.mark.parametrize("name", ["a.bag", "a.mcap", "a.db3"])
def test_what_is_written_is_read_again(tmp_path: Path, name: str) -> None:
    write(tmp_path / name)

    with open_bag(tmp_path / name) as bag:
        messages = list(bag.messages())
    assert [each.as_ros1 for each in messages] == [text_message(f"hello {n}") for n in range(3)]
    assert [each.time_ns for each in messages] == [1_000_000_000 + n for n in range(3)]
    assert [(t.name, t.type_name, t.messages) for t in bag.topics] == [("/chatter", TEXT, 3)]
    assert [file.name for file in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("name", ["a.bag", "a.mcap", "a.db3"])
def test_the_same_messages_make_the_same_file(tmp_path: Path, name: str) -> None:
    digests = set()
    for folder in ("one", "two"):
        write(tmp_path / folder / name)
        digests.add(hashlib.sha256((tmp_path / folder / name).read_bytes()).digest())

    assert len(digests) == 1


def test_the_first_record_has_the_size_it_has_with_ros(tmp_path: Path) -> None:
    """rosbag's bag.cpp and bag.py: header and padding are 4096 bytes, beside their two lengths."""
    write(tmp_path / "a.bag")

    data = (tmp_path / "a.bag").read_bytes()
    header = int.from_bytes(data[13:17], "little")
    padding = int.from_bytes(data[17 + header : 21 + header], "little")
    assert header + padding == 4096
    assert data[21 + header :][:padding] == b" " * padding
    assert b"op=\x05" in data[21 + header + padding :][:40]  # a chunk


def test_a_bag_that_was_not_closed_is_all_but_indexed(tmp_path: Path) -> None:
    bag = Ros1Bag(tmp_path / "a.bag")
    bag.write(1, [(bag.add("/chatter", TEXT), text_message("hello"))])
    bag.flush()

    assert b"hello" in (tmp_path / f"a.bag{ACTIVE}").read_bytes()
    with (
        pytest.raises(RecordingError, match=r"was not closed: plcsim bag reindex .*a\.bag\.active"),
        open_bag(tmp_path / "a.bag"),
    ):
        pass
    bag.close()


def test_the_memory_does_not_grow_with_the_messages(tmp_path: Path) -> None:
    bag = Ros1Bag(tmp_path / "a.bag", chunk_size=1000)
    chatter = bag.add("/chatter", TEXT)

    def fill(count: int) -> None:
        for number in range(count):
            bag.write(number + 1, [(chatter, text_message("hello world"))])

    tracemalloc.start()
    fill(500)
    before, _ = tracemalloc.get_traced_memory()
    fill(2500)
    after, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    bag.close()

    assert after - before < 4000  # 200 chunks more; one is open
    with open_bag(tmp_path / "a.bag") as reader:
        assert sum(1 for _ in reader.messages()) == 3000


def test_rows_are_messages_as_any_others(tmp_path: Path) -> None:
    rows = np.arange(24, dtype=np.uint8).reshape(3, 8)
    for name in ("rows.bag", "one.bag"):
        bag = Ros1Bag(tmp_path / name)
        numbers = [bag.add(f"/n{n}", "std_msgs/msg/Float64") for n in range(4)][1:]
        if name == "rows.bag":
            bag.write_rows(10**9 + 5, numbers, rows)
        else:
            bag.write(10**9 + 5, [(n, bytes(row)) for n, row in zip(numbers, rows, strict=True)])
        bag.close()

    assert (tmp_path / "rows.bag").read_bytes() == (tmp_path / "one.bag").read_bytes()
    with Reader(tmp_path / "rows.bag") as reader:
        found = [(c.topic, time_ns, data) for c, time_ns, data in reader.messages()]
    assert sorted(found) == [(f"/n{n + 1}", 10**9 + 5, bytes(rows[n])) for n in range(3)]


def test_a_file_that_is_there_is_not_written_over(tmp_path: Path) -> None:
    (tmp_path / "a.bag").write_text("mine")

    with pytest.raises(RecordingError, match="exists already"):
        create(tmp_path / "a.bag")
    assert (tmp_path / "a.bag").read_text() == "mine"


def test_other_endings_are_refused(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match=r"ends in \.bag"):
        create(tmp_path / "a.txt")


@pytest.mark.parametrize("name", ["a.bag", "a.mcap"])
def test_what_is_in_a_bag_stays_readable_when_the_disk_is_full(tmp_path: Path, name: str) -> None:
    bag = create(tmp_path / name)
    chatter = bag.add("/chatter", TEXT)

    def fill() -> None:
        for number in range(1000):
            for _ in range(10):
                bag.write(number + 1, [(chatter, text_message("hello " * 100))])
            bag.flush()

    with full_disk(60_000), pytest.raises(OSError, match="too large"):
        fill()
    bag.abandon()

    (left,) = tmp_path.iterdir()
    assert left.name == f"{name}{ACTIVE}"
    if name == "a.bag":
        found = reindex(left, tmp_path / "b.bag")
        assert found.messages >= 60
        assert found.messages % 10 == 0


@contextmanager
def full_disk(size: int) -> Iterator[None]:
    """Let no file be longer than ``size`` bytes."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
