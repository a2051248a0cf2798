"""Messages chunk by chunk are those that rosbags finds by the index."""

import struct
from itertools import permutations
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim.recorder.bag import chunks
from plcsim.recorder.bag.files import Ros1Bag
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.types import text_message
from plcsim.recorder.errors import RecordingError

TEXT = "std_msgs/msg/String"


def write(path: Path, parts: list[list[tuple[int, int]]]) -> None:
    """Write chunks of messages, each (topic, time in nanoseconds)."""
    path.unlink(missing_ok=True)
    bag = Ros1Bag(path)
    topics = [bag.add(f"/topic_{number}", TEXT) for number in range(3)]
    for part in parts:
        for number, (topic, time_ns) in enumerate(part):
            bag.write(topics[topic], time_ns, text_message(f"{time_ns} {number}"))
        bag.flush()
    bag.close()


@settings(max_examples=30)
@given(st.lists(st.lists(st.tuples(st.integers(0, 2), st.integers(1, 50)), max_size=5), max_size=3))
def test_they_are_those_of_the_index(
    tmp_path_factory: pytest.TempPathFactory, parts: list[list[tuple[int, int]]]
) -> None:
    path = tmp_path_factory.getbasetemp() / "chunks.bag"
    write(path, [[(topic, 100 * n + t) for topic, t in part] for n, part in enumerate(parts)])

    with open_bag(path) as bag:
        reader = bag._reader
        assert chunks.is_in_order(reader)
        found = [
            (time_ns, connection, data)
            for connection, time_ns, data in chunks.messages(reader, {0, 1, 2})
        ]
        theirs = [(time_ns, c.id, data) for c, time_ns, data in reader.messages()]
    assert sorted(found) == sorted(theirs)
    assert [time_ns for time_ns, _, _ in found] == [time_ns for time_ns, _, _ in theirs]


def test_chunks_that_overlap_are_read_by_the_index(tmp_path: Path) -> None:
    write(tmp_path / "a.bag", [[(0, 10), (0, 30)], [(1, 20), (1, 40)]])

    with open_bag(tmp_path / "a.bag") as bag:
        assert not chunks.is_in_order(bag._reader)
        assert [each.time_ns for each in bag.messages()] == [10, 20, 30, 40]


@pytest.mark.parametrize("more", [b"", b"more=x"])
@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_the_fields_of_a_header_may_stand_in_any_order(order: tuple[int, ...], more: bytes) -> None:
    fields = [b"op=\x02", b"conn=" + struct.pack("<I", 7), b"time=" + struct.pack("<II", 5, 6)]
    chosen = [*(fields[n] for n in order), *([more] if more else [])]
    head = b"".join(struct.pack("<I", len(each)) + each for each in chosen)
    record = struct.pack("<I", len(head)) + head + struct.pack("<I", 2) + b"hi"

    found = chunks._places(record * 2)

    size = len(record)
    assert found == [(5_000_000_006, 7, size - 2, size), (5_000_000_006, 7, 2 * size - 2, 2 * size)]


@pytest.mark.parametrize("cut", [1, 10, 30, 45, 47])
def test_a_chunk_that_breaks_off_is_told(tmp_path: Path, cut: int) -> None:
    fields = [b"op=\x02", b"conn=" + struct.pack("<I", 7), b"time=" + struct.pack("<II", 5, 6)]
    head = b"".join(struct.pack("<I", len(each)) + each for each in fields)
    record = struct.pack("<I", len(head)) + head + struct.pack("<I", 2) + b"hi"

    with pytest.raises(RecordingError, match="a chunk is damaged"):
        chunks._places(record + record[:cut])
