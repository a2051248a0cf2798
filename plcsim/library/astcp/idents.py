"""The idents of one controller: numbers in PLC memory that stand for sockets."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from plcsim.library.astcp.interface import tcpINVALID_IDENT
from plcsim.library.astcp.settings import AsTcpSettings
from plcsim.network.protocol import network_of

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.network.protocol import Socket

LAST_IDENT = 0xFFFF_FFFF


@dataclass(slots=True)
class Endpoint:
    """What an ident stands for.

    Attributes:
        socket: of the network.
        no_waiting: TcpServer does not wait for a client (tcpSO_NOWAITING_SET).
    """

    socket: Socket
    no_waiting: bool = False


class IdentTable:
    """All idents in use. Each is given once: a stale one stays unknown for 2^32 further sockets.

    Args:
        context: the controller's; gives the settings.

    Attributes:
        settings: table [library.AsTCP].
    """

    def __init__(self, context: Context) -> None:
        self.settings = context.settings(AsTcpSettings) or AsTcpSettings()
        self._context = context
        self._endpoints: dict[int, Endpoint] = {}
        self._idents: dict[Socket, int] = {}
        self._last = tcpINVALID_IDENT

    @property
    def full(self) -> bool:
        """Whether all idents are in use."""
        return len(self._endpoints) >= self.settings.idents

    def add(self, socket: Socket) -> int:
        """Give a socket an ident; the caller sees to it that the table is not full."""
        self._last = self._last % LAST_IDENT + 1
        while self._last in self._endpoints:
            self._last = self._last % LAST_IDENT + 1
        self._endpoints[self._last] = Endpoint(socket)
        self._idents[socket] = self._last
        return self._last

    def find(self, ident: int) -> Endpoint | None:
        """Return what an ident stands for, None if it is not in use."""
        return self._endpoints.get(ident)

    def look(self) -> set[int]:
        """Return the idents with news: TcpServer gives a client, TcpRecv more than "no data"."""
        idents = self._idents
        return {idents[found] for found in network_of(self._context).look() if found in idents}

    def remove(self, ident: int) -> None:
        """Free an ident that is in use and close its socket."""
        socket = self._endpoints.pop(ident).socket
        del self._idents[socket]
        socket.close()

    def in_use(self) -> tuple[int, ...]:
        """Return all idents in use, oldest first."""
        return tuple(self._endpoints)

    def close(self) -> None:
        """Free all idents and close their sockets."""
        for ident in self.in_use():
            self.remove(ident)
