from __future__ import annotations

from struct import pack, unpack

import pytest

from plcsim.core.errors import PageFault
from plcsim.core.memory import adr, sizeof
from plcsim.library import astcp
from plcsim.library.astcp import (
    ERR_OK,
    TcpIoctl,
    tcpERR_INVALID_IDENT,
    tcpERR_INVALID_IOCTL,
    tcpERR_PARAMETER,
    tcpERR_SYSTEM,
    tcpID_LIST_GET,
    tcpID_MAX_GET,
    tcpSO_ADDRESS_GET,
    tcpSO_ADDRESS_typ,
    tcpSO_KEEPALIVE_GET,
    tcpSO_KEEPALIVE_SET,
    tcpSO_LINGER_GET,
    tcpSO_LINGER_SET,
    tcpSO_NOWAITING_GET,
    tcpSO_NOWAITING_SET,
    tcpTCP_KEEPCNT_SET,
)
from plcsim.network import OptionValue, Outcome

from .plc import CLIENT, PORT, WILD, World

SET_GET = {
    "SO_KEEPALIVE": 1,
    "SO_SNDBUF": 4096,
    "SO_RCVBUF": 2048,
    "SO_OOBINLINE": 1,
    "SO_NOWAITING": 1,
    "TCP_NODELAY": 1,
    "TCP_KEEPCNT": 5,
    "TCP_KEEPIDLE": 30,
    "TCP_KEEPINTVL": 3,
}
SIZES = {
    value: 8 if "LINGER" in name or "ADDRESS" in name else 4
    for name, value in vars(astcp).items()
    if name.startswith(("tcpSO_", "tcpTCP_", "tcpID_")) and isinstance(value, int)
}


@pytest.mark.parametrize("name", SET_GET)
def test_values_read_back(world: World, name: str) -> None:
    plc = world.server
    ident = plc.open(PORT).ident
    setting, getting = (getattr(astcp, f"tcp{name}_{act}") for act in ("SET", "GET"))
    done = plc.ioctl(ident, setting, pack("<I", SET_GET[name]))
    assert (done.status, done.outlen) == (ERR_OK, 0)
    got = plc.ioctl(ident, getting)
    assert (got.status, got.outlen) == (ERR_OK, 4)
    assert unpack("<I", plc.got(got)) == (SET_GET[name],)


@pytest.mark.parametrize(("on", "seconds"), [(0, 0), (1, 0), (1, 3)])
def test_linger_reads_back(world: World, on: int, seconds: int) -> None:
    plc = world.server
    ident = plc.open(PORT).ident
    assert plc.ioctl(ident, tcpSO_LINGER_SET, pack("<II", on, seconds)).status == ERR_OK
    got = plc.ioctl(ident, tcpSO_LINGER_GET, bytes(8))
    assert (got.status, got.outlen) == (ERR_OK, 8)
    assert unpack("<II", plc.got(got)) == (on, seconds)


@pytest.mark.parametrize(
    ("ioctl", "data"),
    [
        (tcpSO_LINGER_SET, pack("<II", 1, 0xFFFF_FFFF)),
        (tcpTCP_KEEPCNT_SET, pack("<I", 0)),
        (tcpTCP_KEEPCNT_SET, pack("<I", 128)),
    ],
)
def test_values_out_of_range(world: World, ioctl: int, data: bytes) -> None:
    ident = world.server.open(PORT).ident
    assert world.server.ioctl(ident, ioctl, data).status == tcpERR_PARAMETER


def test_the_own_address(world: World) -> None:
    client, _ = world.pair()
    plc = world.client
    pointers = plc.memory.new(tcpSO_ADDRESS_typ)
    pointers.pPort, pointers.pIpAddr = plc.memory.allocate(2), plc.memory.allocate(16)
    got = plc.call(
        TcpIoctl,
        ident=client,
        ioctl=tcpSO_ADDRESS_GET,
        pData=adr(pointers),
        datalen=sizeof(pointers),
    )
    assert (got.status, got.outlen) == (ERR_OK, 8)
    (port,) = unpack("<H", plc.memory.read(pointers.pPort, 2))
    assert 49_152 <= port <= 65_535
    assert plc.memory.string(pointers.pIpAddr, 16) == CLIENT.encode()


def test_the_own_address_goes_only_where_a_pointer_leads(world: World) -> None:
    plc = world.server
    ident = plc.open(PORT).ident
    at = plc.memory.allocate(2)
    assert plc.ioctl(ident, tcpSO_ADDRESS_GET, pack("<II", 0, 0)).status == ERR_OK
    assert plc.ioctl(ident, tcpSO_ADDRESS_GET, pack("<II", at, 0)).status == ERR_OK
    assert unpack("<H", plc.memory.read(at, 2)) == (PORT,)


def test_a_wild_pointer_inside_the_address(world: World) -> None:
    plc = world.server
    ident = plc.open(PORT).ident
    at = plc.memory.allocate(2)
    with pytest.raises(PageFault):
        plc.ioctl(ident, tcpSO_ADDRESS_GET, pack("<II", at, WILD))
    assert plc.memory.read(at, 2) == bytes(2)


def test_the_list_of_idents(world: World) -> None:
    plc = world.server
    idents = [plc.open().ident for _ in range(3)]
    got = plc.ioctl(0, tcpID_LIST_GET, bytes(20))
    assert (got.status, got.outlen) == (ERR_OK, 12)
    assert list(unpack("<III", plc.got(got))) == idents
    short = plc.ioctl(0, tcpID_LIST_GET, bytes(8))
    assert (short.status, short.outlen) == (ERR_OK, 8)


def test_the_number_of_idents() -> None:
    plc = World(idents=17).server
    got = plc.ioctl(0, tcpID_MAX_GET)
    assert (got.status, plc.got(got)) == (ERR_OK, pack("<I", 17))


def test_no_waiting_is_off_at_first(world: World) -> None:
    plc = world.server
    ident = plc.open(PORT).ident
    assert plc.got(plc.ioctl(ident, tcpSO_NOWAITING_GET)) == bytes(4)
    plc.ioctl(ident, tcpSO_NOWAITING_SET, pack("<I", 256))
    assert plc.got(plc.ioctl(ident, tcpSO_NOWAITING_GET)) == pack("<I", 1)


@pytest.mark.parametrize("ioctl", [0, 1000, 1014, 2000, 2009, 3000, 3003, 0xFFFF_FFFF])
def test_unknown_ioctls(world: World, ioctl: int) -> None:
    assert world.server.ioctl(0, ioctl).status == tcpERR_INVALID_IOCTL


@pytest.mark.parametrize("ioctl", SIZES)
def test_only_the_right_length_is_taken(world: World, ioctl: int) -> None:
    plc = world.server
    ident = plc.open(PORT).ident
    wrong = {0, 1, 2, 3, 5, 9} | ({4, 8} - {SIZES[ioctl]} if ioctl != tcpID_LIST_GET else set())
    for length in wrong:
        assert plc.ioctl(ident, ioctl, bytes(length)).status == tcpERR_PARAMETER
    made = plc.call(TcpIoctl, ident=ident, ioctl=ioctl, pData=0, datalen=SIZES[ioctl])
    assert (made.status, made.outlen) == (tcpERR_PARAMETER, 0)


@pytest.mark.parametrize("ioctl", SIZES)
def test_a_wild_pointer(world: World, ioctl: int) -> None:
    plc = world.server
    ident = plc.open(PORT).ident
    with pytest.raises(PageFault):
        plc.call(TcpIoctl, ident=ident, ioctl=ioctl, pData=WILD, datalen=SIZES[ioctl])


@pytest.mark.parametrize("ioctl", sorted(SIZES.keys() - {tcpID_LIST_GET, tcpID_MAX_GET}))
def test_an_unknown_ident(world: World, ioctl: int) -> None:
    made = world.server.ioctl(99, ioctl, bytes(SIZES[ioctl]))
    assert made.status == tcpERR_INVALID_IDENT


def test_failures_of_the_system(world: World) -> None:
    plc = world.server
    ident = plc.open(PORT).ident
    socket = plc.idents.find(ident).socket
    socket.set_option = lambda *_: Outcome.SYSTEM
    socket.option = lambda *_: OptionValue(Outcome.SYSTEM)
    assert plc.ioctl(ident, tcpSO_KEEPALIVE_SET).status == tcpERR_SYSTEM
    got = plc.ioctl(ident, tcpSO_KEEPALIVE_GET)
    assert (got.status, got.outlen) == (tcpERR_SYSTEM, 0)
