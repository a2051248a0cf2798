"""The heap: what is free is never more or less than what is not reserved."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.context import Context
from plcsim.core.memory import PAGE, Memory
from plcsim.library.heap import CHUNK, Blocks, FreeRanges, Heap, heap_of


def test_ranges_that_touch_are_one():
    ranges = FreeRanges()
    ranges.add(16, 8)
    ranges.add(32, 8)
    assert ranges.largest == 8
    ranges.add(24, 8)
    assert (ranges.largest, ranges.total) == (24, 24)


def test_the_smallest_range_that_fits_is_taken():
    ranges = FreeRanges()
    ranges.add(0, 64)
    ranges.add(100, 16)
    assert ranges.take(16) == 100
    assert ranges.take(16) == 0
    assert ranges.take(64) is None
    assert ranges.total == 48


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 200)), max_size=60))
def test_blocks_never_overlap_and_nothing_is_lost(acts):
    blocks, held = Blocks(0, 1024), {}
    for is_wish, number in acts:
        if is_wish:
            address = blocks.allocate(number)
            if address is None:
                assert blocks.free.largest < max(number, 1)
            else:
                size = blocks.size_of(address)
                assert size >= max(number, 1)
                assert all(address + size <= a or a + s <= address for a, s in held.items())
                held[address] = size
        elif held:
            address = sorted(held)[number % len(held)]
            assert blocks.release(address)
            del held[address]
    assert blocks.free.total == 1024 - sum(held.values())
    for address in held:
        blocks.release(address)
    assert blocks.free.largest == 1024


def test_what_was_not_reserved_cannot_be_released():
    heap = Heap(Memory(PAGE * 4))
    address = heap.allocate(10)
    assert not heap.release(address + 8)
    assert heap.release(address)
    assert not heap.release(address)


def test_reserved_memory_is_zeroed_and_valid():
    memory = Memory(PAGE * 4)
    heap = Heap(memory)
    address = heap.allocate(100)
    memory.write(address, b"\xff" * 100)
    heap.release(address)
    assert memory.read(heap.allocate(100), 100) == bytes(100)
    assert heap.size_of(address) == 104


def test_all_of_the_memory_can_be_had_and_no_more():
    memory = Memory(PAGE * 4)
    memory.allocate(5)
    heap = Heap(memory)
    assert heap.allocate(PAGE * 4) is None
    largest = heap.largest_free
    assert largest >= PAGE * 4 - 32
    assert heap.allocate(CHUNK * 2) is not None
    while heap.allocate(1000) is not None:
        pass
    assert heap.free_bytes < 1024 + 8


def test_a_restart_frees_everything_without_taking_more():
    memory = Memory(PAGE * 4)
    heap = Heap(memory)
    first = heap.allocate(60_000)
    used = memory.used
    for _ in range(20):
        heap.reset()
        assert heap.allocate(60_000) == first
    assert memory.used == used


@pytest.mark.parametrize("size", [0, 1])
def test_every_block_has_an_address_of_its_own(size):
    heap = Heap(Memory(PAGE * 4))
    assert heap.allocate(size) != heap.allocate(size)


def test_a_restart_frees_everything_and_takes_no_more_memory():
    context = Context(Memory(16 * PAGE), None)
    first = heap_of(context).allocate(100)
    assert heap_of(context).allocate(100) != first
    used = context.memory.used
    context.restart()
    assert heap_of(context).allocate(100) == first
    assert context.memory.used == used
