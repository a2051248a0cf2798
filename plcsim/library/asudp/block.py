"""What all AsUDP blocks share: idents, addresses, statuses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.asudp.interface import (
    udpERR_ACCESS,
    udpERR_CONNREFUSED,
    udpERR_INVALID_IDENT,
    udpERR_PARAMETER,
    udpERR_SYSTEM,
    udpERR_UNREACHABLE,
    udpERR_WOULDBLOCK,
)
from plcsim.library.asudp.settings import AsUdpSettings
from plcsim.library.block import SynchronousBlock
from plcsim.library.idents import Idents
from plcsim.library.runtime import ERR_OK
from plcsim.network.datagrams import DatagramSocket
from plcsim.network.protocol import Address, Outcome

if TYPE_CHECKING:
    from plcsim.core.context import Context

IP_SIZE: Final = 16
"""Bytes that an IP address takes with its NUL, at most."""

STATUSES: Final = {
    Outcome.OK: ERR_OK,
    Outcome.WOULD_BLOCK: udpERR_WOULDBLOCK,
    Outcome.NO_RESOURCES: udpERR_WOULDBLOCK,
    Outcome.NOT_CONNECTED: udpERR_PARAMETER,
    Outcome.INVALID_ADDRESS: udpERR_PARAMETER,
    Outcome.INVALID: udpERR_PARAMETER,
    Outcome.DENIED: udpERR_ACCESS,
    Outcome.UNREACHABLE: udpERR_UNREACHABLE,
    Outcome.NOT_LOCAL: udpERR_UNREACHABLE,
    Outcome.REFUSED: udpERR_CONNREFUSED,
}


class UdpIdents(Idents[DatagramSocket]):
    """The sockets of a controller."""

    def __init__(self, context: Context) -> None:
        self.settings = context.settings(AsUdpSettings) or AsUdpSettings()
        super().__init__(context, self.settings.idents)

    def close(self) -> None:
        """Close all sockets."""
        for ident, socket in self:
            self.remove(ident)
            socket.close()


class AsUdpBlock(SynchronousBlock):
    """Base of the AsUDP blocks: each call polls the network and gives a status."""

    __slots__ = ()

    i_state: int
    i_result: int

    def execute(self) -> None:
        """Run one call.

        Raises:
            PageFault: a pointer input is wild; nothing was sent or taken.
        """
        super().execute()
        self.i_result = self.status

    @property
    def idents(self) -> UdpIdents:
        """The sockets of the controller."""
        return self.context.library(UdpIdents)

    def ip_at(self, address: int) -> str:
        """Return the STRING at an address as far as an IP address and one byte more can go."""
        return self.context.memory.string(address, IP_SIZE).decode("latin-1")


class SocketBlock(AsUdpBlock):
    """Base of the blocks that deal with a socket that is open."""

    __slots__ = ()

    ident: int

    def step(self) -> int:
        """Look for the socket, and act on it."""
        socket = self.idents.find(self.ident)
        return udpERR_INVALID_IDENT if socket is None else self.act(socket)

    def act(self, socket: DatagramSocket) -> int:
        """Do what the block does; return the status."""
        raise NotImplementedError(f"{type(self).__name__} has no act method.")

    def address(self, p_host: int, port: int) -> Address:
        """Return the address of another side."""
        return Address(self.ip_at(p_host), port)


def status_of(outcome: Outcome) -> int:
    """Return the status for what came of a call."""
    return STATUSES.get(outcome, udpERR_SYSTEM)
