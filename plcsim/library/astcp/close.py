"""TcpClose: close a socket."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.library.astcp import interface
from plcsim.library.astcp.block import AsTcpBlock
from plcsim.library.astcp.interface import tcpERR_PARAMETER, tcpSHUT_RD, tcpSHUT_WR
from plcsim.library.runtime import ERR_OK

if TYPE_CHECKING:
    from plcsim.library.astcp.idents import IdentTable


class TcpClose(interface.TcpClose, AsTcpBlock):
    """Close a socket and free its ident, whatever ``how`` says.

    Data that TcpSend took are still sent in the background, unless linger says otherwise. Clients
    of a listening ident keep theirs; those that wait in its queue are reset.

    Inputs: enable; ident; how, 0 or tcpSHUT_RD, tcpSHUT_WR or both: what is shut down first.
    Output: status.

    Statuses: ERR_OK, tcpERR_INVALID_IDENT, tcpERR_PARAMETER (another ``how``).
    """

    def step(self, idents: IdentTable) -> int:
        """Close the socket."""
        endpoint = idents.find(self.ident)
        if endpoint is None:
            return self.unknown_ident(idents)
        if self.how & ~(tcpSHUT_RD | tcpSHUT_WR):
            return tcpERR_PARAMETER
        if self.how:
            read, write = bool(self.how & tcpSHUT_RD), bool(self.how & tcpSHUT_WR)
            endpoint.socket.shutdown(read=read, write=write)
        idents.remove(self.ident)
        return ERR_OK
