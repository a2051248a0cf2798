"""UDP of a run that is recorded, and of one that is replayed.

As in `plcsim.recorder.journal.network`; the letters of the calls are those of TCP, in capitals.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.network import Address, Datagram, OptionValue, Outcome, Sent
from plcsim.network.protocol import NO_ADDRESS
from plcsim.recorder.journal.answers import (
    I64,
    NOTHING,
    OUTCOMES,
    U32,
    address_from,
    address_text,
    heads,
    i64_from,
    u32_from,
)

if TYPE_CHECKING:
    from plcsim.network import DatagramSocket, Option
    from plcsim.recorder.journal.feed import Feed

_CONNECT, _DISCONNECT, _SEND, _RECV = map(heads, (b"C", b"D", b"S", b"R"))
_SET_OPTION, _OPTION = map(heads, (b"T", b"P"))
_LOCAL, _PEER, _CLOSE = b"H", b"E", b"X"

OPEN: Final = b"O"
"""The call `DatagramNetwork.open_datagrams`."""


class RecordedDatagrams:
    """A port whose answers go into the journal; for what its calls do see `DatagramSocket`."""

    def __init__(self, socket: DatagramSocket, answers: bytearray) -> None:
        self._socket = socket
        self._answers = answers

    @property
    def local(self) -> Address:
        """See `DatagramSocket`."""
        value = self._socket.local
        self._answers += _LOCAL + NOTHING + address_text(value)
        return value

    @property
    def peer(self) -> Address | None:
        """See `DatagramSocket`."""
        value = self._socket.peer
        self._answers += _PEER + NOTHING + address_text(value)
        return value

    def connect(self, peer: Address) -> Outcome:
        """See `DatagramSocket`."""
        outcome = self._socket.connect(peer)
        self._answers += _CONNECT[outcome]
        return outcome

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

    def set_option(self, option: Option, value: int) -> Outcome:
        """See `DatagramSocket`."""
        outcome = self._socket.set_option(option, value)
        self._answers += _SET_OPTION[outcome]
        return outcome

    def option(self, option: Option) -> OptionValue:
        """See `DatagramSocket`."""
        answer = self._socket.option(option)
        self._answers += _OPTION[answer.outcome] + I64.pack(answer.value)
        return answer

    def close(self) -> None:
        """See `DatagramSocket`."""
        self._socket.close()
        self._answers += _CLOSE + NOTHING


class ReplayDatagrams:
    """A port that answers what was recorded."""

    def __init__(self, feed: Feed) -> None:
        self._feed = feed

    def _outcome(self, call: bytes) -> Outcome:
        return OUTCOMES[self._feed.answer(call)]

    @property
    def local(self) -> Address:
        """See `DatagramSocket`."""
        self._feed.answer(_LOCAL)
        return address_from(self._feed) or NO_ADDRESS

    @property
    def peer(self) -> Address | None:
        """See `DatagramSocket`."""
        self._feed.answer(_PEER)
        return address_from(self._feed)

    def connect(self, peer: Address) -> Outcome:
        """See `DatagramSocket`."""
        return self._outcome(b"C")

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

    def set_option(self, option: Option, value: int) -> Outcome:
        """See `DatagramSocket`."""
        return self._outcome(b"T")

    def option(self, option: Option) -> OptionValue:
        """See `DatagramSocket`."""
        return OptionValue(self._outcome(b"P"), i64_from(self._feed))

    def close(self) -> None:
        """See `DatagramSocket`."""
        self._feed.answer(_CLOSE)
