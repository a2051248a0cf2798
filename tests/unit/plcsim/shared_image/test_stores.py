"""Writes in the scan: whole or not at all, and what was there before is the answer."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.errors import PageFault
from plcsim.core.memory import FIRST, Memory
from plcsim.core.owners import SHARED, Owners
from plcsim.shared_image.command import (
    HEAD,
    Mask,
    Operation,
    Scatter,
    StoreCommand,
    Write,
    decode_command,
    encode_command,
)
from plcsim.shared_image.stores import Stores

SIZE = 64


def made() -> tuple[Memory, Stores]:
    memory = Memory()
    memory.allocate(SIZE)
    memory.write(FIRST, bytes(range(SIZE)))
    return memory, Stores(memory, Owners([]))


def record_of(*operations: Operation) -> memoryview:
    return memoryview(bytearray(encode_command(Write(operations))))


offsets = st.integers(0, SIZE - 8)
operations = st.one_of(
    st.builds(
        lambda at, data: StoreCommand(FIRST + at, data), offsets, st.binary(min_size=1, max_size=8)
    ),
    st.builds(lambda at, a, o: Mask(FIRST + at, a, o), offsets, *[st.integers(0, 0xFFFF)] * 2),
    st.lists(st.tuples(offsets, st.integers(0, 255)), min_size=1, max_size=10).map(
        lambda pairs: Scatter(tuple(FIRST + at for at, _ in pairs), bytes(v for _, v in pairs))
    ),
)


def apply_to_model(model: bytearray, operation: Operation) -> None:
    at = operation.address - FIRST if not isinstance(operation, Scatter) else 0
    if isinstance(operation, StoreCommand):
        model[at : at + len(operation.data)] = operation.data
    elif isinstance(operation, Mask):
        word = int.from_bytes(model[at : at + 2], "little")
        model[at : at + 2] = operation.applied_to(word).to_bytes(2, "little")
    else:
        for address, value in zip(operation.addresses, operation.data, strict=True):
            model[address - FIRST] = value


@given(st.lists(operations, max_size=12))
def test_operations_are_done_in_order_and_told_what_was_there(found: list[Operation]) -> None:
    memory, stores = made()
    model = bytearray(range(SIZE))
    expected = []
    for operation in found:
        before = bytes(model)
        apply_to_model(model, operation)
        if isinstance(operation, StoreCommand):
            at = operation.address - FIRST
            expected.append(StoreCommand(operation.address, before[at : at + len(operation.data)]))
        elif isinstance(operation, Mask):
            at = operation.address - FIRST
            word = int.from_bytes(before[at : at + 2], "little")
            expected.append(operation._replace(and_mask=word))
        else:
            old = bytes(before[a - FIRST] for a in operation.addresses)
            expected.append(operation._replace(data=old))
    record = record_of(*found)
    plan = stores.plan(record, len(found))
    stores.apply(record, plan)
    assert memory.read(FIRST, SIZE) == bytes(model)
    assert decode_command(bytes(record)) == Write(tuple(expected))
    assert plan.owners == (SHARED if found else 0)


@pytest.mark.parametrize(
    "bad",
    [
        StoreCommand(FIRST - 1, b"ab"),
        StoreCommand(FIRST + SIZE - 1, b"ab"),
        StoreCommand(FIRST, b""),
        StoreCommand(0, b"a"),
        StoreCommand(0xFFFF_FFFF, b"ab"),
        Mask(FIRST + SIZE - 1, 0, 0),
        Scatter((FIRST, FIRST + SIZE), b"ab"),
        Scatter((FIRST, 0), b"ab"),
    ],
)
def test_what_lies_outside_the_variables_is_a_page_fault(bad: Operation) -> None:
    _, stores = made()
    with pytest.raises(PageFault):
        stores.plan(record_of(StoreCommand(FIRST, b"good"), bad), 2)


@given(st.binary(max_size=100), st.integers(0, 100))
def test_any_record_is_planned_or_refused(body: bytes, count: int) -> None:
    _, stores = made()
    record = memoryview(bytearray(HEAD.size) + body)
    try:
        plan = stores.plan(record, count)
    except (ValueError, PageFault):
        return
    stores.apply(record, plan)
    assert len(record) == HEAD.size + len(body)


def test_the_work_of_a_plan_grows_with_its_bytes() -> None:
    _, stores = made()
    one = stores.plan(record_of(StoreCommand(FIRST, bytes(40))), 1)
    many = stores.plan(record_of(Scatter([FIRST] * 100, bytes(100))), 1)
    assert (one.work, many.work) == (1, 101)
