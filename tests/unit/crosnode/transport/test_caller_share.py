"""Callers that stay connected leave idents for topics and services."""

from crosnode.node import CrosNode, StatusKind
from crosnode.transport.caller_share import NodeCallers
from crosnode.xmlrpc.writer import dump_call
from plcsim.network import Outcome, Socket

from ..node.world import OTHER_IP, PLC_IP, STRING, World, drain, news

REQUEST = dump_call("getPid", ["/x"])
HEAD = b"POST / HTTP/1.1\r\nHost: n\r\nContent-Length: %d\r\n\r\n" % len(REQUEST)


def port(node: CrosNode) -> int:
    return int(node.uri.rstrip("/").rpartition(":")[2])


def ask(world: World, socket: Socket) -> bool:
    """Call getPid; return whether it is answered."""
    socket.send(HEAD + REQUEST)
    return b"HTTP/1.1 200" in world.receive(socket, 12)


def test_a_hundred_and_eighteen_callers_that_stay_take_no_topic_its_ident() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/x", STRING)
    world.until(lambda: node.is_registered)
    sockets = []
    for _ in range(118):
        sockets.append(world.dial(PLC_IP, port(node)))
        assert ask(world, sockets[-1])
    subscriber = world.node("late", OTHER_IP).register_subscriber("/x", STRING)
    world.until(lambda: publisher.subscribers, 200)
    publisher.send(publisher.new(data="heard"))
    world.run(5)
    assert len(drain(subscriber.pop)) == 1
    call = world.node("other", "192.168.0.30").call_node(node.uri, "getPid")
    world.until(lambda: call.was_answered, 100)
    assert ask(world, sockets[-1])  # who asked last is still there
    assert sockets[0].recv(10).outcome is Outcome.CLOSED
    assert news(node, StatusKind.NO_IDENT) == []


def test_a_caller_that_asks_no_more_is_left_after_a_minute() -> None:
    world = World()
    node = world.node("n")
    socket = world.dial(PLC_IP, port(node))
    assert ask(world, socket)
    world.run(59_000, step_ms=50)
    assert ask(world, socket)
    world.run(62_000, step_ms=50)
    assert socket.recv(10).outcome is Outcome.CLOSED
    assert not news(node, StatusKind.BAD_MESSAGE)


def test_where_none_is_idle_the_newcomer_goes() -> None:
    world = World()
    node = world.node("n")
    most = node.core.loop.callers.most
    sockets = [world.dial(PLC_IP, port(node)) for _ in range(most)]
    for socket in sockets:
        socket.send(HEAD)  # half of a request
    world.run(30)
    late = world.dial(PLC_IP, port(node))
    world.run(12)
    assert late.recv(10).outcome is Outcome.CLOSED
    sockets[0].send(REQUEST)
    assert b"HTTP/1.1 200" in world.receive(sockets[0], 12)


def test_the_share_is_that_of_all_nodes_of_a_controller() -> None:
    world = World()
    context = world.context(PLC_IP)
    assert context.library(NodeCallers) is context.library(NodeCallers)
    assert context.library(NodeCallers).most == 32


def test_a_shortage_is_told_now_and_then() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/x", STRING)
    world.until(lambda: node.is_registered)
    for _ in range(130):
        world.subscribe_raw(node, topic="/x")
        world.run(1)
    assert publisher.subscribers < 128
    drain(node.pop_status)
    world.run(10_000)
    (told,) = news(node, StatusKind.NO_IDENT)
    assert told.text.startswith("all 128 are in use")
