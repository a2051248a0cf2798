"""UDP of a run that is recorded, and of one that is replayed.

As in `plcsim.recorder.journal.network`; where a call does otherwise than that of TCP its letter is
a capital.
"""

from __future__ import annotations

from typing import Final

from plcsim.network import Address, Datagram, DatagramSocket, Outcome, Sent
from plcsim.network.protocol import NO_ADDRESS
from plcsim.recorder.journal.answers import (
    U32,
    address_from,
    address_text,
    heads,
    u32_from,
)
from plcsim.recorder.journal.port import RecordedPort, ReplayPort

_DISCONNECT, _SEND, _RECV = map(heads, (b"D", b"S", b"R"))

OPEN: Final = b"O"
"""The call `DatagramNetwork.open_datagrams`."""


class RecordedDatagrams(RecordedPort[DatagramSocket]):
    """A port whose answers go into the journal; for what its calls do see `DatagramSocket`."""

    def disconnect(self) -> Outcome:
        """See `DatagramSocket`."""
        outcome = self._socket.disconnect()
        self._answers += _DISCONNECT[outcome]
        return outcome

    def send(self, data: bytes | memoryview, target: Address | None = None) -> Sent:
        """See `DatagramSocket`."""
        sent = self._socket.send(data, target)
        self._answers += _SEND[sent.outcome] + U32.pack(sent.taken)
        return sent

    def recv(self, size: int, *, peek: bool = False) -> Datagram:
        """See `DatagramSocket`."""
        found = self._socket.recv(size, peek=peek)
        self._answers += _RECV[found.outcome]
        if found.outcome is Outcome.OK:
            self._answers += address_text(found.peer) + U32.pack(len(found.data)) + found.data
        return found


class ReplayDatagrams(ReplayPort):
    """A port that answers what was recorded."""

    def disconnect(self) -> Outcome:
        """See `DatagramSocket`."""
        return self._outcome(b"D")

    def send(self, data: bytes | memoryview, target: Address | None = None) -> Sent:
        """See `DatagramSocket`."""
        return Sent(self._outcome(b"S"), u32_from(self._feed))

    def recv(self, size: int, *, peek: bool = False) -> Datagram:
        """See `DatagramSocket`."""
        outcome = self._outcome(b"R")
        if outcome is not Outcome.OK:
            return Datagram(outcome)
        peer = address_from(self._feed) or NO_ADDRESS
        return Datagram(outcome, self._feed.data(u32_from(self._feed)), peer)
