"""Arrays of numbers to bytes: lists by struct, which is faster for short ones, others by numpy."""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from crosnode.messages.values import DTYPES, coerce_array

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.messages.values import Array

SHORT: Final = 64
"""Elements; the format of a shorter list is kept."""

CODES: Final = {
    "bool": "B",
    "byte": "b",
    "char": "B",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float32": "f",
    "float64": "d",
}
"""Formats of struct for numbers; a bool is written as a number and read as one."""

NUMBERS: Final = {True: 1, False: 0}
"""What may stand for a bool, 0, 1 and numpy's included."""

EMPTY: Final = {base: np.zeros(0, dtype) for base, dtype in DTYPES.items()}

_COUNT: Final = Struct("<I").pack


class ArrayPacker:
    """Writes the values of fields of one type of number.

    Args:
        base: the type.
    """

    def __init__(self, base: str) -> None:
        self._base = base
        self._dtype = DTYPES[base]
        self._code = CODES[base]
        self._counted: list[Callable[..., bytes] | None] = [None] * SHORT

    def variable(self, values: Any, add: Callable[[Any], None]) -> None:
        """Write the number of elements and the elements.

        Raises:
            TypeError, ValueError, OverflowError, struct.error: elements that do not fit; which of
                them is for the caller to find.
        """
        kind = type(values)
        if kind is list or kind is tuple:
            size = len(values)
            if self._base == "bool":
                values = [NUMBERS[value] for value in values]
            add(self._list_packer(size)(size, *values))
        elif kind is bytes and self._dtype.itemsize == 1 and self._base != "bool":
            add(_COUNT(len(values)))
            add(values)
        else:
            array = self._array(None, values)
            add(_COUNT(len(array)))
            add(array.data if len(array) else b"")

    def fixed(self, values: Any, length: int, add: Callable[[Any], None]) -> None:
        """Write exactly ``length`` elements; raises as ``variable`` does."""
        if type(values) is list and len(values) == length and self._base != "bool":
            add(Struct(f"<{length}{self._code}").pack(*values))
        else:
            add(self._array(length, values).tobytes())

    def _list_packer(self, size: int) -> Callable[..., bytes]:
        if size >= SHORT:
            return Struct(f"<I{size}{self._code}").pack
        packer = self._counted[size]
        if packer is None:
            packer = self._counted[size] = Struct(f"<I{size}{self._code}").pack
        return packer

    def _array(self, length: int | None, values: Any) -> Array:
        return coerce_array(self._base, length, values)


PACKERS: Final = {base: ArrayPacker(base) for base in DTYPES}
