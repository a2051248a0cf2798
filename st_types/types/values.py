"""Values to bytes and back, and the initial image of a variable.

STRING holds one byte a character; Latin-1 maps every byte to one character and back, so nothing is
lost. A STRING longer than its type is cut to the declared length, as an assignment on the
controller cuts it.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from functools import singledispatch
from typing import TYPE_CHECKING

from st_types.errors import ValueRangeError
from st_types.types.derived import (
    AliasType,
    ArrayType,
    EnumerationType,
    ReferenceType,
    StringType,
    StructType,
    SubrangeType,
    UnionType,
    WStringType,
)
from st_types.types.elementary import UDINT, ElementaryType, Kind

if TYPE_CHECKING:
    from st_types.types.elementary import DataType


def encode_string(text: str | bytes, length: int) -> bytes:
    """Return at most ``length`` bytes of ``text``, up to its first NUL, without a terminator.

    Raises:
        ValueRangeError: a character is not in Latin-1.
    """
    if isinstance(text, str):
        try:
            text = text.encode("latin-1")
        except UnicodeEncodeError as err:
            raise ValueRangeError(
                f"STRING cannot hold {text[err.start]!r}: one byte a character (Latin-1)."
            ) from None
    return text[:length].split(b"\0", 1)[0]


def encode_wstring(text: str, length: int) -> bytes:
    """Return at most ``length`` UTF-16 units of ``text``, up to its first NUL, no terminator."""
    data = text.split("\0", 1)[0].encode("utf-16-le", "surrogatepass")
    return data[: 2 * length]


def decode_wstring(data: bytes) -> str:
    """Return the text of UTF-16 units up to the first NUL."""
    units = memoryview(data).cast("H").tolist()
    end = units.index(0) if 0 in units else len(units)
    return data[: 2 * end].decode("utf-16-le", "surrogatepass")


@singledispatch
def encode(data_type: DataType[object], value: object) -> bytes:
    """Return ``data_type.size`` bytes for ``value``; None gives the initial value of the type.

    Args:
        data_type: any type of this package.
        value: bool, int, float, str, bytes, a mapping of members for a STRUCT, a sequence for an
            ARRAY (elements that are not given take the initial value).

    Raises:
        ValueRangeError: the value is of the wrong kind or does not fit; the message says where.
    """
    raise TypeError(f"{data_type} has no values.")


@encode.register
def _elementary(data_type: ElementaryType, value: object) -> bytes:  # type: ignore[type-arg]  # singledispatch dispatches on the bare class
    if data_type.kind is Kind.BOOL:
        if value not in (None, False, True):
            raise ValueRangeError(f"{value!r} is not a BOOL.")
        return b"\1" if value else b"\0"
    if data_type.kind is Kind.REAL:
        return _encode_real(data_type, value)
    return _encode_integer(data_type, value, data_type.minimum, data_type.maximum)


def _encode_real(data_type: ElementaryType[float], value: object) -> bytes:
    if not isinstance(value, int | float | None):
        raise ValueRangeError(f"{value!r} is not a {data_type}.")
    try:
        return struct.pack("<" + data_type.code, 0 if value is None else value)
    except (OverflowError, struct.error):
        raise ValueRangeError(f"{value!r} is too large for a {data_type}.") from None


def _encode_integer(
    data_type: ElementaryType[int], value: object, minimum: int, maximum: int
) -> bytes:
    if value is None:
        value = min(max(0, minimum), maximum)
    if not isinstance(value, int):
        raise ValueRangeError(f"{value!r} is not a {data_type}.")
    if not minimum <= value <= maximum:
        raise ValueRangeError(f"{value} is outside {minimum}..{maximum} of {data_type}.")
    return struct.pack("<" + data_type.code, value)


@encode.register
def _subrange(data_type: SubrangeType, value: object) -> bytes:
    return _encode_integer(data_type.base, value, data_type.minimum, data_type.maximum)


@encode.register
def _enumeration(data_type: EnumerationType, value: object) -> bytes:  # type: ignore[type-arg]  # singledispatch dispatches on the bare class
    if value is None:
        value = next(iter(data_type.values.values()))
    if isinstance(value, str):
        if value not in data_type.values:
            raise ValueRangeError(f"{value} is not a value of {data_type}.")
        value = data_type.values[value]
    return _encode_integer(data_type.base, value, data_type.base.minimum, data_type.base.maximum)


@encode.register
def _reference(_data_type: ReferenceType, value: object) -> bytes:
    return _encode_integer(UDINT, value, UDINT.minimum, UDINT.maximum)


@encode.register
def _string(data_type: StringType, value: object) -> bytes:
    if not isinstance(value, str | bytes | None):
        raise ValueRangeError(f"{value!r} is not a {data_type}.")
    return encode_string(value or b"", data_type.length).ljust(data_type.size, b"\0")


@encode.register
def _wstring(data_type: WStringType, value: object) -> bytes:
    if not isinstance(value, str | None):
        raise ValueRangeError(f"{value!r} is not a {data_type}.")
    return encode_wstring(value or "", data_type.length).ljust(data_type.size, b"\0")


@encode.register
def _alias(data_type: AliasType, value: object) -> bytes:  # type: ignore[type-arg]  # singledispatch dispatches on the bare class
    return encode(data_type.target, data_type.initial if value is None else value)


@encode.register
def _array(data_type: ArrayType, value: object) -> bytes:  # type: ignore[type-arg]  # singledispatch dispatches on the bare class
    if value is None:
        return encode(data_type.element, None) * data_type.count
    if isinstance(value, bytes) and data_type.element.size == 1:
        value = list(value)
    if not isinstance(value, Sequence) or isinstance(value, str):
        raise ValueRangeError(f"{value!r} is not a list of values for {data_type}.")
    if len(value) > data_type.count:
        raise ValueRangeError(f"{len(value)} values are too many for {data_type}.")
    given = _packed(data_type.element, value)
    if given is None:
        given = b"".join(_named(f"[{i}]", data_type.element, v) for i, v in enumerate(value))
    return given + encode(data_type.element, None) * (data_type.count - len(value))


def _packed(element: DataType[object], values: Sequence[object]) -> bytes | None:
    """Return numbers as bytes in one go, None where each of them needs a look."""
    if not isinstance(element, ElementaryType) or not values:
        return None
    kinds = set(map(type, values))
    if element.kind is Kind.BOOL:
        return bytes(values) if kinds == {bool} else None  # type: ignore[arg-type]  # all are bool
    if not kinds <= ({int, float} if element.kind is Kind.REAL else {int}):
        return None
    try:
        return struct.pack(f"<{len(values)}{element.code}", *values)
    except (OverflowError, struct.error):
        return None


@encode.register
def _struct(data_type: StructType, value: object) -> bytes:  # type: ignore[type-arg]  # singledispatch dispatches on the bare class
    given = {} if value is None else value
    if not isinstance(given, Mapping):
        raise ValueRangeError(f"{value!r} is not a mapping of members of {data_type}.")
    image = bytearray(data_type.size)
    left = dict(given)
    is_union = isinstance(data_type, UnionType)
    for number, (member, offset) in enumerate(
        zip(data_type.members, data_type.offsets, strict=True)
    ):
        if is_union and number and member.name not in left:
            continue
        value = left.pop(member.name, member.initial)
        data = _named(f".{member.name}", member.data_type, value)
        image[offset : offset + len(data)] = data
    if left:
        raise ValueRangeError(f"{data_type} has no member {next(iter(left))}.")
    return bytes(image)


def _named(path: str, data_type: DataType[object], value: object) -> bytes:
    try:
        return encode(data_type, value)
    except ValueRangeError as err:
        text = str(err)
        glue = "" if text.startswith((".", "[")) else ": "
        raise ValueRangeError(f"{path}{glue}{text}") from None


def initial_image(data_type: DataType[object]) -> bytes:
    """Return the bytes of a variable of ``data_type`` after a restart."""
    return encode(data_type, None)


def decode(data_type: DataType[object], data: bytes) -> object:
    """Return the plain Python value of ``data_type.size`` bytes.

    STRUCTs become dicts, ARRAYs flat lists with the last index running fastest, enumerations ints.
    """
    match data_type:
        case ElementaryType(kind=Kind.BOOL):
            return data != b"\0"
        case ElementaryType(code=code):
            return struct.unpack("<" + code, data)[0]
        case ReferenceType():
            return struct.unpack("<I", data)[0]
        case SubrangeType(base=base) | EnumerationType(base=base):
            return decode(base, data)
        case AliasType(target=target):
            return decode(target, data)
        case StringType():
            return data.split(b"\0", 1)[0].decode("latin-1")
        case WStringType():
            return decode_wstring(data)
        case ArrayType(element=ElementaryType(kind=kind, code=code), count=count):
            return list(struct.unpack(f"<{count}{'?' if kind is Kind.BOOL else code}", data))
        case ArrayType(element=element):
            return [
                decode(element, data[i * element.size : (i + 1) * element.size])
                for i in range(data_type.count)
            ]
        case StructType(members=members, offsets=offsets):
            return {
                m.name: decode(m.data_type, data[at : at + m.data_type.size])
                for m, at in zip(members, offsets, strict=True)
            }
    raise TypeError(f"{data_type} has no values.")
