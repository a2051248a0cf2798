from __future__ import annotations

import pytest

from plcsim.core.errors import PageFault
from plcsim.library.astcp import (
    ERR_FUB_BUSY,
    ERR_FUB_ENABLE_FALSE,
    ERR_OK,
    TcpClient,
    TcpServer,
    tcpERR_ALREADY_CONNECTED,
    tcpERR_INVALID,
    tcpERR_NOT_CONNECTED,
    tcpERR_PARAMETER,
    tcpERR_SYSTEM,
)
from plcsim.network import Link, Outcome

from .plc import CLIENT, MS, PORT, SECOND, SERVER, WILD, World


def test_busy_while_connecting() -> None:
    world = World(link=Link(latency_ns=2 * MS))
    world.server.listen()
    client = world.client.dial()
    statuses = []
    for _ in range(4):
        world.pass_time(MS)
        client()
        statuses.append(client.status)
    assert statuses == [ERR_FUB_BUSY] * 3 + [ERR_OK]


def test_nobody_listens(world: World) -> None:
    client = world.client.dial()
    client()
    assert client.status == tcpERR_INVALID


def test_no_route(world: World) -> None:
    world.net.faults.unreachable(CLIENT)
    assert world.client.dial().status == tcpERR_INVALID


def test_nobody_answers(world: World) -> None:
    client = world.client.dial("192.168.0.99")
    world.pass_time(world.net.limits.connect_ns - 1)
    client()
    assert client.status == ERR_FUB_BUSY
    world.pass_time(1)
    client()
    assert client.status == tcpERR_INVALID


def test_a_time_limit_of_our_own() -> None:
    world = World(connect_timeout="5s")
    world.pass_time(3 * SECOND)
    client = world.client.dial("192.168.0.99")
    world.pass_time(5 * SECOND - MS)
    client()
    assert client.status == ERR_FUB_BUSY
    world.pass_time(MS)
    client()
    assert client.status == tcpERR_INVALID


def test_the_time_limit_begins_anew_with_each_attempt() -> None:
    world = World(connect_timeout="5s")
    client = world.client.dial("192.168.0.99")
    world.pass_time(5 * SECOND)
    client()
    assert client.status == tcpERR_INVALID
    client()
    assert client.status == ERR_FUB_BUSY
    world.pass_time(4 * SECOND)
    client(enable=False)
    assert client.status == ERR_FUB_ENABLE_FALSE
    client(enable=True)
    world.pass_time(4 * SECOND)
    client()
    assert client.status == ERR_FUB_BUSY


def test_the_time_limit_outlives_the_wrap_of_the_millisecond_count() -> None:
    world = World(connect_timeout="5s")
    world.pass_time((2**32 - 1) * MS)
    client = world.client.dial("192.168.0.99")
    world.pass_time(4 * SECOND)
    client()
    assert client.status == ERR_FUB_BUSY
    world.pass_time(SECOND)
    client()
    assert client.status == tcpERR_INVALID


def test_closing_and_opening_again_after_a_failure(world: World) -> None:
    client = world.client.dial()
    client()
    assert client.status == tcpERR_INVALID
    world.client.close(client.ident)
    world.pair()


def test_connected_already(world: World) -> None:
    server = world.server.listen()
    client, _ = world.connect(server)
    again = world.client.call(
        TcpClient, ident=client, pServer=world.client.text(SERVER), portserv=PORT
    )
    assert again.status == tcpERR_ALREADY_CONNECTED


def test_a_listening_socket_cannot_connect(world: World) -> None:
    opened = world.server.open(PORT)
    world.server.call(TcpServer, ident=opened.ident)
    client = world.server.call(
        TcpClient, ident=opened.ident, pServer=world.server.text(CLIENT), portserv=1
    )
    assert client.status == tcpERR_INVALID


@pytest.mark.parametrize(
    ("address", "port"), [("plc.local", PORT), ("", PORT), ("0.0.0.0", PORT), (SERVER, 0)]
)
def test_no_address_to_connect_to(world: World, address: str, port: int) -> None:
    assert world.client.dial(address, port).status == tcpERR_PARAMETER


def test_no_pointer(world: World) -> None:
    opened = world.client.open()
    client = world.client.call(TcpClient, ident=opened.ident, portserv=PORT)
    assert client.status == tcpERR_PARAMETER


def test_a_wild_pointer(world: World) -> None:
    opened = world.client.open()
    with pytest.raises(PageFault):
        world.client.call(TcpClient, ident=opened.ident, pServer=WILD, portserv=PORT)


def test_a_reset_before_the_program_looks(world: World) -> None:
    server = world.server.listen()
    client = world.client.dial()
    server()
    world.net.faults.reset(SERVER)
    client()
    assert client.status == tcpERR_INVALID
    assert world.client.recv(client.ident).status == tcpERR_NOT_CONNECTED


def test_a_failure_of_the_system(world: World) -> None:
    client = world.client.dial("192.168.0.99")
    world.client.idents.find(client.ident).socket.connect = lambda _: Outcome.NO_RESOURCES
    client()
    assert client.status == tcpERR_SYSTEM
