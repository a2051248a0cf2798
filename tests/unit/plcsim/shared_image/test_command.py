import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.shared_image.command import (
    Command,
    Mask,
    Operation,
    Scatter,
    Store,
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
    st.builds(Store, addresses, st.binary(max_size=40))
    | st.builds(Mask, addresses, words, words)
    | scattered
)


@given(st.lists(operations, max_size=20))
def test_a_command_survives_its_record(command: list[Operation]) -> None:
    record = encode_command(tuple(command))
    assert len(record) % 8 == 0
    assert decode_command(record) == tuple(command)


@given(st.binary(min_size=8, max_size=200))
def test_any_bytes_are_a_command_or_a_value_error(record: bytes) -> None:
    try:
        command = decode_command(record)
    except ValueError:
        return
    assert encode_command(command)[8:] == record[8 : len(encode_command(command))] or command == ()


@given(st.lists(st.builds(Store, st.integers(0, 64), st.binary(min_size=1, max_size=8))))
def test_merging_does_not_change_what_is_stored(stores: list[Store]) -> None:
    def image(command: Command) -> bytearray:
        memory = bytearray(80)
        for operation in command:
            if isinstance(operation, Scatter):
                for address, value in zip(operation.addresses, operation.data, strict=True):
                    memory[address] = value
                continue
            assert isinstance(operation, Store)
            memory[operation.address : operation.address + len(operation.data)] = operation.data
        return memory

    assert image(merged(stores)) == image(tuple(stores))


def test_adjoining_stores_become_one() -> None:
    assert merged([Store(8, b"ab"), Store(10, b"c"), Store(12, b"d")]) == (
        Store(8, b"abc"),
        Store(12, b"d"),
    )


def test_single_bytes_that_follow_each_other_become_one() -> None:
    stores = [Store(4, b"aa"), Store(8, b"b"), Store(20, b"c"), Mask(2, 1, 2), Store(6, b"d")]
    assert merged(stores) == (
        Store(4, b"aa"),
        Scatter((8, 20), b"bc"),
        Mask(2, 1, 2),
        Store(6, b"d"),
    )


def test_a_mask_is_not_merged() -> None:
    command = (Store(8, b"ab"), Mask(10, 1, 2))
    assert merged(command) == command


@pytest.mark.parametrize(
    ("word", "and_mask", "or_mask", "result"),
    [(0x12, 0xF2, 0x25, 0x17), (0xFFFF, 0, 0x1234, 0x1234), (0xABCD, 0xFFFF, 0, 0xABCD)],
)
def test_mask_follows_the_formula_of_the_specification(
    word: int, and_mask: int, or_mask: int, result: int
) -> None:
    assert Mask(0, and_mask, or_mask).applied_to(word) == result
