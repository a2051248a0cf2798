"""What a write has changed, tag by tag, from the bytes stored and those that were there before."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, NamedTuple

from plcsim.shared_image.command import Mask, Scatter, StoreCommand

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.modbus.map.point import Point
    from plcsim.shared_image.command import Operation

_ENCODING = "latin-1"


class TagChange(NamedTuple):
    """A tag that was written.

    Attributes:
        tag: path of the variable.
        value: of the variable, not scaled; of a part of one its bytes in memory, as "16#...".
        before: likewise.
    """

    tag: str
    value: bool | float | str
    before: bool | float | str


def changes(
    points: Sequence[Point], stored: Sequence[Operation], before: Sequence[Operation]
) -> list[TagChange]:
    """Return a change for each point, in order; a tag at several addresses is told once.

    Args:
        points: that the request named.
        stored: its operations.
        before: the same with what was there before (see `plcsim.shared_image.Answer`).
    """
    if len(points) == len(stored) == 1:
        (point,), (new_store,), (old_store,) = points, stored, before
        if isinstance(new_store, StoreCommand) and isinstance(
            old_store, StoreCommand
        ):  # what most requests are
            data, was = new_store.data, old_store.data
            if len(data) == point.size:
                return [TagChange(point.tag, _decoded(point, data), _decoded(point, was))]
    new, old = _bytes_of(stored, before)
    found = {
        point.address: TagChange(point.tag, _value(point, new), _value(point, old))
        for point in points
        if any(address in new for address in range(point.address, point.address + point.size))
    }
    return list(found.values())


def _bytes_of(
    stored: Sequence[Operation], before: Sequence[Operation]
) -> tuple[dict[int, int], dict[int, int]]:
    """Return the bytes by address: as stored, and as they were before the first store of each."""
    new: dict[int, int] = {}
    old: dict[int, int] = {}
    for operation, earlier in zip(stored, before, strict=True):
        match operation, earlier:
            case StoreCommand(address, data), StoreCommand(_, was):
                addresses: Sequence[int] = range(address, address + len(data))
            case Scatter(addresses, data), Scatter(_, was):
                pass
            case Mask(address), Mask(_, word):
                addresses, was = range(address, address + 2), word.to_bytes(2, "little")
                data = operation.applied_to(word).to_bytes(2, "little")
        new.update(zip(addresses, data, strict=True))
        for address, value in zip(addresses, was, strict=True):
            old.setdefault(address, value)
    return new, old


def _value(point: Point, found: dict[int, int]) -> bool | float | str:
    addresses_of_point = range(point.address, point.address + point.size)
    data = bytes(found[address] for address in addresses_of_point if address in found)
    if len(data) < point.size:
        return f"16#{data.hex().upper()}"
    return _decoded(point, data)


def _decoded(point: Point, data: bytes) -> bool | float | str:
    if point.kind == "s":
        return data.partition(b"\0")[0].decode(_ENCODING)
    value: bool | float
    (value,) = struct.unpack("<" + point.code, data)
    return value
