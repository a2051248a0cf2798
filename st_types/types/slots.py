"""How one value that is not a STRUCT or ARRAY is stored: its ctypes type and its conversions."""

from __future__ import annotations

import ctypes
from operator import index
from typing import TYPE_CHECKING, Any, NamedTuple

from st_types.errors import ValueRangeError
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    ReferenceType,
    StringType,
    StructType,
    SubrangeType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import DataType, ElementaryType, Kind
from st_types.types.values import decode_wstring, encode_string, encode_wstring

if TYPE_CHECKING:
    from collections.abc import Callable


class Slot(NamedTuple):
    """``load`` and ``store`` are None where ctypes itself converts."""

    ctype: Any
    load: Callable[[Any], object] | None = None
    store: Callable[[Any], object] | None = None


_CTYPES = {
    "b": ctypes.c_int8,
    "B": ctypes.c_uint8,
    "h": ctypes.c_int16,
    "H": ctypes.c_uint16,
    "i": ctypes.c_int32,
    "I": ctypes.c_uint32,
    "q": ctypes.c_int64,
    "Q": ctypes.c_uint64,
    "f": ctypes.c_float,
    "d": ctypes.c_double,
}


def slot_of(data_type: DataType[object]) -> Slot | None:
    """Return how a value is stored, None for the types that are views themselves."""
    match resolve_alias(data_type):
        case StructType() | ArrayType():
            return None
        case ElementaryType(kind=Kind.BOOL):
            return Slot(ctypes.c_bool)
        case ElementaryType(code=code):
            return Slot(_CTYPES[code])
        case SubrangeType(base=base):
            return Slot(_CTYPES[base.code])
        case ReferenceType():
            return Slot(ctypes.c_uint32)
        case EnumerationType() as enumeration:
            return _enumeration_slot(enumeration)
        case StringType(length=length):
            return _string_slot(length)
        case WStringType(length=length):
            return _wstring_slot(length)
    raise TypeError(f"{data_type} cannot be stored.")


def _enumeration_slot(data_type: EnumerationType[Any]) -> Slot:
    if data_type.members is None:
        return Slot(_CTYPES[data_type.base.code])
    by_value: dict[int, object] = {int(m): m for m in data_type.members}

    def store(value: object) -> int:
        try:
            return index(value)  # type: ignore[arg-type]  # what is no integer raises
        except TypeError:
            raise TypeError(f"{value!r} is not a {data_type}.") from None

    return Slot(_CTYPES[data_type.base.code], lambda raw: by_value.get(raw, raw), store)


def _string_slot(length: int) -> Slot:
    def store(value: str | bytes) -> bytes:
        if not isinstance(value, str | bytes):
            raise ValueRangeError(f"{value!r} is not a STRING.")
        return encode_string(value, length)

    return Slot(ctypes.c_char * (length + 1), lambda raw: raw.decode("latin-1"), store)


def _wstring_slot(length: int) -> Slot:
    units = ctypes.c_uint16 * (length + 1)

    def store(value: str) -> object:
        if not isinstance(value, str):
            raise ValueRangeError(f"{value!r} is not a WSTRING.")
        data = encode_wstring(value, length)
        return units.from_buffer_copy(data.ljust(2 * (length + 1), b"\0"))

    return Slot(units, lambda raw: decode_wstring(bytes(raw)), store)
