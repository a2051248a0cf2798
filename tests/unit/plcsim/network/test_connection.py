from __future__ import annotations

from plcsim.network import Link, Option, Outcome, WireLimits

from .world import CLIENT, MS, SECOND, SERVER, World


def test_keepalive_notices_a_lost_peer() -> None:
    world = World()
    client, _ = world.pair()
    for option, value in (
        (Option.KEEP_IDLE, 10),
        (Option.KEEP_INTERVAL, 2),
        (Option.KEEP_COUNT, 3),
        (Option.KEEPALIVE, 1),
    ):
        assert client.set_option(option, value) is Outcome.OK
    world.faults.silence(SERVER, at_ns=25 * SECOND)
    # Probes are answered at 10 s and 20 s; 30, 32 and 34 s are not; at 36 s it is over.
    assert world.outcome_at(36 * SECOND - 1, client) is Outcome.WOULD_BLOCK
    assert world.outcome_at(36 * SECOND, client) is Outcome.TIMED_OUT
    assert world.net.next_event_ns is None


def test_without_keepalive_nobody_notices() -> None:
    world = World()
    client, _ = world.pair()
    world.faults.silence(SERVER)
    assert world.outcome_at(10**6 * SECOND, client) is Outcome.WOULD_BLOCK


def test_keepalive_can_be_turned_off_again() -> None:
    world = World()
    client, _ = world.pair()
    client.set_option(Option.KEEP_IDLE, 1)
    for value in (1, 0, 1, 0):
        client.set_option(Option.KEEPALIVE, value)
    world.faults.silence(SERVER)
    assert world.outcome_at(10**6 * SECOND, client) is Outcome.WOULD_BLOCK
    assert world.net.next_event_ns is None


def test_keepalive_finds_out_that_the_peer_is_gone() -> None:
    world = World()
    client, server = world.pair()
    client.set_option(Option.KEEP_IDLE, 10)
    client.set_option(Option.KEEPALIVE, 1)
    world.faults.silence(CLIENT, SERVER, until_ns=SECOND)
    server.set_linger(0)
    server.close()
    assert world.outcome_at(10 * SECOND - 1, client) is Outcome.WOULD_BLOCK
    assert world.outcome_at(10 * SECOND, client) is Outcome.RESET


def test_a_closed_socket_sends_its_rest() -> None:
    world = World(link=Link(latency_ns=MS))
    client, server = world.pair()
    client.send(b"rest")
    client.close()
    world.now_ns += MS
    assert server.recv(9).data == b"rest"
    assert server.recv(9).outcome is Outcome.CLOSED


def test_a_rest_that_nobody_takes_is_dropped_in_time() -> None:
    world = World(limits=WireLimits(receive_buffer=4))
    client, server = world.pair()
    client.send(b"too much")
    client.close()
    assert world.client.socket_count == 1
    world.now_ns = world.net.limits.fade_ns
    assert server.recv(9).data == b"too "
    assert server.recv(9).outcome is Outcome.RESET
    assert world.client.socket_count == 0


def test_a_peer_that_never_closes_does_not_hold_the_socket() -> None:
    world = World()
    client, server = world.pair()
    client.close()
    assert world.outcome_at(world.net.limits.fade_ns, server) is Outcome.CLOSED
    assert world.client.socket_count == 0
    server.send(b"late")
    assert server.recv(9).outcome is Outcome.RESET


def test_a_lost_reset_is_made_good_when_the_other_sends() -> None:
    world = World()
    client, server = world.pair()
    world.faults.silence(CLIENT, SERVER, until_ns=SECOND)
    client.set_linger(0)
    client.close()
    assert world.outcome_at(2 * SECOND, server) is Outcome.WOULD_BLOCK
    server.send(b"x")
    assert server.recv(9).outcome is Outcome.RESET


def test_both_ends_closed_free_everything() -> None:
    world = World()
    listener = world.listen()
    client, server = world.connect(listener)
    client.close()
    server.close()
    listener.close()
    world.net.settle()
    assert world.client.socket_count == world.server.socket_count == 0
    assert world.net.next_event_ns is None


def test_reading_the_last_bytes_frees_the_sender() -> None:
    world = World(limits=WireLimits(receive_buffer=4))
    client, server = world.pair()
    client.send(b"too much")
    client.close()
    server.shutdown(write=True)
    world.net.settle()
    assert world.client.socket_count == 1
    server.recv(4)
    assert world.client.socket_count == 0


def test_buffers_can_change_while_connected() -> None:
    world = World()
    client, server = world.pair()
    client.set_option(Option.SEND_BUFFER, 10)
    server.set_option(Option.RECEIVE_BUFFER, 5)
    assert client.send(bytes(100)).taken == 10
    assert client.send(bytes(100)).taken == 5
    assert client.send(bytes(100)).outcome is Outcome.WOULD_BLOCK
