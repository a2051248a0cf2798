"""The idents of one controller: numbers in PLC memory that stand for sockets."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from plcsim.library.astcp.settings import AsTcpSettings
from plcsim.library.idents import Idents
from plcsim.network.protocol import network_of

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.network.protocol import Address, Socket


@dataclass(slots=True)
class Endpoint:
    """What an ident stands for.

    Attributes:
        socket: of the network.
        no_waiting: TcpServer does not wait for a client (tcpSO_NOWAITING_SET).
        peer: the other end, None where there is none yet; the socket is not asked, for a recording
            would hold the answer.
        block: that was called last with this ident, such as "TcpRecv".
        status: that it gave.
    """

    socket: Socket
    no_waiting: bool = False
    peer: Address | None = None
    block: str = ""
    status: int = 0


class IdentTable(Idents[Endpoint]):
    """All idents in use.

    Args:
        context: the controller's; gives the settings.

    Attributes:
        settings: table [library.AsTCP].
    """

    def __init__(self, context: Context) -> None:
        self.settings = context.settings(AsTcpSettings) or AsTcpSettings()
        super().__init__(context, self.settings.idents)
        self._idents: dict[Socket, int] = {}

    def give(self, socket: Socket, peer: Address | None = None) -> int:
        """Give a socket an ident; the caller sees to it that the table is not full."""
        ident = self._idents[socket] = self.add(Endpoint(socket, peer=peer))
        return ident

    def look(self) -> set[int]:
        """Return the idents with news: TcpServer gives a client, TcpRecv more than "no data"."""
        idents = self._idents
        return {idents[found] for found in network_of(self.context).look() if found in idents}

    def remove(self, ident: int) -> Endpoint | None:
        """Free an ident and close its socket; return what it stood for, None if it did for none."""
        endpoint = super().remove(ident)
        if endpoint is not None:
            del self._idents[endpoint.socket]
            endpoint.socket.close()
        return endpoint

    def in_use(self) -> tuple[int, ...]:
        """Return all idents in use, oldest first."""
        return tuple(ident for ident, _ in self)

    def close(self) -> None:
        """Free all idents and close their sockets."""
        for ident in self.in_use():
            self.remove(ident)
