"""``recv_into``: as ``recv``, on the virtual net and on the host."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import pytest

from plcsim.network import Address, Network, OsNetwork, Outcome, Socket, VirtualNetwork

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(name="pair", params=["virtual", "os"])
def _pair(request: pytest.FixtureRequest) -> Iterator[tuple[Socket, Socket]]:
    network: Network = (
        VirtualNetwork(lambda: 0).host("192.168.0.10")
        if request.param == "virtual"
        else OsNetwork()
    )
    listener, client = network.open("127.0.0.1", 0).socket, network.open("", 0).socket
    assert listener is not None
    assert client is not None
    listener.listen(1)
    end = time.monotonic() + 20
    while client.connect(Address("127.0.0.1", listener.local.port)) is Outcome.WOULD_BLOCK:
        assert time.monotonic() < end
    while (server := listener.accept().socket) is None:
        assert time.monotonic() < end
    listener.close()
    yield client, server
    client.close()
    server.close()


def filled(socket: Socket, target: memoryview) -> tuple[Outcome, int]:
    end = time.monotonic() + 20
    while (answer := socket.recv_into(target)).outcome is Outcome.WOULD_BLOCK:
        assert time.monotonic() < end
    return answer


def test_bytes_come_to_their_place_and_what_is_behind_stays(pair: tuple[Socket, Socket]) -> None:
    client, server = pair
    place = bytearray(b"........")
    assert server.recv_into(memoryview(place)) == (Outcome.WOULD_BLOCK, 0)
    client.send(b"abcdef")
    assert filled(server, memoryview(place)[2:5]) == (Outcome.OK, 3)
    assert place == b"..abc..."
    assert filled(server, memoryview(place)) == (Outcome.OK, 3)
    assert place == b"defbc..."
    client.close()
    assert filled(server, memoryview(place)) == (Outcome.CLOSED, 0)


def test_no_place_and_no_connection(pair: tuple[Socket, Socket]) -> None:
    _, server = pair
    assert server.recv_into(memoryview(bytearray())) == (Outcome.INVALID, 0)
    server.close()
    assert server.recv_into(memoryview(bytearray(1))) == (Outcome.NOT_CONNECTED, 0)
