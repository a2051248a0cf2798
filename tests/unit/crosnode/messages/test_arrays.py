"""Any way to give numbers gives the bytes that numpy gives."""

import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.messages.arrays import PACKERS, SHORT
from crosnode.messages.definition import integer_range
from crosnode.messages.values import DTYPES

FAULTS = (TypeError, ValueError, OverflowError, LookupError, struct.error)


def packed(base: str, values: Any, length: int | None = None) -> bytes:
    pieces: list[Any] = []
    if length is None:
        PACKERS[base].variable(values, pieces.append)
    else:
        PACKERS[base].fixed(values, length, pieces.append)
    return b"".join(pieces)


bases = st.sampled_from(sorted(DTYPES))


@given(st.data(), bases)
def test_lists_tuples_and_arrays(data: st.DataObject, base: str) -> None:
    if base == "bool":
        numbers: st.SearchStrategy[Any] = st.booleans()
    elif base.startswith("float"):
        numbers = st.floats(width=32)
    else:
        numbers = st.integers(*integer_range(base))
    values = data.draw(st.lists(numbers, max_size=2 * SHORT))
    plain = np.array(values, DTYPES[base]).tobytes()
    counted = struct.pack("<I", len(values)) + plain
    for given_values in (values, tuple(values), np.array(values, DTYPES[base]), iter(values)):
        assert packed(base, given_values) == counted
    for given_values in (values, tuple(values), np.array(values, DTYPES[base])):
        assert packed(base, given_values, len(values)) == plain


def test_bytes_are_numbers_of_eight_bits() -> None:
    assert packed("uint8", b"\x01\xff") == b"\2\0\0\0\x01\xff"
    assert packed("char", b"\x01\xff", 2) == b"\x01\xff"
    with pytest.raises(FAULTS):
        packed("uint16", b"\x01\xff")


@pytest.mark.parametrize(
    ("base", "values"),
    [
        ("uint8", [256]),
        ("int32", [1.5]),
        ("float32", [1e39]),
        ("float64", ["1"]),
        ("bool", [2]),
        ("uint8", "abc"),
        ("float64", None),
        ("uint8", np.array([300])),
        ("int8", np.zeros((2, 2), np.int8)),
    ],
)
def test_what_does_not_fit(base: str, values: object) -> None:
    with pytest.raises(FAULTS):
        packed(base, values)


def test_a_fixed_array_has_its_length() -> None:
    for values in ([1, 2], (1, 2), np.array([1, 2], np.int8)):
        with pytest.raises(FAULTS):
            packed("int8", values, 3)
