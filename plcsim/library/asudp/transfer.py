"""UdpSend and UdpRecv: send and receive datagrams."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.library.asudp import interface
from plcsim.library.asudp.block import IP_SIZE, SocketBlock, status_of
from plcsim.library.asudp.interface import (
    udpERR_NO_DATA,
    udpERR_PARAMETER,
    udpMSG_DONTROUTE,
    udpMSG_PEEK,
)
from plcsim.library.runtime import ERR_OK
from plcsim.network.datagrams import MAX_DATAGRAM
from plcsim.network.protocol import Outcome

if TYPE_CHECKING:
    from plcsim.network.datagrams import DatagramSocket


class UdpSend(interface.UdpSend, SocketBlock):
    """Send a datagram; whether it arrives nobody knows.

    Inputs: enable; ident; pHost and port, the other side, 0 for that of UdpConnect; pData, datalen;
    flags, 0 or udpMSG_DONTROUTE, which changes nothing. Outputs: status; sentlen.

    Statuses: ERR_OK, udpERR_INVALID_IDENT, udpERR_PARAMETER (no data, too much of it, an address
    that is none, no other side), udpERR_ACCESS (a broadcast without udpOPT_BROADCAST),
    udpERR_UNREACHABLE, udpERR_WOULDBLOCK, udpERR_CONNREFUSED, udpERR_SYSTEM.
    """

    def act(self, socket: DatagramSocket) -> int:
        """Send it."""
        self.sentlen = 0
        too_much = self.datalen > MAX_DATAGRAM
        if not self.pData or too_much or self.flags & ~udpMSG_DONTROUTE:
            return udpERR_PARAMETER
        target = self.address(self.pHost, self.port) if self.pHost else None
        with self.context.memory.view(self.pData, self.datalen) as data:
            outcome, self.sentlen = socket.send(data, target)
        return status_of(outcome)


class UdpRecv(interface.UdpRecv, SocketBlock):
    """Receive a datagram; what is longer than datamax is cut.

    Inputs: enable; ident; pData, datamax; flags, 0 or udpMSG_PEEK; pIpAddr, address of 16 bytes for
    the sender's IP address, 0 for none. Outputs: status; recvlen; port of the sender.

    Statuses: ERR_OK, udpERR_NO_DATA, udpERR_INVALID_IDENT, udpERR_PARAMETER (pData or datamax 0,
    unknown flag), udpERR_CONNREFUSED, udpERR_SYSTEM.
    """

    def act(self, socket: DatagramSocket) -> int:
        """Receive it."""
        self.recvlen = 0
        if not self.pData or not self.datamax or self.flags & ~udpMSG_PEEK:
            return udpERR_PARAMETER
        memory = self.context.memory
        memory.check(self.pData, self.datamax)
        if self.pIpAddr:
            memory.check(self.pIpAddr, IP_SIZE)
        outcome, data, peer = socket.recv(self.datamax, peek=bool(self.flags & udpMSG_PEEK))
        if outcome is not Outcome.OK:
            return udpERR_NO_DATA if outcome is Outcome.WOULD_BLOCK else status_of(outcome)
        memory.write(self.pData, data)
        if self.pIpAddr:
            memory.write(self.pIpAddr, peer.ip.encode("ascii") + b"\0")
        self.recvlen, self.port = len(data), peer.port
        return ERR_OK
