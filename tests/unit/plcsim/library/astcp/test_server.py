from __future__ import annotations

import pytest

from plcsim.core.errors import PageFault
from plcsim.library.astcp import (
    ERR_FUB_BUSY,
    ERR_OK,
    TcpClient,
    TcpServer,
    tcpERR_ALREADY_CONNECTED,
    tcpERR_NO_DATA,
    tcpERR_NOCLIENT,
    tcpERR_NOMORE_IDENTS,
    tcpERR_SOCKET_ACCEPT,
    tcpERR_SOCKET_LISTEN,
    tcpOPT_REUSEADDR,
    tcpSO_NOWAITING_SET,
)
from plcsim.network import Accepted, Outcome

from .plc import CLIENT, PORT, WILD, Plc, World

ON, OFF = b"\1\0\0\0", bytes(4)
LONG_LITERAL = "fd00:1111:2222:3333:4444:5555:6666:7777"


def test_busy_until_a_client_comes(world: World) -> None:
    server = world.server.listen()
    for _ in range(3):
        server()
        assert server.status == ERR_FUB_BUSY
    world.connect(server)
    assert server.identclnt not in (0, server.ident)
    assert 49_152 <= server.portclnt <= 65_535


def test_each_further_call_takes_the_next_client(world: World) -> None:
    server = world.server.listen(backlog=10)
    pairs = [world.connect(server) for _ in range(5)]
    assert len({ident for _, ident in pairs}) == 5
    for number, (client, _) in enumerate(pairs):
        world.client.send(client, bytes([number]))
    for number, (_, ident) in enumerate(pairs):
        assert world.server.received(world.server.recv(ident)) == bytes([number])
    server()
    assert server.status == ERR_FUB_BUSY


def test_the_client_s_address_is_stored_with_its_end(world: World) -> None:
    server = world.server.listen()
    server.pIpAddr = world.server.buffer
    world.server.memory.write(world.server.buffer, b"#" * 20)
    server()
    assert world.server.memory.read(world.server.buffer, 20) == b"#" * 20
    world.connect(server)
    stored = world.server.memory.read(world.server.buffer, 20)
    assert stored == CLIENT.encode() + b"\0" + b"#" * (19 - len(CLIENT))


def test_no_waiting(world: World) -> None:
    server = world.server.listen()
    world.server.ioctl(server.ident, tcpSO_NOWAITING_SET, ON)
    server()
    assert server.status == tcpERR_NOCLIENT
    world.connect(server)
    world.server.ioctl(server.ident, tcpSO_NOWAITING_SET, OFF)
    server()
    assert server.status == ERR_FUB_BUSY


def test_with_all_idents_in_use_clients_wait_in_the_queue() -> None:
    world = World(idents=2)
    server = world.server.listen()
    _, first = world.connect(server)
    second = world.client.dial()
    second()
    assert second.status == ERR_OK
    world.client.send(second.ident, b"patient")
    server()
    assert server.status == tcpERR_NOMORE_IDENTS
    world.server.close(first)
    server()
    assert server.status == ERR_OK
    assert world.server.received(world.server.recv(server.identclnt)) == b"patient"


def test_a_connection_cannot_listen(world: World) -> None:
    client, accepted = world.pair()
    for plc, ident in ((world.client, client), (world.server, accepted)):
        assert plc.call(TcpServer, ident=ident).status == tcpERR_ALREADY_CONNECTED


def test_another_socket_listens_at_the_port(world: World) -> None:
    first, second = (world.server.open(PORT, options=tcpOPT_REUSEADDR) for _ in range(2))
    assert world.server.call(TcpServer, ident=first.ident).status == ERR_FUB_BUSY
    assert world.server.call(TcpServer, ident=second.ident).status == tcpERR_SOCKET_LISTEN


def test_the_system_gives_no_socket(world: World) -> None:
    server = world.server.listen()
    listener = world.server.idents.find(server.ident).socket
    listener.accept = lambda: Accepted(Outcome.NO_RESOURCES)
    server()
    assert server.status == tcpERR_SOCKET_ACCEPT


def test_a_wild_pointer_loses_no_client(world: World) -> None:
    server = world.server.listen()
    client = world.client.dial()
    client()
    assert client.status == ERR_OK
    with pytest.raises(PageFault):
        server(pIpAddr=WILD)
    assert server.identclnt == 0
    server(pIpAddr=0)
    assert server.status == ERR_OK
    assert world.server.recv(server.identclnt).status == tcpERR_NO_DATA


def test_two_blocks_share_a_listening_ident(world: World) -> None:
    one = world.server.listen()
    two = world.server.call(TcpServer, ident=one.ident)
    world.connect(one)
    two()
    assert two.status == ERR_FUB_BUSY
    world.connect(two)


def test_ipv6_takes_the_room_that_its_literals_need(world: World) -> None:
    """Who opens with a literal of IPv6 gives 46 bytes for the client's address."""
    server, client = Plc(world.net.host("fd00::1")), Plc(world.net.host(LONG_LITERAL))
    opened = server.open(PORT, address="::")
    address = server.memory.allocate(46)
    listening = server.call(TcpServer, ident=opened.ident, backlog=1, pIpAddr=address)
    own = client.open(address="::")
    connecting = client.call(
        TcpClient, ident=own.ident, pServer=client.text("fd00::1"), portserv=PORT
    )
    assert [listening.status, connecting.status] == [ERR_FUB_BUSY, ERR_FUB_BUSY]
    connecting()
    listening()
    assert [listening.status, connecting.status] == [ERR_OK, ERR_OK]
    assert server.memory.string(address, 46) == LONG_LITERAL.encode()


def test_a_wild_address_for_ipv6_takes_no_client(world: World) -> None:
    server = Plc(world.net.host("fd00::1"))
    opened = server.open(PORT, address="::")
    with pytest.raises(PageFault):
        server.call(TcpServer, ident=opened.ident, backlog=1, pIpAddr=2**20 - 20)
