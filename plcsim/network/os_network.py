"""The network of the host: non-blocking sockets, each failure translated to an ``Outcome``."""

from __future__ import annotations

import errno
import select
import socket
import struct
from contextlib import suppress
from typing import TYPE_CHECKING, Final

from plcsim.host import descriptors
from plcsim.network import os_datagrams
from plcsim.network.os_options import read_option, set_option
from plcsim.network.os_outcomes import OUTCOMES, outcome_of
from plcsim.network.protocol import (
    ANY_IP,
    ANY_IPV6,
    MAX_BACKLOG,
    MAX_BUFFER,
    MAX_LINGER_S,
    MAX_RECEIVE,
    NO_ADDRESS,
    Accepted,
    Address,
    Filled,
    Opened,
    Option,
    OptionValue,
    Outcome,
    Received,
    Sent,
    canonical_ipv6,
    is_connectable,
    is_ipv4,
)

if TYPE_CHECKING:
    from plcsim.network.datagrams import OpenedDatagrams

_ENDS: Final = frozenset({Outcome.RESET, Outcome.TIMED_OUT, Outcome.UNREACHABLE})
"""Outcomes after which a connection is gone for good."""

_OPTIONS: Final = {
    Option.KEEPALIVE: (socket.SOL_SOCKET, socket.SO_KEEPALIVE),
    Option.SEND_BUFFER: (socket.SOL_SOCKET, socket.SO_SNDBUF),
    Option.RECEIVE_BUFFER: (socket.SOL_SOCKET, socket.SO_RCVBUF),
    Option.RECEIVE_LOW: (socket.SOL_SOCKET, socket.SO_RCVLOWAT),
    Option.URGENT_INLINE: (socket.SOL_SOCKET, socket.SO_OOBINLINE),
    Option.NO_DELAY: (socket.IPPROTO_TCP, socket.TCP_NODELAY),
    Option.KEEP_COUNT: (socket.IPPROTO_TCP, socket.TCP_KEEPCNT),
    Option.KEEP_IDLE: (socket.IPPROTO_TCP, socket.TCP_KEEPIDLE),
    Option.KEEP_INTERVAL: (socket.IPPROTO_TCP, socket.TCP_KEEPINTVL),
}

_LINGER: Final = struct.Struct("ii")

_NOTHING_YET: Final = Received(Outcome.WOULD_BLOCK)
_NOT_FILLED: Final = Filled(Outcome.WOULD_BLOCK)
_NOTHING_URGENT: Final = Received(Outcome.NO_URGENT_DATA)


_MAPPED: Final = "::ffff:"
"""Before the IPv4 literal of a peer that a socket of IPv6 hears (RFC 4291, 2.5.5.2)."""


def _address(name: tuple[str, int] | tuple[str, int, int, int]) -> Address:
    """Return an address as the host tells it, one of IPv4 as such."""
    ip = name[0]
    if ip.startswith(_MAPPED) and "." in ip:
        ip = ip[len(_MAPPED) :]
    return Address(ip, name[1])


class OsSocket:
    """A socket of the host. Made by ``OsNetwork.open`` and ``accept`` only."""

    def __init__(
        self, os_socket: socket.socket, watch: SocketWatch, peer: Address | None = None
    ) -> None:
        os_socket.settimeout(0)
        self._socket = os_socket
        self._is_ipv6 = os_socket.family == socket.AF_INET6
        self._watch = watch
        if peer is not None:
            watch.add(os_socket.fileno(), self)
        self._peer = peer
        self._listening = False
        self._target: Address | None = None
        self._write_ended = False
        self._lost: Outcome | None = None

    @property
    def listening(self) -> bool:
        """True after a successful ``listen``."""
        return self._listening

    @property
    def local(self) -> Address:
        """The own address; ``NO_ADDRESS`` once closed."""
        try:
            return _address(self._socket.getsockname())
        except OSError:
            return NO_ADDRESS

    @property
    def peer(self) -> Address | None:
        """The other end's address while connected, else None."""
        return self._peer

    def listen(self, backlog: int) -> Outcome:
        """See ``Socket.listen``."""
        if self._target is not None or self._peer is not None:
            return Outcome.INVALID
        try:
            self._socket.listen(min(backlog, MAX_BACKLOG))
        except OSError as error:
            return outcome_of(error)
        if not self._listening:
            self._listening = True
            self._watch.add(self._socket.fileno(), self)
        return Outcome.OK

    def accept(self) -> Accepted:
        """See ``Socket.accept``."""
        try:
            os_socket, peer = self._socket.accept()
        except OSError as error:
            outcome = outcome_of(error)
            # accept(2): an error of the waiting connection itself means "try the next one".
            return Accepted(Outcome.WOULD_BLOCK if outcome in _ENDS else outcome)
        address = _address(peer)
        return Accepted(Outcome.OK, OsSocket(os_socket, self._watch, address), address)

    def connect(self, peer: Address) -> Outcome:
        """See ``Socket.connect``."""
        if self._peer is not None:
            return Outcome.ALREADY_CONNECTED
        if self._listening:
            return Outcome.INVALID
        if not is_connectable(peer) or self._is_ipv6 is not (":" in peer.ip):
            return Outcome.INVALID_ADDRESS
        return self._connect(self._target or Address(canonical_ipv6(peer.ip) or peer.ip, peer.port))

    def _connect(self, peer: Address) -> Outcome:
        # Linux answers a repeated connect() with the state of the first one.
        error = self._socket.connect_ex(peer)
        outcome = OUTCOMES.get(error, Outcome.SYSTEM) if error else Outcome.OK
        self._target = peer if outcome is Outcome.WOULD_BLOCK else None
        if outcome is Outcome.OK and self.local == peer:
            # TCP lets a free port connect to itself (RFC 9293, simultaneous open).
            self.close()
            return Outcome.REFUSED
        if outcome is Outcome.OK:
            self._peer = peer
            self._watch.add(self._socket.fileno(), self)
        return outcome

    def send(self, data: bytes | memoryview, *, urgent: bool = False, direct: bool = False) -> Sent:
        """See ``Socket.send``."""
        if self._peer is None or self._write_ended:
            return Sent(Outcome.NOT_CONNECTED)
        flags = socket.MSG_NOSIGNAL
        flags |= socket.MSG_OOB if urgent else 0
        flags |= socket.MSG_DONTROUTE if direct else 0
        try:
            return Sent(Outcome.OK, self._socket.send(data, flags))
        except OSError as error:
            return Sent(self._connection_outcome(error))

    def recv(self, size: int, *, peek: bool = False, urgent: bool = False) -> Received:
        """See ``Socket.recv``."""
        if size < 1:
            return Received(Outcome.INVALID)
        if self._peer is None:
            return Received(Outcome.NOT_CONNECTED)
        flags = (socket.MSG_PEEK if peek else 0) | (socket.MSG_OOB if urgent else 0)
        try:
            data = self._socket.recv(min(size, MAX_RECEIVE), flags)
        except BlockingIOError:  # by far the commonest answer to a program that polls
            return _NOTHING_URGENT if urgent else _NOTHING_YET
        except OSError as error:
            if urgent and error.errno == errno.EINVAL:
                return _NOTHING_URGENT
            return Received(self._connection_outcome(error))
        if data:
            return Received(Outcome.OK, data)
        # The kernel tells a reset once; later it looks like an orderly end.
        return Received(self._lost or Outcome.CLOSED)

    def recv_into(self, target: memoryview) -> Filled:
        """See ``Socket.recv_into``."""
        if not target:
            return Filled(Outcome.INVALID)
        if self._peer is None:
            return Filled(Outcome.NOT_CONNECTED)
        try:
            size = self._socket.recv_into(target[:MAX_BUFFER])
        except BlockingIOError:
            return _NOT_FILLED
        except OSError as error:
            return Filled(self._connection_outcome(error))
        return Filled(Outcome.OK, size) if size else Filled(self._lost or Outcome.CLOSED)

    def _connection_outcome(self, error: OSError) -> Outcome:
        """Translate, and keep in mind that the connection is lost."""
        # EPIPE: the reset came after the peer's orderly end, or was told before.
        outcome = Outcome.RESET if error.errno == errno.EPIPE else outcome_of(error)
        if outcome in _ENDS:
            self._lost = self._lost or outcome
        return self._lost or outcome

    def shutdown(self, *, read: bool = False, write: bool = False) -> Outcome:
        """See ``Socket.shutdown``."""
        if self._peer is None:
            return Outcome.NOT_CONNECTED
        try:
            if read:
                self._socket.shutdown(socket.SHUT_RD)
            if write:
                self._socket.shutdown(socket.SHUT_WR)
        except OSError as error:
            return self._connection_outcome(error)
        self._write_ended = self._write_ended or write
        return Outcome.OK

    def close(self) -> None:
        """See ``Socket.close``."""
        if self.linger():
            # Linux waits in close() for the linger time even on a non-blocking socket.
            self.set_linger(None)
        self._peer = None
        self._target = None
        self._listening = False
        self._watch.remove(self._socket.fileno())
        with suppress(OSError):
            self._socket.close()

    def set_option(self, option: Option, value: int) -> Outcome:
        """See ``Socket.set_option``."""
        return set_option(self._socket, _OPTIONS, option, value)

    def option(self, option: Option) -> OptionValue:
        """See ``Socket.option``."""
        return read_option(self._socket, _OPTIONS, option)

    def set_linger(self, seconds: int | None) -> Outcome:
        """See ``Socket.set_linger``."""
        if seconds is not None and not 0 <= seconds <= MAX_LINGER_S:
            return Outcome.INVALID
        value = _LINGER.pack(seconds is not None, seconds or 0)
        try:
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, value)
        except OSError as error:
            return outcome_of(error)
        return Outcome.OK

    def linger(self) -> int | None:
        """See ``Socket.linger``."""
        try:
            raw = self._socket.getsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _LINGER.size)
        except OSError:
            return None
        on, seconds = _LINGER.unpack(raw)
        return int(seconds) if on else None


class SocketWatch:
    """Which sockets of a network have news; epoll(7), once somebody looks."""

    def __init__(self) -> None:
        self._sockets: dict[int, OsSocket] = {}
        self._epoll: select.epoll | None = None

    def add(self, descriptor: int, watched: OsSocket) -> None:
        """Watch a socket that listens or is connected."""
        self._sockets[descriptor] = watched
        if self._epoll is not None:
            self._epoll.register(descriptor, select.EPOLLIN)

    def remove(self, descriptor: int) -> None:
        """Watch a socket no more that is about to be closed, which takes it out of epoll."""
        self._sockets.pop(descriptor, None)

    def look(self) -> list[OsSocket]:
        """Return the sockets with news."""
        if self._epoll is None:
            self._epoll = select.epoll()
            for descriptor in self._sockets:
                self._epoll.register(descriptor, select.EPOLLIN)
        sockets = self._sockets
        return [sockets[fd] for fd, _ in self._epoll.poll(0) if fd in sockets]


class OsNetwork:
    """TCP and UDP of the host this process runs on."""

    def __init__(self) -> None:
        descriptors.make_room()
        self._watch = SocketWatch()

    def open(self, ip: str, port: int, *, reuse_address: bool = False) -> Opened:
        """See ``Network.open``."""
        ipv6 = canonical_ipv6(ip)
        if ip and not ipv6 and not is_ipv4(ip):
            return Opened(Outcome.INVALID_ADDRESS)
        if not 0 <= port < 65_536:
            return Opened(Outcome.INVALID)
        try:
            family = socket.AF_INET6 if ipv6 else socket.AF_INET
            os_socket = socket.socket(family, socket.SOCK_STREAM)
        except OSError as error:
            return Opened(outcome_of(error))
        try:
            os_socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, int(reuse_address))
            if ipv6:
                os_socket.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, ipv6 != ANY_IPV6)
            os_socket.bind((ipv6 or ip or ANY_IP, port))
        except OSError as error:
            os_socket.close()
            outcome = outcome_of(error)
            no_port_left = port == 0 and outcome is Outcome.IN_USE
            return Opened(Outcome.NO_RESOURCES if no_port_left else outcome)
        return Opened(Outcome.OK, OsSocket(os_socket, self._watch))

    def look(self) -> list[OsSocket]:
        """See ``Network.look``."""
        return self._watch.look()

    def open_datagrams(self, ip: str, port: int, *, reuse_address: bool = False) -> OpenedDatagrams:
        """See ``DatagramNetwork.open_datagrams``."""
        return os_datagrams.open_datagrams(ip, port, reuse_address=reuse_address)
