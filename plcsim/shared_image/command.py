"""A command: stores into PLC memory that are applied together in one LATCH, or not at all."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, NamedTuple

from st_types.layout import align_up

if TYPE_CHECKING:
    from collections.abc import Iterable

HEAD = struct.Struct("<II")
"""Bytes of the record, itself and padding included; number of operations, 0 for filling."""

_OPERATION = struct.Struct("<IHH")
_MASK = struct.Struct("<HH")
_STORE, _MASKED = 0, 1

MAX_OPERATIONS = 2048
"""Of one command; a Modbus request writes 1,968 coils at most."""


class Store(NamedTuple):
    """Store ``data`` at a PLC address."""

    address: int
    data: bytes


class Mask(NamedTuple):
    """Set a 16-bit word to ``(word AND and_mask) OR (or_mask AND NOT and_mask)``, in the scan.

    This is Modbus function 22 (MODBUS Application Protocol V1.1b3, 6.16).
    """

    address: int
    and_mask: int
    or_mask: int

    def applied_to(self, word: int) -> int:
        """Return the new value of the word."""
        return (word & self.and_mask) | (self.or_mask & ~self.and_mask & 0xFFFF)


Command = tuple[Store | Mask, ...]


def merged(stores: Iterable[Store | Mask]) -> Command:
    """Return the same operations with stores at adjoining addresses made one."""
    result: list[Store | Mask] = []
    for operation in stores:
        last = result[-1] if result else None
        if (
            isinstance(operation, Store)
            and isinstance(last, Store)
            and last.address + len(last.data) == operation.address
        ):
            result[-1] = Store(last.address, last.data + operation.data)
        else:
            result.append(operation)
    return tuple(result)


def encode_command(command: Command) -> bytes:
    """Return the record of a command, a multiple of 8 bytes long."""
    parts = [b""]
    for operation in command:
        if isinstance(operation, Store):
            kind, data = _STORE, operation.data
        else:
            kind, data = _MASKED, _MASK.pack(operation.and_mask, operation.or_mask)
        parts.append(_OPERATION.pack(operation.address, len(data), kind) + data)
    body = b"".join(parts)
    size = align_up(HEAD.size + len(body), 8)
    return HEAD.pack(size, len(command)) + body.ljust(size - HEAD.size, b"\0")


def decode_command(record: bytes) -> Command:
    """Return the command of a record.

    Raises:
        ValueError: the record makes no sense.
    """
    size, count = HEAD.unpack_from(record)
    if size != len(record) or count > MAX_OPERATIONS:
        raise ValueError(f"record of {size} bytes with {count} operations")
    at = HEAD.size
    operations: list[Store | Mask] = []
    for _ in range(count):
        if at + _OPERATION.size > size:
            raise ValueError("record ends inside an operation")
        address, length, kind = _OPERATION.unpack_from(record, at)
        at += _OPERATION.size
        operations.append(_operation(address, kind, record[at : at + length], length))
        at += length
    return tuple(operations)


def _operation(address: int, kind: int, data: bytes, length: int) -> Store | Mask:
    if len(data) != length:
        raise ValueError("record ends inside its data")
    if kind == _STORE:
        return Store(address, data)
    if kind == _MASKED and length == _MASK.size:
        return Mask(address, *_MASK.unpack(data))
    raise ValueError(f"operation of kind {kind} with {length} bytes")
