from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.control import Action
from plcsim.shared_image.command import (
    HEAD,
    Answer,
    Cancel,
    Command,
    CommandOutcome,
    Control,
    ForceCommand,
    Mask,
    Operation,
    Release,
    SampleCommand,
    Scatter,
    StoreCommand,
    Write,
    answer_of,
    decode_command,
    encode_command,
    merged,
)

addresses = st.integers(0, 0xFFFF_FFFF)
words = st.integers(0, 0xFFFF)
scattered = st.lists(st.tuples(addresses, st.integers(0, 255)), min_size=1, max_size=20).map(
    lambda bytes_: Scatter(tuple(a for a, _ in bytes_), bytes(b for _, b in bytes_))
)
operations = (
    st.builds(StoreCommand, addresses, st.binary(max_size=40))
    | st.builds(Mask, addresses, words, words)
    | scattered
)


texts = st.text(max_size=30)
numbers = st.integers(0, 2**16 - 1)
commands = st.one_of(
    st.lists(operations, max_size=20).map(lambda found: Write(tuple(found))),
    st.builds(ForceCommand, texts, st.binary(max_size=40)),
    st.builds(Release, texts),
    st.builds(Control, st.sampled_from(Action), st.integers(-(2**63), 2**63 - 1)),
    st.builds(
        SampleCommand,
        st.integers(1, 2**32 - 1),
        st.integers(0, 8),
        st.integers(0, 2**63 - 1),
        st.lists(st.tuples(addresses, addresses), max_size=20).map(tuple),
    ),
    st.builds(Cancel, st.integers(0, 2**32 - 1)),
)


@given(commands)
def test_a_command_survives_its_record(command: Command) -> None:
    record = encode_command(command)
    assert len(record) % 8 == 0
    assert decode_command(record) == command
    assert answer_of(record) == Answer(CommandOutcome.WAITING, 0, command)


@given(st.binary(min_size=16, max_size=200))
def test_any_bytes_are_a_command_or_a_value_error(record: bytes) -> None:
    try:
        command = decode_command(record)
    except ValueError:
        return
    assert decode_command(encode_command(command)) == command


@given(st.binary(max_size=120), st.integers(1, 6), numbers)
def test_any_body_of_any_kind_is_a_command_or_a_value_error(
    body: bytes, kind: int, count: int
) -> None:
    size = 16 + -(-len(body) // 8) * 8
    record = HEAD.pack(size, kind, 0, count, 0) + body.ljust(size - 16, b"\0")
    try:
        command = decode_command(record)
    except ValueError:
        return
    assert decode_command(encode_command(command)) == command


def test_an_outcome_says_whether_and_why_a_command_was_refused() -> None:
    refused = [outcome for outcome in CommandOutcome if outcome.is_refused]
    assert len(refused) == len(CommandOutcome) - 2
    assert len({outcome.text for outcome in CommandOutcome}) == len(CommandOutcome)


@given(st.lists(st.builds(StoreCommand, st.integers(0, 64), st.binary(min_size=1, max_size=8))))
def test_merging_does_not_change_what_is_stored(stores: list[StoreCommand]) -> None:
    def image(operations: Sequence[Operation]) -> bytearray:
        memory = bytearray(80)
        for operation in operations:
            if isinstance(operation, Scatter):
                for address, value in zip(operation.addresses, operation.data, strict=True):
                    memory[address] = value
                continue
            assert isinstance(operation, StoreCommand)
            memory[operation.address : operation.address + len(operation.data)] = operation.data
        return memory

    assert image(merged(stores)) == image(tuple(stores))


def test_adjoining_stores_become_one() -> None:
    assert merged([StoreCommand(8, b"ab"), StoreCommand(10, b"c"), StoreCommand(12, b"d")]) == (
        StoreCommand(8, b"abc"),
        StoreCommand(12, b"d"),
    )


def test_single_bytes_that_follow_each_other_become_one() -> None:
    stores = [
        StoreCommand(4, b"aa"),
        StoreCommand(8, b"b"),
        StoreCommand(20, b"c"),
        Mask(2, 1, 2),
        StoreCommand(6, b"d"),
    ]
    assert merged(stores) == (
        StoreCommand(4, b"aa"),
        Scatter((8, 20), b"bc"),
        Mask(2, 1, 2),
        StoreCommand(6, b"d"),
    )


def test_a_mask_is_not_merged() -> None:
    command = (StoreCommand(8, b"ab"), Mask(10, 1, 2))
    assert merged(command) == command


@pytest.mark.parametrize(
    ("word", "and_mask", "or_mask", "result"),
    [(0x12, 0xF2, 0x25, 0x17), (0xFFFF, 0, 0x1234, 0x1234), (0xABCD, 0xFFFF, 0, 0xABCD)],
)
def test_mask_follows_the_formula_of_the_specification(
    word: int, and_mask: int, or_mask: int, result: int
) -> None:
    assert Mask(0, and_mask, or_mask).applied_to(word) == result
