"""Generator parsers over bytes that come in any pieces."""

import itertools
import struct
import tracemalloc
from collections.abc import Generator

import pytest
from hypothesis import given
from hypothesis import strategies as st

import crosnode.tcpros.reader as reader_module
from crosnode.errors import TcprosError
from crosnode.tcpros.reader import (
    GIVEN_BACK,
    KEPT,
    KEPT_BYTES,
    LARGE,
    MOST_KEPT,
    UNUSED_NS,
    BlockMemory,
    ByteReader,
    length_of,
)


def test_exactly_waits_for_bytes() -> None:
    reader = ByteReader()
    parser = reader.exactly(3)
    assert next(parser) is None
    reader.feed(b"ab")
    assert next(parser) is None
    reader.feed(memoryview(b"cd"))
    with pytest.raises(StopIteration) as done:
        next(parser)
    assert done.value.value == b"abc"
    assert len(reader) == 1


def test_exactly_nothing() -> None:
    with pytest.raises(StopIteration) as done:
        next(ByteReader().exactly(0))
    assert done.value.value == b""


def test_end_within_a_block() -> None:
    reader = ByteReader()
    reader.feed(length_of(b"abcd") + b"ab")
    reader.feed_eof()
    with pytest.raises(TcprosError, match="closed after 2 of 4 bytes"):
        next(reader.block(10, "message"))


def test_length_above_the_limit_is_refused_before_its_bytes_come() -> None:
    reader = ByteReader()
    reader.feed(b"\xff\xff\xff\xff")
    with pytest.raises(TcprosError, match="header of 4294967295 bytes, at most 10 are read"):
        next(reader.block(10, "header"))


def test_more() -> None:
    reader = ByteReader()
    parser = reader.more()
    assert next(parser) is None
    reader.feed_eof()
    with pytest.raises(StopIteration) as done:
        next(parser)
    assert done.value.value is False


@given(
    st.binary(max_size=2000),
    st.lists(st.integers(1, 600), min_size=1),
    st.integers(1, 100),
)
def test_a_large_block_is_the_same_for_any_split(body: bytes, sizes: list[int], large: int) -> None:
    data = length_of(body) + body + b"next"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reader_module, "LARGE", large)
        reader, place, found = ByteReader(), 0, None
        parser = reader.large_block(5000, "message")
        for size in itertools.cycle(sizes):
            reader.feed(data[place : place + size])
            place += size
            try:
                next(parser)
            except StopIteration as stop:
                found = stop.value
                break
        reader.feed(data[place:])
    assert bytes(found) == body
    assert bytes(reader._buffer) == b"next"
    assert not isinstance(found, memoryview) or found.readonly


def read_large(reader: ByteReader, size: int) -> memoryview:
    """Let a large block come in pieces of 64 KiB, and return it."""
    reader.feed(struct.pack("<I", size))
    parser = reader.large_block(size, "message")
    piece = bytes(1 << 16)
    for _ in range(size >> 16):
        assert next(parser) is None
        reader.feed(piece)
    try:
        next(parser)
    except StopIteration as done:  # pytest.raises would keep the block in a cycle
        found: memoryview = done.value
        return found
    pytest.fail("the block is not whole")


def test_no_more_of_a_large_block_is_laid_out_than_has_come() -> None:
    reader = ByteReader()
    tracemalloc.start()
    try:
        read_large(reader, 64 << 20)
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert most < 1 << 18


def test_memory_of_a_large_block_is_used_again_when_nobody_has_a_view_of_it() -> None:
    reader = ByteReader()
    first = read_large(reader, 1 << 20)
    used = id(first.obj)
    second = read_large(reader, 1 << 18)
    assert id(second.obj) != used
    del first
    assert id(read_large(reader, 1 << 20).obj) == used
    assert id(read_large(reader, 1 << 19).obj) == used
    assert id(read_large(reader, 1 << 21).obj) != used  # too small for it


def test_of_the_memories_that_nobody_has_a_view_of_the_one_used_last_is_taken() -> None:
    reader = ByteReader()
    first, second = read_large(reader, 1 << 20), read_large(reader, 1 << 20)
    used = id(second.obj)
    del first, second
    assert [id(read_large(reader, 1 << 20).obj) for _ in range(3)] == 3 * [used]


def held_at_once(memory: BlockMemory, sizes: list[int]) -> int:
    """Take memory for blocks that wait for the program at once; return how much of it is fresh."""
    blocks, fresh = [], 0
    for size in sizes:
        blocks.append(memoryview(memory.take(size)))
        fresh += memory.is_fresh
    return fresh


def kept(memory: BlockMemory) -> tuple[int, int]:
    """Return how many memories are kept, and their bytes."""
    return len(memory._kept), sum(map(len, memory._kept))


def test_what_comes_in_a_step_of_ten_milliseconds_costs_page_faults_once() -> None:
    memory = BlockMemory()
    assert [held_at_once(memory, 8 * [1_000_004]) for _ in range(5)] == [8, 0, 0, 0, 0]


@pytest.mark.parametrize("size", [LARGE + 1, 1 << 20, KEPT_BYTES])
def test_memory_that_waits_for_the_next_blocks_is_bounded(size: int) -> None:
    memory = BlockMemory()
    held_at_once(memory, 100 * [size])
    count, size_of_all = kept(memory)
    assert count == max(KEPT, min(MOST_KEPT, KEPT_BYTES // size))
    assert size_of_all <= max(KEPT_BYTES, KEPT * size)


def test_memory_that_is_not_used_any_more_is_given_back_in_pieces() -> None:
    memory = BlockMemory()
    held_at_once(memory, 8 * [1 << 20])
    for step in range(50):  # a second, in which a block comes now and then
        held_at_once(memory, [1 << 20])
        memory.give_back(step * UNUSED_NS // 50)
    assert kept(memory) == (8, 8 << 20)
    sizes = [kept(memory)[1]]
    for step in range(50, 5_000):
        held_at_once(memory, [1 << 20])
        memory.give_back(step * UNUSED_NS // 50)
        sizes.append(kept(memory)[1])
    assert kept(memory) == (KEPT, KEPT << 20)
    assert {before - after for before, after in itertools.pairwise(sizes)} == {0, GIVEN_BACK}


def test_memory_that_somebody_has_a_view_of_is_not_given_back() -> None:
    memory = BlockMemory()
    views = [memoryview(memory.take(1 << 20)) for _ in range(5)]
    for view in views:
        view[-1] = 7
    for second in range(100):
        memory.give_back(second * UNUSED_NS)
    assert kept(memory) == (5, 5 << 20)
    assert [view[-1] for view in views] == 5 * [7]


def test_a_large_block_that_ends_early_is_an_error() -> None:
    reader = ByteReader()
    reader.feed(struct.pack("<I", 1 << 20) + bytes(100_000))
    parser = reader.large_block(1 << 21, "message")
    next(parser)
    reader.feed_eof()
    with pytest.raises(TcprosError, match="after 100000 of 1048576"):
        next(parser)


def stream(reader: ByteReader, count: int) -> Generator[None, None, list[bytes]]:
    """Take blocks as a subscriber does."""
    found: list[bytes] = []
    while len(found) < count and (yield from reader.more_blocks()):
        found.append(bytes((yield from reader.large_block(5000, "message"))))
    return found


def pour(reader: ByteReader, data: bytes) -> int:
    """Hand bytes over as a link does: to the room, where there is one; return how many."""
    room = reader.room
    if room is None:
        reader.feed(data)
        return len(data)
    taken = data[: len(room)]
    room[: len(taken)] = taken
    reader.filled(len(taken))
    return len(taken)


def read_stream(bodies: list[bytes], sizes: list[int]) -> list[bytes]:
    """Send blocks in pieces, those above 100 bytes being large, and return what is read."""
    data = b"".join(length_of(body) + body for body in bodies)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reader_module, "LARGE", 100)
        reader = ByteReader()
        parser = stream(reader, len(bodies))
        for size in itertools.cycle(sizes):
            try:
                next(parser)
            except StopIteration as done:
                found: list[bytes] = done.value
                return found
            data = data[pour(reader, data[:size]) :]
    pytest.fail("the blocks never end")


@given(
    st.lists(st.sampled_from((0, 1, 99, 200, 201, 900)), min_size=1, max_size=12),
    st.lists(st.integers(1, 3000), min_size=1, max_size=5),
)
def test_blocks_are_the_same_for_any_split_and_whatever_is_expected(
    lengths: list[int], sizes: list[int]
) -> None:
    bodies = [bytes([number]) * length for number, length in enumerate(lengths)]
    assert read_stream(bodies, sizes) == bodies


def test_after_two_large_blocks_of_a_size_the_next_is_read_to_its_place() -> None:
    reader = ByteReader()
    parser = stream(reader, 4)
    large = length_of(bytes(1000)) + bytes(1000)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reader_module, "LARGE", 100)
        for _ in range(2):
            next(parser)
            assert reader.room is None
            reader.feed(large)
        next(parser)
        room = reader.room
        assert room is not None
        assert len(room) == len(large)
        assert pour(reader, length_of(b"x") + b"x") == 5  # but it is a short one
        next(parser)
        assert reader.room is None
        reader.feed(length_of(b"y") + b"y")
        with pytest.raises(StopIteration) as done:
            next(parser)
    assert done.value.value == [bytes(1000), bytes(1000), b"x", b"y"]


def test_an_end_before_an_expected_block_is_an_end_and_one_within_it_is_an_error() -> None:
    for begun in (b"", b"\xe8\x03", length_of(bytes(1000)) + b"x"):
        reader = ByteReader()
        parser = stream(reader, 3)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(reader_module, "LARGE", 100)
            for _ in range(2):
                next(parser)
                reader.feed(length_of(bytes(1000)) + bytes(1000))
            next(parser)
            pour(reader, begun)
            reader.feed_eof()
            expected = TcprosError if begun else StopIteration
            with pytest.raises(expected):
                next(parser)
