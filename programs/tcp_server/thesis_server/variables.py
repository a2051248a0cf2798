"""The variables of the thesis' TCP server (figure 1.2), under the names they have there."""

from plcsim import Program
from plcsim.library.astcp import TcpClose, TcpOpen, TcpRecv, TcpSend, TcpServer
from st_types import ARRAY, BOOL, STRING, UINT, USINT, var

PORT = 22011


class ThesisServer(Program):
    """Answers one client: opens, waits, receives, sends the buffer back, closes.

    CYCLIC calls one block in every third cycle, 3 ms apart in a 1 ms task class. Each ``*_ready``
    flag says that a block has not been called yet, so its inputs are set exactly once; a status
    other than 0 says that the same block must be called again.
    """

    counter = var(UINT)
    codex = var(UINT)
    serv_ready = var(BOOL)
    recv_ready = var(BOOL)
    send_ready = var(BOOL)
    close_ready = var(BOOL)
    buffer = var(ARRAY(USINT, (0, 99)))
    ipAddr = var(STRING(10), "127.0.0.1")

    TcpOpen_1 = var(TcpOpen)
    TcpServer_1 = var(TcpServer)
    TcpSend_1 = var(TcpSend)
    TcpClose_1 = var(TcpClose)
    TcpRecv_1 = var(TcpRecv)
