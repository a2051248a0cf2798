"""Messages chunk by chunk are those that rosbags finds by the index."""

import random
import struct
from itertools import permutations
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.rosbag1 import Reader, Writer

from plcsim.recorder.bag import chunks
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.ros1_bag import Ros1Bag
from plcsim.recorder.bag.types import text_message, typestore
from plcsim.recorder.errors import RecordingError

TEXT = "std_msgs/msg/String"


def write(path: Path, parts: list[list[tuple[int, int]]]) -> None:
    """Write chunks of messages, each (topic, time in nanoseconds)."""
    path.unlink(missing_ok=True)
    bag = Ros1Bag(path)
    topics = [bag.add(f"/topic_{number}", TEXT) for number in range(3)]
    for part in parts:
        for number, (topic, time_ns) in enumerate(part):
            bag.write(time_ns, [(topics[topic], text_message(f"{time_ns} {number}"))])
        bag.flush()
    bag.close()


@settings(max_examples=30)
@given(
    st.lists(st.lists(st.tuples(st.integers(0, 2), st.integers(1, 50)), max_size=5), max_size=3),
    st.sampled_from([0, 25, 49, 100]),
)
def test_they_are_those_of_the_index(
    tmp_path_factory: pytest.TempPathFactory, parts: list[list[tuple[int, int]]], step: int
) -> None:
    path = tmp_path_factory.getbasetemp() / "chunks.bag"
    write(path, [[(topic, step * n + t) for topic, t in part] for n, part in enumerate(parts)])

    with open_bag(path) as bag:
        reader = bag._reader
        ours = [c.msgcount for c in reader.connections]
        found = [
            (time_ns, connection, data)
            for connection, time_ns, data in chunks.messages(reader, {0, 1, 2})
        ]
    with Reader(path) as by_index:
        theirs = [(time_ns, c.id, data) for c, time_ns, data in by_index.messages()]
        counts = [c.msgcount for c in by_index.connections]
    assert sorted(found) == sorted(theirs)
    assert ours == counts
    assert [time_ns for time_ns, _, _ in found] == [time_ns for time_ns, _, _ in theirs]


@pytest.mark.parametrize("compression", ["", "BZ2", "LZ4"])
def test_messages_of_chunks_that_overlap_are_merged(tmp_path: Path, compression: str) -> None:
    writer = Writer(tmp_path / "a.bag")
    if compression:
        writer.set_compression(Writer.CompressionFormat[compression])
    writer.chunk_threshold = 1000
    times = random.Random(1).sample(range(1, 10_000), 1000)
    with writer:
        topics = [writer.add_connection(f"/{n}", TEXT, typestore=typestore()) for n in range(3)]
        for time_ns in times:
            writer.write(topics[time_ns % 3], time_ns, text_message(str(time_ns)))

    with open_bag(tmp_path / "a.bag") as bag:
        found = [(each.time_ns, each.topic, each.data) for each in bag.messages(["/0", "/2"])]
        assert len(bag._reader.chunk_infos) > 10
    assert found == [(t, f"/{t % 3}", text_message(str(t))) for t in sorted(times) if t % 3 != 1]


def test_a_hundred_thousand_messages_out_of_order_are_sorted_in_bounded_memory(
    tmp_path: Path,
) -> None:
    count, size = 100_000, 300
    bag = Ros1Bag(tmp_path / "a.bag")
    topic = bag.add("/topic", TEXT)
    data = text_message("x" * (size - 4))
    for time_ns in random.Random(1).sample(range(1, count + 1), count):
        bag.write(time_ns, [(topic, data)])
    bag.close()

    before, most, read = anonymous_bytes(), 0, 0
    with open_bag(tmp_path / "a.bag") as reader:
        for read, message in enumerate(reader.messages(["/topic"]), 1):
            assert message.time_ns == read
            if read % 5_000 == 1:
                most = max(most, anonymous_bytes())
    assert read == count
    assert most - before < count * size / 2


def anonymous_bytes() -> int:
    """Return the memory of this process that is no file."""
    (line,) = (t for t in Path("/proc/self/status").read_text().splitlines() if "RssAnon" in t)
    return int(line.split()[1]) * 1024


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
