"""The embedded master on its port."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crosnode.xmlrpc.api_caller import ApiCall

from ..node.world import MASTER_IP, OTHER_IP, PLC_IP, SECOND, STRING, World


def test_a_port_in_use_is_tried_again() -> None:
    world = World(master=False)
    blocker = world.net.host(MASTER_IP).open("", 11311).socket
    assert blocker is not None
    blocker.listen(1)
    server = world.start_master()
    world.run(10)
    assert not server.is_open
    assert server.status == 32602
    blocker.close()
    world.until(lambda: server.is_open, 1_100)


def test_parameters_from_the_start_are_there() -> None:
    world = World(master=False)
    server = world.start_master(parameters={"/run_id": "x"})
    node = world.node("n", PLC_IP)
    call = node.get_param("/run_id")
    world.until(lambda: call.was_answered)
    assert call.value == "x"
    assert server.is_open


def test_a_subscriber_of_a_parameter_that_refuses_is_forgotten() -> None:
    world = World()
    node, setter = world.node("n"), world.node("setter", OTHER_IP)
    node.call_master("subscribeParam", node.uri, "/p")
    world.until(lambda: node.is_registered)
    assert world.master
    assert "/p" in world.master.master._graph.parameters.nodes
    setter.set_param("/p", 1)
    world.run(50)
    assert "/p" not in world.master.master._graph.parameters.nodes


def test_a_node_that_stands_still_hears_all_the_news_when_it_goes_on() -> None:
    world = World()
    listener, talker = world.node("listener"), world.node("talker", OTHER_IP)
    subscribers = [listener.register_subscriber(f"/x{number}", STRING) for number in range(3)]
    param = listener.subscribe_param("/p")
    world.until(lambda: listener.is_registered and talker.is_registered)
    world.run(50)
    world.steps.remove(listener.do_events_loop)
    for number in range(3):
        talker.register_publisher(f"/x{number}", STRING)
    talker.set_param("/p", 5)
    world.run(30_000, step_ms=10)
    world.steps.append(listener.do_events_loop)
    world.until(lambda: all(each.publishers for each in subscribers) and param.value == 5, 1_000)


@pytest.mark.parametrize(("silent_s", "is_told"), [(60, True), (200, False)])
def test_news_wait_two_minutes_for_a_node_that_cannot_be_reached(
    silent_s: int, *, is_told: bool
) -> None:
    world = World()
    listener, talker = world.node("listener"), world.node("talker", OTHER_IP)
    subscriber = listener.register_subscriber("/x", STRING)
    world.until(lambda: listener.is_registered and talker.is_registered)
    world.run(50)
    world.leave_to_its_connections(listener)  # which would register again
    world.faults.silence(MASTER_IP, PLC_IP, until_ns=world.now_ns + silent_s * SECOND)
    talker.register_publisher("/x", STRING)
    world.run(250_000, step_ms=20)
    assert bool(subscriber.peers) is is_told


def test_a_dead_node_delays_the_news_of_no_other() -> None:
    world = World()
    world.net.host("192.168.0.77")
    listener = world.node("listener", OTHER_IP)
    subscriber = listener.register_subscriber("/x", STRING)
    world.until(lambda: listener.is_registered)
    for name, ip in (("/gone", "192.168.0.77"), ("/never", "192.168.0.78")):
        params = [name, "/x", STRING, f"http://{ip}:1/"]
        listener.core.api.start(ApiCall(world.master_uri, "registerSubscriber", params))
    world.run(10)
    talker = world.node("talker")
    talker.register_publisher("/x", STRING)
    world.until(lambda: subscriber.publishers, 100)


def test_a_hundred_silent_connections_cost_their_own_ends_only() -> None:
    world = World()
    sockets = []
    for _ in range(100):
        sockets.append(world.dial(MASTER_IP, 11311))
    node = world.node("n")
    world.until(lambda: node.is_registered, 500)
    assert world.master
    assert len(world.master._loop.links) == 64  # half of all idents
    world.run(10_500)
    assert len(world.master._loop.links) < 10


@settings(max_examples=30, deadline=None)
@given(st.binary(max_size=300))
def test_any_bytes_end_at_most_their_own_connection(data: bytes) -> None:
    world = World()
    world.dial(MASTER_IP, 11311, data)
    node = world.node("n")
    world.until(lambda: node.is_registered, 200)
