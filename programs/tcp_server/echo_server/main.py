"""An echo server for many clients, for ever.

Every client has a slot with its own blocks and buffer. In each cycle the server takes new clients
while there is a free slot, and every slot does one bounded step: receive what is there, or send
the rest of what was received. A client that does not read is not read from either; it costs its
own slot and nothing else.
"""

from enum import IntEnum

from plcsim import Program, adr, sizeof
from plcsim.library.astcp import (
    ERR_FUB_BUSY,
    ERR_OK,
    TcpClose,
    TcpIoctl,
    TcpOpen,
    TcpRecv,
    TcpSend,
    TcpServer,
    tcpERR_NO_DATA,
    tcpERR_SENTLEN,
    tcpERR_WOULDBLOCK,
    tcpOPT_REUSEADDR,
    tcpSO_NOWAITING_SET,
)
from st_types import ARRAY, ENUM, STRING, UDINT, UINT, USINT, Struct, var

PORT = 22012
CLIENTS = 64
ACCEPTED_PER_CYCLE = 8


class Step(IntEnum):
    """What a client's slot does next."""

    FREE = 0
    RECEIVE = 1
    SEND = 2
    CLOSE = 3


class Client(Struct):
    """One client: its blocks, and the bytes that are on their way back to it."""

    step = var(ENUM(Step))
    ident = var(UDINT)
    sent = var(UDINT)
    received = var(UDINT)
    data = var(ARRAY(USINT, (0, 1023)))
    recv = var(TcpRecv)
    send = var(TcpSend)
    close = var(TcpClose)


class EchoServer(Program):
    """Accepts up to CLIENTS clients at once and sends every byte back."""

    address = var(STRING(15), "127.0.0.1")
    open = var(TcpOpen)
    nowait = var(TcpIoctl)
    on = var(UDINT, 1)
    listen = var(TcpServer)
    clients = var(ARRAY(Client, (1, CLIENTS)))
    connected = var(UINT)
    served = var(UDINT)
    status = var(UINT, ERR_FUB_BUSY)

    def init(self) -> None:
        """Prepare the blocks; CYCLIC calls them."""
        self.open.pIfAddr = adr(self, "address")
        self.open.port = PORT
        self.open.options = tcpOPT_REUSEADDR
        self.listen.backlog = CLIENTS
        for client in self.clients:
            client.recv.pData = client.send.pData = adr(client.data)
            client.recv.datamax = sizeof(client.data)

    def cyclic(self) -> None:
        """Open once, then accept, receive and send."""
        if self.status != ERR_OK:
            self.start()
            return
        self.accept()
        if self.connected:
            for client in self.clients:
                if client.step != Step.FREE:
                    self.serve(client)

    def start(self) -> None:
        """Open the listening socket; a port in use shows in ``status`` and is tried again."""
        self.open(enable=True)
        if self.open.status == ERR_OK:
            self.nowait.pData, self.nowait.datalen = adr(self, "on"), sizeof(self, "on")
            self.nowait(enable=True, ident=self.open.ident, ioctl=tcpSO_NOWAITING_SET)
        self.status = self.open.status

    def accept(self) -> None:
        """Give new clients a slot; without a free one they wait in the backlog."""
        for _ in range(ACCEPTED_PER_CYCLE):
            if self.connected == CLIENTS:
                return
            self.listen(enable=True, ident=self.open.ident)
            if self.listen.status != ERR_OK:
                return
            client = next(c for c in self.clients if c.step == Step.FREE)
            client.step = Step.RECEIVE
            client.ident = self.listen.identclnt
            self.connected += 1

    def serve(self, client: Client) -> None:
        """Do one step for one client."""
        if client.step == Step.RECEIVE:
            self.receive(client)
        if client.step == Step.SEND:
            self.send_back(client)
        if client.step == Step.CLOSE:
            self.hang_up(client)

    def receive(self, client: Client) -> None:
        """Take what has come; no bytes with status 0 mean that the client has finished."""
        client.recv(enable=True, ident=client.ident)
        if client.recv.status == ERR_OK:
            client.received, client.sent = client.recv.recvlen, 0
            client.step = Step.SEND if client.received else Step.CLOSE
        elif client.recv.status not in (tcpERR_NO_DATA, ERR_FUB_BUSY):
            client.step = Step.CLOSE

    def send_back(self, client: Client) -> None:
        """Send what is left of the bytes received; what does not fit is sent in later cycles."""
        client.send.pData = adr(client.data) + client.sent
        client.send(enable=True, ident=client.ident, datalen=client.received - client.sent)
        if client.send.status in (ERR_OK, tcpERR_SENTLEN):
            client.sent += client.send.sentlen
            if client.sent == client.received:
                client.step = Step.RECEIVE
        elif client.send.status not in (tcpERR_WOULDBLOCK, ERR_FUB_BUSY):
            client.step = Step.CLOSE

    def hang_up(self, client: Client) -> None:
        """Close the client's socket and free its slot."""
        client.close(enable=True, ident=client.ident)
        if client.close.status != ERR_FUB_BUSY:
            client.step = Step.FREE
            self.connected -= 1
            self.served += 1

    def exit(self) -> None:
        """Close all clients, then the listening socket."""
        for client in self.clients:
            if client.step != Step.FREE:
                client.step = Step.CLOSE
                self.hang_up(client)
        self.clients[1].close(enable=True, ident=self.open.ident)
