"""Library AsTCP as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

__all__ = [
    "tcpERR_ALREADY_CONNECTED",
    "tcpERR_ALREADY_EXIST",
    "tcpERR_INTERFACE",
    "tcpERR_INVALID",
    "tcpERR_INVALID_IDENT",
    "tcpERR_INVALID_IOCTL",
    "tcpERR_INVALID_SSL_CONFIG",
    "tcpERR_NOCLIENT",
    "tcpERR_NOMORE_IDENTS",
    "tcpERR_NOT_CONNECTED",
    "tcpERR_NO_DATA",
    "tcpERR_NO_OOBDATA",
    "tcpERR_PARAMETER",
    "tcpERR_SENTLEN",
    "tcpERR_SOCKET_ACCEPT",
    "tcpERR_SOCKET_BIND",
    "tcpERR_SOCKET_CREATE",
    "tcpERR_SOCKET_LISTEN",
    "tcpERR_SSL_HANDSHAKE_FAILED",
    "tcpERR_SYSTEM",
    "tcpERR_WOULDBLOCK",
    "tcpID_LIST_GET",
    "tcpID_MAX_GET",
    "tcpINVALID_IDENT",
    "tcpLINGER_typ",
    "tcpMSG_DONTROUTE",
    "tcpMSG_OOB",
    "tcpMSG_PEEK",
    "tcpOPT_REUSEADDR",
    "tcpSHUT_RD",
    "tcpSHUT_WR",
    "tcpSO_ADDRESS_GET",
    "tcpSO_ADDRESS_typ",
    "tcpSO_KEEPALIVE_GET",
    "tcpSO_KEEPALIVE_SET",
    "tcpSO_LINGER_GET",
    "tcpSO_LINGER_SET",
    "tcpSO_NOWAITING_GET",
    "tcpSO_NOWAITING_SET",
    "tcpSO_OOBINLINE_GET",
    "tcpSO_OOBINLINE_SET",
    "tcpSO_RCVBUF_GET",
    "tcpSO_RCVBUF_SET",
    "tcpSO_SNDBUF_GET",
    "tcpSO_SNDBUF_SET",
    "tcpTCP_KEEPCNT_GET",
    "tcpTCP_KEEPCNT_SET",
    "tcpTCP_KEEPIDLE_GET",
    "tcpTCP_KEEPIDLE_SET",
    "tcpTCP_KEEPINTVL_GET",
    "tcpTCP_KEEPINTVL_SET",
    "tcpTCP_NODELAY_GET",
    "tcpTCP_NODELAY_SET",
]

_DECLARED = declared_beside(__name__)

tcpERR_INVALID_IDENT: Final = 32600
"""No such ident."""

tcpERR_NOMORE_IDENTS: Final = 32601
"""All idents are in use."""

tcpERR_ALREADY_EXIST: Final = 32602
"""The port is in use."""

tcpERR_PARAMETER: Final = 32603
"""An input is wrong."""

tcpERR_INVALID_IOCTL: Final = 32604
"""No such ioctl."""

tcpERR_NO_DATA: Final = 32605
"""Nothing to receive."""

tcpERR_SENTLEN: Final = 32606
"""Only a part was taken: call again for the rest."""

tcpERR_WOULDBLOCK: Final = 32607
"""The send buffer is full: call again."""

tcpERR_INVALID: Final = 32608
"""The connection could not be made."""

tcpERR_NOT_CONNECTED: Final = 32609
"""There is no connection, or none any more."""

tcpERR_ALREADY_CONNECTED: Final = 32610
"""There is a connection already."""

tcpERR_NO_OOBDATA: Final = 32611
"""No urgent data to receive."""

tcpERR_INTERFACE: Final = 32612
"""No interface has this address."""

tcpERR_NOCLIENT: Final = 32613
"""No client waits."""

tcpERR_SOCKET_CREATE: Final = 32650
"""The system gives no socket."""

tcpERR_SOCKET_BIND: Final = 32651
"""The system does not give the port."""

tcpERR_SOCKET_LISTEN: Final = 32652
"""The system does not let the socket listen."""

tcpERR_SOCKET_ACCEPT: Final = 32653
"""The system does not give the client's socket."""

tcpERR_INVALID_SSL_CONFIG: Final = 32697
"""The SSL configuration is wrong."""

tcpERR_SSL_HANDSHAKE_FAILED: Final = 32698
"""The SSL handshake failed."""

tcpERR_SYSTEM: Final = 32699
"""Any other failure of the system."""

tcpSO_LINGER_SET: Final = 1001
"""TcpLINGER_typ."""

tcpSO_LINGER_GET: Final = 1002
"""TcpLINGER_typ."""

tcpSO_KEEPALIVE_SET: Final = 1003
"""UDINT: 0 off, else on."""

tcpSO_KEEPALIVE_GET: Final = 1004
"""UDINT."""

tcpSO_SNDBUF_SET: Final = 1005
"""UDINT: bytes."""

tcpSO_SNDBUF_GET: Final = 1006
"""UDINT: bytes."""

tcpSO_RCVBUF_SET: Final = 1007
"""UDINT: bytes."""

tcpSO_RCVBUF_GET: Final = 1008
"""UDINT: bytes."""

tcpSO_OOBINLINE_SET: Final = 1009
"""UDINT: 0 off, else on."""

tcpSO_OOBINLINE_GET: Final = 1010
"""UDINT."""

tcpSO_ADDRESS_GET: Final = 1011
"""TcpSO_ADDRESS_typ."""

tcpSO_NOWAITING_SET: Final = 1012
"""UDINT: 0 TcpServer waits for a client, else it does not."""

tcpSO_NOWAITING_GET: Final = 1013
"""UDINT."""

tcpTCP_NODELAY_SET: Final = 2001
"""UDINT: 0 off, else on."""

tcpTCP_NODELAY_GET: Final = 2002
"""UDINT."""

tcpTCP_KEEPCNT_SET: Final = 2003
"""UDINT: probes."""

tcpTCP_KEEPCNT_GET: Final = 2004
"""UDINT: probes."""

tcpTCP_KEEPIDLE_SET: Final = 2005
"""UDINT: seconds."""

tcpTCP_KEEPIDLE_GET: Final = 2006
"""UDINT: seconds."""

tcpTCP_KEEPINTVL_SET: Final = 2007
"""UDINT: seconds."""

tcpTCP_KEEPINTVL_GET: Final = 2008
"""UDINT: seconds."""

tcpID_LIST_GET: Final = 3001
"""Array of UDINT: the idents in use."""

tcpID_MAX_GET: Final = 3002
"""UDINT: how many idents there are."""

tcpMSG_OOB: Final = 1
"""Urgent data."""

tcpMSG_PEEK: Final = 2
"""Leave the data in the receive buffer."""

tcpMSG_DONTROUTE: Final = 4
"""Only to hosts on the same net."""

tcpOPT_REUSEADDR: Final = 1
"""Take the port although an old connection fades out."""

tcpSHUT_RD: Final = 1
"""End receiving."""

tcpSHUT_WR: Final = 2
"""End sending."""

tcpINVALID_IDENT: Final = 0
"""Never an ident."""


class tcpLINGER_typ(Struct):
    """What TcpClose does with data that are not sent yet."""

    _plc_type = _DECLARED["tcpLINGER_typ"]

    lOnOff: int
    """0: send them in the background."""

    lLinger: int
    """Seconds; 0: discard them and reset the connection."""


class tcpSO_ADDRESS_typ(Struct):
    """Where to store the address of a socket."""

    _plc_type = _DECLARED["tcpSO_ADDRESS_typ"]

    pPort: int
    """Address of a UINT for the port, 0 for none."""

    pIpAddr: int
    """Address of 16 bytes for the IP address, 0 for none."""


class TcpOpen(FunctionBlock):
    """Opens a socket; asynchronous."""

    _plc_type = _DECLARED["TcpOpen"]

    enable: bool
    """Run the block; FALSE resets it."""

    pIfAddr: int
    """Address of the interface's IP address as a STRING, 0 for all interfaces."""

    port: int
    """Port, 0 for any free one."""

    options: int
    """TcpOPT_REUSEADDR."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_."""

    ident: int
    """The socket."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class TcpOpenSsl(FunctionBlock):
    """Opens a socket for SSL; asynchronous."""

    _plc_type = _DECLARED["TcpOpenSsl"]

    enable: bool
    """Run the block; FALSE resets it."""

    pIfAddr: int
    """Address of the interface's IP address as a STRING, 0 for all interfaces."""

    port: int
    """Port, 0 for any free one."""

    sslCfgIdent: int
    """SSL configuration."""

    options: int
    """TcpOPT_REUSEADDR."""

    status: int
    """ERR_NOTIMPLEMENTED or ERR_FUB_ENABLE_FALSE."""

    ident: int
    """The socket."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class TcpServer(FunctionBlock):
    """Waits for a client; asynchronous."""

    _plc_type = _DECLARED["TcpServer"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """Socket of TcpOpen."""

    backlog: int
    """Clients that may queue."""

    pIpAddr: int
    """Address of 16 bytes for the client's IP address, 0 for none."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_."""

    identclnt: int
    """The client's socket."""

    portclnt: int
    """The client's port."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class TcpClient(FunctionBlock):
    """Connects to a server; asynchronous."""

    _plc_type = _DECLARED["TcpClient"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """Socket of TcpOpen."""

    pServer: int
    """Address of the server's IP address as a STRING."""

    portserv: int
    """The server's port."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Start of a time limit, ms."""


class TcpClose(FunctionBlock):
    """Closes a socket and frees its ident; asynchronous."""

    _plc_type = _DECLARED["TcpClose"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    how: int
    """0, or tcpSHUT_RD and tcpSHUT_WR: what is shut down first."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class TcpSend(FunctionBlock):
    """Sends data; asynchronous."""

    _plc_type = _DECLARED["TcpSend"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    pData: int
    """Address of the data."""

    datalen: int
    """Bytes to send."""

    flags: int
    """TcpMSG_OOB, tcpMSG_DONTROUTE."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_."""

    sentlen: int
    """Bytes taken."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class TcpRecv(FunctionBlock):
    """Receives data; asynchronous."""

    _plc_type = _DECLARED["TcpRecv"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    pData: int
    """Address of the buffer."""

    datamax: int
    """Bytes of the buffer."""

    flags: int
    """TcpMSG_OOB, tcpMSG_PEEK."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_."""

    recvlen: int
    """Bytes received; 0 with status 0: the other side has finished."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class TcpIoctl(FunctionBlock):
    """Reads and sets options of a socket; asynchronous."""

    _plc_type = _DECLARED["TcpIoctl"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The socket."""

    ioctl: int
    """What to do: tcpSO_..., tcpTCP_..., tcpID_."""

    pData: int
    """Address of the value."""

    datalen: int
    """Bytes of the value."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_."""

    outlen: int
    """Bytes stored at pData."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""
