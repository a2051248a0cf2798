"""Seeded hostile input against every listening port, while a topic flows and a service is called.

``attack(30, seed)`` is the long run of the issue; the tests run shorter ones.
"""

import random
import struct

import pytest

from crosnode.tcpros.header import encode_header
from crosnode.uri import parse_uri
from plcsim.network import Address, Outcome, Socket

from .world import MASTER_IP, OTHER_IP, PLC_IP, STRING, World, words

SET_BOOL = "std_srvs/SetBool"
MOST_LINKS = 200


class Attacker:
    """Connects to random ports and says random things, cut at random places."""

    def __init__(self, world: World, ports: list[Address], seed: int) -> None:
        self.random = random.Random(seed)
        self._world = world
        self._ports = ports
        self._open: list[tuple[Socket, bytes]] = []
        self.made = 0

    def step(self) -> None:
        chance = self.random.random
        if chance() < 0.2 and len(self._open) < 60:
            self._connect()
        for place in range(len(self._open) - 1, -1, -1):
            socket, data = self._open[place]
            if chance() < 0.02:
                if chance() < 0.5:
                    socket.set_linger(0)
                socket.close()
                del self._open[place]
            elif data and chance() < 0.5:
                sent = socket.send(data[: self.random.choice((1, 3, 50, 4000))])
                self._open[place] = (socket, data[sent.taken :])

    def _connect(self) -> None:
        socket = self._world.peer().open("", 0).socket
        if socket is None:
            return
        self.made += 1
        socket.connect(self.random.choice(self._ports))
        self._open.append((socket, self._words()))

    def _words(self) -> bytes:
        choose = self.random.choice
        header = {
            "callerid": "/evil",
            "topic": choose(("/x", "/none", "x" * 3000)),
            "service": choose(("/set", "/none")),
            "md5sum": choose(("*", "0" * 32)),
            "type": "*",
            "persistent": choose("01"),
            "probe": choose("01"),
        }
        for key in [key for key in header if self.random.random() < 0.15]:
            del header[key]
        rpc = choose(
            (
                b"<methodCall><methodName>%s</methodName><params>%s</params></methodCall>",
                b"<!DOCTYPE a [<!ENTITY b 'cc'>]><a>&b;%s%s</a>",
                b"%s%s",
            )
        )
        method = choose(
            (
                b"requestTopic",
                b"publisherUpdate",
                b"paramUpdate",
                b"registerPublisher",
                b"getBusInfo",
                b"setParam",
                b"system.multicall",
                b"",
            )
        )
        value = choose(
            (
                b"",
                b"<param><value><string>/x</string></value></param>" * 3,
                b"<param><value><array><data>" * 50,
                b"<param><value><i4>x</i4>",
            )
        )
        body = rpc % (method, value)
        length = choose((len(body), len(body), 10**12, -1, 0))
        head = b"POST /RPC2 HTTP/1.1\r\nHost: x\r\nContent-Length: %d\r\n\r\n" % length
        frames = b"".join(
            struct.pack("<I", choose((0, 1, 5, 2**31, 2**32 - 1))) + b"ab" for _ in range(3)
        )
        noise = self.random.randbytes(choose((0, 5, 5000)))
        return choose(
            (
                encode_header(header) + frames,
                head + body,
                noise,
                encode_header(header),
                head + noise,
                b"GET / HTTP/1.0\r\n\r\n",
                struct.pack("<I", 2**32 - 1),
            )
        )


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
    ports = [Address(MASTER_IP, 11311)]
    for node in (talker, listener):
        numbers = (node.topic_listener.port, node._service_listener.port)
        ports += [Address(node.host, port) for port in numbers]
        ports.append(Address(node.host, parse_uri(node.uri, "http").port))
    attacker = Attacker(world, ports, seed)
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
    assert attack(3, seed).made > 300


def test_ports_are_reached_by_the_attack() -> None:
    world = World()
    node = world.node("talker")
    socket = world.dial(PLC_IP, node.topic_listener.port, b"\xff\xff\xff\xff")
    world.run(20)
    assert b"error=" in socket.recv(1000).data
    assert socket.recv(1).outcome is Outcome.CLOSED
