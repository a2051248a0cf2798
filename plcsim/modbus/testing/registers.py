"""What an HMI makes of the registers of a tag, and of a value that its operator enters.

This is the other side of `plcsim.modbus.map.conversion`, written from the table in docs/modbus.md:
an HMI does not know the variable, only type, order and scale.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

from plcsim.modbus.map.conversion import wire_order
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from plcsim.modbus.map.point import Point

__tracebackhide__ = True

_ENCODING = "latin-1"


def from_registers(point: Point, data: bytes) -> bool | float | str:
    """Return the value that the registers of a tag show, in engineering units."""
    data = _ordered(point, data)
    if point.kind == "s":
        return data.partition(b"\0")[0].decode(_ENCODING)
    if point.bit >= 0:
        return bool(int.from_bytes(data) >> point.bit & 1)
    if point.kind == "?":
        return any(data)
    value: float = struct.unpack(">" + point.kind, data)[0]
    return value * point.scale + point.offset_eu if point.is_scaled else value


def to_registers(point: Point, value: bool | float | str) -> bytes:
    """Return the registers for a value in engineering units.

    Raises:
        PlcTestError: they cannot hold it.
    """
    try:
        return _ordered(point, _encoded(point, value))
    except (struct.error, ValueError, TypeError, OverflowError) as error:
        raise PlcTestError(
            f"{point.tag}: {value!r} does not fit its {point.registers} registers: {error}"
        ) from None


def _encoded(point: Point, value: bool | float | str) -> bytes:
    """Return a value as big-endian bytes."""
    size = 2 * point.registers
    if point.kind == "s":
        text = str(value).encode(_ENCODING)
        if len(text) > size:
            raise ValueError(f"{len(text)} characters")
        return text.ljust(size, b"\0")
    if point.kind == "?":
        return struct.pack(">H", bool(value))
    if isinstance(value, str):
        raise TypeError("a number is needed")
    raw = (value - point.offset_eu) / point.scale if point.is_scaled else value
    return struct.pack(">" + point.kind, raw if point.kind in "fd" else round(raw))


def _ordered(point: Point, data: bytes) -> bytes:
    """Put bytes into the point's order, or back: each order undoes itself."""
    if point.kind == "s":  # a text has no low word, but its registers may have their bytes swapped
        swapped = point.order in ("BADC", "DCBA")
        return b"".join(
            data[i : i + 2][::-1] if swapped else data[i : i + 2] for i in range(0, len(data), 2)
        )
    return bytes(data[index] for index in wire_order(len(data), point.order))
