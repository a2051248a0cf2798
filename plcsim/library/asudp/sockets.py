"""UdpOpen, UdpClose, UdpConnect, UdpDisconnect."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.asudp import interface
from plcsim.library.asudp.block import AsUdpBlock, SocketBlock, status_of
from plcsim.library.asudp.interface import (
    udpERR_ALREADY_EXIST,
    udpERR_INTERFACE,
    udpERR_NOMORE_IDENTS,
    udpERR_PARAMETER,
    udpERR_SOCKET_BIND,
    udpERR_SOCKET_CREATE,
    udpERR_SYSTEM,
    udpINVALID_IDENT,
    udpOPT_BROADCAST,
    udpOPT_REUSEADDR,
    udpOPT_REUSEPORT,
)
from plcsim.library.runtime import ERR_OK
from plcsim.network.datagrams import datagrams_of
from plcsim.network.protocol import Option, Outcome

if TYPE_CHECKING:
    from plcsim.network.datagrams import DatagramSocket

_STATUSES: Final = {
    Outcome.IN_USE: udpERR_ALREADY_EXIST,
    Outcome.INVALID_ADDRESS: udpERR_INTERFACE,
    Outcome.NOT_LOCAL: udpERR_INTERFACE,
    Outcome.DENIED: udpERR_SOCKET_BIND,
    Outcome.NO_RESOURCES: udpERR_SOCKET_CREATE,
}


class UdpOpen(interface.UdpOpen, AsUdpBlock):
    """Open a socket.

    Inputs: enable; pIfAddr, address of the interface's IP address as a STRING, 0 for all; port, 0
    for any free one; options, 0 or udpOPT_REUSEADDR, udpOPT_REUSEPORT, udpOPT_BROADCAST. Outputs:
    status; ident, udpINVALID_IDENT after a failure.

    Statuses: ERR_OK, udpERR_ALREADY_EXIST (port in use), udpERR_NOMORE_IDENTS, udpERR_INTERFACE,
    udpERR_PARAMETER (unknown option), udpERR_SOCKET_BIND, udpERR_SOCKET_CREATE, udpERR_SYSTEM.
    """

    def step(self) -> int:
        """Open it."""
        self.ident = udpINVALID_IDENT
        if self.options & ~(udpOPT_REUSEADDR | udpOPT_REUSEPORT | udpOPT_BROADCAST):
            return udpERR_PARAMETER
        ip = self.ip_at(self.pIfAddr) if self.pIfAddr else ""
        if self.idents.full:
            return udpERR_NOMORE_IDENTS
        reuse = bool(self.options & (udpOPT_REUSEADDR | udpOPT_REUSEPORT))
        network = datagrams_of(self.context)
        outcome, made = network.open_datagrams(ip, self.port, reuse_address=reuse)
        if made is None:
            return _STATUSES.get(outcome, udpERR_SYSTEM)
        if self.options & udpOPT_BROADCAST:
            made.set_option(Option.BROADCAST, 1)
        self.ident = self.idents.add(made)
        return ERR_OK


class UdpClose(interface.UdpClose, SocketBlock):
    """Close a socket. Inputs: enable, ident. Output: status (ERR_OK, udpERR_INVALID_IDENT)."""

    def act(self, socket: DatagramSocket) -> int:
        """Close it."""
        self.idents.remove(self.ident)
        socket.close()
        return ERR_OK


class UdpConnect(interface.UdpConnect, SocketBlock):
    """Fix the other side: UdpSend goes there, UdpRecv takes from there only.

    Inputs: enable, ident, pHost, port. Output: status (ERR_OK, udpERR_INVALID_IDENT,
    udpERR_PARAMETER).
    """

    def act(self, socket: DatagramSocket) -> int:
        """Fix it."""
        if not self.pHost:
            return udpERR_PARAMETER
        return status_of(socket.connect(self.address(self.pHost, self.port)))


class UdpDisconnect(interface.UdpDisconnect, SocketBlock):
    """Free the other side again. Inputs: enable, ident. Output: status."""

    def act(self, socket: DatagramSocket) -> int:
        """Free it."""
        return status_of(socket.disconnect())
