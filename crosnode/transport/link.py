"""A link: one protocol connection (TCPROS or XML-RPC) on one TcpipSocket.

The link moves bytes between the two within the budget of a step and hands each event to its owner.
It ends when the connection is over and what was left to say is written, or the socket is lost.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Protocol

from crosnode.transport.budget import (
    CONNECTION_WORK,
    MESSAGE_WORK,
    POLL_WORK,
    TRANSFER_WORK,
    XMLRPC_WORK,
)
from crosnode.transport.connection import Failed, State
from crosnode.transport.dyn_buffer import DynBuffer
from crosnode.transport.tcpip_socket import AREA_SIZE, TcpipSocketState
from crosnode.xmlrpc import Progress

if TYPE_CHECKING:
    from crosnode import tcpros, xmlrpc
    from crosnode.transport.budget import Budget
    from crosnode.transport.dyn_buffer import Data
    from crosnode.transport.tcpip_socket import TcpipSocket

OUTBOX_MAX: Final = 1 << 30
"""Bytes; owners bound what they send, so this is never reached."""

CLOSING_NS: Final = 5_000_000_000
"""Nanoseconds that a peer has to read what is left to say to it."""

CONNECT_NS: Final = 2_000_000_000
"""Nanoseconds after which a peer that does not answer counts as absent."""

XMLRPC_READ: Final = 4_096
"""Bytes read at once from an XML-RPC connection."""

TIMER_TURNS: Final = 16
"""Time limits are looked at in every sixteenth turn of a link."""

QUIET_TURNS: Final = 8
"""A peer that has nothing to say but that it leaves is read from in every eighth turn."""

_DONE: Final = TcpipSocketState.DONE
_IN_PROGRESS: Final = TcpipSocketState.IN_PROGRESS


class SansIo(Protocol):
    """What a link asks of a protocol connection; see ``crosnode.transport.connection``."""

    state: State

    @property
    def wants_data(self) -> bool:
        """Whether bytes should be read."""

    def receive_data(self, data: Data) -> None:
        """Take bytes; what is kept of them is copied."""

    def receive_eof(self) -> None:
        """Take the end of the stream."""

    def handle_timer(self, now_ns: int) -> Failed | None:
        """End the connection where its time is over."""

    def data_to_send(self) -> list[bytes | memoryview]:
        """Give what is to be written."""

    def close(self) -> None:
        """End the connection."""


class Owner(Protocol):
    """Who a link belongs to."""

    def handle_event(self, link: Link, event: tcpros.Event | xmlrpc.Event, now_ns: int) -> None:
        """Take an event of the link's connection."""

    def expects_data(self, link: Link) -> bool:
        """Whether the peer may have something to say."""

    def fill(self, link: Link) -> None:
        """Hand waiting messages to the connection; called while little is left to write."""

    def ended(self, link: Link, reason: str, now_ns: int) -> None:
        """Note that the link is over; its socket is closed. "" where the peer just closed."""


class Link:
    """One connection; made by `crosnode.transport.event_loop.EventLoop`.

    Args:
        socket: connected, or named by ``init`` to be connected.
        connection: the protocol.
        owner: takes events.
        now_ns: time of the step.

    Attributes:
        bytes_in: bytes read so far.
        bytes_out: bytes written so far.
        peer: who is at the other end, for messages and getBusInfo.
    """

    __slots__ = ("_closing_ns", "_has_more", "_is_up", "_outbox", "_reason", "_since_ns",
        "_turn", "_xmlrpc",
                 "bytes_in", "bytes_out", "connection", "is_over", "owner", "peer",
                 "socket")  # fmt: skip

    def __init__(
        self,
        socket: TcpipSocket,
        connection: tcpros.TcprosConnection | xmlrpc.XmlRpcConnection,
        owner: Owner,
        now_ns: int,
        *,
        is_xmlrpc: bool,
    ) -> None:
        self.socket = socket
        self.connection = connection
        self.owner = owner
        self.peer = f"{socket.ip}:{socket.port}"
        self.bytes_in = self.bytes_out = 0
        self.is_over = False
        self._outbox = DynBuffer(OUTBOX_MAX)
        self._since_ns = now_ns
        self._closing_ns: int | None = None
        self._reason = ""
        self._xmlrpc = is_xmlrpc
        self._is_up = socket.is_connected
        self._turn = 0
        self._has_more = False

    @property
    def waiting(self) -> int:
        """Bytes that wait to be written."""
        return self._outbox.size

    def step(self, now_ns: int, budget: Budget) -> None:
        """Do what can be done now within the budget."""
        budget.polls -= 1
        budget.work -= POLL_WORK
        if not self._is_up and not self._connect(now_ns):
            return
        self._turn += 1
        if self._turn % TIMER_TURNS == 0 and (failed := self.connection.handle_timer(now_ns)):
            self._handle(failed, now_ns)
        expects_data = self.owner.expects_data(self)
        if not expects_data or self._outbox.size < AREA_SIZE:  # who does not read is not heard
            self._read(now_ns, budget, expects_data=expects_data)
        self._send(now_ns, budget)
        if self.connection.state is State.CLOSED and not self.is_over:
            self._finish(now_ns)
        if self.is_over:
            budget.work -= CONNECTION_WORK

    def _read(self, now_ns: int, budget: Budget, *, expects_data: bool) -> None:
        """Take the events that are there, then what the socket has."""
        if not self.connection.wants_data:
            self._take_events(now_ns, budget)
        if self.connection.wants_data and (expects_data or self._turn % QUIET_TURNS == 0):
            self._receive(now_ns, budget)
            if self._has_more and self.connection.wants_data:
                self._receive(now_ns, budget)

    def close(self, reason: str = "") -> None:
        """End the link from this side: what waits is still written, for a while."""
        self._reason = self._reason or reason
        self.connection.close()

    def abort(self, reason: str, now_ns: int) -> None:
        """End the link at once."""
        if not self.is_over:
            self.is_over = True
            self.connection.close()
            self.socket.close()
            self.owner.ended(self, self._reason or reason, now_ns)

    def _connect(self, now_ns: int) -> bool:
        state = self.socket.connect()
        if state is _IN_PROGRESS:
            state = self.socket.connect()  # on the own host the connection is there at once
        if state is _DONE:
            self._is_up = True
            self.socket.set_options()
            return True
        if state is not _IN_PROGRESS:
            self.abort(f"no connection to {self.peer}: AsTCP status {self.socket.status}", now_ns)
        elif now_ns - self._since_ns >= CONNECT_NS or self.connection.state is State.CLOSED:
            self.abort(f"{self.peer} does not answer", now_ns)
        return False

    def _receive(self, now_ns: int, budget: Budget) -> None:
        size = min(XMLRPC_READ, budget.bytes_parsed) if self._xmlrpc else budget.bytes_in
        size = budget.at_most(size)
        if size <= 0:
            return
        state, data = self.socket.read_area(size)
        self._has_more = len(data) == AREA_SIZE
        if state is _DONE:
            self._count(len(data), budget)
            self.connection.receive_data(data)
            self._take_events(now_ns, budget)
        elif state is not _IN_PROGRESS:
            self.connection.receive_eof()
            self._take_events(now_ns, budget)
            self.connection.close()

    def _count(self, received: int, budget: Budget) -> None:
        self.bytes_in += received
        budget.work -= TRANSFER_WORK + received
        if self._xmlrpc:
            budget.bytes_parsed -= received
        else:
            budget.bytes_in -= received

    def _take_events(self, now_ns: int, budget: Budget) -> None:
        while budget.messages > 0 and budget.affords(price := self._price()):
            event = self.connection.next_event(now_ns)
            if event is None:
                return
            budget.messages -= 1
            budget.work -= price
            if not isinstance(event, Progress):
                self._handle(event, now_ns)

    def _price(self) -> int:
        """Return the price of the next event."""
        if self._xmlrpc:
            return XMLRPC_WORK
        is_new = self.connection.state is State.HANDSHAKE
        return CONNECTION_WORK if is_new else MESSAGE_WORK

    def _handle(self, event: tcpros.Event | xmlrpc.Event, now_ns: int) -> None:
        if isinstance(event, Failed):
            self._reason = self._reason or event.reason
        self.owner.handle_event(self, event, now_ns)

    def _send(self, now_ns: int, budget: Budget) -> None:
        if self._outbox.size < AREA_SIZE and self.connection.state is not State.CLOSED:
            self.owner.fill(self)
        for piece in self.connection.data_to_send():
            self._outbox.push_back(piece)
        if not self._outbox.size:
            return
        size = budget.bytes_out if self._xmlrpc else budget.at_most(budget.bytes_out)
        if size <= 0:
            return
        state, written = self.socket.write_buffer_ex(self._outbox, size)
        self.bytes_out += written
        budget.bytes_out -= written
        budget.work -= TRANSFER_WORK + (0 if self._xmlrpc else written)  # in the call's price
        if state not in (_DONE, _IN_PROGRESS):
            self.abort(f"{self.peer} is gone", now_ns)

    def _finish(self, now_ns: int) -> None:
        """End the link when the last bytes are written, or the peer does not take them."""
        if self._closing_ns is None:
            self._closing_ns = now_ns + CLOSING_NS
        if not self._outbox.size or now_ns >= self._closing_ns:
            self.abort("", now_ns)
