from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim.network import Address, Link, Outcome, VirtualNetwork
from plcsim.network.errors import NetworkSetupError
from plcsim.network.wire import TraceEvent

from .world import CLIENT, MS, SECOND, SERVER, World


@pytest.mark.parametrize("ip", ["plc", "", "0.0.0.0", "127.0.0.1"])
def test_only_host_addresses_make_a_host(ip: str) -> None:
    with pytest.raises(NetworkSetupError, match="not an address of a host"):
        World().net.host(ip)


def test_a_host_is_made_once() -> None:
    net = World().net
    assert net.host("10.0.0.1") is net.host("10.0.0.1")


def test_a_link_of_its_own() -> None:
    world = World()
    world.net.set_link(CLIENT, SERVER, Link(latency_ns=7 * MS))
    client, server = world.pair()
    assert world.now_ns == 14 * MS
    client.send(b"x")
    assert world.outcome_at(21 * MS - 1, server) is Outcome.WOULD_BLOCK
    assert world.outcome_at(21 * MS, server) is Outcome.OK


def test_time_passes_for_a_program_that_spins() -> None:
    net = VirtualNetwork(lambda: 0, link=Link(latency_ns=MS), call_ns=1_000)
    client = net.host(CLIENT).open("", 0).socket
    assert client is not None
    target = Address(SERVER, 502)
    net.host(SERVER)
    calls = 1
    while client.connect(target) is Outcome.WOULD_BLOCK:
        calls += 1
    assert calls == 2_001
    assert net.now_ns == 2_002 * 1_000


def test_the_clock_leads_where_it_moves() -> None:
    now_ns = [0]
    net = VirtualNetwork(lambda: now_ns[0], call_ns=10)
    net.settle()
    assert net.now_ns == 10
    now_ns[0] = 5
    net.settle()
    assert net.now_ns == 20
    now_ns[0] = 1_000
    net.settle()
    assert net.now_ns == 1_000


def test_a_long_jump_lets_things_happen_at_their_own_times() -> None:
    world = World(link=Link(latency_ns=MS))
    world.listen()
    world.dial()
    world.now_ns = SECOND
    world.net.settle()
    assert [(event.time_ns, event.kind) for event in world.net.trace] == [
        (MS, "SYN"),
        (2 * MS, "SYN-ACK"),
    ]


def test_the_trace_tells_arrivals_and_losses() -> None:
    world = World()
    client, _ = world.pair()
    world.net.trace.clear()
    client.send(b"abc")
    world.net.settle()
    world.faults.silence(SERVER, until_ns=MS)
    client.send(b"de")
    world.net.settle()
    assert list(world.net.trace) == [
        TraceEvent(0, "DATA", client.local, Address(SERVER, 502), 3, lost=False),
        TraceEvent(0, "DATA", client.local, Address(SERVER, 502), 2, lost=True),
    ]


def test_the_trace_is_bounded() -> None:
    net = VirtualNetwork(lambda: 0, trace_length=3)
    for port in range(1, 10):
        client = net.host(CLIENT).open("", 0).socket
        assert client is not None
        client.connect(Address(CLIENT, port))
    net.settle()
    assert len(net.trace) == 3


def talk(seed: int, script: list[tuple[int, int]]) -> tuple[list[TraceEvent], list[bytes]]:
    link = Link(latency_ns=1_000, jitter_ns=5_000, smallest_packet=1, largest_packet=30)
    world = World(seed=seed, link=link)
    client, server = world.pair()
    world.faults.short_sends(CLIENT, largest=20)
    world.faults.silence(SERVER, at_ns=world.now_ns + 50_000, until_ns=world.now_ns + 90_000)
    got = []
    for size, wait_ns in script:
        client.send(bytes(size))
        world.now_ns += wait_ns
        got.append(server.recv(size).data)
    return list(world.net.trace), got


SCRIPT = st.lists(st.tuples(st.integers(1, 60), st.integers(0, 20_000)), max_size=20)


@settings(max_examples=50)
@given(seed=st.integers(0, 2**32), script=SCRIPT)
def test_the_same_seed_gives_the_same_run(seed: int, script: list[tuple[int, int]]) -> None:
    assert talk(seed, script) == talk(seed, script)


def test_another_seed_gives_another_run() -> None:
    script = [(50, 10_000)] * 10
    assert talk(1, script) != talk(2, script)
