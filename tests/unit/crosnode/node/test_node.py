"""Nodes and the embedded master in one test, on the virtual network and clock."""

from itertools import pairwise

import pytest

from crosnode.errors import InvalidNameError, MessageTypeError, NodeError
from crosnode.graph.arguments import node_settings
from crosnode.master.server import MasterOptions, MasterServer
from crosnode.node import CrosNode, StatusKind
from crosnode.transport.budget import StepLimits
from crosnode.xmlrpc.api_caller import CallState
from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.astcp.idents import IdentTable
from plcsim.network import Address, OsNetwork, Outcome
from tests.ports import free_port

from .world import MS, OTHER_IP, PLC_IP, STRING, World, drain, news, words


def test_what_a_node_publishes_another_receives() -> None:
    world = World()
    talker, listener = world.node("talker"), world.node("listener", OTHER_IP)
    publisher = talker.register_publisher("chatter", STRING)
    subscriber = listener.register_subscriber("chatter", STRING)
    world.until(lambda: publisher.subscribers)
    for number in range(5):
        publisher.send(publisher.new(data=f"Hello {number}"))
    world.run(5)
    assert words(subscriber.pop) == [f"Hello {number}" for number in range(5)]


def test_the_first_message_is_there_within_eighteen_ticks() -> None:
    """Master and talker have a step a millisecond too."""
    world = World()
    talker = world.node("talker")
    publisher = talker.register_publisher("/chatter", STRING, loop_period_ns=MS)
    world.run(50)
    subscriber = world.node("listener", OTHER_IP).register_subscriber("/chatter", STRING)
    ticks = 0
    while not subscriber.queue:
        if (message := publisher.pop()) is not None:
            publisher.send(message)
        world.run(1)
        ticks += 1
    assert ticks <= 18


def test_in_init_the_master_is_told_of_the_program_s_first_topic() -> None:
    port = free_port()
    master_context, context = (Context(Memory(), OsNetwork()) for _ in range(2))
    master = MasterServer(master_context, MasterOptions("127.0.0.1", port))
    master.step()
    given = {"ROS_MASTER_URI": master.uri}
    node = CrosNode(context, node_settings("n", (), given, host="127.0.0.1"))
    node.register_subscriber("/x", STRING)
    node.register_publisher("/y", STRING)
    for _ in range(100):
        master_context.release_ns += MS
        master.step()
    _, _, told = master.master.get_system_state("/test")
    assert told == [[], [["/x", ["/n"]]], []]  # the next call waits for the answer
    node.destroy(steps=10)
    master.close()


def test_a_run_repeats_itself_exactly() -> None:
    def run() -> list[object]:
        world = World(seed=7)
        talker = world.node("talker")
        publisher = talker.register_publisher("/chatter", STRING, loop_period_ns=3 * MS)
        subscriber = world.node("listener", OTHER_IP).register_subscriber("/chatter", STRING)
        trace: list[object] = []
        for tick in range(100):
            if (message := publisher.pop()) is not None:
                publisher.send(message)
            world.run(1)
            trace.append((tick, len(drain(subscriber.pop))))
        return [*trace, *[str(event) for event in world.net.trace]]

    first, second = run(), run()
    for trace in (first, second):
        assert any(isinstance(entry, tuple) and entry[1] for entry in trace)
    assert [str(entry) for entry in first] == [str(entry) for entry in second]


def test_a_node_can_subscribe_to_itself() -> None:
    world = World()
    node = world.node("both")
    publisher = node.register_publisher("/x", STRING)
    subscriber = node.register_subscriber("/x", STRING)
    world.until(lambda: publisher.subscribers)
    publisher.send(publisher.new(data="me"))
    world.run(5)
    assert words(subscriber.pop) == ["me"]


def test_names_are_resolved_and_remapped() -> None:
    world = World()
    node = world.node("n", PLC_IP, "__ns:=/cell", "__name:=robot", "chatter:=/other", "_p:=3")
    assert node.name == "/cell/robot"
    assert node.register_publisher("chatter", STRING).topic == "/other"
    assert node.register_publisher("~mine", STRING).topic == "/cell/robot/mine"
    assert node.register_publisher("x", STRING).topic == "/cell/x"
    value = node.get_param("~p")
    world.until(lambda: value.state is CallState.DONE)
    assert value.value == 3


def test_the_same_topic_twice_and_wrong_names_are_errors() -> None:
    node = World().node("n")
    node.register_publisher("/x", STRING)
    with pytest.raises(InvalidNameError, match="has /x already"):
        node.register_publisher("/x", STRING)
    with pytest.raises(InvalidNameError):
        node.register_publisher("/a b", STRING)
    with pytest.raises(MessageTypeError):
        node.register_subscriber("/y", "no_msgs/Such")


def test_unregister_ends_the_connections_and_tells_the_master() -> None:
    world = World()
    talker, listener = world.node("talker"), world.node("listener", OTHER_IP)
    publisher = talker.register_publisher("/chatter", STRING)
    other = talker.register_publisher("/other", STRING)
    subscriber = listener.register_subscriber("/chatter", STRING)
    second = listener.register_subscriber("/other", STRING)
    world.until(lambda: publisher.subscribers and other.subscribers)
    talker.unregister(publisher)
    world.run(20)
    assert subscriber.publishers == 0
    assert second.publishers == 1
    assert [s.name for s in news(talker, StatusKind.UNREGISTERED)] == ["/chatter"]
    listener.unregister(second)
    world.until(lambda: other.subscribers == 0)
    state = talker.call_master("getSystemState")
    world.run(20)
    assert "/chatter" not in str(state.value[0])
    assert "/other" not in str(state.value[1])


def test_unregister_while_the_registration_is_under_way() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/x", STRING)
    world.run(2)
    node.unregister(publisher)
    world.run(50)
    state = node.call_master("getSystemState")
    world.run(10)
    assert "/x" not in str(state.value)


def test_a_closed_node_leaves_no_trace() -> None:
    world = World()
    talker, listener = world.node("talker"), world.node("listener", OTHER_IP)
    publisher = talker.register_publisher("/chatter", STRING)
    talker.register_service_provider("~set", "std_srvs/SetBool")
    talker.subscribe_param("/p")
    listener.register_subscriber("/chatter", STRING)
    world.until(lambda: publisher.subscribers)
    context = talker._context
    assert context.library(IdentTable).in_use()
    talker.close()
    assert world.until(lambda: talker.is_closed) <= 60
    assert context.library(IdentTable).in_use() == ()
    assert world.master
    _, _, state = world.master.master.get_system_state("/x")
    assert "talker" not in str(state)
    talker.do_events_loop()


def test_exit_closes_a_node_within_one_call() -> None:
    world = World()
    node = world.node("n", "192.168.0.1")
    world.until(lambda: node.is_registered)
    assert world.master
    master = world.master
    world.steps.clear()
    node.options = node.options._replace(beside=master.step)
    node.destroy()
    assert node.is_closed
    assert "/n" not in str(master.master.get_system_state("/x")[2])


def test_exit_without_a_master_ends_too() -> None:
    world = World(master=False)
    node = world.node("n")
    world.run(10)
    node.destroy(steps=200)
    assert node.is_closed


def test_parameters() -> None:
    world = World()
    node = world.node("n", PLC_IP)
    calls = {
        "set": node.set_param("/a/b", [1, "x", 2.5, True]),
        "get": node.get_param("/a"),
        "has": node.has_param("/a/b"),
        "names": node.get_param_names(),
        "search": node.search_param("a"),
        "delete": node.delete_param("/a/b"),
        "gone": node.has_param("/a/b"),
        "missing": node.get_param("/nothing"),
    }
    world.until(lambda: calls["missing"].state is not CallState.WAITING)
    assert calls["get"].value == {"b": [1, "x", 2.5, True]}
    assert calls["has"].value is True
    assert "/a/b" in calls["names"].value
    assert calls["search"].value == "/a"
    assert calls["gone"].value is False
    assert calls["missing"].state is CallState.FAILED
    assert "not set" in calls["missing"].error


def test_the_master_api_and_the_slave_api_of_another_node() -> None:
    world = World()
    one, other = world.node("one"), world.node("other", OTHER_IP)
    one.register_publisher("/x", STRING)
    world.until(lambda: one.is_registered and other.is_registered)
    found = other.call_master("lookupNode", "/one")
    world.run(10)
    assert found.value == one.uri
    pid, info = other.call_node(one.uri, "getPid"), other.call_node(one.uri, "getPublications")
    wrong = other.call_node(one.uri, "getNothing")
    world.run(20)
    assert pid.value == one.pid
    assert ["/x", STRING] in info.value
    assert wrong.state is CallState.FAILED
    assert "not supported" in wrong.error


def test_shutdown_ends_the_node_and_the_program_hears_of_it() -> None:
    world = World()
    node, killer = world.node("n"), world.node("killer", OTHER_IP)
    world.until(lambda: node.is_registered)
    killer.call_node(node.uri, "shutdown", "because")
    world.until(lambda: node.is_closed, 100)
    assert news(node, StatusKind.SHUTDOWN)


def test_of_two_nodes_with_one_name_the_first_ends() -> None:
    world = World()
    first = world.node("twin")
    world.until(lambda: first.is_registered)
    second = world.node("twin", OTHER_IP)
    world.until(lambda: first.is_closed, 200)
    world.run(1_200)
    assert not second.is_shut_down
    assert second.is_registered


def test_a_node_with_no_work_spends_one_poll_on_each_connection() -> None:
    world = World()
    node = world.node("n")
    peers = [world.subscribe_raw(node, topic="/rosout") for _ in range(10)]
    world.run(20)
    assert len(node.core.loop.links) == 11
    assert all(link.waiting == 0 for link in node.core.loop.links)
    assert len(peers) == 10


def test_limits_of_the_step_hold() -> None:
    limits = StepLimits(bytes_in=1000, bytes_out=1000, messages=3)
    world = World()
    talker = world.node("talker", step=StepLimits())
    listener = world.node("listener", OTHER_IP, step=limits)
    publisher = talker.register_publisher("/x", STRING, queue_size=1000)
    subscriber = listener.register_subscriber("/x", STRING, queue_size=1000)
    world.until(lambda: publisher.subscribers)
    for number in range(100):
        publisher.send(publisher.new(data=str(number)))
    seen = []
    for _ in range(100):
        world.run(1)
        seen.append(len(subscriber.queue))
    steps = [b - a for a, b in pairwise(seen)]
    assert max(steps) <= 3
    assert words(subscriber.pop) == [str(number) for number in range(100)]


def test_a_role_taken_back_twice_stays_taken_back_and_the_one_after_it_stays() -> None:
    world = World()
    node = world.node("n")
    roles = [
        node.register_publisher("/x", STRING),
        node.register_subscriber("/x", STRING),
        node.register_service_provider("/set", "std_srvs/SetBool"),
        node.register_service_caller("/set", "std_srvs/SetBool"),
        node.subscribe_param("/p"),
    ]
    world.until(lambda: node.is_registered)
    for role in roles:
        node.unregister(role)
    again = node.register_publisher("/x", STRING), node.register_subscriber("/x", STRING)
    for role in roles:
        node.unregister(role)
    world.until(lambda: node.is_registered and again[1].publishers)
    assert node.publishers["/x"] is again[0]
    assert node.subscribers["/x"] is again[1]


def test_a_subscriber_taken_back_while_the_master_is_new_parts_from_its_publisher() -> None:
    world = World()
    talker, listener = world.node("talker"), world.node("listener", OTHER_IP)
    publisher = talker.register_publisher("/x", STRING)
    subscriber = listener.register_subscriber("/x", STRING)
    world.until(lambda: publisher.subscribers)
    world.leave_to_its_connections(talker)
    world.kill_master()
    world.run(100)
    world.restart_master()
    world.until(lambda: listener.is_registered)
    (peer,) = subscriber.peers.values()
    assert peer.life < listener.core.master.life
    listener.unregister(subscriber)
    world.until(lambda: not publisher.subscribers, 100)


def test_a_node_is_reached_by_those_who_can_reach_its_host_and_no_others() -> None:
    world = World()
    here = world.node("here", environment={"ROS_IP": "127.0.0.1"})
    there = world.node("there", OTHER_IP)
    opened = world.node("opened", "192.168.0.21", environment={"ROS_IP": "127.0.0.1"}, bind_ip="")

    def outcome(node: CrosNode, ip: str) -> Outcome:
        socket = world.peer().open("", 0).socket
        assert socket
        port = int(node.uri.rstrip("/").rpartition(":")[2])
        while (result := socket.connect(Address(ip, port))) is Outcome.WOULD_BLOCK:
            world.run(1)
        return result

    assert outcome(here, PLC_IP) is Outcome.REFUSED
    assert outcome(there, OTHER_IP) is Outcome.OK
    assert outcome(opened, "192.168.0.21") is Outcome.OK


def test_a_host_that_is_none_of_this_machine_is_named() -> None:
    world = World()
    with pytest.raises(NodeError, match=r"/n: 10\.1\.1\.1 is no address of this host; bind = "):
        world.node("n", environment={"ROS_IP": "10.1.1.1"})
