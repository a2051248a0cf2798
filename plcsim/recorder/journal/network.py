"""The network of a run that is recorded, and of one that is replayed.

An answer is a letter for the call, a byte for its outcome, and what came with it. What a program
sends is not recorded: in a replay it goes nowhere, and comes out the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, cast

from plcsim.network import (
    Accepted,
    Address,
    Filled,
    Opened,
    OpenedDatagrams,
    Outcome,
    Received,
    Sent,
    Socket,
)
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
from plcsim.recorder.journal.datagrams import OPEN, RecordedDatagrams, ReplayDatagrams
from plcsim.recorder.journal.port import RecordedPort, ReplayPort

if TYPE_CHECKING:
    from plcsim.network import DatagramNetwork, Network
    from plcsim.recorder.journal.feed import Feed
    from plcsim.recorder.journal.journal import Journal

_NONE: Final = -1

_OPEN, _ACCEPT, _LISTEN = map(heads, (b"o", b"a", b"l"))
_SEND, _RECV, _SHUTDOWN, _SET_LINGER = map(heads, (b"s", b"r", b"d", b"i"))
_LISTENING, _LINGER = b"n", b"g"
_LOOK = b"k"
_NO_NEWS = _LOOK + NOTHING + U32.pack(0)
_OPEN_DATAGRAMS = heads(OPEN)


class RecordedNetwork:
    """A network whose answers go into the journal.

    Args:
        network: answers.
        journal: takes the answers down.

    Attributes:
        answers: those of the cycle so far.
        recorded: the network itself, for what must not stand in the journal.
    """

    def __init__(self, network: Network, journal: Journal) -> None:
        self.recorded = self._network = network
        self.answers = journal.network
        self._count = 0
        self._made: dict[Socket, RecordedSocket] = {}

    def look(self) -> list[RecordedSocket]:
        """See `plcsim.network.Network`; a socket is told by its place among those made."""
        news = self._network.look()
        if not news:  # as nearly always
            self.answers += _NO_NEWS
            return []
        found = [self._made[each] for each in news if each in self._made]
        self.answers += _LOOK + NOTHING + U32.pack(len(found))
        for each in found:
            self.answers += U32.pack(each.number)
        return found

    def record(self, socket: Socket) -> RecordedSocket:
        """Return what records the answers of a new socket."""
        self._count += 1
        made = self._made[socket] = RecordedSocket(socket, self, self._count)
        return made

    def forget(self, socket: Socket) -> None:
        """Look at a socket no more."""
        self._made.pop(socket, None)

    def open(self, ip: str, port: int, *, reuse_address: bool = False) -> Opened:
        """See `plcsim.network.Network`."""
        outcome, socket = self._network.open(ip, port, reuse_address=reuse_address)
        self.answers += _OPEN[outcome]
        return Opened(outcome, socket and self.record(socket))

    def open_datagrams(self, ip: str, port: int, *, reuse_address: bool = False) -> OpenedDatagrams:
        """See `plcsim.network.DatagramNetwork`."""
        network = cast("DatagramNetwork", self._network)
        outcome, socket = network.open_datagrams(ip, port, reuse_address=reuse_address)
        self.answers += _OPEN_DATAGRAMS[outcome]
        made = None if socket is None else RecordedDatagrams(socket, self.answers)
        return OpenedDatagrams(outcome, made)


class RecordedSocket(RecordedPort[Socket]):
    """A socket whose answers go into the journal; for what its calls do see `Socket`.

    Attributes:
        number: its place among the sockets made.
    """

    def __init__(self, socket: Socket, network: RecordedNetwork, number: int) -> None:
        super().__init__(socket, network.answers)
        self.number = number
        self._network = network

    @property
    def listening(self) -> bool:
        """See `Socket`."""
        value = self._socket.listening
        self._answers += _LISTENING + bytes([value])
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
        self._answers += address_text(peer)
        return Accepted(outcome, self._network.record(socket), peer)

    def send(self, data: bytes | memoryview, *, urgent: bool = False, direct: bool = False) -> Sent:
        """See `Socket`."""
        sent = self._socket.send(data, urgent=urgent, direct=direct)
        self._answers += _SEND[sent.outcome]
        self._answers += U32.pack(sent.taken)
        return sent

    def recv(self, size: int, *, peek: bool = False, urgent: bool = False) -> Received:
        """See `Socket`."""
        received = self._socket.recv(size, peek=peek, urgent=urgent)
        self._answers += _RECV[received.outcome]
        if received.outcome is Outcome.OK:
            self._answers += U32.pack(len(received.data))
            self._answers += received.data
        return received

    def recv_into(self, target: memoryview) -> Filled:
        """See `Socket`; recorded as ``recv`` is."""
        filled = self._socket.recv_into(target)
        self._answers += _RECV[filled.outcome]
        if filled.outcome is Outcome.OK:
            self._answers += U32.pack(filled.size)
            self._answers += target[: filled.size]
        return filled

    def shutdown(self, *, read: bool = False, write: bool = False) -> Outcome:
        """See `Socket`."""
        outcome = self._socket.shutdown(read=read, write=write)
        self._answers += _SHUTDOWN[outcome]
        return outcome

    def close(self) -> None:
        """See `Socket`."""
        self._network.forget(self._socket)
        super().close()

    def set_linger(self, seconds: int | None) -> Outcome:
        """See `Socket`."""
        outcome = self._socket.set_linger(seconds)
        self._answers += _SET_LINGER[outcome]
        return outcome

    def linger(self) -> int | None:
        """See `Socket`."""
        value = self._socket.linger()
        self._answers += _LINGER + NOTHING + I64.pack(_NONE if value is None else value)
        return value


class ReplayNetwork:
    """A network that answers what was recorded.

    Args:
        feed: the records.
    """

    def __init__(self, feed: Feed) -> None:
        self._feed = feed
        self._count = 0
        self._made: dict[int, ReplaySocket] = {}

    def look(self) -> list[ReplaySocket]:
        """See `plcsim.network.Network`."""
        self._feed.answer(_LOOK)
        found = [self._made.get(u32_from(self._feed)) for _ in range(u32_from(self._feed))]
        if None in found:
            raise self._feed.differs("the network told of a socket that is not there")
        return [each for each in found if each is not None]

    def replay(self) -> ReplaySocket:
        """Return what answers for a new socket."""
        self._count += 1
        made = self._made[self._count] = ReplaySocket(self._feed, self, self._count)
        return made

    def forget(self, number: int) -> None:
        """Look at a socket no more."""
        self._made.pop(number, None)

    def open(self, ip: str, port: int, *, reuse_address: bool = False) -> Opened:
        """See `plcsim.network.Network`."""
        outcome = OUTCOMES[self._feed.answer(b"o")]
        return Opened(outcome, self.replay() if outcome is Outcome.OK else None)

    def open_datagrams(self, ip: str, port: int, *, reuse_address: bool = False) -> OpenedDatagrams:
        """See `plcsim.network.DatagramNetwork`."""
        outcome = OUTCOMES[self._feed.answer(OPEN)]
        made = ReplayDatagrams(self._feed) if outcome is Outcome.OK else None
        return OpenedDatagrams(outcome, made)


class ReplaySocket(ReplayPort):
    """A socket that answers what was recorded."""

    def __init__(self, feed: Feed, network: ReplayNetwork, number: int) -> None:
        super().__init__(feed)
        self._network = network
        self._number = number

    @property
    def listening(self) -> bool:
        """See `Socket`."""
        return bool(self._feed.answer(_LISTENING))

    def listen(self, backlog: int) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"l")

    def accept(self) -> Accepted:
        """See `Socket`."""
        outcome = self._outcome(b"a")
        if outcome is not Outcome.OK:
            return Accepted(outcome)
        peer = address_from(self._feed) or Address("", 0)
        return Accepted(outcome, self._network.replay(), peer)

    def send(self, data: bytes | memoryview, *, urgent: bool = False, direct: bool = False) -> Sent:
        """See `Socket`."""
        outcome = self._outcome(b"s")
        return Sent(outcome, u32_from(self._feed))

    def recv(self, size: int, *, peek: bool = False, urgent: bool = False) -> Received:
        """See `Socket`."""
        outcome = self._outcome(b"r")
        return Received(
            outcome, self._feed.data(u32_from(self._feed)) if outcome is Outcome.OK else b""
        )

    def recv_into(self, target: memoryview) -> Filled:
        """See `Socket`."""
        outcome, data = self.recv(len(target))
        if len(data) > len(target):
            raise self._feed.differs("more was received than is asked for")
        target[: len(data)] = data
        return Filled(outcome, len(data))

    def shutdown(self, *, read: bool = False, write: bool = False) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"d")

    def close(self) -> None:
        """See `Socket`."""
        self._network.forget(self._number)
        super().close()

    def set_linger(self, seconds: int | None) -> Outcome:
        """See `Socket`."""
        return self._outcome(b"i")

    def linger(self) -> int | None:
        """See `Socket`."""
        self._feed.answer(_LINGER)
        value = i64_from(self._feed)
        return None if value == _NONE else value
