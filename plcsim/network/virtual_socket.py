"""One socket on a virtual net."""

from __future__ import annotations

from collections import deque
from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from plcsim.network.connection import Connection
from plcsim.network.handshake import Handshake
from plcsim.network.options import SocketOptions
from plcsim.network.protocol import (
    ANY_IPS,
    MAX_BACKLOG,
    MAX_RECEIVE,
    NO_ADDRESS,
    Accepted,
    Address,
    Filled,
    Option,
    OptionValue,
    Outcome,
    Received,
    Sent,
    canonical_ipv6,
    is_connectable,
)
from plcsim.network.wire import is_loopback

if TYPE_CHECKING:
    from plcsim.network.virtual_host import VirtualHost


class SocketState(Enum):
    """Where a socket is in its life."""

    OPENED = auto()
    LISTENING = auto()
    CONNECTING = auto()
    CONNECTED = auto()
    CLOSED = auto()


class SocketAct(Enum):
    """What moves a socket from state to state."""

    LISTEN = auto()
    CONNECT = auto()
    ESTABLISH = auto()
    FAIL = auto()
    CLOSE = auto()


TRANSITIONS: Final[dict[SocketState, dict[SocketAct, SocketState]]] = {
    SocketState.OPENED: {
        SocketAct.LISTEN: SocketState.LISTENING,
        SocketAct.CONNECT: SocketState.CONNECTING,
        SocketAct.ESTABLISH: SocketState.CONNECTED,
        SocketAct.CLOSE: SocketState.CLOSED,
    },
    SocketState.LISTENING: {
        SocketAct.LISTEN: SocketState.LISTENING,
        SocketAct.CLOSE: SocketState.CLOSED,
    },
    SocketState.CONNECTING: {
        SocketAct.ESTABLISH: SocketState.CONNECTED,
        SocketAct.FAIL: SocketState.OPENED,
        SocketAct.CLOSE: SocketState.CLOSED,
    },
    SocketState.CONNECTED: {SocketAct.CLOSE: SocketState.CLOSED},
    SocketState.CLOSED: {},
}
"""Every transition of a socket; one that a listening socket takes is established at once."""


class VirtualSocket:
    """A socket of a virtual host. Made by ``VirtualHost.open`` and ``accept`` only.

    Attributes:
        host: the host it belongs to.
        bound: the address it was bound to.
        reuse_address: whether it was bound with reuse.
        state: where it is in its life.
    """

    def __init__(self, host: VirtualHost, bound: Address, *, reuse_address: bool) -> None:
        self.host = host
        self.bound = bound
        self.reuse_address = reuse_address
        self.state = SocketState.OPENED
        self._net = host.net
        self._local = bound
        self._options = SocketOptions(host.net.limits.send_buffer, host.net.limits.receive_buffer)
        self._queue: deque[VirtualSocket] = deque()
        self._backlog = 0
        self._connection: Connection | None = None
        self._handshake: Handshake | None = None
        self._read_ended = False

    @property
    def listening(self) -> bool:
        """True after a successful ``listen``."""
        return self.state is SocketState.LISTENING

    @property
    def local(self) -> Address:
        """The own address; ``NO_ADDRESS`` once closed."""
        return NO_ADDRESS if self.state is SocketState.CLOSED else self._local

    @property
    def peer(self) -> Address | None:
        """The other end's address while connected, else None."""
        connection = self._connected()
        return None if connection is None else connection.peer

    def listen(self, backlog: int) -> Outcome:
        """See ``Socket.listen``."""
        self._net.settle()
        if SocketAct.LISTEN not in TRANSITIONS[self.state]:
            return Outcome.INVALID
        if self.host.listener(self.bound) not in (None, self):
            return Outcome.IN_USE
        self._step(SocketAct.LISTEN)
        self._backlog = min(backlog, MAX_BACKLOG)
        return Outcome.OK

    def accept(self) -> Accepted:
        """See ``Socket.accept``."""
        self._net.settle()
        if not self.listening:
            return Accepted(Outcome.INVALID)
        if not self._queue:
            return Accepted(Outcome.WOULD_BLOCK)
        accepted = self._queue.popleft()
        return Accepted(Outcome.OK, accepted, accepted.peer or NO_ADDRESS)

    def connect(self, peer: Address) -> Outcome:
        """See ``Socket.connect``."""
        self._net.settle()
        if self.state is SocketState.CONNECTED:
            return Outcome.ALREADY_CONNECTED
        if self._handshake is not None:
            return self._take_answer(self._handshake)
        if self.state is not SocketState.OPENED:
            return Outcome.INVALID
        if not is_connectable(peer) or (":" in peer.ip) is not (":" in self.bound.ip):
            return Outcome.INVALID_ADDRESS
        peer = Address(canonical_ipv6(peer.ip) or peer.ip, peer.port)
        if self._net.faults.no_route(self.host.ip, peer.ip, self._net.moment_ns):
            return Outcome.UNREACHABLE
        self._start_to_connect(peer)
        return Outcome.WOULD_BLOCK

    def send(self, data: bytes | memoryview, *, urgent: bool = False, direct: bool = False) -> Sent:
        """See ``Socket.send``; ``direct`` changes nothing, as all hosts are on one net."""
        self._net.settle()
        connection = self._connected()
        if connection is None or connection.outgoing.finished:
            return Sent(Outcome.NOT_CONNECTED)
        if connection.lost is not None:
            return Sent(connection.lost)
        part = data[: self._net.send_limit(self.host.ip)]
        taken = connection.outgoing.write(part, urgent=urgent and len(part) == len(data))
        return Sent(Outcome.OK if taken or not data else Outcome.WOULD_BLOCK, taken)

    def recv(self, size: int, *, peek: bool = False, urgent: bool = False) -> Received:
        """See ``Socket.recv``."""
        self._net.settle()
        if size < 1:
            return Received(Outcome.INVALID)
        connection = self._connected()
        if connection is None:
            return Received(Outcome.NOT_CONNECTED)
        if urgent:
            data = connection.incoming.read_urgent(peek=peek)
            return Received(Outcome.OK if data else Outcome.NO_URGENT_DATA, data)
        data = connection.read(min(size, MAX_RECEIVE), peek=peek)
        return Received(Outcome.OK, data) if data else Received(self._why_nothing(connection))

    def recv_into(self, target: memoryview) -> Filled:
        """See ``Socket.recv_into``."""
        outcome, data = self.recv(len(target))
        target[: len(data)] = data
        return Filled(outcome, len(data))

    def shutdown(self, *, read: bool = False, write: bool = False) -> Outcome:
        """See ``Socket.shutdown``."""
        self._net.settle()
        connection = self._connected()
        if connection is None or connection.lost is not None:
            return Outcome.NOT_CONNECTED
        self._read_ended = self._read_ended or read
        if write:
            connection.finish()
        return Outcome.OK

    def close(self) -> None:
        """See ``Socket.close``."""
        self._net.settle()
        if self.state is SocketState.CLOSED:
            return
        connection = self._connected() or self._cancel_handshake()
        self._step(SocketAct.CLOSE)
        for queued in self._queue:
            queued.abort()
        self._queue.clear()
        if connection is None:
            self.host.remove(self, fading=False)
        else:
            connection.hang_up()

    def set_option(self, option: Option, value: int) -> Outcome:
        """See ``Socket.set_option``."""
        self._net.settle()
        if self.state is SocketState.CLOSED:
            return Outcome.INVALID
        outcome = self._options.set(option, value)
        connection = self._connected()
        if connection is not None:
            connection.apply_options()
        return outcome

    def option(self, option: Option) -> OptionValue:
        """See ``Socket.option``."""
        if self.state is SocketState.CLOSED:
            return OptionValue(Outcome.INVALID)
        if option not in self._options:
            return OptionValue(Outcome.INVALID)
        return OptionValue(Outcome.OK, self._options[option])

    def set_linger(self, seconds: int | None) -> Outcome:
        """See ``Socket.set_linger``."""
        if self.state is SocketState.CLOSED:
            return Outcome.INVALID
        return self._options.set_linger(seconds)

    def linger(self) -> int | None:
        """See ``Socket.linger``."""
        return None if self.state is SocketState.CLOSED else self._options.linger

    def take(self, local: Address, peer: Address) -> Connection | None:
        """Queue a connection that arrives at a listening socket.

        Args:
            local: the address the client asked for.
            peer: the client's address.

        Returns:
            The server's end, not joined yet; None if there is no room.
        """
        # As on Linux, a backlog of N holds N + 1 connections: 0 still lets one client in.
        if len(self._queue) > self._backlog or self.host.full():
            return None
        server = VirtualSocket(self.host, self.bound, reuse_address=self.reuse_address)
        self.host.add(server)
        self._queue.append(server)
        server._options.inherit(self._options)
        server._step(SocketAct.ESTABLISH)
        server._connection = server._make_connection(local, peer)
        return server._connection

    def abort(self) -> None:
        """Close a connection that nobody accepted."""
        self._step(SocketAct.CLOSE)
        if self._connection is not None:
            self._connection.abort()

    def lose_connection(self, peer_ip: str | None) -> None:
        """Lose the connection with a host (None: any but the own) at both ends at once."""
        connection = self._connection
        if connection is None or not connection.joined:
            return
        own = connection.peer.ip == self.host.ip or is_loopback(connection.peer.ip)
        if connection.peer.ip == peer_ip or (peer_ip is None and not own):
            connection.lose(Outcome.RESET)
            connection.other.lose(Outcome.RESET)

    def _step(self, act: SocketAct) -> None:
        self.state = TRANSITIONS[self.state][act]

    def _connected(self) -> Connection | None:
        return self._connection if self.state is SocketState.CONNECTED else None

    def _make_connection(self, local: Address, peer: Address) -> Connection:
        self._local = local
        return Connection(self._net, local, peer, self._options, self._leave)

    def _leave(self, fading: bool) -> None:
        self.host.remove(self, fading=fading)

    def _start_to_connect(self, peer: Address) -> None:
        self._step(SocketAct.CONNECT)
        to_self = is_loopback(peer.ip)
        own_ip = peer.ip if to_self else self.host.ip
        local = Address(own_ip if self.bound.ip in ANY_IPS else self.bound.ip, self.bound.port)
        self._connection = self._make_connection(local, peer)
        target = self.host if to_self else self._net.find_host(peer.ip)
        self._handshake = Handshake(self._net, target, self._connection)

    def _take_answer(self, handshake: Handshake) -> Outcome:
        answer = handshake.answer
        if answer is Outcome.OK and self._connection is not None:
            answer = self._connection.lost or Outcome.OK
        if answer is not Outcome.WOULD_BLOCK:
            self._handshake = None
            self._step(SocketAct.ESTABLISH if answer is Outcome.OK else SocketAct.FAIL)
        return answer

    def _cancel_handshake(self) -> Connection | None:
        """Stop connecting; return the connection if the handshake is through already."""
        handshake, self._handshake = self._handshake, None
        if handshake is None:
            return None
        handshake.cancelled = True
        return self._connection if handshake.answer is Outcome.OK else None

    @property
    def has_news(self) -> bool:
        """Whether ``accept`` or ``recv`` would not say WOULD_BLOCK now."""
        if self.state is SocketState.LISTENING:
            return bool(self._queue)
        connection = self._connected()
        if connection is None:
            return False
        return (
            bool(connection.incoming.arrived)
            or self._why_nothing(connection) is not Outcome.WOULD_BLOCK
        )

    def _why_nothing(self, connection: Connection) -> Outcome:
        """Tell why there is no byte to read."""
        if connection.lost is not None:
            return connection.lost
        ended = connection.incoming.ended or self._read_ended
        return Outcome.CLOSED if ended else Outcome.WOULD_BLOCK
