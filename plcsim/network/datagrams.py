"""UDP as function blocks see it: datagrams, never blocking, nothing raised."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol, cast

from plcsim.network.protocol import NO_ADDRESS, Address, Outcome, is_connectable, is_ipv4

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.network.protocol import Option, OptionValue, Sent

MAX_DATAGRAM = 65_507
"""Bytes of the largest datagram of IPv4."""

BROADCAST_IP = "255.255.255.255"
"""Address of all hosts on the directly connected nets."""


def is_target(peer: Address) -> bool:
    """Whether datagrams can be sent to an address: UDP here is that of IPv4."""
    return is_ipv4(peer.ip) and is_connectable(peer)


class OpenedDatagrams(NamedTuple):
    """Answer of ``DatagramNetwork.open_datagrams``; ``socket`` is there exactly for OK."""

    outcome: Outcome
    socket: DatagramSocket | None = None


class Datagram(NamedTuple):
    """Answer of ``DatagramSocket.recv``: what came, and who has sent it; no data but for OK."""

    outcome: Outcome
    data: bytes = b""
    peer: Address = NO_ADDRESS


class DatagramSocket(Protocol):
    """A port that datagrams are sent from and received at. After ``close`` it answers INVALID."""

    @property
    def local(self) -> Address:
        """The own address; ``NO_ADDRESS`` once closed."""

    @property
    def peer(self) -> Address | None:
        """The other side that ``connect`` has fixed, else None."""

    def connect(self, peer: Address) -> Outcome:
        """Fix the other side: OK or INVALID_ADDRESS. Datagrams of others are not received."""

    def disconnect(self) -> Outcome:
        """Undo ``connect``: OK."""

    def send(self, data: bytes | memoryview, target: Address | None = None) -> Sent:
        """Send one datagram; whether it arrives nobody knows.

        Args:
            data: at most `MAX_DATAGRAM` bytes.
            target: None for that of ``connect``.

        Returns:
            OK with the bytes sent, WOULD_BLOCK, NOT_CONNECTED (no target), INVALID_ADDRESS, DENIED
            (a broadcast that was not allowed), UNREACHABLE, REFUSED (the last one was) or INVALID
            (too large).
        """

    def recv(self, size: int, *, peek: bool = False) -> Datagram:
        """Take one datagram; what is beyond ``size`` bytes is lost.

        Returns:
            OK, WOULD_BLOCK (there is none), REFUSED (nobody has received the last one sent) or
            INVALID.
        """

    def set_option(self, option: Option, value: int) -> Outcome:
        """Set BROADCAST or the size of a buffer: OK or INVALID."""

    def option(self, option: Option) -> OptionValue:
        """Read it back."""

    def close(self) -> None:
        """Free the port."""


class DatagramNetwork(Protocol):
    """A host's access to UDP."""

    def open_datagrams(self, ip: str, port: int, *, reuse_address: bool = False) -> OpenedDatagrams:
        """Make a socket and bind it; arguments and outcomes are those of ``Network.open``."""


def datagrams_of(context: Context) -> DatagramNetwork:
    """Return what the blocks of a controller send datagrams over."""
    return cast("DatagramNetwork", context.network)
