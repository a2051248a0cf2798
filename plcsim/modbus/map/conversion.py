"""One value between the bytes of a variable and the bytes of its registers."""

from __future__ import annotations

import math
import struct
from functools import cache
from typing import TYPE_CHECKING

from plcsim.modbus.map.errors import IllegalValue
from st_types.types.elementary import INTEGER_RANGES

if TYPE_CHECKING:
    from plcsim.modbus.map.point import Point


@cache
def wire_order(size: int, order: str) -> tuple[int, ...]:
    """Return for each byte on the wire its index in the big-endian value.

    ABCD is big-endian; CDAB has the low word first; BADC swaps the bytes of each word; DCBA does
    both. Each of them undoes itself.
    """
    indices = list(range(size))
    if order in ("CDAB", "DCBA"):
        words = [indices[i : i + 2] for i in range(0, size, 2)]
        indices = [index for word in reversed(words) for index in word]
    if order in ("BADC", "DCBA"):
        indices = [indices[i ^ 1] for i in range(size)]
    return tuple(indices)


def _ordered(data: bytes, order: str) -> bytes:
    if order == "ABCD":
        return data
    return bytes(data[i] for i in wire_order(len(data), order))


def _ordered_text(data: bytes, order: str) -> bytes:
    """Swap the two characters of each register for BADC and DCBA; text has no low word."""
    if order in ("ABCD", "CDAB"):
        return data
    return bytes(data[i ^ 1] for i in range(len(data)))


def to_registers(point: Point, data: bytes) -> bytes:
    """Return the bytes on the wire for the bytes of a variable.

    A number that the type on the wire cannot hold shows the nearest one that it can.
    """
    if point.kind == "s":
        text = data.split(b"\0", 1)[0][: 2 * point.registers]
        return _ordered_text(text.ljust(2 * point.registers, b"\0"), point.order)
    (value,) = struct.unpack("<" + point.code, data)
    if point.kind == "?":
        return _ordered(b"\0\1" if value else b"\0\0", point.order)
    if point.is_scaled:
        value = (value - point.offset_eu) / point.scale
    return _ordered(_packed(point.kind, value), point.order)


def _packed(kind: str, value: float) -> bytes:
    if kind in "fd":
        try:
            return struct.pack(">" + kind, value)
        except OverflowError:
            return struct.pack(">" + kind, math.copysign(math.inf, value))
    low, high = INTEGER_RANGES[kind]
    if math.isnan(value):
        return struct.pack(">" + kind, 0)
    if not low <= value <= high:
        return struct.pack(">" + kind, low if value < low else high)
    return struct.pack(">" + kind, round(value))


def from_registers(point: Point, data: bytes) -> bytes:
    """Return the bytes of the variable for the bytes on the wire.

    Raises:
        IllegalValue: the variable cannot hold the value, or it is outside the limits of the row.
    """
    if point.kind == "s":
        text = _ordered_text(data, point.order).split(b"\0", 1)[0]
        if len(text) > point.size - 1:
            raise IllegalValue(f"{point.tag}: {len(text)} characters are too many")
        return text.ljust(point.size, b"\0")
    wire = _ordered(data, point.order)
    if point.kind == "?":
        return b"\1" if any(wire) else b"\0"
    (value,) = struct.unpack(">" + point.kind, wire)
    if point.is_plain and not point.is_limited:
        if point.kind in "fd" and not math.isfinite(value):
            raise IllegalValue(f"{point.tag}: {value} is not a finite number")
        return wire[::-1]
    return _checked(point, value)


def _checked(point: Point, value: float) -> bytes:
    """Return the bytes of a value from the wire, scaled, within limits, as the variable's type."""
    if point.is_scaled:
        value = value * point.scale + point.offset_eu
    if not math.isfinite(value):
        raise IllegalValue(f"{point.tag}: {value} is not a finite number")
    if point.is_plain and point.code not in "fd":  # signed or unsigned as the variable is
        (value,) = struct.unpack("<" + point.code, struct.pack("<" + point.kind, value))
    if (point.minimum is not None and value < point.minimum) or (
        point.maximum is not None and value > point.maximum
    ):
        raise IllegalValue(f"{point.tag}: {value} is outside its limits")
    if point.values and value not in point.values:
        raise IllegalValue(f"{point.tag}: {value} is none of its values")
    return _stored(point, value)


def _stored(point: Point, value: float) -> bytes:
    if point.code == "?":
        return b"\1" if value else b"\0"
    if point.code not in "fd":
        low, high = INTEGER_RANGES[point.code]
        if not low <= round(value) <= high:
            raise IllegalValue(f"{point.tag}: {value} does not fit the variable")
        value = round(value)
    try:
        return struct.pack("<" + point.code, value)
    except OverflowError:
        raise IllegalValue(f"{point.tag}: {value} does not fit the variable") from None
