"""UdpIoctl: options of a socket and of the library."""

from __future__ import annotations

from struct import Struct as Format
from typing import TYPE_CHECKING, Final

from plcsim.library.asudp import interface
from plcsim.library.asudp.block import IP_SIZE, AsUdpBlock
from plcsim.library.asudp.interface import (
    udpERR_INVALID_IDENT,
    udpERR_INVALID_IOCTL,
    udpERR_PARAMETER,
)
from plcsim.library.runtime import ERR_OK
from plcsim.network.protocol import Option, Outcome

if TYPE_CHECKING:
    from plcsim.network.datagrams import DatagramSocket

_UDINT: Final = Format("<I")
_PAIR: Final = Format("<II")
_UINT: Final = Format("<H")

_SET: Final = {
    interface.udpSO_BROADCAST_SET: Option.BROADCAST,
    interface.udpSO_SNDBUF_SET: Option.SEND_BUFFER,
    interface.udpSO_RCVBUF_SET: Option.RECEIVE_BUFFER,
}
_GET: Final = {
    interface.udpSO_BROADCAST_GET: Option.BROADCAST,
    interface.udpSO_SNDBUF_GET: Option.SEND_BUFFER,
    interface.udpSO_RCVBUF_GET: Option.RECEIVE_BUFFER,
}


class UdpIoctl(interface.UdpIoctl, AsUdpBlock):
    """Read or set an option.

    Inputs: enable; ident, not looked at by udpID_...; ioctl; pData, address of the value; datalen,
    its bytes: 8 for udpSO_ADDRESS_GET, a multiple of 4 for udpID_LIST_GET, 4 for all others.
    Outputs: status; outlen, bytes stored at pData.

    Statuses: ERR_OK, udpERR_INVALID_IOCTL, udpERR_INVALID_IDENT, udpERR_PARAMETER.
    """

    def step(self) -> int:
        """Do what ioctl says."""
        self.outlen = 0
        size = _PAIR.size if self.ioctl == interface.udpSO_ADDRESS_GET else _UDINT.size
        is_list = self.ioctl == interface.udpID_LIST_GET
        fits = self.datalen % size == 0 if is_list else self.datalen == size
        if not self.pData or not self.datalen or not fits:
            return udpERR_PARAMETER
        self.context.memory.check(self.pData, self.datalen)
        if is_list:
            idents = [ident for ident, _ in self.idents][: self.datalen // size]
            return self._store(b"".join(map(_UDINT.pack, idents)))
        if self.ioctl == interface.udpID_MAX_GET:
            return self._store(_UDINT.pack(self.idents.settings.idents))
        socket = self.idents.find(self.ident)
        return udpERR_INVALID_IDENT if socket is None else self._of_socket(socket)

    def _of_socket(self, socket: DatagramSocket) -> int:
        data = self.context.memory.read(self.pData, self.datalen)
        if self.ioctl == interface.udpSO_ADDRESS_GET:
            return self._store_address(socket, *_PAIR.unpack(data))
        if self.ioctl in _SET:
            (value,) = _UDINT.unpack(data)
            outcome = socket.set_option(_SET[self.ioctl], value)
            return ERR_OK if outcome is Outcome.OK else udpERR_PARAMETER
        if self.ioctl in _GET:
            return self._store(_UDINT.pack(socket.option(_GET[self.ioctl]).value))
        return udpERR_INVALID_IOCTL

    def _store(self, data: bytes) -> int:
        self.context.memory.write(self.pData, data)
        self.outlen = len(data)
        return ERR_OK

    def _store_address(self, socket: DatagramSocket, port_at: int, ip_at: int) -> int:
        memory, local = self.context.memory, socket.local
        for address, size in ((port_at, _UINT.size), (ip_at, IP_SIZE)):
            if address:
                memory.check(address, size)
        if port_at:
            memory.write(port_at, _UINT.pack(local.port))
        if ip_at:
            memory.write(ip_at, local.ip.encode("ascii") + b"\0")
        self.outlen = _PAIR.size
        return ERR_OK
