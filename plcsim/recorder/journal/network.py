"""The network of a run that is recorded, and of one that is replayed.

An answer is a letter for the call, a byte for its outcome, and what came with it. What a program
sends is not recorded: in a replay it goes nowhere, and comes out the same.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final

from plcsim.network import Accepted, Address, Opened, OptionValue, Outcome, Received, Sent

if TYPE_CHECKING:
    from plcsim.network import Network, Option, Socket
    from plcsim.recorder.journal.feed import Feed
    from plcsim.recorder.journal.journal import Journal

_OUTCOMES: Final = tuple(Outcome)
_U32: Final = struct.Struct("<I")
_I64: Final = struct.Struct("<q")
_NONE: Final = -1


def _heads(call: bytes) -> dict[Outcome, bytes]:
    return {outcome: call + bytes([place]) for place, outcome in enumerate(_OUTCOMES)}


_OPEN, _ACCEPT, _LISTEN, _CONNECT = map(_heads, (b"o", b"a", b"l", b"c"))
_SEND, _RECV, _SHUTDOWN = map(_heads, (b"s", b"r", b"d"))
_SET_OPTION, _OPTION, _SET_LINGER = map(_heads, (b"t", b"p", b"i"))
_CLOSE, _LISTENING, _LOCAL, _PEER, _LINGER = b"x", b"n", b"h", b"e", b"g"


def _text(address: Address | None) -> bytes:
    if address is None:
        return b"\0"
    ip = address.ip.encode()
    return bytes([len(ip) + 1]) + ip + address.port.to_bytes(4, "little")


class RecordedNetwork:
    """A network whose answers go into the journal.

    Args:
        network: answers.
        journal: takes the answers down.
    """

    def __init__(self, network: Network, journal: Journal) -> None:
        self._network = network
        self._answers = journal.network

    def open(self, ip: str, port: int, *, reuse_address: bool = False) -> Opened:
        """See `plcsim.network.Network`."""
        outcome, socket = self._network.open(ip, port, reuse_address=reuse_address)
        self._answers += _OPEN[outcome]
        return Opened(outcome, socket and RecordedSocket(socket, self._answers))


class RecordedSocket:
    """A socket whose answers go into the journal; for what its calls do see `Socket`."""

    def __init__(self, socket: Socket, answers: bytearray) -> None:
        self._socket = socket
        self._answers = answers

    @property
    def listening(self) -> bool:
        """See `Socket`."""
        value = self._socket.listening
        self._answers += _LISTENING + bytes([value])
        return value

    @property
    def local(self) -> Address:
        """See `Socket`."""
        value = self._socket.local
        self._answers += _LOCAL + b"\0" + _text(value)
        return value

    @property
    def peer(self) -> Address | None:
        """See `Socket`."""
        value = self._socket.peer
        self._answers += _PEER + b"\0" + _text(value)
        return value

    def listen(self, backlog: int) -> Outcome:
        """See `Socket`."""
        outcome = self._socket.listen(backlog)
        self._answers += _LISTEN[outcome]
        return outcome

    def accept(self) -> Accepted:
        """See `Socket`."""
        outcome, socket, peer = self._socket.accept()
        self._answers += _ACCEPT[outcome]
        if socket is None:
            return Accepted(outcome, None, peer)
        self._answers += _text(peer)
        return Accepted(outcome, RecordedSocket(socket, self._answers), peer)

    def connect(self, peer: Address) -> Outcome:
        """See `Socket`."""
        outcome = self._socket.connect(peer)
        self._answers += _CONNECT[outcome]
        return outcome

    def send(self, data: bytes | memoryview, *, urgent: bool = False, direct: bool = False) -> Sent:
        """See `Socket`."""
        sent = self._socket.send(data, urgent=urgent, direct=direct)
        self._answers += _SEND[sent.outcome]
        self._answers += _U32.pack(sent.taken)
        return sent

    def recv(self, size: int, *, peek: bool = False, urgent: bool = False) -> Received:
        """See `Socket`."""
        received = self._socket.recv(size, peek=peek, urgent=urgent)
        self._answers += _RECV[received.outcome]
        if received.outcome is Outcome.OK:
            self._answers += _U32.pack(len(received.data))
            self._answers += received.data
        return received

    def shutdown(self, *, read: bool = False, write: bool = False) -> Outcome:
        """See `Socket`."""
        outcome = self._socket.shutdown(read=read, write=write)
        self._answers += _SHUTDOWN[outcome]
        return outcome

    def close(self) -> None:
        """See `Socket`."""
        self._socket.close()
        self._answers += _CLOSE + b"\0"

    def set_option(self, option: Option, value: int) -> Outcome:
        """See `Socket`."""
        outcome = self._socket.set_option(option, value)
        self._answers += _SET_OPTION[outcome]
        return outcome

    def option(self, option: Option) -> OptionValue:
        """See `Socket`."""
        answer = self._socket.option(option)
        self._answers += _OPTION[answer.outcome]
        self._answers += _I64.pack(answer.value)
        return answer

    def set_linger(self, seconds: int | None) -> Outcome:
        """See `Socket`."""
        outcome = self._socket.set_linger(seconds)
        self._answers += _SET_LINGER[outcome]
        return outcome

    def linger(self) -> int | None:
        """See `Socket`."""
        value = self._socket.linger()
        self._answers += _LINGER + b"\0" + _I64.pack(_NONE if value is None else value)
        return value


class ReplayNetwork:
    """A network that answers what was recorded.

    Args:
        feed: the records.
    """

    def __init__(self, feed: Feed) -> None:
        self._feed = feed

    def open(self, ip: str, port: int, *, reuse_address: bool = False) -> Opened:
        """See `plcsim.network.Network`."""
        outcome = _OUTCOMES[self._feed.answer(b"o")]
        return Opened(outcome, ReplaySocket(self._feed) if outcome is Outcome.OK else None)


class ReplaySocket:
    """A socket that answers what was recorded."""

    def __init__(self, feed: Feed) -> None:
        self._feed = feed

    def _outcome(self, call: bytes) -> Outcome:
        return _OUTCOMES[self._feed.answer(call)]

    def _u32(self) -> int:
        return int.from_bytes(self._feed.data(4), "little")

    def _i64(self) -> int:
        return int.from_bytes(self._feed.data(8), "little", signed=True)

    def _address(self) -> Address | None:
        length = self._feed.data(1)[0]
        if not length:
            return None
        ip = self._feed.data(length - 1).decode()
        return Address(ip, self._u32())

    @property
    def listening(self) -> bool:
        """See `Socket`."""
        return bool(self._feed.answer(_LISTENING))

    @property
    def local(self) -> Address:
        """See `Socket`."""
        self._feed.answer(_LOCAL)
        return self._address() or Address("", 0)

    @property
    def peer(self) -> Address | None:
        """See `Socket`."""
        self._feed.answer(_PEER)
        return self._address()

    def listen(self, backlog: int) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"l")

    def accept(self) -> Accepted:
        """See `Socket`."""
        outcome = self._outcome(b"a")
        if outcome is not Outcome.OK:
            return Accepted(outcome)
        peer = self._address() or Address("", 0)
        return Accepted(outcome, ReplaySocket(self._feed), peer)

    def connect(self, peer: Address) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"c")

    def send(self, data: bytes | memoryview, *, urgent: bool = False, direct: bool = False) -> Sent:
        """See `Socket`."""
        outcome = self._outcome(b"s")
        return Sent(outcome, self._u32())

    def recv(self, size: int, *, peek: bool = False, urgent: bool = False) -> Received:
        """See `Socket`."""
        outcome = self._outcome(b"r")
        return Received(outcome, self._feed.data(self._u32()) if outcome is Outcome.OK else b"")

    def shutdown(self, *, read: bool = False, write: bool = False) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"d")

    def close(self) -> None:
        """See `Socket`."""
        self._feed.answer(_CLOSE)

    def set_option(self, option: Option, value: int) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"t")

    def option(self, option: Option) -> OptionValue:
        """See `Socket`."""
        outcome = self._outcome(b"p")
        return OptionValue(outcome, self._i64())

    def set_linger(self, seconds: int | None) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"i")

    def linger(self) -> int | None:
        """See `Socket`."""
        self._feed.answer(_LINGER)
        value = self._i64()
        return None if value == _NONE else value
