"""Values of builtin types: time and duration, checks of scalars, coercion of arrays."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from crosnode.messages.definition import INTEGERS, integer_range
from crosnode.messages.text import bytes_of

NS_PER_S: Final = 1_000_000_000

Array = npt.NDArray[Any]

DTYPES: Final[dict[str, np.dtype[Any]]] = {
    name: np.dtype({"byte": "int8", "char": "uint8"}.get(name, name))
    for name in ("bool", "float32", "float64", *INTEGERS)
}
"""The element type of an array of each numeric builtin; byte is signed, char is not."""


@dataclass(slots=True, order=True)
class Time:
    """A ROS 1 time: unsigned seconds and nanoseconds since the epoch of the clock."""

    secs: int = 0
    nsecs: int = 0

    @classmethod
    def from_ns(cls, time_ns: int) -> Time:
        """Make a time of nanoseconds."""
        return cls(*divmod(time_ns, NS_PER_S))

    def to_ns(self) -> int:
        """Return nanoseconds."""
        return self.secs * NS_PER_S + self.nsecs


@dataclass(slots=True)
class Duration:
    """A ROS 1 duration: signed seconds, and nanoseconds that count upwards from them."""

    secs: int = 0
    nsecs: int = 0

    @classmethod
    def from_ns(cls, duration_ns: int) -> Duration:
        """Make a duration of nanoseconds, which may be negative."""
        return cls(*divmod(duration_ns, NS_PER_S))

    def to_ns(self) -> int:
        """Return nanoseconds."""
        return self.secs * NS_PER_S + self.nsecs


def check_scalar(primitive: str, value: object) -> None:
    """Check that ``value`` fits a primitive.

    Raises:
        TypeError: it is of a wrong type.
        ValueError: it is out of range, or a text that stands for no bytes.
    """
    if primitive == "string":
        if not isinstance(value, str):
            raise TypeError(f"expected a string, got {_kind(value)}")
        bytes_of(value)
    elif primitive == "bool":
        if not isinstance(value, (bool, np.bool_)) and value not in (0, 1):
            raise TypeError(f"expected a bool, got {_kind(value)}")
    elif primitive.startswith("float"):
        _check_float(primitive, value)
    else:
        _check_integer(primitive, value)


def _check_integer(primitive: str, value: object) -> None:
    low, high = integer_range(primitive)
    if not hasattr(value, "__index__"):
        raise TypeError(f"expected an integer, got {_kind(value)}")
    if not low <= operator.index(value) <= high:
        raise ValueError(f"{value} is out of range of {primitive}")


def _check_float(primitive: str, value: object) -> None:
    if not isinstance(value, (int, float, np.number, np.bool_)):
        raise TypeError(f"expected a number, got {_kind(value)}")
    number = float(value)
    if primitive == "float32" and np.isfinite(number) and abs(number) >= FLOAT32_LIMIT:
        raise ValueError(f"{value} is out of range of float32")


FLOAT32_LIMIT: Final = float(2**128 - 2**103)
"""Half a step above the greatest float32: from here on rounding gives infinity."""


def _kind(value: object) -> str:
    return f"{type(value).__name__} {str(value)[:40]!r}"


def coerce_array(primitive: str, length: int | None, value: object) -> Array:
    """Return ``value`` as a contiguous one-dimensional array of exactly the element type.

    An array that is so already is returned as it is. Lists, tuples, other arrays and buffers are
    converted where no value changes but by rounding of floats; bytes become 8-bit elements.

    Args:
        primitive: numeric builtin of the elements.
        length: elements of a fixed array, or None.
        value: the value of the field.

    Raises:
        TypeError: elements of a wrong type, or not a sequence.
        ValueError: elements out of range, wrong length or shape.
    """
    dtype = DTYPES[primitive]
    if type(value) is not np.ndarray or value.dtype != dtype:
        value = _converted(primitive, dtype, value)
    if value.ndim != 1:
        raise ValueError(f"expected a one-dimensional array, got {value.ndim} dimensions")
    if length is not None and len(value) != length:
        raise ValueError(f"expected {length} elements, got {len(value)}")
    return value if value.flags.c_contiguous else np.ascontiguousarray(value)


def _converted(primitive: str, dtype: np.dtype[Any], value: object) -> Array:
    if isinstance(value, (bytes, bytearray, memoryview)) and dtype.itemsize == 1:
        return np.frombuffer(bytes(value), dtype)
    if isinstance(value, np.ndarray):
        return _cast(primitive, dtype, value)
    if isinstance(value, (str, bytes, bytearray, memoryview)) or not isinstance(value, Iterable):
        raise TypeError(f"expected a sequence, got {_kind(value)}")
    elements = list(value)
    for element in elements:
        check_scalar(primitive, element)
    return np.array(elements, dtype)


def _cast(primitive: str, dtype: np.dtype[Any], value: Array) -> Array:
    if value.dtype.kind not in "biuf":
        raise TypeError(f"expected {primitive} elements, got {value.dtype}")
    with np.errstate(all="ignore"):
        result: Array = value.astype(dtype)
    if dtype.kind != "f" and not np.array_equal(result, value):
        raise ValueError(f"elements of {value.dtype} are out of range of {primitive}")
    if dtype.kind == "f" and np.any(np.isinf(result) & np.isfinite(value)):
        raise ValueError(f"elements of {value.dtype} are out of range of {primitive}")
    return result
