"""One direction of a virtual connection: from a send buffer over the net to a receive buffer."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable

MAX_PACKETS = 1024
"""Packets under way in one direction: what a peer that is silent can make the sender keep."""


class Carrier(Protocol):
    """What carries the packets of a stream: the sender's end of the connection."""

    def carry(self, size: int, arrive: Callable[[], None]) -> None:
        """Bring a packet of ``size`` bytes over (0 for the end mark), in order, then ``arrive``."""

    def packet_size(self) -> int:
        """Choose the size of the next packet, above 0 bytes."""


class Stream:
    """Bytes in order, and at most one urgent byte.

    A byte counts against ``capacity`` (the send buffer) until it lies in the receive buffer, and
    against ``window`` (the receive buffer) until it is read: both ends are bounded.

    Args:
        carrier: brings packets over.

    Attributes:
        capacity: bytes of the send buffer, chosen by the sender.
        window: bytes of the receive buffer, chosen by the receiver.
        urgent_inline: the receiver leaves urgent bytes in the stream.
        arrived: the receive buffer.
        finished: the sender has sent the end mark.
    """

    def __init__(self, carrier: Carrier) -> None:
        self.capacity = 0
        self.window = 0
        self.urgent_inline = False
        self.arrived = bytearray()
        self.finished = False
        self._cut = False
        self._urgent = b""
        self._carrier = carrier
        self._pending = bytearray()
        self._under_way = 0
        self._due = 0
        self._end_due = False
        self._urgent_at = -1

    @property
    def ended(self) -> bool:
        """True when the sender has finished and all bytes lie in the receive buffer."""
        return self._end_due and not self._pending

    @property
    def drained(self) -> bool:
        """True when no byte is left in the send buffer."""
        return not self._pending

    def write(self, data: bytes | memoryview, *, urgent: bool = False) -> int:
        """Take as many bytes as the send buffer has room for; return how many."""
        size = min(len(data), self.capacity - len(self._pending))
        taken = 0
        while taken < size and self._under_way < MAX_PACKETS:
            taken += self._send_packet(data[taken : min(size, taken + self._carrier.packet_size())])
        if urgent and taken == len(data) > 0:
            # RFC 6093: one mark per connection; a later one makes the former an ordinary byte.
            self._urgent_at = len(self._pending) - 1
        return taken

    def _send_packet(self, data: bytes | memoryview) -> int:
        self._pending += data
        self._under_way += 1
        self._carrier.carry(len(data), partial(self._arrive, len(data)))
        return len(data)

    def finish(self) -> None:
        """Send the end mark after the last byte. Repeats do nothing."""
        if not self.finished:
            self.finished = True
            self._carrier.carry(0, self._arrive_end)

    def cut_off(self) -> None:
        """Forget all that is not in the receive buffer yet; what is on the way never arrives."""
        self._cut = True
        self._pending.clear()
        self._due = 0
        self._urgent_at = -1

    def read(self, size: int, *, peek: bool = False) -> bytes:
        """Take up to ``size`` bytes from the receive buffer; none if it is empty."""
        data = bytes(self.arrived[:size])
        if not peek:
            del self.arrived[:size]
            self._move()
        return data

    def read_urgent(self, *, peek: bool = False) -> bytes:
        """Take the urgent byte, if one has arrived."""
        data = self._urgent
        if not peek:
            self._urgent = b""
        return data

    def _arrive(self, size: int) -> None:
        self._under_way -= 1
        if not self._cut:
            self._due += size
            self._move()

    def _arrive_end(self) -> None:
        self._end_due = not self._cut

    def _move(self) -> None:
        size = min(self._due, self.window - len(self.arrived))
        if size <= 0:
            return
        moved = self._pending[:size]
        del self._pending[:size]
        self._due -= size
        mark, self._urgent_at = self._urgent_at, max(-1, self._urgent_at - size)
        if 0 <= mark < size and not self.urgent_inline:
            self._urgent = bytes(moved[mark : mark + 1])
            del moved[mark]
        self.arrived += moved
