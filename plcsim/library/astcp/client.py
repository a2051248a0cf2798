"""TcpClient: connect to a server."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.astcp import interface
from plcsim.library.astcp.block import BUSY, AsTcpBlock
from plcsim.library.astcp.interface import (
    tcpERR_ALREADY_CONNECTED,
    tcpERR_INVALID,
    tcpERR_PARAMETER,
    tcpERR_SYSTEM,
)
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_OK
from plcsim.network.protocol import Address, Outcome

if TYPE_CHECKING:
    from plcsim.library.astcp.idents import IdentTable

NS_PER_MS: Final = 1_000_000
UDINT_MASK: Final = 0xFFFF_FFFF

_STATUSES: Final = {
    Outcome.OK: ERR_OK,
    Outcome.WOULD_BLOCK: ERR_FUB_BUSY,
    Outcome.ALREADY_CONNECTED: tcpERR_ALREADY_CONNECTED,
    Outcome.INVALID_ADDRESS: tcpERR_PARAMETER,
    Outcome.NO_RESOURCES: tcpERR_SYSTEM,
    Outcome.SYSTEM: tcpERR_SYSTEM,
}


class TcpClient(interface.TcpClient, AsTcpBlock):
    """Connect a socket to a server.

    Inputs: enable; ident of TcpOpen; pServer, address of the server's IP address as a STRING;
    portserv. While it is BUSY the target is that of the first call. Names are not resolved. Output:
    status.

    Statuses: ERR_OK, ERR_FUB_BUSY, tcpERR_INVALID (refused, no route, no answer in time, a socket
    that listens), tcpERR_ALREADY_CONNECTED, tcpERR_INVALID_IDENT, tcpERR_PARAMETER (no IP
    address, one of IPv6 for a socket of IPv4 or the reverse, port 0), tcpERR_SYSTEM.
    """

    def step(self, idents: IdentTable) -> int:
        """Start to connect, or see how it goes."""
        endpoint = idents.find(self.ident)
        if endpoint is None:
            return self.unknown_ident(idents)
        if not self.pServer:
            return tcpERR_PARAMETER
        server = Address(self.ip_at(self.pServer), self.portserv)
        status = _STATUSES.get(endpoint.socket.connect(server), tcpERR_INVALID)
        if status in (ERR_OK, ERR_FUB_BUSY) and endpoint.peer is None:
            endpoint.peer = server
        if status == ERR_FUB_BUSY and self._too_late(idents.settings.connect_timeout_ns):
            return tcpERR_INVALID
        return status

    def _too_late(self, timeout_ns: int) -> bool:
        """Whether the time limit has passed since the first call that was BUSY."""
        now_ms = self.context.release_ns // NS_PER_MS & UDINT_MASK
        if self.i_state != BUSY:
            self.i_tmp = now_ms
        waited_ms = (now_ms - self.i_tmp) & UDINT_MASK
        return bool(timeout_ns) and waited_ms * NS_PER_MS >= timeout_ns
