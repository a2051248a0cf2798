"""Constants of library AsTCP (``AsTCP.var``)."""

# ruff: noqa: N816  # the constants have the controller's names

from __future__ import annotations

from typing import Final

# Statuses.
tcpERR_INVALID_IDENT: Final = 32600
tcpERR_NOMORE_IDENTS: Final = 32601
tcpERR_ALREADY_EXIST: Final = 32602
tcpERR_PARAMETER: Final = 32603
tcpERR_INVALID_IOCTL: Final = 32604
tcpERR_NO_DATA: Final = 32605
tcpERR_SENTLEN: Final = 32606
tcpERR_WOULDBLOCK: Final = 32607
tcpERR_INVALID: Final = 32608
tcpERR_NOT_CONNECTED: Final = 32609
tcpERR_ALREADY_CONNECTED: Final = 32610
tcpERR_NO_OOBDATA: Final = 32611
tcpERR_INTERFACE: Final = 32612
tcpERR_NOCLIENT: Final = 32613
tcpERR_SOCKET_CREATE: Final = 32650
tcpERR_SOCKET_BIND: Final = 32651
tcpERR_SOCKET_LISTEN: Final = 32652
tcpERR_SOCKET_ACCEPT: Final = 32653
tcpERR_INVALID_SSL_CONFIG: Final = 32697
tcpERR_SSL_HANDSHAKE_FAILED: Final = 32698
tcpERR_SYSTEM: Final = 32699

# Ioctls of TcpIoctl.
tcpSO_LINGER_SET: Final = 1001
tcpSO_LINGER_GET: Final = 1002
tcpSO_KEEPALIVE_SET: Final = 1003
tcpSO_KEEPALIVE_GET: Final = 1004
tcpSO_SNDBUF_SET: Final = 1005
tcpSO_SNDBUF_GET: Final = 1006
tcpSO_RCVBUF_SET: Final = 1007
tcpSO_RCVBUF_GET: Final = 1008
tcpSO_OOBINLINE_SET: Final = 1009
tcpSO_OOBINLINE_GET: Final = 1010
tcpSO_ADDRESS_GET: Final = 1011
tcpSO_NOWAITING_SET: Final = 1012
tcpSO_NOWAITING_GET: Final = 1013
tcpTCP_NODELAY_SET: Final = 2001
tcpTCP_NODELAY_GET: Final = 2002
tcpTCP_KEEPCNT_SET: Final = 2003
tcpTCP_KEEPCNT_GET: Final = 2004
tcpTCP_KEEPIDLE_SET: Final = 2005
tcpTCP_KEEPIDLE_GET: Final = 2006
tcpTCP_KEEPINTVL_SET: Final = 2007
tcpTCP_KEEPINTVL_GET: Final = 2008
tcpID_LIST_GET: Final = 3001
tcpID_MAX_GET: Final = 3002

# Flags of TcpSend and TcpRecv, options of TcpOpen, how of TcpClose.
tcpMSG_OOB: Final = 1
tcpMSG_PEEK: Final = 2
tcpMSG_DONTROUTE: Final = 4
tcpOPT_REUSEADDR: Final = 1
tcpSHUT_RD: Final = 1
tcpSHUT_WR: Final = 2
tcpINVALID_IDENT: Final = 0
