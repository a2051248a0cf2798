"""The step is bounded and fair; see also node/test_node.py."""

from itertools import pairwise

from crosnode.tcpros.header import encode_header
from crosnode.transport.budget import POLL_WORK, StepLimits
from crosnode.xmlrpc.api_caller import ApiCall, CallState
from crosnode.xmlrpc.writer import dump_call
from plcsim.network import Address

from ..node.world import MASTER_IP, OTHER_IP, PLC_IP, STRING, World, words


def test_all_connections_have_their_turn_though_few_fit_into_a_step() -> None:
    world = World()
    node = world.node("n", step=StepLimits(polls=4))
    publisher = node.register_publisher("/chatter", STRING)
    sockets = [world.subscribe_raw(node) for _ in range(20)]
    world.until(lambda: publisher.subscribers == 20, 200)
    for number in range(5):
        publisher.send(publisher.new(data=f"<{number}>"))
        world.run(10)
    for socket in sockets:
        data = socket.recv(65_536).data
        assert all(b"<%d>" % number in data for number in range(5))


def test_a_flood_on_one_connection_leaves_the_others_their_turn() -> None:
    world = World()
    limits = StepLimits(bytes_in=2_000)
    listener = world.node("listener", step=limits)
    subscriber = listener.register_subscriber("/x", STRING, queue_size=10_000)
    flood = world.node("flood", OTHER_IP).register_publisher("/x", STRING, queue_size=10_000)
    calm = world.node("calm", "192.168.0.21").register_publisher("/x", STRING)
    world.until(lambda: flood.subscribers and calm.subscribers)
    for _ in range(500):
        flood.send(flood.new(data="f" * 500))
    world.run(5)
    calm.send(calm.new(data="calm"))
    world.run(8)
    assert "calm" in words(subscriber.pop)


def test_calls_of_many_nodes_at_once_are_spread_over_steps() -> None:
    world = World()
    node = world.node("n")
    world.until(lambda: node.is_registered)
    request = dump_call("getPid", ["/x"])
    head = b"POST / HTTP/1.1\r\nHost: n\r\nContent-Length: %d\r\n\r\n" % len(request)
    port = int(node.uri.rstrip("/").rpartition(":")[2])
    sockets = [world.dial(PLC_IP, port) for _ in range(20)]
    world.run(20)
    for socket in sockets:
        socket.send(4 * (head + request))
    answered = []
    for _ in range(165):  # each takes two steps: reading it, and answering
        world.run(1)
        answered.append(sum(socket.recv(65_536).data.count(b"HTTP/1.1 200") for socket in sockets))
    assert sum(answered) == 80
    assert max(answered) <= 2


def test_who_connects_has_a_first_turn_where_the_step_has_time_for_it() -> None:
    world = World()
    node = world.node("n")
    world.until(lambda: node.is_registered)
    world.run(50)
    port = int(node.uri.rstrip("/").rpartition(":")[2])
    for socket in [world.peer().open("", 0).socket for _ in range(6)]:
        assert socket is not None
        socket.connect(Address(PLC_IP, port))
    left = []
    for _ in range(20):
        world.run(1)
        left.append((node.core.budget.work, node.core.budget.polls))
    looks = StepLimits().polls
    assert all(work >= POLL_WORK * (polls - looks) for work, polls in left)
    assert len(node.core.loop.links) == 1 + 6


def flood(callers: int) -> tuple[int, int]:
    """Return the calls answered and the messages received within 300 steps."""
    world = World()
    listener = world.node("listener")
    subscriber = listener.register_subscriber("/x", STRING, queue_size=10_000)
    talker = world.node("talker", OTHER_IP).register_publisher("/x", STRING, queue_size=10_000)
    nodes = [world.node(f"caller{i}", f"192.168.1.{i + 1}") for i in range(callers)]
    world.until(lambda: talker.subscribers and all(node.is_registered for node in nodes))
    calls: list[ApiCall | None] = [None] * callers
    answered = 0
    for _ in range(300):
        talker.send(talker.new(data="x" * 150_000))
        for place, call in enumerate(calls):
            if call is None or call.state is CallState.DONE:
                answered += call is not None
                calls[place] = nodes[place].call_node(listener.uri, "getPid")
        world.run(1)
    return answered, len(words(subscriber.pop))


def test_a_flood_of_calls_leaves_a_topic_its_turn_and_the_other_way_round() -> None:
    _, alone = flood(0)
    answered, beside = flood(4)
    assert beside >= alone // 5 > 3  # one link of five, and calls come over new connections
    assert answered > 50  # each in some six parts, between which the topic has its turn


def test_a_call_for_much_is_answered_over_many_steps() -> None:
    world = World()
    node, asker = world.node("n"), world.node("asker", OTHER_IP)
    for number in range(100):
        node.register_publisher(f"/topic{number}", STRING)
    world.until(lambda: node.is_registered and asker.is_registered)
    calls = [{"methodName": "getPublications", "params": ["/x"]} for _ in range(60)]
    multi = asker.core.api.start(ApiCall(node.uri, "system.multicall", [calls]))
    steps = 0
    while multi.state is CallState.WAITING:
        world.run(1)
        steps += 1
    assert steps > 60
    assert len(multi.value) == 60
    assert all(answer == multi.value[0] for answer in multi.value)
    assert len(multi.value[0][0][2]) == 101


def test_a_caller_that_does_not_read_its_answers_is_not_heard_any_more() -> None:
    world = World()
    node = world.node("n")
    for number in range(200):
        node.register_publisher(f"/topic{number}", STRING)
    world.run(1_000)
    assert world.master
    links = world.master._loop.links
    request = dump_call("getSystemState", ["/x"])
    head = b"POST / HTTP/1.1\r\nHost: n\r\nContent-Length: %d\r\n\r\n" % len(request)
    socket = world.dial(MASTER_IP, 11311)
    for _ in range(100):
        socket.send(head + request)
        world.run(1)
    largest = max(link.waiting for link in links)
    assert 1 << 16 < largest < 1 << 18
    answered = 0
    for _ in range(2_000):
        world.run(1)
        answered += socket.recv(65_536).data.count(b"HTTP/1.1 200")
    assert answered == 100  # they were only late


def test_accepts_are_bounded() -> None:
    world = World()
    node = world.node("n", step=StepLimits(accepts=2))
    world.until(lambda: node.is_registered)
    before = len(node.core.loop.links)
    dialled = [world.peer().open("", 0).socket for _ in range(12)]
    address = world.subscribe_raw(node, topic="/rosout").peer
    assert address
    for socket in dialled:
        assert socket
        socket.connect(address)
    grown = []
    for _ in range(12):
        world.run(1)
        grown.append(len(node.core.loop.links))
    steps = [later - earlier for earlier, later in pairwise(grown)]
    assert max(steps) <= 2
    assert grown[-1] > before + 4


def test_two_hundred_connections_that_say_nothing() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/x", STRING)
    subscriber = world.node("l", OTHER_IP).register_subscriber("/x", STRING, queue_size=100)
    world.until(lambda: publisher.subscribers)
    sockets = [world.peer().open("", 0).socket for _ in range(200)]
    target = world.subscribe_raw(node).peer
    assert target
    for socket in sockets:
        assert socket
        socket.connect(target)
        world.run(1)
    assert len(node.core.loop.links) > 100
    for number in range(20):
        publisher.send(publisher.new(data=str(number)))
        world.run(20)
    assert words(subscriber.pop) == [str(number) for number in range(20)]
    world.run(33_000, step_ms=50)
    assert len(node.core.loop.links) < 10


def test_a_port_that_lost_its_socket_is_opened_again() -> None:
    world = World()
    node = world.node("n")
    publisher = node.register_publisher("/chatter", STRING)
    world.until(lambda: node.is_registered)
    node.topic_listener._socket.close()
    world.run(1_100)
    assert node.topic_listener.is_open
    header = {"callerid": "/raw", "topic": "/chatter", "md5sum": "*"}
    world.dial(PLC_IP, node.topic_listener.port, encode_header(header))
    world.until(lambda: publisher.subscribers, 50)
