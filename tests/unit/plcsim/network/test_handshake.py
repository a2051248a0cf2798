from __future__ import annotations

from plcsim.network import Link, Outcome

from .world import CLIENT, MS, SECOND, SERVER, World


def test_connecting_takes_two_latencies() -> None:
    world = World(link=Link(latency_ns=MS))
    world.listen()
    client, target = world.dial()
    world.now_ns = 2 * MS - 1
    assert client.connect(target) is Outcome.WOULD_BLOCK
    world.now_ns = 2 * MS
    assert client.connect(target) is Outcome.OK


def test_a_refusal_takes_two_latencies() -> None:
    world = World(link=Link(latency_ns=MS))
    client, target = world.dial()
    world.now_ns = 2 * MS - 1
    assert client.connect(target) is Outcome.WOULD_BLOCK
    world.now_ns = 2 * MS
    assert client.connect(target) is Outcome.REFUSED


def test_no_such_host_times_out() -> None:
    world = World()
    client, target = world.dial(ip="192.168.0.99")
    world.now_ns = world.net.limits.connect_ns - 1
    assert client.connect(target) is Outcome.WOULD_BLOCK
    world.now_ns = world.net.limits.connect_ns
    assert client.connect(target) is Outcome.TIMED_OUT
    assert world.net.next_event_ns is None


def test_after_a_failure_the_same_socket_can_try_again() -> None:
    world = World()
    client, target = world.dial()
    assert client.connect(target) is Outcome.REFUSED
    world.listen()
    assert client.connect(target) is Outcome.WOULD_BLOCK
    assert client.connect(target) is Outcome.OK


def test_a_full_queue_lets_the_client_wait() -> None:
    world = World()
    listener = world.listen(backlog=0)
    first, target = world.dial()
    second, _ = world.dial()
    assert first.connect(target) is Outcome.OK
    assert second.connect(target) is Outcome.WOULD_BLOCK
    assert listener.accept().outcome is Outcome.OK
    assert second.connect(target) is Outcome.WOULD_BLOCK
    world.now_ns = SECOND
    assert second.connect(target) is Outcome.OK


def test_a_lost_syn_ack_is_repeated() -> None:
    world = World(link=Link(latency_ns=MS))
    listener = world.listen()
    client, target = world.dial()
    world.faults.silence(CLIENT, SERVER, at_ns=2 * MS, until_ns=3 * MS)
    world.now_ns = 10 * MS
    assert client.connect(target) is Outcome.WOULD_BLOCK
    assert listener.accept().outcome is Outcome.OK
    world.now_ns = SECOND
    assert client.connect(target) is Outcome.OK


def test_silence_after_the_syn_times_both_ends_out() -> None:
    world = World(link=Link(latency_ns=MS))
    listener = world.listen()
    client, target = world.dial()
    world.faults.silence(CLIENT, SERVER, at_ns=2 * MS)
    world.now_ns = 2 * world.net.limits.connect_ns
    assert client.connect(target) is Outcome.TIMED_OUT
    server = listener.accept().socket
    assert server is not None
    assert server.recv(1).outcome is Outcome.TIMED_OUT


def test_closing_before_the_syn_arrives_leaves_no_trace_at_the_server() -> None:
    world = World(link=Link(latency_ns=MS))
    listener = world.listen()
    client, _ = world.dial()
    client.close()
    world.now_ns = SECOND
    assert listener.accept().outcome is Outcome.WOULD_BLOCK


def test_closing_before_the_syn_ack_arrives_resets_the_server() -> None:
    world = World(link=Link(latency_ns=MS))
    listener = world.listen()
    client, target = world.dial()
    world.now_ns = MS
    assert client.connect(target) is Outcome.WOULD_BLOCK
    client.close()
    world.now_ns = SECOND
    server = listener.accept().socket
    assert server is not None
    assert server.recv(1).outcome is Outcome.RESET


def test_closing_when_connected_but_not_told_ends_in_order() -> None:
    world = World()
    listener = world.listen()
    client, _ = world.dial()
    server = listener.accept().socket
    assert server is not None
    client.close()
    assert server.recv(1).outcome is Outcome.CLOSED


def test_the_target_of_later_calls_does_not_matter() -> None:
    world = World()
    world.listen(502)
    client, target = world.dial(502)
    assert client.connect(target._replace(port=503)) is Outcome.OK
    assert client.peer == target


def test_a_reset_between_connection_and_the_poll_is_told() -> None:
    world = World()
    listener = world.listen()
    client, target = world.dial()
    server = listener.accept().socket
    assert server is not None
    world.faults.reset(SERVER)
    assert client.connect(target) is Outcome.RESET
