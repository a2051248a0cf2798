"""IPv6: the same rules on the virtual net and on the host's own loopback."""

from __future__ import annotations

import ipaddress
import socket
import time
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.network import Address, Network, OsNetwork, Outcome, Socket, VirtualNetwork
from plcsim.network.protocol import canonical_ipv6, is_ip, is_ipv6

if TYPE_CHECKING:
    from collections.abc import Callable


def has_ipv6() -> bool:
    try:
        with socket.socket(socket.AF_INET6) as probe:
            probe.bind(("::1", 0))
    except OSError:
        return False
    return True


@pytest.fixture(name="network", params=["virtual", "os"])
def _network(request: pytest.FixtureRequest) -> Network:
    if request.param == "virtual":
        return VirtualNetwork(lambda: 0).host("fd00::10")
    if not has_ipv6():
        pytest.skip("this host has no IPv6")
    return OsNetwork()


def opened(network: Network, ip: str, port: int = 0) -> Socket:
    made = network.open(ip, port)
    assert made.socket is not None, made
    return made.socket


def until(ask: Callable[[], Outcome], wanted: Outcome) -> None:
    """Ask until the answer is the wanted one; the host needs its time."""
    end = time.monotonic() + 100
    while (outcome := ask()) is not wanted:
        assert outcome is Outcome.WOULD_BLOCK
        assert time.monotonic() < end


def pair(network: Network, bound: str, target: str) -> tuple[Socket, Socket, Socket]:
    """Return listener, client and what the listener took."""
    listener = opened(network, bound)
    assert listener.listen(1) is Outcome.OK
    client = opened(network, "::" if ":" in target else "")
    until(lambda: client.connect(Address(target, listener.local.port)), Outcome.OK)
    taken: list[Socket] = []

    def accept() -> Outcome:
        outcome, socket, peer = listener.accept()
        if socket is not None:
            taken.append(socket)
            assert peer.ip == target
        return outcome

    until(accept, Outcome.OK)
    return listener, client, taken[0]


@pytest.mark.parametrize("bound", ["::1", "::", "0:0:0:0:0:0:0:1"])
def test_bytes_go_both_ways(network: Network, bound: str) -> None:
    listener, client, server = pair(network, bound, "::1")
    assert client.peer == Address("::1", listener.local.port)
    for sender, reader in ((client, server), (server, client)):
        assert sender.send(b"six").outcome is Outcome.OK
        until(lambda reader=reader: reader.recv(1, peek=True).outcome, Outcome.OK)
        assert reader.recv(100).data == b"six"
    for each in (client, server, listener):
        each.close()


def test_who_listens_on_all_hears_ipv4_too_and_knows_it_as_such() -> None:
    if not has_ipv6():
        pytest.skip("this host has no IPv6")
    for each in pair(OsNetwork(), "::", "127.0.0.1"):
        each.close()


def test_a_socket_of_one_kind_does_not_connect_to_the_other(network: Network) -> None:
    four, six = opened(network, ""), opened(network, "::")
    assert four.connect(Address("::1", 1)) is Outcome.INVALID_ADDRESS
    assert six.connect(Address("127.0.0.1", 1)) is Outcome.INVALID_ADDRESS
    assert six.connect(Address("::", 1)) is Outcome.INVALID_ADDRESS
    four.close()
    six.close()


@pytest.mark.parametrize("ip", ["fe80::1%eth0", ":::", "1::2::3", "::1 ", "[::1]", "12345::"])
def test_what_is_no_literal_opens_nothing(network: Network, ip: str) -> None:
    assert network.open(ip, 0) == (Outcome.INVALID_ADDRESS, None)


def test_hosts_of_a_virtual_net_find_each_other() -> None:
    net = VirtualNetwork(lambda: 0)
    server, client = net.host("fd00::a"), net.host("FD00:0::B")
    listener = opened(server, "")
    assert listener.local.ip == "0.0.0.0"
    listener.close()
    listener = opened(server, "::", 80)
    listener.listen(1)
    socket = opened(client, "::")
    until(lambda: socket.connect(Address("fd00:0:0::A", 80)), Outcome.OK)
    assert listener.accept().peer.ip == "fd00::b"


@given(st.one_of(st.text(), st.ip_addresses(v=6).map(str), st.text("0123456789abcdef:.%")))
def test_literals_are_those_of_the_standard_library(text: str) -> None:
    try:
        wanted: str | None = str(ipaddress.IPv6Address(text))
    except ValueError:
        wanted = None
    if "%" in text:
        wanted = None
    assert canonical_ipv6(text) == wanted
    assert is_ipv6(text) is (wanted is not None)
    assert is_ip(text) or wanted is None
