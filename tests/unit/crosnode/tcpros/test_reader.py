"""Generator parsers over bytes that come in any pieces."""

import pytest

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
