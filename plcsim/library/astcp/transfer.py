"""TcpSend and TcpRecv: send and receive data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.astcp import interface
from plcsim.library.astcp.block import AsTcpBlock
from plcsim.library.astcp.idents import IdentTable
from plcsim.library.astcp.interface import (
    tcpERR_INVALID_IDENT,
    tcpERR_NO_DATA,
    tcpERR_NO_OOBDATA,
    tcpERR_NOT_CONNECTED,
    tcpERR_PARAMETER,
    tcpERR_SENTLEN,
    tcpERR_SYSTEM,
    tcpERR_WOULDBLOCK,
    tcpMSG_DONTROUTE,
    tcpMSG_OOB,
    tcpMSG_PEEK,
)
from plcsim.library.runtime import ERR_OK
from plcsim.network.protocol import MAX_BUFFER, Option, Outcome

if TYPE_CHECKING:
    from plcsim.core.context import Context

_ENDED: Final = {
    Outcome.RESET: tcpERR_NOT_CONNECTED,
    Outcome.TIMED_OUT: tcpERR_NOT_CONNECTED,
    Outcome.UNREACHABLE: tcpERR_NOT_CONNECTED,
    Outcome.NOT_CONNECTED: tcpERR_NOT_CONNECTED,
}
_SEND_STATUSES: Final = _ENDED | {
    Outcome.WOULD_BLOCK: tcpERR_WOULDBLOCK,
    Outcome.NO_RESOURCES: tcpERR_WOULDBLOCK,
}
_RECV_STATUSES: Final = _ENDED | {
    Outcome.OK: ERR_OK,
    Outcome.CLOSED: ERR_OK,
    Outcome.WOULD_BLOCK: tcpERR_NO_DATA,
    Outcome.NO_URGENT_DATA: tcpERR_NO_OOBDATA,
}


class TcpSend(interface.TcpSend, AsTcpBlock):
    """Hand data to the send buffer.

    Inputs: enable; ident; pData, address of the data; datalen, bytes; flags, 0 or tcpMSG_OOB,
    tcpMSG_DONTROUTE. Outputs: status; sentlen, bytes taken.

    Statuses: ERR_OK, tcpERR_SENTLEN (sentlen bytes were taken: call again for the rest),
    tcpERR_WOULDBLOCK (none were: call again), tcpERR_NOT_CONNECTED, tcpERR_INVALID_IDENT,
    tcpERR_PARAMETER (pData 0, unknown flag), tcpERR_SYSTEM.
    """

    def step(self, idents: IdentTable) -> int:
        """Send what the buffer takes."""
        self.sentlen = 0
        endpoint = idents.find(self.ident)
        if endpoint is None:
            return self.unknown_ident(idents)
        if not self.pData or self.flags & ~(tcpMSG_OOB | tcpMSG_DONTROUTE):
            return tcpERR_PARAMETER
        self.context.memory.check(self.pData, self.datalen)
        # No send buffer is larger than MAX_BUFFER: what is beyond need not be offered.
        data = self.context.memory.view(self.pData, min(self.datalen, MAX_BUFFER))
        urgent = bool(self.flags & tcpMSG_OOB) and len(data) == self.datalen
        direct = bool(self.flags & tcpMSG_DONTROUTE)
        outcome, self.sentlen = endpoint.socket.send(data, urgent=urgent, direct=direct)
        if outcome is Outcome.OK:
            return ERR_OK if self.sentlen == self.datalen else tcpERR_SENTLEN
        return _SEND_STATUSES.get(outcome, tcpERR_SYSTEM)


class TcpRecv(interface.TcpRecv, AsTcpBlock):
    """Take data from the receive buffer: a stream, without message boundaries.

    Inputs: enable; ident; pData, address of the buffer, all of which must be valid; datamax, its
    bytes; flags, 0 or tcpMSG_OOB, tcpMSG_PEEK. Outputs: status; recvlen, bytes received.

    Statuses: ERR_OK (with recvlen 0: the other side has finished), tcpERR_NO_DATA,
    tcpERR_NOT_CONNECTED (reset, lost, never there), tcpERR_NO_OOBDATA, tcpERR_INVALID_IDENT,
    tcpERR_PARAMETER (pData or datamax 0, unknown flag), tcpERR_SYSTEM.
    """

    def step(self, idents: IdentTable) -> int:
        """Receive what is there."""
        self.recvlen = 0
        endpoint = idents.find(self.ident)
        if endpoint is None:
            return self.unknown_ident(idents)
        address, size, flags = self.pData, self.datamax, self.flags
        if not address or not size or flags & ~(tcpMSG_OOB | tcpMSG_PEEK):
            return tcpERR_PARAMETER
        memory = self.context.memory
        memory.check(address, size)
        if not flags:
            outcome, self.recvlen = endpoint.socket.recv_into(memory.view(address, size))
            return _RECV_STATUSES.get(outcome, tcpERR_SYSTEM)
        peek, urgent = bool(flags & tcpMSG_PEEK), bool(flags & tcpMSG_OOB)
        outcome, data = endpoint.socket.recv(size, peek=peek, urgent=urgent)
        if data:
            memory.write(address, data)
            self.recvlen = len(data)
        return _RECV_STATUSES.get(outcome, tcpERR_SYSTEM)


def receive_outside(context: Context, ident: int, target: memoryview) -> tuple[int, int]:
    """Receive as TcpRecv does, to a place outside of PLC memory: for a library's large messages.

    Returns:
        The status of TcpRecv, and the bytes received.
    """
    endpoint = context.library(IdentTable).find(ident)
    if endpoint is None:
        return tcpERR_INVALID_IDENT, 0
    outcome, size = endpoint.socket.recv_into(target)
    return _RECV_STATUSES.get(outcome, tcpERR_SYSTEM), size


def expect_stream(context: Context, ident: int, size: int) -> None:
    """Let the host acknowledge up to ``size`` bytes that nobody has read: for ``receive_outside``.

    While ``size`` is above 1 the socket need not be told of by ``look``; see `Option.RECEIVE_LOW`.
    """
    endpoint = context.library(IdentTable).find(ident)
    if endpoint is not None:
        endpoint.socket.set_option(Option.RECEIVE_LOW, size)


def send_outside(context: Context, ident: int, data: bytes | memoryview) -> tuple[int, int]:
    """Send as TcpSend does, from a place outside of PLC memory.

    Returns:
        The status of TcpSend, and the bytes taken.
    """
    endpoint = context.library(IdentTable).find(ident)
    if endpoint is None:
        return tcpERR_INVALID_IDENT, 0
    outcome, size = endpoint.socket.send(data[:MAX_BUFFER])
    if outcome is Outcome.OK:
        return (ERR_OK if size == len(data) else tcpERR_SENTLEN), size
    return _SEND_STATUSES.get(outcome, tcpERR_SYSTEM), size
