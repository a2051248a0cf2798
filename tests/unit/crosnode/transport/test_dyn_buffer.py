from hypothesis import given
from hypothesis import strategies as st

from crosnode.transport.dyn_buffer import DynBuffer, DynString


def test_bytes_leave_in_the_order_they_came() -> None:
    buffer = DynBuffer()
    for piece in (b"ab", b"", b"cdef", bytearray(b"gh")):
        assert buffer.push_back(piece)
    assert bytes(buffer.peek(3)) == b"abc"
    buffer.discard(3)
    assert bytes(buffer.peek(100)) == b"defgh"
    assert bytes(buffer.take()) == b"defgh"
    assert len(buffer) == 0
    assert buffer.peek(1) == b""


def test_growth_ends_at_the_maximum() -> None:
    buffer = DynBuffer(4)
    assert buffer.push_back(b"abc")
    assert not buffer.push_back(b"de")
    assert buffer.size == 3
    assert buffer.push_back(b"d")


def test_a_large_piece_is_not_copied() -> None:
    buffer = DynBuffer(1 << 20)
    piece = bytes(100_000)
    buffer.push_back(piece)
    assert buffer.peek(100_000) is piece
    view = buffer.peek(10)
    assert isinstance(view, memoryview)
    assert view.obj is piece


@given(st.lists(st.binary(max_size=8)), st.lists(st.integers(0, 20)))
def test_any_pieces_and_any_steps_give_the_same_stream(
    pieces: list[bytes], sizes: list[int]
) -> None:
    buffer = DynBuffer()
    for piece in pieces:
        buffer.push_back(piece)
    rest = b"".join(pieces)
    for size in sizes:
        seen = bytes(buffer.peek(size))
        assert rest.startswith(seen)
        assert size == 0 or len(seen) == min(size, len(rest))
        buffer.discard(size)
        rest = rest[size:]
        assert buffer.size == len(rest)
    assert bytes(buffer.take()) == rest


def test_a_string_is_text_in_and_text_out() -> None:
    text = DynString(20)
    assert text.push_back_str("schön")
    assert text.push_back_str("!")
    assert str(text) == "schön!"
    assert not text.push_back_str("x" * 20)
    text.clear()
    text.push_back(b"\xff")
    assert str(text) == "\N{REPLACEMENT CHARACTER}"
