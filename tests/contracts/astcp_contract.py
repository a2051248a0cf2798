"""What a program sees of AsTCP, whatever network the blocks run on.

The programs here do what public programs do: they call a block again while it is BUSY, and look at
the status.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory, adr, sizeof
from plcsim.library.astcp import (
    ERR_FUB_BUSY,
    ERR_FUB_ENABLE_FALSE,
    ERR_OK,
    TcpClient,
    TcpClose,
    TcpIoctl,
    TcpOpen,
    TcpRecv,
    TcpSend,
    TcpServer,
    tcpERR_ALREADY_CONNECTED,
    tcpERR_ALREADY_EXIST,
    tcpERR_INTERFACE,
    tcpERR_INVALID,
    tcpERR_INVALID_IDENT,
    tcpERR_NO_DATA,
    tcpERR_NO_OOBDATA,
    tcpERR_NOCLIENT,
    tcpERR_NOMORE_IDENTS,
    tcpERR_NOT_CONNECTED,
    tcpERR_SENTLEN,
    tcpERR_WOULDBLOCK,
    tcpMSG_OOB,
    tcpMSG_PEEK,
    tcpOPT_REUSEADDR,
    tcpSO_ADDRESS_GET,
    tcpSO_ADDRESS_typ,
    tcpSO_LINGER_SET,
    tcpSO_NOWAITING_SET,
)
from st_types import STRING, UDINT, UINT, Struct, var

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from plcsim.core.function_block import FunctionBlock
    from plcsim.network import Network

    from .network_rigs import Rig

B = TypeVar("B", bound="FunctionBlock")
PATIENCE = 5_000


class Address(Struct):
    """Where TcpServer and tcpSO_ADDRESS_GET store an address."""

    pointers = var(tcpSO_ADDRESS_typ)
    port = var(UINT)
    ip = var(STRING(15))


class Station:
    """A controller whose program calls blocks until they are done."""

    def __init__(self, network: Network, wait: Callable[[], None]) -> None:
        self.memory = Memory(2 * 1024 * 1024)
        self.context = Context(self.memory, network)
        self.buffer = self.memory.allocate(1024 * 1024)
        self.wait = wait

    def new(self, block: type[B]) -> B:
        return self.memory.new(block, self.context)

    def run(self, block: FunctionBlock, *again: int, **inputs: object) -> int:
        """Call a block until its status is neither BUSY nor one of ``again``; return it."""
        block(enable=True, **inputs)
        for _ in range(PATIENCE):
            if block.status not in (ERR_FUB_BUSY, *again):
                return block.status
            self.wait()
            block()
        pytest.fail(f"{block} after {PATIENCE} calls")

    def do(self, kind: type[B], *again: int, **inputs: object) -> B:
        block = self.new(kind)
        self.run(block, *again, **inputs)
        return block

    def text(self, text: str) -> int:
        address = self.memory.allocate(81)
        self.memory.write(address, text.encode() + b"\0")
        return address

    def send(self, ident: int, data: bytes, flags: int = 0) -> TcpSend:
        self.memory.write(self.buffer, data)
        return self.do(TcpSend, ident=ident, pData=self.buffer, datalen=len(data), flags=flags)

    def recv(self, ident: int, *again: int, datamax: int = 4096, flags: int = 0) -> TcpRecv:
        return self.do(
            TcpRecv, *again, ident=ident, pData=self.buffer, datamax=datamax, flags=flags
        )

    def read(self, ident: int, size: int) -> bytes:
        """Receive exactly ``size`` bytes."""
        data = b""
        while len(data) < size:
            recv = self.recv(ident, tcpERR_NO_DATA, datamax=size - len(data))
            assert recv.status == ERR_OK
            assert recv.recvlen > 0
            data += self.memory.read(self.buffer, recv.recvlen)
        return data

    def close(self, ident: int) -> int:
        return self.do(TcpClose, ident=ident).status


class AsTcpContract:
    """The suite; a subclass says what carries the bytes."""

    rig_class: type[Rig]

    @pytest.fixture
    def rig(self) -> Rig:
        return self.rig_class()

    @pytest.fixture
    def server(self, rig: Rig) -> Iterator[Station]:
        station = Station(rig.server, rig.wait)
        yield station
        station.context.restart()

    @pytest.fixture
    def client(self, rig: Rig) -> Iterator[Station]:
        station = Station(rig.client, rig.wait)
        yield station
        station.context.restart()

    @pytest.fixture
    def address(self, server: Station) -> Address:
        made = server.new(Address)
        made.pointers.pPort, made.pointers.pIpAddr = adr(made, "port"), adr(made, "ip")
        return made

    @pytest.fixture
    def listening(self, server: Station, address: Address) -> TcpServer:
        """A TcpServer that listens at a free port, which is in ``address.port``."""
        ident = server.do(TcpOpen, options=tcpOPT_REUSEADDR).ident
        made = server.new(TcpServer)
        made(enable=True, ident=ident, backlog=3)
        assert made.status == ERR_FUB_BUSY
        server.do(
            TcpIoctl,
            ident=ident,
            ioctl=tcpSO_ADDRESS_GET,
            pData=adr(address),
            datalen=sizeof(address.pointers),
        )
        assert address.port > 0
        return made

    @pytest.fixture
    def connect(
        self, rig: Rig, server: Station, client: Station, listening: TcpServer, address: Address
    ) -> Callable[[], tuple[int, int]]:
        """Connect; gives the client's ident and the server's."""

        def connect() -> tuple[int, int]:
            made = client.new(TcpClient)
            status = client.run(
                made,
                ident=client.do(TcpOpen).ident,
                pServer=client.text(rig.server_ip),
                portserv=address.port,
            )
            assert status == ERR_OK
            assert server.run(listening) == ERR_OK
            return made.ident, listening.identclnt

        return connect

    @pytest.fixture
    def pair(self, connect: Callable[[], tuple[int, int]]) -> tuple[int, int]:
        return connect()

    # opening and connecting

    def test_a_port_in_use(self, server: Station, listening: TcpServer, address: Address) -> None:
        for options in (0, tcpOPT_REUSEADDR):
            again = server.do(TcpOpen, port=address.port, options=options)
            assert (again.status, again.ident) == (tcpERR_ALREADY_EXIST, 0)

    def test_no_such_interface(self, server: Station) -> None:
        for text in ("203.0.113.7", "localhost"):
            opened = server.do(TcpOpen, pIfAddr=server.text(text))
            assert opened.status == tcpERR_INTERFACE

    def test_the_server_learns_who_came(
        self,
        rig: Rig,
        address: Address,
        listening: TcpServer,
        connect: Callable[[], tuple[int, int]],
    ) -> None:
        listening.pIpAddr = adr(address, "ip")
        connect()
        assert address.ip == rig.client_ip
        assert listening.portclnt > 0

    def test_nobody_listens(
        self, rig: Rig, server: Station, client: Station, listening: TcpServer, address: Address
    ) -> None:
        server.close(listening.ident)
        opened = client.do(TcpOpen)
        refused = client.do(
            TcpClient,
            ident=opened.ident,
            pServer=client.text(rig.server_ip),
            portserv=address.port,
        )
        assert refused.status == tcpERR_INVALID
        assert client.close(opened.ident) == ERR_OK

    def test_connected_already(
        self, rig: Rig, client: Station, pair: tuple[int, int], address: Address
    ) -> None:
        again = client.do(
            TcpClient, ident=pair[0], pServer=client.text(rig.server_ip), portserv=address.port
        )
        assert again.status == tcpERR_ALREADY_CONNECTED

    def test_no_waiting(
        self, server: Station, listening: TcpServer, connect: Callable[[], tuple[int, int]]
    ) -> None:
        server.memory.set(UDINT, server.buffer, 1)
        done = server.do(
            TcpIoctl,
            ident=listening.ident,
            ioctl=tcpSO_NOWAITING_SET,
            pData=server.buffer,
            datalen=4,
        )
        assert done.status == ERR_OK
        assert server.run(listening) == tcpERR_NOCLIENT

    def test_many_clients_on_one_listening_ident(
        self, server: Station, client: Station, connect: Callable[[], tuple[int, int]]
    ) -> None:
        pairs = [connect() for _ in range(20)]
        for number, (ident, _) in enumerate(pairs):
            assert client.send(ident, bytes([number])).status == ERR_OK
        assert [server.read(ident, 1)[0] for _, ident in pairs] == list(range(20))

    def test_idents_run_out_and_come_back(self, server: Station, listening: TcpServer) -> None:
        opened = [server.do(TcpOpen) for _ in range(128)]
        assert [o.status for o in opened] == [ERR_OK] * 127 + [tcpERR_NOMORE_IDENTS]
        assert server.close(opened[0].ident) == ERR_OK
        assert server.do(TcpOpen).status == ERR_OK

    # data

    def test_echo(self, server: Station, client: Station, pair: tuple[int, int]) -> None:
        ours, theirs = pair
        sent = client.send(ours, b"hello")
        assert (sent.status, sent.sentlen) == (ERR_OK, 5)
        assert server.read(theirs, 5) == b"hello"
        assert server.send(theirs, b"hello").status == ERR_OK
        assert client.read(ours, 5) == b"hello"
        assert client.recv(ours).status == tcpERR_NO_DATA

    def test_peek(self, server: Station, client: Station, pair: tuple[int, int]) -> None:
        client.send(pair[0], b"x")
        for _ in range(2):
            peeked = server.recv(pair[1], tcpERR_NO_DATA, flags=tcpMSG_PEEK)
            assert (peeked.status, peeked.recvlen) == (ERR_OK, 1)
        assert server.read(pair[1], 1) == b"x"
        assert server.recv(pair[1], flags=tcpMSG_PEEK).status == tcpERR_NO_DATA

    def test_urgent_data(self, server: Station, client: Station, pair: tuple[int, int]) -> None:
        assert server.recv(pair[1], flags=tcpMSG_OOB).status == tcpERR_NO_OOBDATA
        client.send(pair[0], b"ab!", tcpMSG_OOB)
        urgent = server.recv(pair[1], tcpERR_NO_OOBDATA, flags=tcpMSG_OOB)
        assert (urgent.status, server.memory.read(server.buffer, 1)) == (ERR_OK, b"!")
        assert server.read(pair[1], 2) == b"ab"

    def test_a_client_that_never_reads(
        self, server: Station, client: Station, pair: tuple[int, int]
    ) -> None:
        flood = bytes(range(256)) * 4096
        send = client.new(TcpSend)
        client.memory.write(client.buffer, flood)
        sent = total = 0
        for _ in range(PATIENCE):
            send(
                enable=True,
                ident=pair[0],
                pData=client.buffer + sent,
                datalen=len(flood) - sent,
            )
            assert send.status in (ERR_OK, tcpERR_SENTLEN, tcpERR_WOULDBLOCK)
            if send.status == tcpERR_WOULDBLOCK:
                break
            total += send.sentlen
            sent = total % len(flood)
        assert (send.status, send.sentlen) == (tcpERR_WOULDBLOCK, 0)
        got = b""
        while len(got) < total:
            got += server.read(pair[1], min(total - len(got), 65_536))
        assert got == (flood * (total // len(flood) + 1))[:total]

    # ending

    def test_a_graceful_end(self, server: Station, client: Station, pair: tuple[int, int]) -> None:
        client.send(pair[0], b"bye")
        assert client.close(pair[0]) == ERR_OK
        assert server.read(pair[1], 3) == b"bye"
        ended = server.recv(pair[1], tcpERR_NO_DATA)
        assert (ended.status, ended.recvlen) == (ERR_OK, 0)
        assert server.close(pair[1]) == ERR_OK

    def test_a_reset(self, server: Station, client: Station, pair: tuple[int, int]) -> None:
        client.memory.write(client.buffer, b"\1\0\0\0\0\0\0\0")
        client.do(TcpIoctl, ident=pair[0], ioctl=tcpSO_LINGER_SET, pData=client.buffer, datalen=8)
        client.close(pair[0])
        assert server.recv(pair[1], tcpERR_NO_DATA).status == tcpERR_NOT_CONNECTED
        assert server.send(pair[1], b"x").status == tcpERR_NOT_CONNECTED
        assert server.recv(pair[1]).status == tcpERR_NOT_CONNECTED

    def test_a_port_is_free_again_with_reuse(
        self,
        server: Station,
        client: Station,
        listening: TcpServer,
        pair: tuple[int, int],
        address: Address,
    ) -> None:
        for ident in (pair[1], listening.ident):
            assert server.close(ident) == ERR_OK
        client.close(pair[0])
        again = server.do(TcpOpen, port=address.port, options=tcpOPT_REUSEADDR)
        assert again.status == ERR_OK

    def test_stale_idents(self, server: Station, pair: tuple[int, int]) -> None:
        stale = pair[1]
        assert server.close(stale) == ERR_OK
        assert server.do(TcpOpen).ident != stale
        assert server.close(stale) == tcpERR_INVALID_IDENT
        assert server.send(stale, b"x").status == tcpERR_INVALID_IDENT
        assert server.recv(stale).status == tcpERR_INVALID_IDENT

    def test_closing_under_a_busy_block(self, server: Station, listening: TcpServer) -> None:
        server.close(listening.ident)
        listening()
        assert listening.status == tcpERR_INVALID_IDENT
        listening(enable=False)
        assert listening.status == ERR_FUB_ENABLE_FALSE
