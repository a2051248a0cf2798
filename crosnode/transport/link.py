"""A link: one protocol connection, whatever it speaks, on one TcpipSocket.

The link moves bytes between the two within the budget of a step and hands each event to its owner.
It ends when the connection is over and what was left to say is written, or the socket is lost.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING, Final, Protocol

from crosnode.graph.uri import make_authority
from crosnode.transport.budget import (
    CONNECT_WORK,
    CONNECTED_WORK,
    END_WORK,
    LARGE_WORK,
    OPTION_WORK,
    POLL_WORK,
    QUIET_WORK,
    TRANSFER_WORK,
    UNPACED,
    StepBudget,
)
from crosnode.transport.connection import ConnectionState, Failed, Progress
from crosnode.transport.dyn_buffer import DynBuffer
from crosnode.transport.tcpip_socket import AREA_SIZE, LARGE_PIECE, OPTIONS, TcpipSocketState
from crosnode.transport.transitions import Transitions, next_state

if TYPE_CHECKING:
    from crosnode.transport.connection import ConnectionEvent, ProtocolConnection
    from crosnode.transport.tcpip_socket import TcpipSocket

OUTBOX_MAX: Final = 1 << 30
"""Bytes; owners bound what they send, so this is never reached."""

CLOSING_NS: Final = 5_000_000_000
"""Nanoseconds that a peer has to read what is left to say to it."""

PATIENT_NS: Final = 20_000_000
"""Nanoseconds that a link which has but to end lets others go first."""

CONNECT_NS: Final = 2_000_000_000
"""Nanoseconds after which a peer that does not answer counts as absent."""

PARSED_READ: Final = 4_096
"""Bytes read at once where they are parsed."""

STREAM_AHEAD: Final = 8 << 20
"""Bytes that a peer may send between two steps of a node that large messages reach without a pause:
more than a step of 10 ms takes."""

READS: Final = 2
"""Times that a connection is read from in a step, where the first time gave a whole area."""

_DONE: Final = TcpipSocketState.DONE
_IN_PROGRESS: Final = TcpipSocketState.IN_PROGRESS


class LinkState(Enum):
    """How far a link is."""

    CONNECTING = auto()
    OPEN = auto()
    CLOSING = auto()
    """The connection is over; what was left to say is being written."""
    OVER = auto()


class LinkTrigger(Enum):
    """What happens to a link."""

    CONNECTED = "the socket is connected"
    ENDED = "the protocol has ended, from either side"
    WRITTEN = "all is written, or the peer had its time to take it"
    LOST = "the socket is lost, or given up"


LINK: Final[Transitions[LinkState, LinkTrigger]] = {
    LinkState.CONNECTING: {
        LinkTrigger.CONNECTED: LinkState.OPEN,
        LinkTrigger.LOST: LinkState.OVER,
    },
    LinkState.OPEN: {LinkTrigger.ENDED: LinkState.CLOSING, LinkTrigger.LOST: LinkState.OVER},
    LinkState.CLOSING: {LinkTrigger.WRITTEN: LinkState.OVER, LinkTrigger.LOST: LinkState.OVER},
    LinkState.OVER: {},
}


class Owner(Protocol):
    """Who a link belongs to."""

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Take an event of the link's connection."""

    def expects_data(self, link: PeerLink) -> bool:
        """Whether the peer may have something to say."""

    def fill(self, link: PeerLink) -> None:
        """Hand waiting messages to the connection; called while little is left to write."""

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """Note that the link is over; its socket is closed. "" where the peer just closed."""


class PeerLink:
    """One connection; made by `crosnode.transport.event_loop.EventLoop`.

    Args:
        socket: connected, or named by ``init`` to be connected.
        connection: the protocol.
        owner: takes events.
        now_ns: time of the step.

    Attributes:
        bytes_in: bytes read so far.
        bytes_out: bytes written so far.
        has_more: whether the last turn left something to read.
        is_readable: whether the socket has something to read, or may have.
        peer: who is at the other end, for messages and getBusInfo.
        state: how far it is.
    """

    __slots__ = ("_is_parsed", "_is_streaming", "_options", "_outbox", "_reason", "_resting",
                 "_since_ns", "bytes_in", "bytes_out", "connection", "has_more", "is_readable",
                 "owner", "peer", "socket", "state")  # fmt: skip

    def __init__(
        self,
        socket: TcpipSocket,
        connection: ProtocolConnection,
        owner: Owner,
        now_ns: int,
    ) -> None:
        self.socket = socket
        self.connection = connection
        self.owner = owner
        self.peer = make_authority(socket.ip, socket.port)
        self.bytes_in = self.bytes_out = 0
        self.state = LinkState.OPEN if socket.is_connected else LinkState.CONNECTING
        self._outbox = DynBuffer(OUTBOX_MAX)
        self._since_ns = now_ns
        self._reason = ""
        self.has_more = False
        self._is_parsed = connection.IS_PARSED
        self._resting: ConnectionState | None = None
        self._options = 0  # so many are set
        self._is_streaming = False
        self.is_readable = True

    @property
    def is_over(self) -> bool:
        """Whether the socket is closed and the owner told."""
        return self.state is LinkState.OVER

    @property
    def waiting(self) -> int:
        """Bytes that wait to be written."""
        return self._outbox.size

    def has_work(self, news: set[int]) -> bool:
        """Whether a turn would do anything.

        After a turn that did nothing, that is so when the socket has news, when the connection has
        something to say or is in another state, or when ``wake`` was called.

        Args:
            news: idents with something to read.
        """
        self.is_readable = self._is_streaming or self.socket.ident in news
        connection = self.connection
        return self.is_readable or self._resting is not connection.state or bool(connection.outbox)

    def wake(self) -> None:
        """Have a turn in the next step: the owner has something to say."""
        self._resting = None

    def may_wait(self, now_ns: int) -> bool:
        """Whether others go first: the link has but to end, and not for long."""
        return self.state is LinkState.CLOSING and now_ns - self._since_ns < PATIENT_NS

    def check_time(self, now_ns: int) -> None:
        """End the connection where the peer has had its time."""
        if self.state is not LinkState.OVER and (failed := self.connection.handle_timer(now_ns)):
            self._handle(failed, now_ns)

    def step(self, now_ns: int, budget: StepBudget) -> None:
        """Do what can be done now within the budget."""
        budget.polls -= 1
        budget.work -= POLL_WORK
        if self.state is LinkState.CONNECTING and not self._connect(now_ns, budget):
            return
        if self._options == 0:  # the first before anything is said, others where there is time
            if not budget.affords(OPTION_WORK):
                return
            self._set_option(budget)
        self._exchange(now_ns, budget)
        if self.state is LinkState.OVER:
            budget.work -= END_WORK
        elif self._options < len(OPTIONS) and budget.may_begin(QUIET_WORK):
            self._set_option(budget)

    def _set_option(self, budget: StepBudget) -> None:
        """Set the next option."""
        self.socket.set_option(self._options)
        self._options += 1
        budget.work -= OPTION_WORK

    def _exchange(self, now_ns: int, budget: StepBudget) -> None:
        # Who does not read is not heard, unless it has no more to say than that it leaves.
        if self._outbox.size < AREA_SIZE or not self.owner.expects_data(self):
            self._read(now_ns, budget)
        self._send(now_ns, budget)
        if self.connection.state is ConnectionState.CLOSED:
            self._finish(now_ns, budget)

    def _read(self, now_ns: int, budget: StepBudget) -> None:
        """Take the events that are there, then what the socket has."""
        self.has_more = False
        if not self.connection.wants_data:
            self._take_events(now_ns, budget)
        if not self.is_readable:
            return
        for _ in range(READS):
            self.has_more = self.connection.wants_data and self._receive(now_ns, budget)
            if not self.has_more:
                return

    def flush(self, now_ns: int, budget: StepBudget) -> None:
        """Write what waits within the budget, outside of a turn."""
        if self.state is LinkState.OPEN and self.connection.state is not ConnectionState.CLOSED:
            self._send(now_ns, budget)

    def close(self, reason: str = "") -> None:
        """End the link from this side: what waits is still written, for a while."""
        self._reason = self._reason or reason
        self.connection.close()

    def abort(self, reason: str, now_ns: int) -> None:
        """End the link at once."""
        if self.state is not LinkState.OVER:
            self._end(LinkTrigger.LOST, reason, now_ns)

    def _end(self, trigger: LinkTrigger, reason: str, now_ns: int) -> None:
        self._move(trigger)
        self.connection.close()
        self.socket.close()
        self.owner.ended(self, self._reason or reason, now_ns)

    def _move(self, trigger: LinkTrigger) -> None:
        self.state = next_state(LINK, self.state, trigger, "link")

    def is_there(self, now_ns: int) -> bool:
        """Whether the peer is connected, as seen now."""
        if self.state is LinkState.CONNECTING:
            self._connect(now_ns, StepBudget(UNPACED))
        return self.state is LinkState.OPEN

    def _connect(self, now_ns: int, budget: StepBudget) -> bool:
        """Begin to connect, and see whether the peer is there; return whether it is."""
        state = _IN_PROGRESS
        if not self.socket.is_open:
            if not budget.affords(CONNECT_WORK):
                return False
            budget.work -= CONNECT_WORK
            self._since_ns = now_ns
            state = self.socket.connect()
        if state is _IN_PROGRESS and self.socket.is_open and budget.affords(CONNECTED_WORK):
            state = self.socket.connect()
            budget.work -= CONNECTED_WORK if state is _DONE else TRANSFER_WORK
        if state is _DONE:
            self._move(LinkTrigger.CONNECTED)
            return True
        if state is not _IN_PROGRESS:
            self.abort(f"no connection to {self.peer}: AsTCP status {self.socket.status}", now_ns)
        elif (
            now_ns - self._since_ns >= CONNECT_NS or self.connection.state is ConnectionState.CLOSED
        ):
            self.abort(f"{self.peer} does not answer", now_ns)
        return False

    def _receive(self, now_ns: int, budget: StepBudget) -> bool:
        """Take what the socket has and the events of it; return whether it may have more."""
        if not budget.affords(TRANSFER_WORK):
            return False
        room = self.connection.room
        if room is not None:
            return self._fill_message(room, now_ns, budget)
        size = min(PARSED_READ, budget.bytes_parsed) if self._is_parsed else budget.bytes_in
        size = budget.at_most(min(size, self.connection.next_read))
        if size <= 0:
            return False
        state, data = self.socket.read_area(size)
        received = len(data)
        if state is _DONE:
            self._count(received, budget)
            self.connection.receive_data(data)
            self._take_events(now_ns, budget)
            if self.connection.room is not None:
                budget.work -= LARGE_WORK
        else:
            self._ended_in(state, now_ns, budget)
        return not self._is_parsed and received >= min(size, AREA_SIZE)

    def _ended_in(self, state: TcpipSocketState, now_ns: int, budget: StepBudget) -> None:
        """Take the end of what the peer sends, where that is what the socket tells."""
        if state is not _IN_PROGRESS:
            self.connection.receive_eof()
            self._take_events(now_ns, budget)
            self.connection.close()
        elif self._is_streaming:
            self._expect_stream(1, budget)

    def _expect_stream(self, size: int, budget: StepBudget) -> None:
        """Let the peer send so much between two steps, where that is more than 1."""
        self.socket.expect_stream(size)
        self._is_streaming = size > 1
        budget.work -= TRANSFER_WORK

    def _fill_message(self, room: memoryview, now_ns: int, budget: StepBudget) -> bool:
        """Read the bytes of a large message to their place; return whether there may be more."""
        is_fresh = self.connection.is_room_fresh
        size = budget.at_most_large(min(len(room), budget.bytes_in), is_fresh=is_fresh)
        if size <= 0:
            return False
        state, received = self.socket.read_into(room[:size])
        if state is _DONE:
            self.bytes_in += received
            budget.bytes_in -= received
            budget.take_large(received, is_fresh=is_fresh)
            self.connection.filled(received)
            self._take_events(now_ns, budget)
            if budget.is_stream and not self._is_streaming:
                self._expect_stream(STREAM_AHEAD, budget)
        else:
            self._ended_in(state, now_ns, budget)
        return received == size

    def _count(self, received: int, budget: StepBudget) -> None:
        self.bytes_in += received
        budget.work -= TRANSFER_WORK + received
        if self._is_parsed:
            budget.bytes_parsed -= received
        else:
            budget.bytes_in -= received

    def _take_events(self, now_ns: int, budget: StepBudget) -> None:
        connection = self.connection
        while budget.messages > 0 and budget.affords(price := connection.event_price(now_ns)):
            connection.most = min(budget.messages, max(1, budget.work // price))
            event = connection.next_event(now_ns)
            if event is None:
                return
            count = event.count
            budget.messages -= count
            budget.work -= count * price
            if not isinstance(event, Progress):
                self._handle(event, now_ns)
            if connection.wants_data:  # nothing is left that another event could come of
                return

    def _handle(self, event: ConnectionEvent, now_ns: int) -> None:
        if isinstance(event, Failed):
            self._reason = self._reason or event.reason
        self.owner.handle_event(self, event, now_ns)

    def _send(self, now_ns: int, budget: StepBudget) -> None:
        self._fill_outbox()
        if self._outbox.size:
            self._resting = None
            self._write(now_ns, budget)
            if self._outbox.size or self.state is LinkState.OVER:
                return
            self._fill_outbox()  # what follows is written in the next step; else it can rest now
        if not self._outbox.size:
            connection = self.connection
            is_ready = self.state is LinkState.OPEN and self._options == len(OPTIONS)
            self._resting = connection.state if is_ready and connection.wants_data else None

    def _fill_outbox(self) -> None:
        """Take what the owner and the connection have to say, while little waits."""
        connection = self.connection
        if self._outbox.size < AREA_SIZE and connection.state is not ConnectionState.CLOSED:
            self.owner.fill(self)
        if connection.outbox:
            for piece in connection.data_to_send():
                self._outbox.push_back(piece)

    def _write(self, now_ns: int, budget: StepBudget) -> None:
        is_large = not self._is_parsed and self._outbox.has_large_piece(LARGE_PIECE)
        if is_large:
            size = budget.at_most_large(budget.bytes_out)
        else:  # what is parsed is in the price of the call
            size = budget.bytes_out if self._is_parsed else budget.at_most(budget.bytes_out)
        if size <= 0:
            return
        state, written = self.socket.write_buffer_ex(self._outbox, size)
        self.bytes_out += written
        budget.bytes_out -= written
        if is_large:
            budget.take_large(written)
        else:
            budget.work -= TRANSFER_WORK + (0 if self._is_parsed else written)
        if state not in (_DONE, _IN_PROGRESS):
            self.abort(f"{self.peer} is gone", now_ns)

    def _finish(self, now_ns: int, budget: StepBudget) -> None:
        """End the link when the last bytes are written, or the peer does not take them."""
        if self.state is LinkState.OPEN:
            self._move(LinkTrigger.ENDED)
            self._since_ns = now_ns
            return
        is_late = now_ns - self._since_ns >= CLOSING_NS
        is_due = self.state is LinkState.CLOSING and (is_late or not self._outbox.size)
        if is_due and budget.affords(END_WORK):
            self._end(LinkTrigger.WRITTEN, "", now_ns)
