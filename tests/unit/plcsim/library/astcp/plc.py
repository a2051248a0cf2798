"""Two controllers on a virtual net, and the blocks of each."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.astcp import (
    ERR_FUB_BUSY,
    ERR_OK,
    TcpClient,
    TcpClose,
    TcpIoctl,
    TcpOpen,
    TcpRecv,
    TcpSend,
    TcpServer,
)
from plcsim.library.astcp.idents import IdentTable
from plcsim.library.astcp.settings import AsTcpSettings
from plcsim.network import Link, VirtualNetwork, WireLimits
from plcsim.settings import Table

if TYPE_CHECKING:
    from plcsim.core.function_block import FunctionBlock
    from plcsim.network import Network

B = TypeVar("B", bound="FunctionBlock")

SERVER = "192.168.0.10"
CLIENT = "192.168.0.20"
PORT = 22_011
MS = 1_000_000
SECOND = 1_000_000_000
WILD = 0x7000_0000


class Plc:
    """A controller's context, and shortcuts to call its blocks."""

    def __init__(self, network: Network, **options: object) -> None:
        settings = Table(Path("plc.toml"), "library.AsTCP", options).read(AsTcpSettings)
        self.memory = Memory(1024 * 1024)
        self.context = Context(self.memory, network, [settings])
        self.buffer = self.memory.allocate(8192)

    @property
    def idents(self) -> IdentTable:
        return self.context.library(IdentTable)

    def new(self, block: type[B]) -> B:
        return self.memory.new(block, self.context)

    def text(self, text: str) -> int:
        """Store a STRING; return its address."""
        address = self.memory.allocate(81)
        self.memory.write(address, text.encode("latin-1") + b"\0")
        return address

    def call(self, block: type[B], **inputs: object) -> B:
        """Make a block, enable it, call it once."""
        made = self.new(block)
        made(enable=True, **inputs)
        return made

    def open(self, port: int = 0, options: int = 0, address: str = "") -> TcpOpen:
        return self.call(
            TcpOpen, port=port, options=options, pIfAddr=self.text(address) if address else 0
        )

    def listen(self, port: int = PORT, backlog: int = 3) -> TcpServer:
        """Open and listen; the first call of TcpServer is done and found nobody."""
        opened = self.open(port)
        assert opened.status == ERR_OK
        server = self.call(TcpServer, ident=opened.ident, backlog=backlog)
        assert server.status == ERR_FUB_BUSY
        return server

    def dial(self, address: str = SERVER, port: int = PORT) -> TcpClient:
        opened = self.open()
        assert opened.status == ERR_OK
        return self.call(TcpClient, ident=opened.ident, pServer=self.text(address), portserv=port)

    def send(self, ident: int, data: bytes, flags: int = 0) -> TcpSend:
        self.memory.write(self.buffer, data)
        return self.call(TcpSend, ident=ident, pData=self.buffer, datalen=len(data), flags=flags)

    def recv(self, ident: int, datamax: int = 8192, flags: int = 0) -> TcpRecv:
        return self.call(TcpRecv, ident=ident, pData=self.buffer, datamax=datamax, flags=flags)

    def received(self, recv: TcpRecv) -> bytes:
        return self.memory.read(recv.pData, recv.recvlen)

    def close(self, ident: int, how: int = 0) -> int:
        return self.call(TcpClose, ident=ident, how=how).status

    def ioctl(self, ident: int, ioctl: int, data: bytes = bytes(4)) -> TcpIoctl:
        self.memory.write(self.buffer, data)
        return self.call(TcpIoctl, ident=ident, ioctl=ioctl, pData=self.buffer, datalen=len(data))

    def got(self, ioctl: TcpIoctl) -> bytes:
        return self.memory.read(ioctl.pData, ioctl.outlen)


class World:
    """A server's and a client's controller."""

    def __init__(
        self, *, limits: WireLimits | None = None, link: Link | None = None, **options: object
    ) -> None:
        self.now_ns = 0
        self.net = VirtualNetwork(lambda: self.now_ns, limits=limits, link=link, call_ns=0)
        self.server = Plc(self.net.host(SERVER), **options)
        self.client = Plc(self.net.host(CLIENT), **options)

    def pass_time(self, time_ns: int) -> None:
        self.now_ns += time_ns
        self.server.context.release_ns = self.client.context.release_ns = self.now_ns

    def connect(self, server: TcpServer) -> tuple[int, int]:
        """Connect a client; return the client's ident and the server's for it."""
        client = self.client.dial()
        assert client.status == ERR_FUB_BUSY
        client()
        assert client.status == ERR_OK
        server()
        assert server.status == ERR_OK
        return client.ident, server.identclnt

    def pair(self) -> tuple[int, int]:
        return self.connect(self.server.listen())
