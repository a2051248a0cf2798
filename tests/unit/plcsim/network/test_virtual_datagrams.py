"""Datagrams on the virtual net: latency, loss, broadcasts, full buffers. The rest: the contract."""

import pytest

from plcsim.network import Address, Link, Option, Outcome, VirtualNetwork, WireLimits

A, B, C = "192.168.0.10", "192.168.0.20", "192.168.0.30"
MS = 1_000_000


class World:
    def __init__(self, **given):
        self.now_ns = 0
        self.net = VirtualNetwork(lambda: self.now_ns, call_ns=0, **given)
        self.a, self.b, self.c = (self.net.host(ip) for ip in (A, B, C))

    def opened(self, host, port=0):
        return host.open_datagrams("", port).socket


def test_a_datagram_takes_its_time():
    world = World(link=Link(latency_ns=3 * MS))
    sender, receiver = world.opened(world.a), world.opened(world.b, 700)
    sender.send(b"x", Address(B, 700))
    world.now_ns = 3 * MS - 1
    assert receiver.recv(9).outcome is Outcome.WOULD_BLOCK
    world.now_ns = 3 * MS
    assert receiver.recv(9).data == b"x"


def test_what_is_lost_is_lost():
    world = World()
    sender, receiver = world.opened(world.a), world.opened(world.b, 700)
    world.net.faults.silence(A, B, until_ns=10 * MS)
    assert sender.send(b"lost", Address(B, 700)).outcome is Outcome.OK
    world.now_ns = 20 * MS
    sender.send(b"heard", Address(B, 700))
    assert receiver.recv(9).data == b"heard"
    assert receiver.recv(9).outcome is Outcome.WOULD_BLOCK


def test_nobody_there():
    world = World()
    sender = world.opened(world.a)
    for target in (Address(B, 700), Address("192.168.0.99", 700)):
        assert sender.send(b"x", target).outcome is Outcome.OK
    assert sender.recv(9).outcome is Outcome.WOULD_BLOCK


def test_a_broadcast_reaches_all_hosts():
    world = World()
    sender = world.opened(world.a, 700)
    others = [world.opened(world.b, 700), world.opened(world.c, 700)]
    sender.set_option(Option.BROADCAST, 1)
    assert sender.send(b"all", Address("255.255.255.255", 700)).outcome is Outcome.OK
    assert [socket.recv(9).data for socket in (sender, *others)] == [b"all"] * 3


def test_a_full_buffer_loses_what_comes():
    world = World(limits=WireLimits(receive_buffer=10))
    sender, receiver = world.opened(world.a), world.opened(world.b, 700)
    for text in (b"123456", b"7890", b"x"):
        sender.send(text, Address(B, 700))
    found = [receiver.recv(9) for _ in range(3)]
    assert [each.data for each in found] == [b"123456", b"7890", b""]
    assert found[2].outcome is Outcome.WOULD_BLOCK


def test_loopback_stays_on_the_host():
    world = World()
    receiver = world.a.open_datagrams("127.0.0.1", 700).socket
    world.opened(world.b).send(b"from outside", Address(A, 700))
    world.opened(world.a).send(b"from inside", Address("127.0.0.1", 700))
    found = receiver.recv(20)
    assert (found.data, found.peer.ip) == (b"from inside", "127.0.0.1")
    assert receiver.recv(20).outcome is Outcome.WOULD_BLOCK


def test_sockets_have_an_end_and_count_with_those_of_tcp():
    world = World(limits=WireLimits(sockets=2))
    first = world.opened(world.a)
    assert world.a.open("", 0).outcome is Outcome.OK
    assert world.a.open_datagrams("", 0).outcome is Outcome.NO_RESOURCES
    first.close()
    assert world.a.open_datagrams("", 0).outcome is Outcome.OK
    assert world.a.socket_count == 2


@pytest.mark.parametrize("jitter_ns", [0, 5 * MS])
def test_a_run_can_be_repeated(jitter_ns):
    def run():
        world = World(link=Link(latency_ns=MS, jitter_ns=jitter_ns), seed=7)
        sender, receiver = world.opened(world.a), world.opened(world.b, 700)
        for number in range(20):
            sender.send(bytes([number]), Address(B, 700))
        world.now_ns = 100 * MS
        return [receiver.recv(1).data for _ in range(20)]

    assert run() == run()
    assert sorted(run()) == [bytes([number]) for number in range(20)]
