"""The ring: a queue whose records are answered in their places, in any order."""

from collections import deque

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.shared_image import layout
from plcsim.shared_image.command import HEAD, CommandOutcome, StoreCommand, Write, encode_command
from plcsim.shared_image.errors import CommandRefused
from plcsim.shared_image.ring import ANSWERS_KEPT, LARGEST_RECORD, Consumer, Producer, Taken


def both_ends() -> tuple[Producer, Consumer, memoryview]:
    cells = memoryview(bytearray(layout.HEADER_SIZE)).cast("Q")
    ring = memoryview(bytearray(layout.RING_SIZE))
    at = layout.ring_cells(0)
    return Producer(cells, ring, at), Consumer(cells, ring, at), cells


def record_of(number: int, size: int = 1) -> bytes:
    return encode_command(Write((StoreCommand(number, bytes(size)),)))


def take(consumer: Consumer) -> bytes | None:
    taken = consumer.take()
    if taken is None:
        return None
    record = bytes(taken.record)
    taken.applied()
    consumer.acknowledge()
    return record


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 20_000)), max_size=60))
def test_the_ring_is_a_queue(steps: list[tuple[bool, int]]) -> None:
    producer, consumer, _ = both_ends()
    model: deque[bytes] = deque()
    for number, (put, size) in enumerate(steps):
        if put:
            record = record_of(number, size)
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


acts = st.lists(st.tuples(st.sampled_from("ptaAok"), st.integers(0, 30)), max_size=200)


@given(acts)
def test_whatever_the_order_of_answers_each_is_got_once(acts: list[tuple[str, int]]) -> None:
    """(p)ut, (t)ake, (a)nswer by refusing, (A)pply, ask for the (o)utcome, ac(k)nowledge."""
    producer, consumer, _ = both_ends()
    tickets: list[int] = []
    model: dict[int, CommandOutcome] = {}
    taken: list[tuple[int, Taken]] = []
    numbers = iter(range(1000))
    for act, number in acts:
        if act == "p":
            try:
                ticket = producer.put(record_of(next(numbers), 1 + 300 * number))
            except CommandRefused:
                continue
            tickets.append(ticket)
            model[ticket] = CommandOutcome.WAITING
        elif act == "t":
            found = consumer.take()
            if found is not None:
                taken.append((tickets[len(taken)], found))
        elif act in "aA" and taken:
            ticket, found = taken[number % len(taken)]
            if model.get(ticket) is CommandOutcome.WAITING:
                outcome = CommandOutcome.APPLIED if act == "A" else CommandOutcome.TOO_MANY
                found.answer(outcome)
                model[ticket] = outcome
        elif act == "k":
            consumer.acknowledge()
        elif act == "o" and model:
            ticket = list(model)[number % len(model)]
            assert producer.outcome(ticket) is model[ticket]
            answer = producer.take_answer(ticket)
            if model[ticket] is CommandOutcome.WAITING:
                assert answer is None
            else:
                assert answer is not None
                assert answer.outcome is model.pop(ticket)
                assert producer.take_answer(ticket) is None


def test_a_full_ring_refuses_and_recovers() -> None:
    producer, consumer, _ = both_ends()
    record = record_of(1, 1000)
    for _ in range(layout.RING_SIZE // len(record)):
        producer.put(record)
    with pytest.raises(CommandRefused, match="full"):
        producer.put(record)
    assert take(consumer) == record
    producer.put(record)


def test_the_place_of_a_record_is_given_back_in_order() -> None:
    producer, consumer, cells = both_ends()
    tail = layout.ring_cells(0).tail
    first, second = (producer.put(record_of(n)) for n in (1, 2))
    one, two = consumer.take(), consumer.take()
    assert one is not None
    assert two is not None
    two.applied()
    assert not consumer.acknowledge()
    assert (producer.outcome(first), producer.outcome(second)) == (
        CommandOutcome.WAITING,
        CommandOutcome.APPLIED,
    )
    assert cells[tail] == 0
    one.applied()
    assert consumer.acknowledge()
    assert cells[tail] == two.end
    assert not consumer.is_open


def test_an_answer_can_be_read_after_its_place_was_used_again() -> None:
    producer, consumer, _ = both_ends()
    first = producer.put(record_of(7, 30_000))
    take(consumer)
    for _ in range(3):
        producer.put(record_of(8, 30_000))
        take(consumer)
    assert producer.outcome(first) is CommandOutcome.APPLIED
    answer = producer.take_answer(first)
    assert answer is not None
    assert answer.before == Write((StoreCommand(7, bytes(30_000)),))


def test_answers_that_nobody_asks_for_are_not_kept_for_ever() -> None:
    producer, consumer, _ = both_ends()
    for number in range(2 * ANSWERS_KEPT):
        producer.put(record_of(number))
        take(consumer)
    assert len(producer._answers) <= ANSWERS_KEPT
    assert len(producer._open) < layout.RING_SIZE // HEAD.size


def test_a_record_that_no_ring_can_hold_is_refused() -> None:
    with pytest.raises(CommandRefused, match="too long"):
        both_ends()[0].put(record_of(1, LARGEST_RECORD))


def test_a_producer_that_begins_again_goes_on_in_the_same_ring() -> None:
    producer, consumer, cells = both_ends()
    producer.put(record_of(1))
    again = Producer(cells, consumer._ring, layout.ring_cells(0))
    ticket = again.put(record_of(2))
    assert take(consumer) == record_of(1)
    assert again.outcome(ticket) is CommandOutcome.WAITING
    take(consumer)
    assert again.outcome(ticket) is CommandOutcome.APPLIED


@pytest.mark.parametrize(
    "head",
    [b"\0" * 8, b"\xff" * 8, b"\x09\0\0\0\1\0\0\0", b"\x40\0\0\0\1\0\0\0", b"\x08\0\0\0\1\0\0\0"],
)
def test_a_record_without_a_length_empties_the_ring_and_is_counted(head: bytes) -> None:
    producer, consumer, cells = both_ends()
    at = layout.ring_cells(0)
    consumer._ring[:8] = head
    cells[at.head] = 16
    assert consumer.take() is None
    assert consumer.is_empty
    assert producer.refused == 1
    assert consumer.acknowledge()
    assert cells[at.tail] == 16


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
    for _ in range(50):
        record = take(consumer)
        assert record is None or len(record) <= layout.RING_SIZE
    consumer.acknowledge()
    assert cells[layout.ring_cells(0).tail] % 8 == 0
