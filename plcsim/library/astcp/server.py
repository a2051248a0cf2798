"""TcpServer: wait for clients."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.library.astcp import interface
from plcsim.library.astcp.block import AsTcpBlock, ip_size, ip_string
from plcsim.library.astcp.interface import (
    tcpERR_ALREADY_CONNECTED,
    tcpERR_NOCLIENT,
    tcpERR_NOMORE_IDENTS,
    tcpERR_SOCKET_ACCEPT,
    tcpERR_SOCKET_LISTEN,
)
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_OK
from plcsim.network.protocol import Outcome

if TYPE_CHECKING:
    from plcsim.library.astcp.idents import Endpoint, IdentTable
    from plcsim.network.protocol import Socket


class TcpServer(interface.TcpServer, AsTcpBlock):
    """Wait for a client; each call after ERR_OK waits for the next one on the same ident.

    Inputs: enable; ident of TcpOpen; backlog, clients that may queue, taken from the first call;
    pIpAddr, address of 16 bytes, 46 where the ident listens in IPv6, for the client's IP address as
    a STRING, 0 for none. Outputs:
    status; identclnt for TcpSend, TcpRecv and TcpClose; portclnt. The outputs keep their values
    while nobody comes.

    Statuses: ERR_OK, ERR_FUB_BUSY (nobody yet), tcpERR_NOCLIENT (instead of BUSY after
    tcpSO_NOWAITING_SET), tcpERR_INVALID_IDENT, tcpERR_NOMORE_IDENTS (clients stay in the queue),
    tcpERR_ALREADY_CONNECTED (the ident is that of a connection), tcpERR_SOCKET_LISTEN,
    tcpERR_SOCKET_ACCEPT.
    """

    def step(self, idents: IdentTable) -> int:
        """Listen if that is not done yet, then take a client if one is there."""
        endpoint = idents.find(self.ident)
        if endpoint is None:
            return self.unknown_ident(idents)
        if self.pIpAddr:
            self.context.memory.check(self.pIpAddr, ip_size(endpoint.socket.local.ip))
        status = self._listen(endpoint.socket)
        if status != ERR_OK:
            return status
        return tcpERR_NOMORE_IDENTS if idents.full else self._accept(endpoint, idents)

    def _listen(self, listener: Socket) -> int:
        if listener.listening or listener.listen(self.backlog) is Outcome.OK:
            return ERR_OK
        return tcpERR_SOCKET_LISTEN if listener.peer is None else tcpERR_ALREADY_CONNECTED

    def _accept(self, endpoint: Endpoint, idents: IdentTable) -> int:
        outcome, client, peer = endpoint.socket.accept()
        if client is None:
            if outcome is not Outcome.WOULD_BLOCK:
                return tcpERR_SOCKET_ACCEPT
            return tcpERR_NOCLIENT if endpoint.no_waiting else ERR_FUB_BUSY
        self.identclnt = idents.give(client, peer)
        self.portclnt = peer.port
        if self.pIpAddr:
            self.context.memory.write(self.pIpAddr, ip_string(peer.ip))
        return ERR_OK
