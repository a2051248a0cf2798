"""Sending and receiving."""

import pytest

from plcsim.core.errors import PageFault
from plcsim.library.asudp import (
    udpERR_ACCESS,
    udpERR_INVALID_IDENT,
    udpERR_NO_DATA,
    udpERR_PARAMETER,
    udpMSG_PEEK,
    udpOPT_BROADCAST,
)
from plcsim.library.asudp.sockets import UdpConnect, UdpOpen
from plcsim.library.asudp.transfer import UdpRecv, UdpSend
from plcsim.library.runtime import ERR_OK


@pytest.fixture
def a(pair):
    return pair[0]


@pytest.fixture
def b(pair):
    return pair[1]


def send(plc, ident, text, **inputs):
    data = plc.bytes(text)
    return plc.do(UdpSend, ident=ident, pData=data, datalen=len(text), **inputs)


def test_a_datagram_and_its_answer(a, b):
    here, there = a.do(UdpOpen).ident, b.do(UdpOpen, port=700).ident
    sent = send(a, here, b"hello", pHost="192.168.0.20", port=700)
    assert (sent.status, sent.sentlen) == (ERR_OK, 5)
    buffer, ip = b.bytes(b"#" * 10), b.bytes(b"#" * 16)
    got = b.do(UdpRecv, ident=there, pData=buffer, datamax=10, pIpAddr=ip)
    assert (got.status, got.recvlen) == (ERR_OK, 5)
    assert b.memory.read(buffer, 6) == b"hello#"
    assert b.string(ip) == "192.168.0.10"
    send(b, there, b"yes", pHost="192.168.0.10", port=got.port)
    answer = a.do(UdpRecv, ident=here, pData=a.bytes(bytes(9)), datamax=9)
    assert (answer.status, answer.recvlen, answer.port) == (ERR_OK, 3, 700)
    assert a.memory.read(answer.pData, 3) == b"yes"


def test_nothing_has_come(a):
    ident = a.do(UdpOpen).ident
    got = a.do(UdpRecv, ident=ident, pData=a.bytes(bytes(9)), datamax=9)
    assert (got.status, got.recvlen) == (udpERR_NO_DATA, 0)


def test_peeking(a, b):
    there = b.do(UdpOpen, port=700).ident
    send(a, a.do(UdpOpen).ident, b"abc", pHost="192.168.0.20", port=700)
    given = {"ident": there, "pData": b.bytes(bytes(9)), "datamax": 2}
    assert b.do(UdpRecv, flags=udpMSG_PEEK, **given).recvlen == 2
    assert b.do(UdpRecv, **given).recvlen == 2
    assert b.do(UdpRecv, **given).status == udpERR_NO_DATA


def test_to_the_side_that_is_fixed(a, b):
    there = b.do(UdpOpen, port=700).ident
    ident = a.do(UdpOpen).ident
    assert send(a, ident, b"x").status == udpERR_PARAMETER
    a.do(UdpConnect, ident=ident, pHost="192.168.0.20", port=700)
    assert send(a, ident, b"x").status == ERR_OK
    assert b.do(UdpRecv, ident=there, pData=b.bytes(bytes(9)), datamax=9).recvlen == 1


def test_broadcasts(a, b):
    there = b.do(UdpOpen, port=700).ident
    to_all = {"pHost": "255.255.255.255", "port": 700}
    assert send(a, a.do(UdpOpen).ident, b"x", **to_all).status == udpERR_ACCESS
    ident = a.do(UdpOpen, options=udpOPT_BROADCAST).ident
    assert send(a, ident, b"x", **to_all).status == ERR_OK
    assert b.do(UdpRecv, ident=there, pData=b.bytes(bytes(9)), datamax=9).status == ERR_OK


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"ident": 99}, udpERR_INVALID_IDENT),
        ({"pData": 0}, udpERR_PARAMETER),
        ({"datalen": 65_508}, udpERR_PARAMETER),
        ({"flags": 8}, udpERR_PARAMETER),
        ({"pHost": "nobody"}, udpERR_PARAMETER),
        ({"port": 0}, udpERR_PARAMETER),
    ],
)
def test_wrong_sends(a, inputs, status):
    ident = a.do(UdpOpen).ident
    given = {"ident": ident, "pData": a.bytes(b"x"), "datalen": 1, "pHost": "10.0.0.1", "port": 9}
    sent = a.do(UdpSend, **given | inputs)
    assert (sent.status, sent.sentlen) == (status, 0)


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"ident": 99}, udpERR_INVALID_IDENT),
        ({"pData": 0}, udpERR_PARAMETER),
        ({"datamax": 0}, udpERR_PARAMETER),
        ({"flags": 2}, udpERR_PARAMETER),
    ],
)
def test_wrong_receives(a, inputs, status):
    given = {"ident": a.do(UdpOpen).ident, "pData": a.bytes(b"x"), "datamax": 1}
    assert a.do(UdpRecv, **given | inputs).status == status


def test_a_wild_pointer_takes_nothing(a, b):
    there = b.do(UdpOpen, port=700).ident
    send(a, a.do(UdpOpen).ident, b"abc", pHost="192.168.0.20", port=700)
    wild = {"pData": 0x7000_0000, "datamax": 9}, {"pData": b.bytes(bytes(9)), "datamax": 9}
    with pytest.raises(PageFault):
        b.do(UdpRecv, ident=there, **wild[0])
    with pytest.raises(PageFault):
        b.do(UdpRecv, ident=there, pIpAddr=0x7000_0000, **wild[1])
    assert b.do(UdpRecv, ident=there, **wild[1]).recvlen == 3
