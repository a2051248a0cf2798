"""Nodes that others end, and that return where they shall."""

from crosnode.node import StatusKind
from crosnode.node.registration import RegistrationState
from crosnode.xmlrpc.api_caller import CallState

from .world import MASTER_IP, MS, OTHER_IP, STRING, World, news, words


def test_a_node_that_shall_respawn_returns_with_all_it_had() -> None:
    world = World()
    node, other = world.node("n", respawns=True), world.node("other", OTHER_IP)
    publisher = node.register_publisher("/out", STRING)
    subscriber = node.register_subscriber("/in", STRING)
    gone = node.register_publisher("/gone", STRING)
    heard, source = (
        other.register_subscriber("/out", STRING),
        other.register_publisher("/in", STRING),
    )
    world.until(lambda: heard.publishers and subscriber.publishers)
    other.call_node(node.uri, "shutdown", "because")
    world.until(lambda: not heard.publishers, 100)
    assert not node.is_shut_down
    assert not node.is_registered
    assert news(node, StatusKind.SHUTDOWN)
    node.unregister(gone)
    late = node.register_publisher("/late", STRING)
    took = world.until(lambda: publisher.subscribers and subscriber.publishers)
    assert 900 < took < 1_300
    publisher.send(publisher.new(data="again"))
    source.send(source.new(data="and again"))
    world.run(10)
    assert (words(heard.pop), words(subscriber.pop)) == (["again"], ["and again"])
    world.until(lambda: node.is_registered)
    call = other.call_master("getPublishedTopics", "")
    world.until(lambda: call.was_answered)
    assert ["/late", STRING] in call.value
    assert ["/gone", STRING] not in call.value
    assert late.registration.is_settled


def test_twins_that_both_respawn_take_turns_that_grow_longer() -> None:
    world = World()
    first = world.node("twin", respawns=True)
    world.until(lambda: first.is_registered)
    second = world.node("twin", OTHER_IP, respawns=True)
    world.run(60_000, step_ms=10)
    assert 3 <= first.life.kills <= 7
    assert 3 <= second.life.kills <= 7


def test_a_node_that_rests_can_be_closed() -> None:
    world = World()
    node = world.node("n", respawns=True)
    node.register_publisher("/out", STRING)
    world.until(lambda: node.is_registered)
    node.shut_down("so")
    world.run(500)
    node.close()
    world.until(lambda: node.is_closed, 100)


def test_a_node_whose_master_hangs_returns_all_the_same() -> None:
    world = World()
    node = world.node("n", respawns=True)
    publisher = node.register_publisher("/out", STRING)
    world.until(lambda: node.is_registered)
    world.faults.silence(MASTER_IP, until_ns=world.now_ns + 30_000 * MS)
    node.shut_down("so")
    world.run(40_000, step_ms=5)
    assert publisher.registration.state is RegistrationState.REGISTERED


def test_calls_of_a_node_that_has_ended_have_failed() -> None:
    world = World()
    node = world.node("n")
    world.until(lambda: node.is_registered)
    world.run(50)
    world.faults.silence(MASTER_IP)
    calls = [node.get_param("/p") for _ in range(3)]
    node.close()
    world.run(4_000)
    assert node.is_closed
    assert {call.state for call in calls} == {CallState.FAILED}
