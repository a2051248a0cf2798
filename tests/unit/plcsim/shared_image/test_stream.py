"""Streams: in order, bounded, every loss counted, whatever the reader's pace."""

import multiprocessing
import struct
from mmap import mmap

from hypothesis import given
from hypothesis import strategies as st

from plcsim.shared_image import layout
from plcsim.shared_image.stream import PIECE, StreamReader, StreamRecord, StreamWriter

AT = layout.EVENT_CELLS
SIZE = 1024


def ends(size: int = SIZE) -> tuple[memoryview, memoryview]:
    return memoryview(bytearray(layout.HEADER_SIZE)).cast("Q"), memoryview(bytearray(size))


@given(
    st.lists(
        st.one_of(st.integers(0, 700).map(lambda n: ("write", n)), st.just(("read", 0))),
        max_size=80,
    ),
    st.integers(1, 5),
)
def test_a_reader_gets_every_record_or_counts_it_as_lost(
    steps: list[tuple[str, int]], most: int
) -> None:
    cells, ring = ends()
    writer = StreamWriter(cells, ring, AT)
    greedy = StreamReader(cells, ring, AT, from_oldest=True)
    slow = StreamReader(cells, ring, AT)
    written = 0
    got: list[StreamRecord] = []
    from_slow: list[StreamRecord] = []
    for act, size in steps:
        if act == "write":
            writer.write(1 + written % 7, written * 10, bytes([written % 256]) * size)
            written += 1
            got += greedy.read()
        else:
            from_slow += slow.read(most)
    from_slow += slow.read()
    assert len(got) + greedy.lost == written
    assert len(from_slow) + slow.lost == written
    assert greedy.lost == sum(size > SIZE // 2 - 24 for act, size in steps if act == "write")
    for records in (got, from_slow):
        numbers = [record.number for record in records]
        assert numbers == sorted(set(numbers))
        assert all(set(r.data) <= {r.time_ns // 10 % 256} for r in records)


def test_a_record_is_what_was_written() -> None:
    cells, ring = ends()
    writer = StreamWriter(cells, ring, AT)
    reader = StreamReader(cells, ring, AT)
    writer.write(3, 17, b"hello")
    writer.write(5, 18, b"")
    assert reader.read() == [StreamRecord(3, 0, 17, b"hello"), StreamRecord(5, 1, 18, b"")]
    assert reader.read() == []


def test_a_reader_that_begins_late_starts_there_or_with_what_is_left() -> None:
    cells, ring = ends()
    writer = StreamWriter(cells, ring, AT)
    for number in range(100):
        writer.write(1, number, bytes(8))
    late = StreamReader(cells, ring, AT)
    oldest = StreamReader(cells, ring, AT, from_oldest=True)
    assert (late.read(), late.lost) == ([], 0)
    found = oldest.read()
    assert len(found) + oldest.lost == 100
    assert found[-1].time_ns == 99
    assert len(found) == SIZE // 32
    writer.write(1, 100, b"")
    assert [r.time_ns for r in late.read()] == [r.time_ns for r in oldest.read()] == [100]


def test_readers_do_not_disturb_each_other() -> None:
    cells, ring = ends()
    writer = StreamWriter(cells, ring, AT)
    readers = [StreamReader(cells, ring, AT) for _ in range(3)]
    for number in range(10):
        writer.write(1, number, b"")
        readers[0].read()
    assert [len(r.read()) for r in readers] == [0, 10, 10]


def test_a_writer_that_begins_again_goes_on_in_the_same_stream() -> None:
    cells, ring = ends()
    reader = StreamReader(cells, ring, AT)
    for number in range(3):
        StreamWriter(cells, ring, AT).write(1, number, b"x")
    assert [(r.number, r.time_ns) for r in reader.read()] == [(0, 0), (1, 1), (2, 2)]


def test_a_stream_of_no_bytes_takes_nothing() -> None:
    cells, ring = ends(0)
    writer = StreamWriter(cells, ring, AT)
    reader = StreamReader(cells, ring, AT)
    writer.write(1, 0, b"")
    assert (reader.read(), reader.lost) == ([], 1)


RECORDS = 60_000
BIG = 16 * 1024


def _write(file: mmap) -> None:
    view = memoryview(file)
    cells, ring = view[: layout.HEADER_SIZE].cast("Q"), view[layout.HEADER_SIZE :]
    writer = StreamWriter(cells, ring, AT)
    for number in range(RECORDS):
        writer.write(1, number, struct.pack("<Q", number) * (number % 40))


def test_beside_a_writer_that_never_waits_no_record_is_torn() -> None:
    file = mmap(-1, layout.HEADER_SIZE + BIG)
    view = memoryview(file)
    cells, ring = view[: layout.HEADER_SIZE].cast("Q"), view[layout.HEADER_SIZE :]
    readers = [StreamReader(cells, ring, AT, from_oldest=True) for _ in range(2)]
    process = multiprocessing.get_context("fork").Process(target=_write, args=(file,))
    process.start()
    counts = [0, 0]
    while process.is_alive() or cells[AT.records] < RECORDS:
        for which, reader in enumerate(readers):
            records = reader.read(50 if which else 5000)
            counts[which] += len(records)
            for record in records:
                assert record.number == record.time_ns
                assert record.data == struct.pack("<Q", record.number) * (record.number % 40)
    process.join()
    for which, reader in enumerate(readers):
        counts[which] += len(reader.read(RECORDS))
        assert counts[which] + reader.lost == RECORDS
        assert counts[which] > BIG // 400


def test_a_reader_that_is_far_behind_copies_piece_by_piece() -> None:
    cells, ring = ends(4 * PIECE)
    writer = StreamWriter(cells, ring, AT)
    reader = StreamReader(cells, ring, AT)
    read = 0
    for turn in range(20):
        sizes = [PIECE + 5, *[(turn + n) * 7919 % 60_000 for n in range(20)]]
        for number, size in enumerate(sizes):
            writer.write(1, number, bytes([number]) * size)
        for number, size in enumerate(sizes):
            (record,) = reader.read(1)
            assert (record.number, record.time_ns) == (read, number)
            assert record.data == bytes([number]) * size
            read += 1
    assert reader.read() == []
    assert reader.lost == 0
