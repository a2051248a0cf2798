from collections import deque

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.shared_image import layout
from plcsim.shared_image.command import Store, encode_command
from plcsim.shared_image.errors import CommandRefused
from plcsim.shared_image.ring import LARGEST_RECORD, Consumer, Producer


def both_ends() -> tuple[Producer, Consumer, memoryview]:
    cells = memoryview(bytearray(layout.HEADER_SIZE)).cast("Q")
    ring = memoryview(bytearray(layout.RING_SIZE))
    at = layout.ring_cells(0)
    return Producer(cells, ring, at), Consumer(cells, ring, at), cells


def take(consumer: Consumer) -> bytes | None:
    record = consumer.peek()
    if record is not None:
        consumer.position += len(record)
        consumer.acknowledge(consumer.position)
    return record


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 20_000)), max_size=60))
def test_the_ring_is_a_queue(steps: list[tuple[bool, int]]) -> None:
    producer, consumer, _ = both_ends()
    model: deque[bytes] = deque()
    for number, (put, size) in enumerate(steps):
        if put:
            record = encode_command((Store(number, bytes(size)),))
            try:
                producer.put(record)
            except CommandRefused:
                assert sum(map(len, model)) + 2 * len(record) > layout.RING_SIZE - LARGEST_RECORD
                continue
            model.append(record)
        else:
            assert take(consumer) == (model.popleft() if model else None)
    while model:
        assert take(consumer) == model.popleft()
    assert take(consumer) is None


def test_a_full_ring_refuses_and_recovers() -> None:
    producer, consumer, _ = both_ends()
    record = encode_command((Store(1, bytes(1000)),))
    for _ in range(layout.RING_SIZE // len(record)):
        producer.put(record)
    with pytest.raises(CommandRefused, match="full"):
        producer.put(record)
    assert take(consumer) == record
    producer.put(record)


def test_a_record_that_no_ring_can_hold_is_refused() -> None:
    with pytest.raises(CommandRefused, match="too long"):
        both_ends()[0].put(encode_command((Store(1, bytes(LARGEST_RECORD)),)))


def test_a_ticket_is_acknowledged_when_the_tail_passes_it() -> None:
    producer, consumer, _ = both_ends()
    first = producer.put(encode_command((Store(1, b"a"),)))
    second = producer.put(encode_command((Store(2, b"b"),)))
    assert not producer.is_acknowledged(first)
    take(consumer)
    assert producer.is_acknowledged(first)
    assert not producer.is_acknowledged(second)


@pytest.mark.parametrize(
    "head", [b"\0" * 8, b"\xff" * 8, b"\x09\0\0\0\1\0\0\0", b"\x40\0\0\0\1\0\0\0"]
)
def test_a_record_without_a_length_empties_the_ring_and_is_counted(head: bytes) -> None:
    producer, consumer, cells = both_ends()
    at = layout.ring_cells(0)
    consumer._ring[:8] = head
    cells[at.head] = 16
    assert consumer.peek() is None
    assert consumer.position == 16
    assert producer.refused == 1


@given(
    st.integers(0, 2**64 - 1) | st.integers(0, 2 * layout.RING_SIZE),
    st.lists(st.integers(0, 2**64 - 1) | st.sampled_from([8, 16, 4096, 1 << 32 | 8]), max_size=40),
)
def test_whatever_a_service_leaves_in_the_ring_the_scan_is_through_soon(
    head: int, words: list[int]
) -> None:
    _, consumer, cells = both_ends()
    consumer._ring[: 8 * len(words)] = b"".join(w.to_bytes(8, "little") for w in words)
    cells[layout.ring_cells(0).head] = head
    for _ in range(10):
        record = take(consumer)
        assert record is None or len(record) <= layout.RING_SIZE
    assert consumer.position % 8 == 0
