"""Library AsUDP as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

__all__ = [
    "udpERR_ACCESS",
    "udpERR_ALREADY_EXIST",
    "udpERR_CONNREFUSED",
    "udpERR_FIREWALL",
    "udpERR_INTERFACE",
    "udpERR_INVALID_IDENT",
    "udpERR_INVALID_IOCTL",
    "udpERR_NOMORE_IDENTS",
    "udpERR_NO_DATA",
    "udpERR_PARAMETER",
    "udpERR_SENTLEN",
    "udpERR_SOCKET_BIND",
    "udpERR_SOCKET_CONNECT",
    "udpERR_SOCKET_CREATE",
    "udpERR_SYSTEM",
    "udpERR_UNREACHABLE",
    "udpERR_WOULDBLOCK",
    "udpID_LIST_GET",
    "udpID_MAX_GET",
    "udpINVALID_IDENT",
    "udpIP_ADD_MEMBERSHIP",
    "udpIP_DROP_MEMBERSHIP",
    "udpIP_MREQ_typ",
    "udpIP_MULTICAST_IF_GET",
    "udpIP_MULTICAST_IF_SET",
    "udpIP_MULTICAST_LOOP_GET",
    "udpIP_MULTICAST_LOOP_SET",
    "udpIP_MULTICAST_TTL_GET",
    "udpIP_MULTICAST_TTL_SET",
    "udpIP_TOS_GET",
    "udpIP_TOS_LOWDELAY",
    "udpIP_TOS_MINCOST",
    "udpIP_TOS_RELIABILITY",
    "udpIP_TOS_SET",
    "udpIP_TOS_THROUGHPUT",
    "udpIP_TTL_GET",
    "udpIP_TTL_SET",
    "udpMSG_DONTROUTE",
    "udpMSG_PEEK",
    "udpOPT_BROADCAST",
    "udpOPT_REUSEADDR",
    "udpOPT_REUSEPORT",
    "udpSO_ADDRESS_GET",
    "udpSO_ADDRESS_typ",
    "udpSO_BINDTODEVICE",
    "udpSO_BROADCAST_GET",
    "udpSO_BROADCAST_SET",
    "udpSO_RCVBUF_GET",
    "udpSO_RCVBUF_SET",
    "udpSO_SNDBUF_GET",
    "udpSO_SNDBUF_SET",
]

_DECLARED = declared_beside(__name__)

udpERR_INVALID_IDENT: Final = 32500

udpERR_NOMORE_IDENTS: Final = 32501

udpERR_ALREADY_EXIST: Final = 32502

udpERR_PARAMETER: Final = 32503

udpERR_INVALID_IOCTL: Final = 32504

udpERR_NO_DATA: Final = 32505

udpERR_SENTLEN: Final = 32506

udpERR_WOULDBLOCK: Final = 32507

udpERR_CONNREFUSED: Final = 32508

udpERR_ACCESS: Final = 32509

udpERR_UNREACHABLE: Final = 32510

udpERR_INTERFACE: Final = 32511

udpERR_FIREWALL: Final = 32512

udpERR_SOCKET_CREATE: Final = 32550

udpERR_SOCKET_BIND: Final = 32551

udpERR_SOCKET_CONNECT: Final = 32552

udpERR_SYSTEM: Final = 32599

udpSO_BROADCAST_SET: Final = 1001

udpSO_BROADCAST_GET: Final = 1002

udpSO_SNDBUF_SET: Final = 1003

udpSO_SNDBUF_GET: Final = 1004

udpSO_RCVBUF_SET: Final = 1005

udpSO_RCVBUF_GET: Final = 1006

udpSO_ADDRESS_GET: Final = 1007

udpSO_BINDTODEVICE: Final = 1008

udpIP_ADD_MEMBERSHIP: Final = 2001

udpIP_DROP_MEMBERSHIP: Final = 2002

udpIP_MULTICAST_IF_SET: Final = 2003

udpIP_MULTICAST_IF_GET: Final = 2004

udpIP_MULTICAST_TTL_SET: Final = 2005

udpIP_MULTICAST_TTL_GET: Final = 2006

udpIP_MULTICAST_LOOP_SET: Final = 2007

udpIP_MULTICAST_LOOP_GET: Final = 2008

udpIP_TOS_SET: Final = 2009

udpIP_TOS_GET: Final = 2010

udpIP_TTL_SET: Final = 2011

udpIP_TTL_GET: Final = 2012

udpID_LIST_GET: Final = 3001

udpID_MAX_GET: Final = 3002

udpMSG_PEEK: Final = 1

udpMSG_DONTROUTE: Final = 2

udpOPT_REUSEADDR: Final = 1

udpOPT_REUSEPORT: Final = 2

udpOPT_BROADCAST: Final = 4

udpIP_TOS_LOWDELAY: Final = 16

udpIP_TOS_THROUGHPUT: Final = 8

udpIP_TOS_RELIABILITY: Final = 4

udpIP_TOS_MINCOST: Final = 2

udpINVALID_IDENT: Final = 0


class udpIP_MREQ_typ(Struct):
    """UdpIP_MREQ_typ."""

    _plc_type = _DECLARED["udpIP_MREQ_typ"]

    pMcastAddr: int

    pIfAddr: int
    """Address of the interface's IP address as a STRING, 0 for all interfaces."""


class udpSO_ADDRESS_typ(Struct):
    """UdpSO_ADDRESS_typ."""

    _plc_type = _DECLARED["udpSO_ADDRESS_typ"]

    pPort: int

    pIpAddr: int
    """Address of 16 bytes for the sender's IP address, 0 for none."""


class UdpOpen(FunctionBlock):
    """Opens a socket; asynchronous."""

    _plc_type = _DECLARED["UdpOpen"]

    enable: bool
    """Run the block; FALSE resets it."""

    pIfAddr: int
    """Address of the interface's IP address as a STRING, 0 for all interfaces."""

    port: int
    """Port, 0 for any free one."""

    options: int
    """UdpOPT_REUSEADDR, udpOPT_BROADCAST."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The socket."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UdpClose(FunctionBlock):
    """Closes a socket; asynchronous."""

    _plc_type = _DECLARED["UdpClose"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UdpConnect(FunctionBlock):
    """Fixes the other side of a socket; asynchronous."""

    _plc_type = _DECLARED["UdpConnect"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    pHost: int
    """Address of the other side's IP address as a STRING, 0 where it is connected."""

    port: int
    """Port of the other side."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UdpDisconnect(FunctionBlock):
    """Frees the other side again; asynchronous."""

    _plc_type = _DECLARED["UdpDisconnect"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UdpSend(FunctionBlock):
    """Sends a datagram; asynchronous."""

    _plc_type = _DECLARED["UdpSend"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    pHost: int
    """Address of the other side's IP address as a STRING, 0 where it is connected."""

    port: int
    """Port of the other side."""

    pData: int
    """Address of the data."""

    datalen: int
    """Bytes."""

    flags: int
    """UdpMSG_PEEK, udpMSG_DONTROUTE."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    sentlen: int
    """Bytes sent."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UdpRecv(FunctionBlock):
    """Receives a datagram; asynchronous."""

    _plc_type = _DECLARED["UdpRecv"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    pData: int
    """Address of the data."""

    datamax: int
    """Bytes there."""

    flags: int
    """UdpMSG_PEEK, udpMSG_DONTROUTE."""

    pIpAddr: int
    """Address of 16 bytes for the sender's IP address, 0 for none."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    recvlen: int
    """Bytes received."""

    port: int
    """Port of the other side."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class UdpIoctl(FunctionBlock):
    """Options of a socket; asynchronous."""

    _plc_type = _DECLARED["UdpIoctl"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    ioctl: int
    """UdpSO_."""

    pData: int
    """Address of the data."""

    datalen: int
    """Bytes."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    outlen: int
    """Bytes at pData."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""
