import struct
from pathlib import Path

import pytest

from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.bag.reindex import MAGIC, Recovered, reindex
from plcsim.recorder.bag.ros1_bag import Ros1Bag
from plcsim.recorder.bag.types import text_message
from plcsim.recorder.commands.bag import reindex as command
from plcsim.recorder.errors import RecordingError

TEXT = "std_msgs/msg/String"


def make(path: Path) -> tuple[bytes, list[int]]:
    """Write four chunks of five messages; return the file before it is closed, and their ends."""
    bag = Ros1Bag(path)
    chatter = bag.add("/chatter", TEXT)
    ends = []
    for chunk in range(4):
        for number in range(5):
            bag.write(10**9 + 5 * chunk + number, [(chatter, text_message(f"hello {number}"))])
        bag.flush()
        ends.append(bag.size)
    data = path.with_name(path.name + ".active").read_bytes()
    bag.close()
    return data, ends


def texts(path: Path) -> list[tuple[int, bytes]]:
    with open_bag(path) as bag:
        return [(each.time_ns, each.as_ros1) for each in bag.messages()]


def test_a_bag_cut_at_any_byte_gives_every_complete_chunk(tmp_path: Path) -> None:
    data, ends = make(tmp_path / "a.bag")
    starts = [data.index(b"op=\x05"), *ends[:-1]]
    whole = texts(tmp_path / "a.bag")
    before = 0
    for cut in range(len(MAGIC), len(data) + 1, 13):
        (tmp_path / "cut.bag").write_bytes(data[:cut])
        (tmp_path / "found.bag").unlink(missing_ok=True)

        found = reindex(tmp_path / "cut.bag", tmp_path / "found.bag").messages

        assert 5 * sum(end <= cut for end in ends) <= found <= 5 * sum(s < cut for s in starts)
        if found != before or cut % 130 == 0:
            assert texts(tmp_path / "found.bag") == whole[:found]
        before = found
    assert before == 20


def test_a_closed_bag_stays_what_it_is(tmp_path: Path) -> None:
    make(tmp_path / "a.bag")

    assert reindex(tmp_path / "a.bag", tmp_path / "b.bag") == Recovered(20, 0)
    assert texts(tmp_path / "b.bag") == texts(tmp_path / "a.bag")


@pytest.mark.parametrize("compression", ["BZ2", "LZ4"])
def test_compressed_chunks_of_others_are_copied(tmp_path: Path, compression: str) -> None:
    from rosbags.rosbag1 import Writer

    from plcsim.recorder.bag.types import typestore

    writer = Writer(tmp_path / "a.bag")
    writer.set_compression(Writer.CompressionFormat[compression])
    with writer:
        chatter = writer.add_connection("/chatter", TEXT, typestore=typestore())
        for number in range(100):
            writer.write(chatter, number + 1, text_message("hello"))
    data = (tmp_path / "a.bag").read_bytes()
    (tmp_path / "cut.bag").write_bytes(data[:-100])

    assert reindex(tmp_path / "cut.bag", tmp_path / "b.bag").messages == 100
    assert texts(tmp_path / "b.bag") == texts(tmp_path / "a.bag")


def test_damaged_bytes_end_it_and_are_counted(tmp_path: Path) -> None:
    data, ends = make(tmp_path / "a.bag")
    for place in range(ends[1], ends[2], 11):
        for byte in (0, 255):
            broken = data[:place] + bytes([byte]) * 8 + data[place + 8 :]
            (tmp_path / "broken.bag").write_bytes(broken)
            (tmp_path / "b.bag").unlink(missing_ok=True)

            found = reindex(tmp_path / "broken.bag", tmp_path / "b.bag")

            assert found.messages in {10, 15, 20}
            assert (found.messages == 20) == (found.left_out == 0)


def test_a_chunk_that_unpacks_to_more_than_it_says_is_left_out(tmp_path: Path) -> None:
    import bz2

    data, _ends = make(tmp_path / "a.bag")
    start = data.index(b"op=\x05") - 8
    head = b"".join(
        struct.pack("<I", len(field)) + field
        for field in (b"op=\x05", b"compression=bz2", b"size=" + struct.pack("<I", 100))
    )
    bomb = bz2.compress(bytes(1_000_000))
    chunk = struct.pack("<I", len(head)) + head + struct.pack("<I", len(bomb)) + bomb
    (tmp_path / "bomb.bag").write_bytes(data[:start] + chunk)

    assert reindex(tmp_path / "bomb.bag", tmp_path / "b.bag") == Recovered(0, len(chunk))


def test_what_is_there_is_not_written_over(tmp_path: Path) -> None:
    make(tmp_path / "a.bag")

    with pytest.raises(RecordingError, match=r"a\.bag: exists already"):
        reindex(tmp_path / "a.bag", tmp_path / "a.bag")
    (tmp_path / "no.bag").write_bytes(b"#ROSBAG V1.2\n")
    with pytest.raises(RecordingError, match=r"no\.bag: is no bag of ROS 1"):
        reindex(tmp_path / "no.bag", tmp_path / "b.bag")
    with pytest.raises(RecordingError, match=r"none\.bag: No such file"):
        reindex(tmp_path / "none.bag", tmp_path / "b.bag")


def test_the_command_takes_the_name_from_the_active_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from argparse import Namespace

    data, _ends = make(tmp_path / "a.bag")
    (tmp_path / "b.bag.active").write_bytes(data[:-1000])

    command(Namespace(bag=tmp_path / "b.bag.active", output=None))
    assert capsys.readouterr().out.startswith(f"{tmp_path / 'b.bag'}: 10 messages, ")
    with pytest.raises(RecordingError, match="say where to"):
        command(Namespace(bag=tmp_path / "a.bag", output=None))
