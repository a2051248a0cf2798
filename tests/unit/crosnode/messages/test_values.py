"""Time, duration, scalars and arrays."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.messages.values import (
    DTYPES,
    FLOAT32_LIMIT,
    Duration,
    Time,
    check_scalar,
    coerce_array,
)


@given(st.integers(0, (2**32) * 10**9 - 1))
def test_time_and_back(time_ns: int) -> None:
    time = Time.from_ns(time_ns)
    assert time.to_ns() == time_ns
    assert 0 <= time.nsecs < 10**9


@given(st.integers(-(2**31) * 10**9, 2**31 * 10**9 - 1))
def test_duration_and_back(duration_ns: int) -> None:
    assert Duration.from_ns(duration_ns).to_ns() == duration_ns


def test_negative_duration_counts_nanoseconds_upwards() -> None:
    assert Duration.from_ns(-1) == Duration(-1, 999_999_999)


def test_times_are_ordered() -> None:
    assert Time(1, 5) < Time(1, 6) < Time(2, 0)


@pytest.mark.parametrize(
    ("primitive", "value"),
    [
        ("string", "é"),
        ("bool", True),
        ("bool", np.bool_(False)),
        ("bool", 1),
        ("byte", -128),
        ("char", 255),
        ("uint64", 2**64 - 1),
        ("int8", np.int64(-5)),
        ("float32", 3),
        ("float32", float("inf")),
        ("float32", 3.4028235e38),
        ("float64", np.float32(1.5)),
    ],
)
def test_fits(primitive: str, value: object) -> None:
    check_scalar(primitive, value)


@pytest.mark.parametrize(
    ("primitive", "value", "reason"),
    [
        ("string", b"bytes", "expected a string"),
        ("string", "\ud800", "surrogates"),
        ("bool", "no", "expected a bool"),
        ("bool", 2, "expected a bool"),
        ("byte", 128, "out of range of byte"),
        ("char", -1, "out of range of char"),
        ("int32", 1.0, "expected an integer"),
        ("int32", "1", "expected an integer"),
        ("float32", FLOAT32_LIMIT, "out of range of float32"),
        ("float64", "1.0", "expected a number"),
        ("float64", None, "expected a number"),
    ],
)
def test_does_not_fit(primitive: str, value: object, reason: str) -> None:
    with pytest.raises((TypeError, ValueError), match=reason):
        check_scalar(primitive, value)


def test_right_array_is_kept() -> None:
    array = np.zeros(3)
    assert coerce_array("float64", 3, array) is array


@pytest.mark.parametrize(
    ("primitive", "value", "expected"),
    [
        ("float64", [1, 2.5], [1.0, 2.5]),
        ("float64", np.array([1, 2], np.int64), [1.0, 2.0]),
        ("float32", np.array([0.5]), [0.5]),
        ("float64", range(3), [0.0, 1.0, 2.0]),
        ("uint8", b"\x00\xff", [0, 255]),
        ("int8", bytearray(b"\xff"), [-1]),
        ("uint8", memoryview(b"ab"), [97, 98]),
        ("uint64", [2**64 - 1, 0], [2**64 - 1, 0]),
        ("int64", [-(2**63)], [-(2**63)]),
        ("uint8", np.array([1, 2], np.int64), [1, 2]),
        ("bool", [True, 0], [True, False]),
        ("int16", (), []),
        ("float64", np.arange(6.0)[::2], [0.0, 2.0, 4.0]),
    ],
)
def test_coerced(primitive: str, value: object, expected: list[object]) -> None:
    array = coerce_array(primitive, None, value)
    assert array.dtype == DTYPES[primitive]
    assert array.flags.c_contiguous
    assert array.tolist() == expected


@pytest.mark.parametrize(
    ("primitive", "length", "value", "reason"),
    [
        ("float64", 2, [1.0], "expected 2 elements, got 1"),
        ("uint8", None, [1.5], "expected an integer"),
        ("uint8", None, [256], "out of range"),
        ("uint8", None, np.array([256]), "out of range"),
        ("uint8", None, np.array([1.5]), "out of range"),
        ("float32", None, np.array([1e300]), "out of range"),
        ("float32", None, [1e300], "out of range"),
        ("float64", None, "text", "expected a sequence"),
        ("float64", None, 1.0, "expected a sequence"),
        ("float64", None, b"\x00", "expected a sequence"),
        ("float64", None, np.array(["a"]), "elements"),
        ("float64", None, np.zeros((2, 2)), "dimension"),
        ("float64", None, [[1.0]], "expected a number"),
    ],
)
def test_not_coerced(primitive: str, length: int | None, value: object, reason: str) -> None:
    with pytest.raises((TypeError, ValueError), match=reason):
        coerce_array(primitive, length, value)


def test_bytes_of_a_float_array_are_numbers_not_memory() -> None:
    """Int64 bits must not be taken for float64 bits."""
    assert coerce_array("float64", None, np.array([1], np.int64))[0] == 1.0
