from __future__ import annotations

import pytest

from plcsim.core.errors import PageFault
from plcsim.library.astcp import (
    ERR_FUB_ENABLE_FALSE,
    ERR_NOTIMPLEMENTED,
    ERR_OK,
    TcpOpen,
    TcpOpenSsl,
    tcpERR_ALREADY_EXIST,
    tcpERR_INTERFACE,
    tcpERR_NOMORE_IDENTS,
    tcpERR_PARAMETER,
    tcpERR_SOCKET_BIND,
    tcpERR_SOCKET_CREATE,
    tcpERR_SYSTEM,
    tcpOPT_REUSEADDR,
)
from plcsim.network import Opened, Outcome, WireLimits

from .plc import PORT, SERVER, WILD, Plc, World


class FailingNetwork:
    def __init__(self, outcome: Outcome) -> None:
        self.outcome = outcome

    def open(self, ip: str, port: int, *, reuse_address: bool = False) -> Opened:
        return Opened(self.outcome)


@pytest.mark.parametrize("address", ["", "0.0.0.0", SERVER, "127.0.0.1"])
def test_own_addresses(world: World, address: str) -> None:
    opened = world.server.open(PORT, address=address)
    assert opened.status == ERR_OK
    assert world.server.idents.in_use() == (opened.ident,)


def test_an_empty_string_means_all_interfaces(world: World) -> None:
    opened = world.server.call(TcpOpen, pIfAddr=world.server.text(""), port=PORT)
    assert opened.status == ERR_OK


@pytest.mark.parametrize(
    "address", ["192.168.0.77", "IF3", "plc.local", "1.2.3.4.5.6.7.8.9", "\xff"]
)
def test_no_interface_has_the_address(world: World, address: str) -> None:
    opened = world.server.open(PORT, address=address)
    assert (opened.status, opened.ident) == (tcpERR_INTERFACE, 0)


def test_a_port_in_use(world: World) -> None:
    first = world.server.open(PORT)
    second = world.server.open(PORT)
    assert (second.status, second.ident) == (tcpERR_ALREADY_EXIST, 0)
    world.server.close(first.ident)
    second()
    assert second.status == ERR_OK


def test_reuse_takes_the_port_of_an_old_connection(world: World) -> None:
    server = world.server.listen()
    client, accepted = world.connect(server)
    for ident in (accepted, server.ident):
        assert world.server.close(ident) == ERR_OK
    world.client.close(client)
    assert world.server.open(PORT).status == tcpERR_ALREADY_EXIST
    assert world.server.open(PORT, options=tcpOPT_REUSEADDR).status == ERR_OK


@pytest.mark.parametrize("options", [2, 3, 0x8000_0000])
def test_unknown_options(world: World, options: int) -> None:
    assert world.server.open(PORT, options=options).status == tcpERR_PARAMETER


def test_idents_run_out(world: World) -> None:
    statuses = [world.server.open().status for _ in range(129)]
    assert statuses == [ERR_OK] * 128 + [tcpERR_NOMORE_IDENTS]


def test_the_system_runs_out_of_sockets() -> None:
    world = World(limits=WireLimits(sockets=1))
    assert world.server.open().status == ERR_OK
    assert world.server.open().status == tcpERR_SOCKET_CREATE


@pytest.mark.parametrize(
    ("outcome", "status"),
    [
        (Outcome.DENIED, tcpERR_SOCKET_BIND),
        (Outcome.SYSTEM, tcpERR_SYSTEM),
        (Outcome.INVALID, tcpERR_SYSTEM),
    ],
)
def test_failures_of_the_system(outcome: Outcome, status: int) -> None:
    assert Plc(FailingNetwork(outcome)).open(PORT).status == status


def test_a_wild_pointer(world: World) -> None:
    with pytest.raises(PageFault, match="16#70000000"):
        world.server.call(TcpOpen, pIfAddr=WILD)
    assert world.server.idents.in_use() == ()


def test_there_is_no_ssl(world: World) -> None:
    opened = world.server.call(TcpOpenSsl, pIfAddr=WILD, port=PORT)
    assert (opened.status, opened.ident) == (ERR_NOTIMPLEMENTED, 0)
    opened(enable=False)
    assert opened.status == ERR_FUB_ENABLE_FALSE
