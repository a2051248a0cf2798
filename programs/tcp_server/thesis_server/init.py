"""INIT of the thesis' TCP server (figure 1.3): prepare TcpOpen and call it a first time."""

from plcsim import adr

from .variables import PORT, ThesisServer


def init(self: ThesisServer) -> None:
    """Set the inputs of TcpOpen and the flags, then open the socket."""
    self.TcpOpen_1.enable = True
    self.TcpOpen_1.pIfAddr = adr(self, "ipAddr")
    self.TcpOpen_1.port = PORT

    self.counter = 0
    self.recv_ready = True
    self.serv_ready = True
    self.send_ready = True
    self.close_ready = True
    self.TcpOpen_1()
