from __future__ import annotations

import pytest

from plcsim.network import Address, Outcome
from plcsim.network.errors import NetworkSetupError

from .world import CLIENT, MS, SERVER, World


def test_reset_at_a_time_ends_both_ends() -> None:
    world = World()
    client, server = world.pair()
    world.faults.reset(CLIENT, SERVER, at_ns=5 * MS)
    assert world.outcome_at(5 * MS - 1, client) is Outcome.WOULD_BLOCK
    assert world.outcome_at(5 * MS, client) is Outcome.RESET
    assert server.recv(1).outcome is Outcome.RESET


def test_reset_spares_other_connections() -> None:
    world = World()
    listener = world.listen()
    client, _ = world.connect(listener)
    world.faults.reset(SERVER, "192.168.0.99")
    assert world.outcome_at(1, client) is Outcome.WOULD_BLOCK
    world.faults.reset(SERVER)
    assert world.outcome_at(2, client) is Outcome.RESET


def test_reset_of_a_host_spares_its_loopback() -> None:
    world = World()
    listener = world.server.open("127.0.0.1", 80).socket
    client = world.server.open("", 0).socket
    assert listener is not None
    assert client is not None
    listener.listen(1)
    client.connect(listener.local)
    assert client.connect(listener.local) is Outcome.OK
    world.faults.reset(SERVER)
    assert client.recv(1).outcome is Outcome.WOULD_BLOCK


def test_reset_of_what_never_was_is_nothing() -> None:
    world = World()
    world.faults.reset("10.0.0.1", "10.0.0.2")
    client, _ = world.pair()
    assert client.recv(1).outcome is Outcome.WOULD_BLOCK


def test_refusal_for_a_span_of_time() -> None:
    world = World()
    world.listen(502)
    world.faults.refuse(SERVER, 502, at_ns=0, until_ns=10)
    client, target = world.dial(502)
    assert client.connect(target) is Outcome.REFUSED
    world.now_ns = 10
    assert client.connect(target) is Outcome.WOULD_BLOCK
    assert client.connect(target) is Outcome.OK


def test_refusal_of_one_port_leaves_the_others() -> None:
    world = World()
    world.listen(502)
    world.faults.refuse(SERVER, 503)
    world.faults.refuse(CLIENT)
    client, target = world.dial(502)
    assert client.connect(target) is Outcome.OK


def test_short_silence_only_delays() -> None:
    world = World()
    client, server = world.pair()
    world.faults.silence(CLIENT, SERVER, until_ns=100 * MS)
    client.send(b"abc")
    assert world.outcome_at(99 * MS, server) is Outcome.WOULD_BLOCK
    world.now_ns = 1_000 * MS
    assert server.recv(10).data == b"abc"


def test_a_lost_host_is_noticed_by_who_sends() -> None:
    world = World()
    client, server = world.pair()
    world.faults.silence(SERVER, at_ns=1 * MS)
    world.now_ns = 1 * MS
    client.send(b"abc")
    limit_ns = 1 * MS + world.net.limits.retransmit_ns
    assert world.outcome_at(limit_ns - 1, client) is Outcome.WOULD_BLOCK
    assert world.outcome_at(limit_ns, client) is Outcome.TIMED_OUT
    assert client.send(b"x").outcome is Outcome.TIMED_OUT
    assert server.recv(1).outcome is Outcome.WOULD_BLOCK


def test_no_route_fails_at_once() -> None:
    world = World()
    world.listen(502)
    world.faults.unreachable(CLIENT, SERVER, until_ns=10)
    client = world.client.open("", 0).socket
    assert client is not None
    target = Address(SERVER, 502)
    assert client.connect(target) is Outcome.UNREACHABLE
    world.now_ns = 10
    assert client.connect(target) is Outcome.WOULD_BLOCK


def test_delay_adds_to_the_latency() -> None:
    world = World()
    client, server = world.pair()
    world.faults.delay(CLIENT, SERVER, by_ns=3 * MS)
    client.send(b"x")
    assert world.outcome_at(3 * MS - 1, server) is Outcome.WOULD_BLOCK
    assert world.outcome_at(3 * MS, server) is Outcome.OK


def test_short_sends() -> None:
    world = World(seed=1)
    client, server = world.pair()
    world.faults.short_sends(CLIENT, largest=3)
    taken = [client.send(b"abcdef").taken for _ in range(20)]
    assert set(taken) == {1, 2, 3}
    assert server.send(b"abcdef").taken == 6


def test_clear_ends_what_lasts() -> None:
    world = World()
    client, server = world.pair()
    world.faults.silence(CLIENT)
    world.faults.clear()
    client.send(b"x")
    assert world.outcome_at(1, server) is Outcome.OK


def test_faults_that_are_over_are_forgotten() -> None:
    world = World()
    for _ in range(100):
        world.faults.silence(CLIENT, until_ns=world.now_ns + 1)
        world.now_ns += 1
    assert len(world.faults._faults) == 1


def test_wrong_plans_are_refused() -> None:
    world = World()
    world.now_ns = 100
    with pytest.raises(NetworkSetupError, match="'plc' is not an address"):
        world.faults.reset("plc")
    with pytest.raises(NetworkSetupError, match="at_ns=99 is before"):
        world.faults.silence(CLIENT, at_ns=99)
    with pytest.raises(NetworkSetupError, match="until_ns=100 is not after"):
        world.faults.silence(CLIENT, until_ns=100)
    with pytest.raises(NetworkSetupError, match="by_ns=0"):
        world.faults.delay(CLIENT, by_ns=0)
    with pytest.raises(NetworkSetupError, match="largest=0"):
        world.faults.short_sends(CLIENT, largest=0)
