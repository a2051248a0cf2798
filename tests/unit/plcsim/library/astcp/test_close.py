from __future__ import annotations

import pytest

from plcsim.library.astcp import (
    ERR_OK,
    tcpERR_INVALID_IDENT,
    tcpERR_NO_DATA,
    tcpERR_NOT_CONNECTED,
    tcpERR_PARAMETER,
    tcpSHUT_RD,
    tcpSHUT_WR,
    tcpSO_LINGER_SET,
)

from .plc import PORT, World


@pytest.mark.parametrize("how", [0, tcpSHUT_RD, tcpSHUT_WR, tcpSHUT_RD | tcpSHUT_WR])
def test_every_how_frees_the_ident_and_ends_the_connection(world: World, how: int) -> None:
    client, server = world.pair()
    world.client.send(client, b"last")
    assert world.client.close(client, how) == ERR_OK
    assert world.client.idents.in_use() == ()
    assert world.server.received(world.server.recv(server)) == b"last"
    ended = world.server.recv(server)
    assert (ended.status, ended.recvlen) == (ERR_OK, 0)


@pytest.mark.parametrize("how", [4, 0xFFFF_FFFF])
def test_a_wrong_how_closes_nothing(world: World, how: int) -> None:
    client, _ = world.pair()
    assert world.client.close(client, how) == tcpERR_PARAMETER
    assert world.client.recv(client).status == tcpERR_NO_DATA


def test_closing_twice(world: World) -> None:
    opened = world.server.open(PORT)
    assert world.server.close(opened.ident) == ERR_OK
    assert world.server.close(opened.ident) == tcpERR_INVALID_IDENT


def test_a_stale_ident_is_not_that_of_a_later_socket(world: World) -> None:
    stale = world.server.open(PORT).ident
    world.server.close(stale)
    later = world.server.open(PORT).ident
    assert world.server.close(stale) == tcpERR_INVALID_IDENT
    assert world.server.idents.in_use() == (later,)


def test_clients_outlive_the_listening_ident(world: World) -> None:
    listening = world.server.listen()
    client, server = world.connect(listening)
    assert world.server.close(listening.ident) == ERR_OK
    world.client.send(client, b"x")
    assert world.server.received(world.server.recv(server)) == b"x"


def test_linger_zero_resets(world: World) -> None:
    client, server = world.pair()
    linger = b"\1\0\0\0\0\0\0\0"
    assert world.client.ioctl(client, tcpSO_LINGER_SET, linger).status == ERR_OK
    world.client.close(client)
    assert world.server.recv(server).status == tcpERR_NOT_CONNECTED
