"""Seeded hostile input against every listening port, while a topic flows and a service is called.

``attack(30, seed)`` is a long run; the tests run shorter ones. ``benchmarks/ros_fuzz.py`` does the
same to real processes.
"""

import pytest

from crosnode.graph.uri import parse_uri
from crosnode.testing import AttackedPort, Attacker, HostilePeers, Speaks
from plcsim.network import Address, Outcome

from .world import MASTER_IP, OTHER_IP, PLC_IP, STRING, World, words

SET_BOOL = "std_srvs/SetBool"
MOST_LINKS = 200


def attack(seconds: int, seed: int) -> Attacker:
    """Attack the master, a node that publishes and provides, and one that subscribes."""
    world = World(seed=seed)
    assert world.master
    talker, listener = world.node("talker"), world.node("listener", OTHER_IP)
    publisher = talker.register_publisher("/x", STRING)
    provider = talker.register_service_provider("/set", SET_BOOL)
    subscriber = listener.register_subscriber("/x", STRING, queue_size=1000)
    caller = listener.register_service_caller("/set", SET_BOOL, persistent=True)
    world.until(lambda: publisher.subscribers and talker.is_registered)
    doors = [AttackedPort(Address(MASTER_IP, 11311), Speaks.XMLRPC)]
    for node in (talker, listener):
        numbers = (node.topic_listener.port, node._service_listener.port)
        doors += [AttackedPort(Address(node.host, port), Speaks.TCPROS) for port in numbers]
        doors.append(
            AttackedPort(Address(node.host, parse_uri(node.uri, "http").port), Speaks.XMLRPC)
        )
    attacker = Attacker(world.peer(), doors, HostilePeers(seed, "/x", "/set"))
    heard: list[str] = []
    answered = 0
    for tick in range(seconds * 1000):
        attacker.step()
        if tick % 10 == 0:
            publisher.send(publisher.new(data=str(tick // 10)))
        if tick % 100 == 0:
            caller.call(caller.new(data=True))
        world.run(1)
        while (request := provider.pop()) is not None:
            request.respond(success=True)
        while (reply := caller.pop()) is not None:
            answered += reply.response is not None
        heard += words(subscriber.pop)
        for loop in (talker.core.loop, listener.core.loop, world.master._loop):
            assert len(loop.links) <= MOST_LINKS
            assert sum(link.waiting for link in loop.links) < 1 << 20
    world.run(50)
    heard += words(subscriber.pop)
    assert heard == [str(number) for number in range(seconds * 100)]
    assert answered >= seconds * 10 - 2
    assert talker.is_registered
    return attacker


@pytest.mark.parametrize("seed", [1, 2])
def test_the_topic_flows_and_the_service_answers_while_others_attack(seed: int) -> None:
    assert attack(3, seed).counts.total() > 300


def test_ports_are_reached_by_the_attack() -> None:
    world = World()
    node = world.node("talker")
    socket = world.dial(PLC_IP, node.topic_listener.port, b"\xff\xff\xff\xff")
    world.run(20)
    assert b"error=" in socket.recv(1000).data
    assert socket.recv(1).outcome is Outcome.CLOSED
