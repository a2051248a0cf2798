"""Generator parsers over bytes that come in any pieces."""

import itertools
import struct
import tracemalloc

import pytest
from hypothesis import given
from hypothesis import strategies as st

import crosnode.tcpros.reader as reader_module
from crosnode.errors import TcprosError
from crosnode.tcpros.reader import ByteReader, length_of


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


def test_a_large_block_that_ends_early_is_an_error() -> None:
    reader = ByteReader()
    reader.feed(struct.pack("<I", 1 << 20) + bytes(100_000))
    parser = reader.large_block(1 << 21, "message")
    next(parser)
    reader.feed_eof()
    with pytest.raises(TcprosError, match="after 100000 of 1048576"):
        next(parser)
