"""Opening, fixing the other side, closing."""

import pytest

from plcsim.library.asudp import (
    udpERR_ALREADY_EXIST,
    udpERR_INTERFACE,
    udpERR_INVALID_IDENT,
    udpERR_NOMORE_IDENTS,
    udpERR_PARAMETER,
    udpOPT_REUSEADDR,
)
from plcsim.library.asudp.block import UdpIdents
from plcsim.library.asudp.settings import AsUdpSettings
from plcsim.library.asudp.sockets import UdpClose, UdpConnect, UdpDisconnect, UdpOpen
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK
from plcsim.network import VirtualNetwork


def test_a_port_is_taken_until_it_is_closed(pair):
    plc, _ = pair
    first = plc.do(UdpOpen, port=700)
    assert first.status == ERR_OK
    again = plc.do(UdpOpen, port=700, options=udpOPT_REUSEADDR)
    assert (again.status, again.ident) == (udpERR_ALREADY_EXIST, 0)
    assert plc.do(UdpClose, ident=first.ident).status == ERR_OK
    assert plc.do(UdpClose, ident=first.ident).status == udpERR_INVALID_IDENT
    assert plc.do(UdpOpen, port=700).status == ERR_OK


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"pIfAddr": "10.9.9.9"}, udpERR_INTERFACE),
        ({"pIfAddr": "eth0"}, udpERR_INTERFACE),
        ({"options": 8}, udpERR_PARAMETER),
        ({"pIfAddr": "192.168.0.10"}, ERR_OK),
        ({"pIfAddr": ""}, ERR_OK),
    ],
)
def test_interfaces_and_options(pair, inputs, status):
    assert pair[0].do(UdpOpen, port=700, **inputs).status == status


def test_there_is_an_end_of_idents(make_plc):
    network = VirtualNetwork(lambda: 0).host("192.168.0.10")
    plc = make_plc([AsUdpSettings(idents=2)], network=network)
    found = [plc.call(UdpOpen).status for _ in range(3)]
    assert found == [ERR_OK, ERR_OK, udpERR_NOMORE_IDENTS]


@pytest.mark.parametrize("view", [UdpOpen, UdpClose, UdpConnect, UdpDisconnect])
def test_disabled(pair, view):
    block = pair[0].new(view)
    block(enable=False)
    assert block.status == ERR_FUB_ENABLE_FALSE


def test_the_other_side(pair):
    plc, _ = pair
    ident = plc.do(UdpOpen).ident
    assert plc.do(UdpConnect, ident=ident, pHost="192.168.0.20", port=7).status == ERR_OK
    assert plc.do(UdpConnect, ident=ident, pHost="nobody", port=7).status == udpERR_PARAMETER
    assert plc.do(UdpConnect, ident=ident, port=7).status == udpERR_PARAMETER
    assert plc.do(UdpConnect, ident=99).status == udpERR_INVALID_IDENT
    assert plc.do(UdpDisconnect, ident=ident).status == ERR_OK
    assert plc.do(UdpDisconnect, ident=99).status == udpERR_INVALID_IDENT


def test_a_restart_closes_all(pair):
    plc, _ = pair
    plc.do(UdpOpen, port=700)
    plc.context.restart()
    assert len(plc.context.library(UdpIdents)) == 0
    assert plc.do(UdpOpen, port=700).status == ERR_OK
