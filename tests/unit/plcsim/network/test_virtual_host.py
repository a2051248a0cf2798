from __future__ import annotations

import pytest

from plcsim.network import Address, Outcome, WireLimits
from plcsim.network.virtual_host import FIRST_FREE_PORT, LAST_PORT

from .world import SERVER, World


def test_free_ports_come_in_turn() -> None:
    host = World().server
    ports = [host.open("", 0).socket.local.port for _ in range(3)]
    assert ports == [FIRST_FREE_PORT, FIRST_FREE_PORT + 1, FIRST_FREE_PORT + 2]


def test_free_ports_skip_what_is_taken_and_begin_again() -> None:
    host = World().server
    host._last_free = LAST_PORT - 1
    host.open("", FIRST_FREE_PORT)
    ports = [host.open("", 0).socket.local.port for _ in range(2)]
    assert ports == [LAST_PORT, FIRST_FREE_PORT + 1]


def test_a_host_has_only_so_many_sockets() -> None:
    world = World(limits=WireLimits(sockets=2))
    one = world.server.open("", 0).socket
    world.server.open("", 0)
    assert world.server.open("", 0).outcome is Outcome.NO_RESOURCES
    one.close()
    assert world.server.open("", 0).outcome is Outcome.OK


def test_queued_connections_count_as_sockets() -> None:
    world = World(limits=WireLimits(sockets=2))
    world.listen()
    first, target = world.dial()
    second, _ = world.dial()
    assert first.connect(target) is Outcome.OK
    assert second.connect(target) is Outcome.WOULD_BLOCK


@pytest.mark.parametrize("ip", ["", "0.0.0.0", SERVER, "127.0.0.1"])
def test_own_addresses(ip: str) -> None:
    assert World().server.open(ip, 80).outcome is Outcome.OK


def test_the_same_port_on_two_addresses() -> None:
    host = World().server
    host.open(SERVER, 80)
    assert host.open("127.0.0.1", 80).outcome is Outcome.OK
    assert host.open("", 80).outcome is Outcome.IN_USE


def test_a_listener_on_loopback_is_not_seen_from_outside() -> None:
    world = World()
    listener = world.server.open("127.0.0.1", 80).socket
    listener.listen(1)
    client, target = world.dial(80)
    assert client.connect(target) is Outcome.REFUSED


def test_loopback_knows_both_names_of_the_host() -> None:
    world = World()
    listener = world.server.open("", 80).socket
    listener.listen(3)
    for ip in ("127.0.0.1", SERVER):
        client = world.server.open("", 0).socket
        target = Address(ip, 80)
        client.connect(target)
        assert client.connect(target) is Outcome.OK
        assert client.local.ip == ip
        assert listener.accept().peer == client.local


def test_time_wait_passes() -> None:
    world = World()
    listener = world.listen(80)
    client, server = world.connect(listener)
    server.close()
    client.close()
    listener.close()
    assert world.server.open("", 80).outcome is Outcome.IN_USE
    world.now_ns += world.net.limits.fade_ns
    assert world.server.open("", 80).outcome is Outcome.OK


def test_who_closes_last_has_no_time_wait() -> None:
    world = World()
    listener = world.listen(80)
    client, server = world.connect(listener)
    client.close()
    server.close()
    listener.close()
    assert world.server.open("", 80).outcome is Outcome.OK
