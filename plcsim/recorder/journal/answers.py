"""How answers of the network stand in the journal: a letter for the call, its outcome, values."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final

from plcsim.network import Address, Outcome

if TYPE_CHECKING:
    from plcsim.recorder.journal.feed import Feed

OUTCOMES: Final = tuple(Outcome)
U32: Final = struct.Struct("<I")
I64: Final = struct.Struct("<q")
NOTHING: Final = b"\0"
"""In the place of an outcome, of calls that have none."""


def heads(call: bytes) -> dict[Outcome, bytes]:
    """Return what an answer begins with, for each outcome of a call."""
    return {outcome: call + bytes([place]) for place, outcome in enumerate(OUTCOMES)}


def address_text(address: Address | None) -> bytes:
    """Return an address as `address_from` reads it."""
    if address is None:
        return b"\0"
    ip = address.ip.encode()
    return bytes([len(ip) + 1]) + ip + address.port.to_bytes(4, "little")


def address_from(feed: Feed) -> Address | None:
    """Read an address."""
    length = feed.data(1)[0]
    if not length:
        return None
    ip = feed.data(length - 1).decode()
    return Address(ip, u32_from(feed))


def u32_from(feed: Feed) -> int:
    """Read a number."""
    return int.from_bytes(feed.data(4), "little")


def i64_from(feed: Feed) -> int:
    """Read a number with a sign."""
    return int.from_bytes(feed.data(8), "little", signed=True)
