from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from hypothesis import given
from hypothesis import strategies as st

from plcsim.network.stream import MAX_PACKETS, Stream

if TYPE_CHECKING:
    from collections.abc import Callable


class Belt:
    """Carries packets when told to."""

    def __init__(self, largest: int = 4) -> None:
        self.largest = largest
        self.packets: deque[tuple[int, Callable[[], None]]] = deque()

    def packet_size(self) -> int:
        return self.largest

    def carry(self, size: int, arrive: Callable[[], None]) -> None:
        self.packets.append((size, arrive))

    def deliver(self, number: int = 1_000_000) -> None:
        while self.packets and number:
            self.packets.popleft()[1]()
            number -= 1


def make(capacity: int = 8, window: int = 8) -> tuple[Stream, Belt]:
    belt = Belt()
    stream = Stream(belt)
    stream.capacity, stream.window = capacity, window
    return stream, belt


def test_bytes_count_against_the_send_buffer_until_they_arrive() -> None:
    stream, belt = make(capacity=6)
    assert stream.write(b"abcdefgh") == 6
    assert stream.write(b"gh") == 0
    belt.deliver(1)
    assert stream.read(10) == b"abcd"
    assert stream.write(b"gh") == 2


def test_packets_are_no_larger_than_the_carrier_says() -> None:
    stream, belt = make()
    stream.write(b"abcdef")
    assert [size for size, _ in belt.packets] == [4, 2]


def test_a_full_receive_buffer_holds_the_sender_back() -> None:
    stream, belt = make(capacity=8, window=3)
    stream.write(b"abcdefgh")
    belt.deliver()
    assert bytes(stream.arrived) == b"abc"
    assert stream.write(b"ijkl") == 3
    belt.deliver()
    assert [stream.read(3) for _ in range(5)] == [b"abc", b"def", b"ghi", b"jk", b""]


def test_the_end_comes_after_the_last_byte() -> None:
    stream, belt = make(window=2)
    stream.write(b"abcd")
    stream.finish()
    stream.finish()
    belt.deliver()
    assert not stream.ended
    assert stream.read(2) == b"ab"
    assert stream.ended
    assert stream.read(2) == b"cd"


def test_cut_off_keeps_what_has_arrived() -> None:
    stream, belt = make()
    stream.write(b"abcdef")
    stream.finish()
    belt.deliver(1)
    stream.cut_off()
    belt.deliver()
    assert stream.read(8) == b"abcd"
    assert not stream.ended
    assert stream.drained


def test_a_later_urgent_mark_replaces_one_that_is_under_way() -> None:
    stream, belt = make(capacity=20, window=20)
    stream.write(b"a1", urgent=True)
    stream.write(b"b2", urgent=True)
    belt.deliver()
    assert stream.read_urgent() == b"2"
    assert stream.read(8) == b"a1b"


def test_no_urgent_mark_when_only_a_part_was_taken() -> None:
    stream, belt = make(capacity=2)
    assert stream.write(b"abc", urgent=True) == 2
    belt.deliver()
    assert stream.read_urgent() == b""
    assert stream.read(8) == b"ab"


def test_packets_under_way_are_bounded() -> None:
    stream, belt = make(capacity=10**6, window=10**6)
    belt.largest = 1
    assert stream.write(bytes(5_000)) == MAX_PACKETS
    assert stream.write(b"x") == 0
    belt.deliver(1)
    assert stream.write(b"xy") == 1


def test_peeking_takes_nothing() -> None:
    stream, belt = make()
    stream.write(b"ab!", urgent=True)
    belt.deliver()
    assert stream.read(1, peek=True) == b"a"
    assert stream.read_urgent(peek=True) == b"!"
    assert stream.read_urgent() == b"!"
    assert stream.read_urgent() == b""
    assert stream.read(8) == b"ab"


@given(
    data=st.binary(max_size=300),
    capacity=st.integers(1, 40),
    window=st.integers(1, 40),
    largest=st.integers(1, 10),
    steps=st.lists(st.integers(1, 50), min_size=1, max_size=30),
)
def test_any_split_arrives_whole_and_in_order(
    data: bytes, capacity: int, window: int, largest: int, steps: list[int]
) -> None:
    stream, belt = make(capacity, window)
    belt.largest = largest
    sent, got = 0, b""
    for step in range(2_000):
        size = steps[step % len(steps)]
        sent += stream.write(data[sent : sent + size])
        belt.deliver(size)
        assert len(stream.arrived) <= window
        got += stream.read(size)
        if len(got) == len(data):
            break
    assert got == data
