"""Options of a socket and of the library."""

import struct

import pytest

from plcsim.library import asudp
from plcsim.library.asudp import (
    udpERR_INVALID_IDENT,
    udpERR_INVALID_IOCTL,
    udpERR_PARAMETER,
)
from plcsim.library.asudp.ioctl import UdpIoctl
from plcsim.library.asudp.sockets import UdpOpen
from plcsim.library.runtime import ERR_OK


@pytest.fixture
def plc(pair):
    return pair[0]


@pytest.fixture
def ident(plc):
    return plc.do(UdpOpen, port=700).ident


def ioctl(plc, ident, number, data):
    given = {"pData": plc.bytes(data), "datalen": len(data)}
    return plc.do(UdpIoctl, ident=ident, ioctl=number, **given)


@pytest.mark.parametrize(
    ("name", "value"), [("SO_BROADCAST", 1), ("SO_SNDBUF", 5000), ("SO_RCVBUF", 6000)]
)
def test_options_are_read_back(plc, ident, name, value):
    numbers = [getattr(asudp, f"udp{name}_{end}") for end in ("SET", "GET")]
    assert ioctl(plc, ident, numbers[0], struct.pack("<I", value)).status == ERR_OK
    got = ioctl(plc, ident, numbers[1], bytes(4))
    assert (got.status, got.outlen) == (ERR_OK, 4)
    assert plc.memory.read(got.pData, 4) == struct.pack("<I", value)


def test_the_own_address(plc, ident):
    places = plc.bytes(bytes(2)), plc.bytes(bytes(16))
    got = ioctl(plc, ident, asudp.udpSO_ADDRESS_GET, struct.pack("<II", *places))
    assert (got.status, got.outlen) == (ERR_OK, 8)
    assert plc.memory.read(places[0], 2) == struct.pack("<H", 700)
    assert plc.string(places[1]) == "0.0.0.0"
    assert ioctl(plc, ident, asudp.udpSO_ADDRESS_GET, bytes(8)).status == ERR_OK


def test_idents(plc, ident):
    second = plc.do(UdpOpen).ident
    got = ioctl(plc, 0, asudp.udpID_LIST_GET, bytes(12))
    assert got.outlen == 8
    assert plc.memory.read(got.pData, 12) == struct.pack("<III", ident, second, 0)
    assert ioctl(plc, 0, asudp.udpID_LIST_GET, bytes(4)).outlen == 4
    most = ioctl(plc, 0, asudp.udpID_MAX_GET, bytes(4))
    assert plc.memory.read(most.pData, 4) == struct.pack("<I", 128)


def test_what_is_not_there(plc, ident):
    for number in (0, 9999, asudp.udpIP_TTL_SET, asudp.udpIP_ADD_MEMBERSHIP):
        assert ioctl(plc, ident, number, bytes(4)).status == udpERR_INVALID_IOCTL
    assert ioctl(plc, 99, asudp.udpSO_SNDBUF_GET, bytes(4)).status == udpERR_INVALID_IDENT


@pytest.mark.parametrize("size", [0, 3, 8])
def test_wrong_lengths(plc, ident, size):
    data = bytes(size)
    assert ioctl(plc, ident, asudp.udpSO_SNDBUF_GET, data).status == udpERR_PARAMETER
    no_data = plc.do(UdpIoctl, ident=ident, ioctl=asudp.udpSO_SNDBUF_GET, datalen=4)
    assert no_data.status == udpERR_PARAMETER
