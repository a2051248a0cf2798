from __future__ import annotations

import pytest

from plcsim.library.astcp import (
    ERR_FUB_BUSY,
    ERR_FUB_ENABLE_FALSE,
    ERR_OK,
    TcpClient,
    TcpClose,
    TcpIoctl,
    TcpOpen,
    TcpOpenSsl,
    TcpRecv,
    TcpSend,
    TcpServer,
    tcpERR_INVALID_IDENT,
    tcpERR_NO_DATA,
)
from plcsim.library.astcp.block import BUSY, IDLE, AsTcpBlock

from .plc import PORT, World

BLOCKS = [TcpOpen, TcpOpenSsl, TcpServer, TcpClient, TcpClose, TcpSend, TcpRecv, TcpIoctl]


@pytest.mark.parametrize("block", BLOCKS)
def test_disabled_does_nothing(world: World, block: type[AsTcpBlock]) -> None:
    made = world.server.new(block)
    made(enable=False)
    assert made.status == ERR_FUB_ENABLE_FALSE
    assert world.server.idents.in_use() == ()


def test_disabling_ends_busy_but_keeps_the_outputs(world: World) -> None:
    server = world.server.listen()
    world.connect(server)
    ident, port = server.identclnt, server.portclnt
    server()
    assert (server.status, server.i_state) == (ERR_FUB_BUSY, BUSY)
    server(enable=False)
    assert (server.status, server.i_state) == (ERR_FUB_ENABLE_FALSE, IDLE)
    assert (server.identclnt, server.portclnt) == (ident, port)


def test_the_last_status_stays_when_disabled(world: World) -> None:
    opened = world.server.open(PORT)
    opened(enable=False)
    assert (opened.status, opened.i_result) == (ERR_FUB_ENABLE_FALSE, ERR_OK)


@pytest.mark.parametrize("block", [TcpServer, TcpClient, TcpClose, TcpSend, TcpRecv])
@pytest.mark.parametrize("ident", [0, 1, 7, 0xFFFF_FFFF])
def test_an_unknown_ident(world: World, block: type[AsTcpBlock], ident: int) -> None:
    assert world.server.call(block, ident=ident).status == tcpERR_INVALID_IDENT


@pytest.mark.parametrize("setting", [32600, 32608, 32609])
def test_closing_an_ident_that_a_block_is_busy_on(setting: int) -> None:
    world = World(closed_while_busy=setting)
    server = world.server.listen()
    world.server.close(server.ident)
    server()
    assert server.status == setting
    server()
    assert server.status == tcpERR_INVALID_IDENT


def test_programs_may_spin_on_busy(world: World) -> None:
    server, client = world.server.listen(), world.client.dial()
    while client.status == ERR_FUB_BUSY:
        client()
    while server.status == ERR_FUB_BUSY:
        server()
    assert (client.status, server.status) == (ERR_OK, ERR_OK)


def test_a_controller_has_idents_of_its_own(world: World) -> None:
    client, server = world.pair()
    assert world.client.recv(client).status == tcpERR_NO_DATA
    assert world.server.recv(server + 1).status == tcpERR_INVALID_IDENT
