"""CYCLIC of the thesis' TCP server (figure 1.4): one block in every third cycle.

Two slips of the figure are put right: TcpRecv has ``datamax``, not ``dataLen``, and the counter
counts in the other branch, so that every third cycle is the useful one, as the text says. As in the
figure the whole buffer goes back, 100 bytes, and one client is served.
"""

from plcsim import adr, sizeof

from .variables import ThesisServer


def cyclic(self: ThesisServer) -> None:
    """Call the next block, or the same one again while its status is not 0."""
    if self.counter != 2:
        self.counter += 1
        return
    self.counter = 0
    if self.TcpOpen_1.status != 0:
        self.TcpOpen_1()
        self.codex = self.TcpOpen_1.status
    elif self.serv_ready:
        self.TcpServer_1.enable = True
        self.TcpServer_1.ident = self.TcpOpen_1.ident
        self.TcpServer_1.backlog = 0
        self.TcpServer_1()
        self.serv_ready = False
        self.codex = 11
    elif self.TcpServer_1.status != 0:
        self.TcpServer_1()
        self.codex = self.TcpServer_1.status
    elif self.recv_ready:
        self.TcpRecv_1.enable = True
        self.TcpRecv_1.ident = self.TcpServer_1.identclnt
        self.TcpRecv_1.pData = adr(self.buffer)
        self.TcpRecv_1.datamax = sizeof(self.buffer)
        self.TcpRecv_1()
        self.recv_ready = False
        self.codex = 8
    elif self.TcpRecv_1.status != 0:
        self.TcpRecv_1()
    elif self.send_ready:
        self.TcpSend_1.enable = True
        self.TcpSend_1.ident = self.TcpServer_1.identclnt
        self.TcpSend_1.pData = adr(self.buffer)
        self.TcpSend_1.datalen = sizeof(self.buffer)
        self.TcpSend_1()
        self.send_ready = False
    elif self.TcpSend_1.status != 0:
        self.TcpSend_1()
    elif self.close_ready:
        self.TcpClose_1.enable = True
        self.TcpClose_1.ident = self.TcpServer_1.identclnt
        self.TcpClose_1()
        self.close_ready = False
    elif self.TcpClose_1.status != 0:
        self.TcpClose_1()
