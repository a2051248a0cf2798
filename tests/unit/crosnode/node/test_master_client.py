"""The node and its master on bad days: absent, restarted, restarted with the same pid, refusing."""

import pytest

from crosnode.node import StatusKind
from crosnode.node.registration import RegistrationState
from crosnode.xmlrpc.api_caller import ApiCall
from plcsim.network import Outcome

from .world import (
    MASTER_IP,
    OTHER_IP,
    PLC_IP,
    STRING,
    World,
    drain,
    end_behind_answers,
    news,
    words,
)


def test_a_node_waits_for_a_master_that_comes_later() -> None:
    world = World(master=False)
    world.net.host(MASTER_IP)
    node = world.node("n")
    world.run(3_000)
    assert not node.is_registered
    world.restart_master()
    assert world.until(lambda: node.is_registered) <= 1_200


def test_after_a_restart_all_is_registered_again_and_no_message_is_lost() -> None:
    world = World()
    talker, listener = world.node("talker"), world.node("listener", OTHER_IP)
    publisher = talker.register_publisher("/x", STRING)
    subscriber = listener.register_subscriber("/x", STRING, queue_size=1000)
    talker.register_service_provider("/set", "std_srvs/SetBool")
    param = listener.subscribe_param("/p")
    world.until(lambda: publisher.subscribers and listener.is_registered)
    world.run(50)
    sent = 0
    for tick in range(4_000):
        if tick == 500:
            world.kill_master()
        if tick == 1_500:
            world.restart_master()
        if tick % 10 == 0:
            publisher.send(publisher.new(data=str(sent)))
            sent += 1
        world.run(1)
    assert words(subscriber.pop) == [str(number) for number in range(sent)]
    assert talker.is_registered
    assert listener.is_registered
    assert world.master
    state = str(world.master.master.get_system_state("/x"))
    for name in ("/x", "/set", "/talker", "/listener"):
        assert f"'{name}'" in state
    talker.set_param("/p", 5)
    world.until(lambda: param.value == 5, 50)
    kinds = {s.kind for s in drain(talker.pop_status)}
    assert {StatusKind.MASTER_FOUND, StatusKind.MASTER_LOST} <= kinds


def test_an_open_connection_is_kept_though_a_new_master_never_names_the_publisher() -> None:
    world = World()
    listener, talker = world.node("listener"), world.node("talker", OTHER_IP)
    subscriber = listener.register_subscriber("/x", STRING, queue_size=1000)
    publisher = talker.register_publisher("/x", STRING)
    world.until(lambda: subscriber.publishers)
    world.leave_to_its_connections(talker)
    world.kill_master()
    world.run(500)
    world.restart_master()
    world.until(lambda: listener.is_registered)
    for number in range(40):
        publisher.send(publisher.new(data=str(number)))
        world.run(1_000, step_ms=10)
    assert words(subscriber.pop) == [str(number) for number in range(40)]
    kinds = [status.kind for status in drain(listener.pop_status) if status.name == "/x"]
    assert StatusKind.DISCONNECTED not in kinds
    talker.destroy()
    world.run(50)
    assert subscriber.peers == {}  # nobody names it: it is not tried again


@pytest.mark.parametrize("state", ["ASKING", "CONNECTING"])
def test_a_connection_on_its_way_is_made_though_the_master_dies(state: str) -> None:
    world = World()
    listener, talker = world.node("listener"), world.node("talker", OTHER_IP)
    subscriber = listener.register_subscriber("/x", STRING)
    world.until(lambda: listener.is_registered)
    publisher = talker.register_publisher("/x", STRING)
    world.until(lambda: [each.state.name for each in subscriber.peers.values()] == [state])
    world.leave_to_its_connections(talker)
    stopped = world.steps.pop()
    world.kill_master()
    world.restart_master()
    world.run(100)
    world.until(lambda: listener.is_registered)
    world.run(100)
    world.steps.append(stopped)
    world.until(lambda: subscriber.publishers == publisher.subscribers == 1, 100)


def test_what_the_same_master_takes_away_is_left_though_the_connection_lives() -> None:
    world = World()
    listener, talker = world.node("listener"), world.node("talker", OTHER_IP)
    subscriber = listener.register_subscriber("/x", STRING)
    talker.register_publisher("/x", STRING)
    world.until(lambda: subscriber.publishers)
    world.kill_master()
    master = world.start_master()
    world.until(lambda: listener.is_registered and talker.is_registered)
    world.run(50)
    assert list(subscriber.peers) == [talker.uri]
    call = ApiCall(master.uri, "unregisterPublisher", ["/talker", "/x", talker.uri])
    listener.core.api.start(call)
    world.until(lambda: not subscriber.peers, 50)
    world.run(50)
    assert not subscriber.publishers


def test_a_master_that_forgot_all_while_the_connection_stayed_is_told_again() -> None:
    world = World()
    node = world.node("n")
    node.subscribe_param("/p")
    world.until(lambda: node.is_registered)
    world.run(50)
    assert world.master
    pid = world.master.master._pid
    world.master.master = type(world.master.master)(world.master.uri, pid)
    assert world.until(lambda: "/n" in str(world.master.master.get_system_state("/x"))) <= 1_100  # type: ignore[union-attr]


def test_a_registration_that_is_refused_is_told_and_the_others_stay() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/x", STRING)
    publisher.registration.register = ("registerPublisher", ["/x"])
    world.until(lambda: node.is_registered)
    refused = news(node, StatusKind.REGISTRATION_REFUSED)
    assert [status.name for status in refused] == ["/x"]


def test_a_master_that_does_not_answer_delays_nothing_but_itself() -> None:
    world = World()
    talker, listener = world.node("talker"), world.node("listener", OTHER_IP)
    publisher = talker.register_publisher("/x", STRING)
    subscriber = listener.register_subscriber("/x", STRING, queue_size=1000)
    world.until(lambda: publisher.subscribers)
    world.faults.silence(MASTER_IP)
    for number in range(100):
        publisher.send(publisher.new(data=str(number)))
        world.run(20)
    assert len(words(subscriber.pop)) == 100


def test_a_port_that_speaks_no_xml_rpc_is_no_master() -> None:
    world = World(master=False)
    listener = world.net.host(MASTER_IP).open("", 11311).socket
    assert listener is not None
    listener.listen(5)
    node = world.node("n")
    for _ in range(20):
        world.run(100)
        if (accepted := listener.accept()).outcome is Outcome.OK:
            assert accepted.socket
            accepted.socket.send(b"SSH-2.0-hello\r\n\r\n" * 10)
            accepted.socket.close()
    assert not node.is_registered
    assert node.core.loop.listeners
    listener.close()
    world.run(100)
    world.restart_master()
    world.until(lambda: node.is_registered)


def test_an_unknown_host_of_the_master_is_told() -> None:
    world = World()
    node = world.node("n", environment={"ROS_MASTER_URI": "http://robot:11311"})
    call = node.get_param("/x")
    world.run(10)
    assert "host 'robot' is not known" in call.error
    known = world.node("m", OTHER_IP, environment={"ROS_MASTER_URI": "http://robot:11311"},
                       hosts={"robot": MASTER_IP})  # fmt: skip
    world.until(lambda: known.is_registered)


def test_a_master_that_is_not_there_is_told_once_until_it_comes() -> None:
    world = World(master=False)
    node = world.node("n")
    world.run(5_000)
    (lost,) = news(node, StatusKind.MASTER_LOST)
    assert lost.name == world.master_uri
    world.restart_master()
    world.until(lambda: node.is_registered)
    assert len(news(node, StatusKind.MASTER_FOUND)) == 1
    world.kill_master()
    world.run(5_000)
    assert len(news(node, StatusKind.MASTER_LOST)) == 1


def published(world: World) -> list[str]:
    assert world.master
    return [topic for topic, _ in world.master.master.get_system_state("/x")[2][0]]


def test_what_is_taken_back_while_the_master_is_away_is_taken_back_later() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/x", STRING)
    world.until(lambda: node.is_registered)
    world.faults.reset(PLC_IP, MASTER_IP)
    world.run(3)
    node.unregister(publisher)
    assert "/x" in published(world)
    world.until(lambda: publisher.registration.state is RegistrationState.GONE)
    assert "/x" not in published(world)
    assert len(news(node, StatusKind.UNREGISTERED)) == 1


def test_a_topic_taken_back_and_published_again_while_the_master_is_away() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/x", STRING)
    world.until(lambda: node.is_registered)
    world.kill_master()
    world.run(300)
    node.unregister(publisher)
    node.register_publisher("/x", "std_msgs/Bool")
    world.run(300)
    world.restart_master()
    world.until(lambda: node.is_registered and world.master and "/x" in published(world))
    world.run(100)
    assert world.master
    assert ["/x", "std_msgs/Bool"] in world.master.master.get_topic_types("/x")[2]


def test_a_node_that_closes_does_not_wait_for_a_master_that_is_away() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/x", STRING)
    world.until(lambda: node.is_registered)
    world.kill_master()
    world.run(10)
    node.unregister(publisher)
    node.close()
    world.until(lambda: node.is_closed, 100)


def test_what_the_master_refused_is_gone_at_once() -> None:
    world = World()
    node = world.node("n")
    subscriber = node.register_subscriber("/x", STRING)
    world.until(lambda: node.is_registered)
    subscriber.registration.state = RegistrationState.REFUSED
    node.unregister(subscriber)
    assert subscriber.registration.state is RegistrationState.GONE
    assert node.is_registered


@pytest.mark.parametrize("steps", [50, 51])  # calls go before the connections in every other one
def test_a_master_that_was_started_again_while_the_controller_stood_still_is_told_all(
    steps: int,
) -> None:
    world = World()
    node = world.node("n")
    node.register_publisher("/before", STRING)
    world.until(lambda: node.is_registered)
    world.run(steps * 10, step_ms=10)  # in such a step there is time to connect again
    world.steps.remove(node.do_events_loop)
    world.kill_master()
    world.restart_master()
    world.run(100, step_ms=10)
    node.register_publisher("/behind", STRING)
    node.get_param("/p")  # this call, not sent yet, finds the new master
    world.steps.append(node.do_events_loop)
    world.run(500, step_ms=10)
    assert world.master
    state = str(world.master.master.get_system_state("/x"))
    assert "'/before'" in state
    assert "'/behind'" in state


def test_a_master_that_ends_each_connection_behind_its_answer_is_not_lost(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    world = World()
    end_behind_answers(monkeypatch)
    talker, listener = world.node("talker"), world.node("listener", OTHER_IP)
    publisher = talker.register_publisher("/x", STRING)
    subscriber = listener.register_subscriber("/x", STRING)
    world.until(lambda: subscriber.publishers, 500)
    world.run(5_000)
    assert not news(listener, StatusKind.MASTER_LOST)
    world.kill_master()
    world.run(2_000)
    assert len(news(talker, StatusKind.MASTER_LOST)) == 1
    world.restart_master()
    world.until(lambda: talker.is_registered and listener.is_registered)
    publisher.send(publisher.new(data="still"))
    world.until(lambda: words(subscriber.pop) == ["still"], 50)
