import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.node.queues import DropOldestQueue


@given(st.integers(1, 5), st.lists(st.integers()))
def test_the_newest_entries_stay(length: int, entries: list[int]) -> None:
    queue: DropOldestQueue[int] = DropOldestQueue(length)
    for entry in entries:
        queue.push(entry)
    kept = entries[-length:]
    assert len(queue) == len(kept)
    assert [queue.pop() for _ in kept] == kept
    assert queue.pop() is None
    assert queue.dropped == len(entries) - len(kept)
    assert queue.pushed == len(entries)


@given(st.lists(st.lists(st.integers())), st.integers(1, 10))
def test_many_entries_at_once_are_as_one_by_one(batches: list[list[int]], length: int) -> None:
    one: DropOldestQueue[int] = DropOldestQueue(length)
    many: DropOldestQueue[int] = DropOldestQueue(length)
    for batch in batches:
        many.extend(batch)
        for entry in batch:
            one.push(entry)
    assert (many.pushed, many.dropped, len(many)) == (one.pushed, one.dropped, len(one))
    assert [many.pop() for _ in range(length)] == [one.pop() for _ in range(length)]


def test_release_empties_the_queue() -> None:
    queue: DropOldestQueue[int] = DropOldestQueue(2)
    queue.push(1)
    queue.release()
    assert not queue
    assert queue.pop() is None


def test_a_queue_of_no_length_is_an_error() -> None:
    with pytest.raises(ValueError, match="above 0"):
        DropOldestQueue(0)


def test_the_newest_entry_can_be_seen_while_it_waits() -> None:
    queue: DropOldestQueue[int] = DropOldestQueue(2)
    assert queue.newest is None
    queue.push(1)
    queue.push(2)
    assert (queue.newest, len(queue)) == (2, 2)
