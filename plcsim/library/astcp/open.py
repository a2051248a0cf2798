"""TcpOpen and TcpOpenSsl: open a socket."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.astcp import interface
from plcsim.library.astcp.block import AsTcpBlock
from plcsim.library.astcp.interface import (
    tcpERR_ALREADY_EXIST,
    tcpERR_INTERFACE,
    tcpERR_NOMORE_IDENTS,
    tcpERR_PARAMETER,
    tcpERR_SOCKET_BIND,
    tcpERR_SOCKET_CREATE,
    tcpERR_SYSTEM,
    tcpINVALID_IDENT,
    tcpOPT_REUSEADDR,
)
from plcsim.library.runtime import ERR_NOTIMPLEMENTED, ERR_OK
from plcsim.network.protocol import Outcome, network_of

if TYPE_CHECKING:
    from plcsim.library.astcp.idents import IdentTable

_STATUSES: Final = {
    Outcome.IN_USE: tcpERR_ALREADY_EXIST,
    Outcome.INVALID_ADDRESS: tcpERR_INTERFACE,
    Outcome.NOT_LOCAL: tcpERR_INTERFACE,
    Outcome.DENIED: tcpERR_SOCKET_BIND,
    Outcome.NO_RESOURCES: tcpERR_SOCKET_CREATE,
}


class TcpOpen(interface.TcpOpen, AsTcpBlock):
    """Open a socket, for a server or a client.

    Inputs: enable; pIfAddr, address of the interface's IP address as a STRING, 0 or an empty STRING
    for all; beyond the library a literal of IPv6 (such as ::) makes a socket of IPv6; port, 0 for
    any free one; options, 0 or tcpOPT_REUSEADDR. Outputs: status; ident, tcpINVALID_IDENT after a
    failure.

    Statuses: ERR_OK, tcpERR_ALREADY_EXIST (port in use), tcpERR_NOMORE_IDENTS, tcpERR_INTERFACE,
    tcpERR_PARAMETER (unknown option), tcpERR_SOCKET_BIND (such as a port below 1024 without
    rights), tcpERR_SOCKET_CREATE (no more descriptors), tcpERR_SYSTEM.
    """

    def step(self, idents: IdentTable) -> int:
        """Open the socket."""
        self.ident = tcpINVALID_IDENT
        if self.options & ~tcpOPT_REUSEADDR:
            return tcpERR_PARAMETER
        ip = self.ip_at(self.pIfAddr) if self.pIfAddr else ""
        if idents.full:
            return tcpERR_NOMORE_IDENTS
        reuse_address = bool(self.options & tcpOPT_REUSEADDR)
        outcome, made = network_of(self.context).open(ip, self.port, reuse_address=reuse_address)
        if made is None:
            return _STATUSES.get(outcome, tcpERR_SYSTEM)
        self.ident = idents.give(made)
        return ERR_OK


class TcpOpenSsl(interface.TcpOpenSsl, AsTcpBlock):
    """Open a socket for SSL: not implemented, the status is ERR_NOTIMPLEMENTED."""

    def step(self, idents: IdentTable) -> int:  # the interface of all blocks
        """Say that there is no SSL."""
        return ERR_NOTIMPLEMENTED
