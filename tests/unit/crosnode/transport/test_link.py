"""A link from its connection to its end, over the virtual network."""

from typing import ClassVar
from unittest.mock import patch

from crosnode.transport.budget import (
    LARGE_WORK,
    POLL_WORK,
    STREAM_SHARE,
    TRANSFER_WORK,
    StepBudget,
    StepLimits,
)
from crosnode.transport.connection import (
    Closed,
    ConnectionEvent,
    ConnectionState,
    ProtocolConnection,
    Table,
    Trigger,
)
from crosnode.transport.dyn_buffer import Data
from crosnode.transport.event_loop import EventLoop
from crosnode.transport.link import CLOSING_NS, CONNECT_NS, STREAM_AHEAD, LinkState, PeerLink
from crosnode.transport.tcpip_socket import TcpipSocket
from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.network import Address, Outcome, Socket, VirtualNetwork

PEER_IP, OWN_IP = "192.168.0.2", "192.168.0.1"


class Lines(ProtocolConnection):
    """Bytes until the peer closes; says goodbye when it is closed from this side."""

    TABLE: ClassVar[Table] = {
        ConnectionState.STREAMING: {Trigger.END: ConnectionState.CLOSED},
        ConnectionState.CLOSED: {},
    }
    IS_PARSED: ClassVar[bool] = False

    def event_price(self, now_ns: int) -> int:
        return 1

    def __init__(self, farewell: bytes = b"") -> None:
        super().__init__(ConnectionState.STREAMING, 0, 0)
        self.received = b""
        self._farewell = farewell
        self._ended = False

    def receive_data(self, data: Data) -> None:
        self.received += data

    def receive_eof(self) -> None:
        self._ended = True

    def next_event(self, now_ns: int) -> ConnectionEvent | None:
        if not self._ended or self.state is ConnectionState.CLOSED:
            return None
        self.close()
        return Closed()

    def close(self) -> None:
        if self.state is not ConnectionState.CLOSED:
            self.outbox.append(self._farewell)
        super().close()


class Told:
    """An owner that notes what it is told."""

    def __init__(self) -> None:
        self.events: list[ConnectionEvent] = []
        self.reasons: list[str] = []

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        self.events.append(event)

    def expects_data(self, link: PeerLink) -> bool:
        return True

    def fill(self, link: PeerLink) -> None:
        pass

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        self.reasons.append(reason)


class Wire:
    """A link to a port of another host, where a socket may listen."""

    def __init__(self, farewell: bytes = b"", *, listens: bool = True) -> None:
        self.now_ns = 0
        self.network = VirtualNetwork(lambda: self.now_ns)
        self.host = self.network.host(PEER_IP)
        self.listener = self._listen() if listens else None
        context = Context(Memory(), self.network.host(OWN_IP))
        self.loop = EventLoop(context)
        self.protocol, self.told = Lines(farewell), Told()
        self.link = self.loop.connect(Address(PEER_IP, 99), self.protocol, self.told, 0)

    def _listen(self) -> Socket:
        socket = self.host.open("", 99).socket
        assert socket
        socket.listen(1)
        return socket

    def step(self, count: int = 5) -> None:
        for _ in range(count):
            self.now_ns += 1_000_000
            self.loop.step(self.now_ns, StepBudget(StepLimits()))

    def idle_work(self) -> int:
        """Return the most that one of a hundred steps cost."""
        limits = StepLimits()
        budgets = [StepBudget(limits) for _ in range(100)]
        for budget in budgets:
            self.now_ns += 1_000_000
            self.loop.step(self.now_ns, budget)
        return max(limits.work - budget.work for budget in budgets)

    def peer(self) -> Socket:
        assert self.listener
        self.step()
        socket = self.listener.accept().socket
        assert socket
        self.step()
        return socket


def test_bytes_go_to_the_protocol_and_its_events_to_the_owner() -> None:
    wire = Wire()
    peer = wire.peer()
    assert wire.link.state is LinkState.OPEN
    peer.send(b"abc")
    wire.step()
    assert wire.protocol.received == b"abc"
    assert wire.link.bytes_in == 3
    peer.close()
    wire.step()
    assert wire.told.events == [Closed()]
    assert wire.told.reasons == [""]
    assert wire.link.is_over
    assert wire.loop.links == []


def test_a_link_with_nothing_to_do_costs_no_work_of_a_step() -> None:
    wire = Wire()
    peer = wire.peer()
    assert wire.idle_work() == 0
    peer.send(b"abc")
    wire.step(1)
    assert wire.protocol.received == b"abc"
    wire.step()
    assert wire.idle_work() == 0
    wire.protocol.outbox.append(b"hello")
    wire.step(1)
    assert wire.idle_work() == 0
    assert peer.recv(10).data == b"hello"


def test_a_read_begins_only_where_its_price_is_left() -> None:
    wire = Wire()
    wire.peer().send(b"abc")
    wire.now_ns += 1_000_000
    budget = StepBudget(StepLimits())
    budget.work = POLL_WORK + TRANSFER_WORK - 1
    wire.loop.step(wire.now_ns, budget)
    assert wire.protocol.received == b""
    assert budget.is_short
    wire.step(1)
    assert wire.protocol.received == b"abc"


def test_a_port_where_nobody_listens() -> None:
    wire = Wire(listens=False)
    wire.step(20)
    assert wire.link.is_over
    (reason,) = wire.told.reasons
    assert reason.startswith(f"no connection to {PEER_IP}:99: AsTCP status")


def test_a_peer_that_does_not_answer() -> None:
    wire = Wire()
    wire.network.faults.silence(PEER_IP)
    wire.now_ns = 3 * CONNECT_NS  # it was laid out long before
    wire.step()
    wire.now_ns += CONNECT_NS
    wire.step()
    assert wire.told.reasons == [f"{PEER_IP}:99 does not answer"]


def test_what_was_left_to_say_is_written_first() -> None:
    wire = Wire(farewell=b"bye")
    peer = wire.peer()
    wire.link.close("enough")
    wire.step()
    assert wire.link.is_over
    assert peer.recv(10).data == b"bye"
    assert peer.recv(10).outcome is Outcome.CLOSED
    assert wire.told.reasons == ["enough"]


def test_a_peer_that_does_not_take_the_last_bytes_is_left_in_time() -> None:
    wire = Wire(farewell=bytes(8 << 20))
    wire.peer()
    wire.link.close()
    wire.step(200)
    assert wire.link.state is LinkState.CLOSING
    wire.now_ns += CLOSING_NS
    wire.step()
    assert wire.link.is_over


def test_a_link_that_was_given_up_ends_once() -> None:
    wire = Wire()
    wire.link.abort("no time", 0)
    wire.link.abort("again", 0)
    wire.step()
    assert wire.told.reasons == ["no time"]


class Block(Lines):
    """Bytes behind the first that come go to a room."""

    def __init__(self) -> None:
        super().__init__()
        self._room: memoryview | None = None

    @property
    def room(self) -> memoryview | None:
        return self._room

    def receive_data(self, data: Data) -> None:
        super().receive_data(data)
        self._room = memoryview(bytearray(1000))

    def filled(self, size: int) -> None:
        self._room = None


def test_the_begin_of_a_large_message_that_was_not_expected_has_a_price() -> None:
    def work_of(protocol: Lines) -> int:
        wire = Wire()
        peer = wire.peer()
        wire.link.connection = protocol
        peer.send(b"length")
        return wire.idle_work()

    assert work_of(Block()) - work_of(Lines()) == LARGE_WORK


def test_what_comes_in_a_stream_is_read_in_each_step_until_nothing_comes() -> None:
    wire = Wire()
    peer = wire.peer()
    wire.link.connection = Block()
    wire.step()
    asked: list[int] = []
    with patch.object(TcpipSocket, "expect_stream", lambda _, size: asked.append(size)):
        peer.send(b"length")
        wire.step(1)
        peer.send(b"block")
        wire.now_ns += 1_000_000
        wire.loop.step(wire.now_ns, StepBudget(StepLimits(), STREAM_SHARE))
        assert asked == [STREAM_AHEAD]
        assert wire.link.has_work(set())
        wire.step(1)
        assert asked == [STREAM_AHEAD, 1]
        assert not wire.link.is_over
    wire.step()
    assert not wire.link.has_work(set())
