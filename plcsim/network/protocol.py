"""The interface that function blocks see of a network, and the values it answers with.

Every call returns at once. What the world does (a refusal, a reset, no more descriptors) comes back
as an ``Outcome``; nothing is raised and no name is ever resolved: an address is a literal of IPv4
or IPv6.
"""

from __future__ import annotations

from enum import Enum, auto
from ipaddress import AddressValueError, IPv6Address
from typing import TYPE_CHECKING, NamedTuple, Protocol, cast

if TYPE_CHECKING:
    from collections.abc import Collection

    from plcsim.core.context import Context

ANY_IP = "0.0.0.0"  # noqa: S104  # the literal is compared and passed on by choice of the program
"""Address of all interfaces of a host."""

ANY_IPV6 = "::"
"""The same in IPv6; who listens there hears IPv4 as well, as by default on Linux."""

ANY_IPS = frozenset({ANY_IP, ANY_IPV6})

MAX_LITERAL = 45
"""Characters of the longest IPv6 literal (RFC 4291, 2.2)."""

MAX_RECEIVE = 65_536
"""Bytes; one ``recv`` never allocates more, whatever size is asked for."""

MAX_BACKLOG = 128
"""Connections; a longer queue that is asked for is cut to this."""

MAX_BUFFER = 1_048_576
"""Bytes; a larger send or receive buffer that is asked for is cut to this."""

MAX_RECEIVE_LOW = 8 << 20
"""Bytes; a larger `Option.RECEIVE_LOW` is cut to this."""

MAX_LINGER_S = 32_767
"""Seconds; the largest linger time that every TCP stack takes."""


class Outcome(Enum):
    """What came of a call."""

    __hash__ = object.__hash__  # that of Enum is written in Python, and every poll needs it

    OK = auto()
    WOULD_BLOCK = auto()
    """Nothing could be done yet; the same call may succeed later."""
    CLOSED = auto()
    """The peer has finished sending and all its bytes are read."""
    RESET = auto()
    """The connection was torn down by the peer."""
    TIMED_OUT = auto()
    """The peer did not answer in time, while connecting or afterwards."""
    NOT_CONNECTED = auto()
    """There is no connection to send to or receive from."""
    ALREADY_CONNECTED = auto()
    REFUSED = auto()
    """Nobody listens at the peer's port."""
    UNREACHABLE = auto()
    """No route to the peer."""
    IN_USE = auto()
    """The local port is taken."""
    INVALID_ADDRESS = auto()
    """Not a literal of IPv4 or IPv6, of the other one, or one that cannot be connected to."""
    NOT_LOCAL = auto()
    """No interface of this host has the address."""
    DENIED = auto()
    """The host does not allow it, such as a port below 1024."""
    NO_URGENT_DATA = auto()
    NO_RESOURCES = auto()
    """No more descriptors, ports or memory on this host."""
    INVALID = auto()
    """The call does not fit the state of the socket, or a value is out of range."""
    SYSTEM = auto()
    """Any other failure of the host."""


class Option(Enum):
    """Options of a socket with an integer value; 0 and 1 for switches."""

    BROADCAST = auto()
    """Of datagrams: they may go to all hosts."""
    KEEPALIVE = auto()
    SEND_BUFFER = auto()
    """Bytes."""
    RECEIVE_BUFFER = auto()
    """Bytes."""
    URGENT_INLINE = auto()
    """Leave urgent data in the stream."""
    NO_DELAY = auto()
    KEEP_COUNT = auto()
    """Unanswered probes after which the connection is lost, 1..127."""
    KEEP_IDLE = auto()
    """Seconds of silence before the first probe, 1..32767."""
    KEEP_INTERVAL = auto()
    """Seconds between probes, 1..32767."""
    RECEIVE_LOW = auto()
    """Bytes below which ``look`` need not tell of what is there, 1 at first. The host of a stream
    acknowledges so many at once though nobody has read them, else after 40 ms, which stops a sender
    whose buffer is full (Linux, tcp_input.c, __tcp_ack_snd_check). Virtual sockets wait for nothing
    of it."""


BUFFERS = frozenset({Option.SEND_BUFFER, Option.RECEIVE_BUFFER})
_KEEP_MAXIMA = {Option.KEEP_COUNT: 127, Option.KEEP_IDLE: 32_767, Option.KEEP_INTERVAL: 32_767}


def legal_value(option: Option, value: int) -> int | None:
    """Return the value that takes effect: switches 0 or 1, buffers cut; None if out of range."""
    if option is Option.RECEIVE_LOW:
        return min(max(value, 1), MAX_RECEIVE_LOW)
    if option in BUFFERS:
        return min(max(value, 1), MAX_BUFFER)
    if option in _KEEP_MAXIMA:
        return value if 0 < value <= _KEEP_MAXIMA[option] else None
    return int(value != 0)


class Address(NamedTuple):
    """A literal and a port; ``ip`` is ``0.0.0.0`` or ``::`` where all interfaces are meant."""

    ip: str
    port: int


NO_ADDRESS = Address(ANY_IP, 0)


class Opened(NamedTuple):
    """Answer of ``Network.open``; ``socket`` is there exactly when the outcome is OK."""

    outcome: Outcome
    socket: Socket | None = None


class Accepted(NamedTuple):
    """Answer of ``Socket.accept``; ``socket`` is there exactly when the outcome is OK."""

    outcome: Outcome
    socket: Socket | None = None
    peer: Address = NO_ADDRESS


class Sent(NamedTuple):
    """Answer of ``Socket.send``: how many bytes were taken, which may be fewer than given."""

    outcome: Outcome
    taken: int = 0


class Received(NamedTuple):
    """Answer of ``Socket.recv``; at least one byte when the outcome is OK, else none."""

    outcome: Outcome
    data: bytes = b""


class Filled(NamedTuple):
    """Answer of ``Socket.recv_into``; at least one byte when the outcome is OK, else none."""

    outcome: Outcome
    size: int = 0


class OptionValue(NamedTuple):
    """Answer of ``Socket.option``."""

    outcome: Outcome
    value: int = 0


class Socket(Protocol):
    """One end of TCP. After ``close`` every call answers as an unconnected socket does."""

    @property
    def listening(self) -> bool:
        """True after a successful ``listen``."""

    @property
    def local(self) -> Address:
        """The own address; ``NO_ADDRESS`` once closed."""

    @property
    def peer(self) -> Address | None:
        """The other end's address while connected, else None."""

    def listen(self, backlog: int) -> Outcome:
        """Queue connections that arrive, ``backlog`` of them (at most ``MAX_BACKLOG``).

        Returns:
            OK, IN_USE (another socket listens at the port) or INVALID (connecting, connected).
        """

    def accept(self) -> Accepted:
        """Take the oldest queued connection.

        Returns:
            OK, WOULD_BLOCK (nobody in the queue), NO_RESOURCES (the queue keeps the connection)
            or INVALID (not listening).
        """

    def connect(self, peer: Address) -> Outcome:
        """Start to connect, or tell how it goes: call until it is not WOULD_BLOCK.

        While it is under way, ``peer`` of later calls is not looked at.

        Returns:
            OK (once, when connected), WOULD_BLOCK, REFUSED, UNREACHABLE, TIMED_OUT, RESET (at
            once after the connection), INVALID_ADDRESS, ALREADY_CONNECTED or INVALID (listening,
            closed).
        """

    def send(self, data: bytes | memoryview, *, urgent: bool = False, direct: bool = False) -> Sent:
        """Hand bytes to the send buffer.

        Args:
            data: the bytes; none are kept by reference.
            urgent: mark the last byte as urgent (MSG_OOB).
            direct: send to hosts on directly connected nets only (MSG_DONTROUTE).

        Returns:
            OK with the bytes taken, WOULD_BLOCK (the buffer is full, none taken), RESET,
            TIMED_OUT, UNREACHABLE or NOT_CONNECTED (also after ``shutdown`` of writing).
        """

    def recv(self, size: int, *, peek: bool = False, urgent: bool = False) -> Received:
        """Take up to ``size`` bytes, at most ``MAX_RECEIVE``.

        Args:
            size: bytes, above 0.
            peek: leave the bytes in the buffer.
            urgent: take the urgent byte instead of the stream (MSG_OOB).

        Returns:
            OK with bytes, WOULD_BLOCK, CLOSED, RESET, TIMED_OUT, UNREACHABLE, NOT_CONNECTED,
            NO_URGENT_DATA or INVALID (``size`` below 1).
        """

    def recv_into(self, target: memoryview) -> Filled:
        """Take bytes to their place, without a copy in between; for the rest as ``recv``.

        Args:
            target: takes up to ``MAX_BUFFER`` bytes; not empty.
        """

    def shutdown(self, *, read: bool = False, write: bool = False) -> Outcome:
        """End one direction or both: OK or NOT_CONNECTED."""

    def close(self) -> None:
        """Free the socket. Unsent bytes go out in the background, unless linger is 0: then RST."""

    def set_option(self, option: Option, value: int) -> Outcome:
        """Set an option: OK, or INVALID for a value out of range or a closed socket."""

    def option(self, option: Option) -> OptionValue:
        """Read an option: OK with the value, or INVALID for a closed socket."""

    def set_linger(self, seconds: int | None) -> Outcome:
        """Choose what ``close`` does with unsent bytes.

        Args:
            seconds: None sends them in the background, 0 discards them and resets the connection.
                A time above 0 is remembered but ``close`` does not wait: it acts as None does.

        Returns:
            OK, or INVALID (negative, above ``MAX_LINGER_S``, closed socket).
        """

    def linger(self) -> int | None:
        """Read back ``set_linger``; None once closed."""


class Network(Protocol):
    """A host's access to TCP."""

    def open(self, ip: str, port: int, *, reuse_address: bool = False) -> Opened:
        """Make a socket and bind it.

        Args:
            ip: literal of an own interface, of IPv6 for a socket of IPv6; empty or ``0.0.0.0``
                for all of IPv4, ``::`` for all.
            port: 0..65535, 0 for any free one.
            reuse_address: bind even if an earlier connection of the port still fades out.

        Returns:
            OK with the socket, IN_USE, NOT_LOCAL, INVALID_ADDRESS, DENIED, NO_RESOURCES,
            INVALID (port out of range) or SYSTEM.
        """

    def look(self) -> Collection[Socket]:
        """Return the sockets with news: ``accept`` or ``recv`` would not say WOULD_BLOCK now.

        One call to the host tells of all sockets, so that a program of many connections need not
        try each. Urgent data are no news.
        """


def network_of(context: Context) -> Network:
    """Return what the blocks of a controller talk over."""
    return cast("Network", context.network)


def is_ipv4(text: str) -> bool:
    """Whether ``text`` is four decimal numbers 0..255 joined by dots, without leading zeros."""
    parts = text.split(".")
    return len(parts) == 4 and all(_is_byte(part) for part in parts)


def is_ipv6(text: str) -> bool:
    """Whether ``text`` is an IPv6 literal (RFC 4291, 2.2), without a zone."""
    return canonical_ipv6(text) is not None


def canonical_ipv6(text: str) -> str | None:
    """Return an IPv6 literal as RFC 5952 writes it; None for any other text, or with a zone."""
    if ":" not in text or "%" in text or len(text) > MAX_LITERAL:
        return None
    try:
        return str(IPv6Address(text))
    except AddressValueError:
        return None


def is_ip(text: str) -> bool:
    """Whether ``text`` is a literal of IPv4 or IPv6."""
    return is_ipv4(text) or is_ipv6(text)


def is_connectable(peer: Address) -> bool:
    """Whether ``peer`` can be the other end of a connection: a literal and a port above 0."""
    return is_ip(peer.ip) and peer.ip not in ANY_IPS and 0 < peer.port < 65_536


def _is_byte(text: str) -> bool:
    if not (text.isascii() and text.isdecimal() and len(text) <= 3):
        return False
    return int(text) < 256 and (text == "0" or text[0] != "0")
