"""Publishers: latching, queues, slow subscribers, periods, refusals on the wire."""

import pytest

from crosnode.errors import MessageValueError
from crosnode.node import StatusKind
from crosnode.tcpros.header import decode_header, encode_header

from .world import MS, OTHER_IP, PLC_IP, STRING, STRING_MD5, World, drain, news, words


def header_of(data: bytes) -> dict[str, str]:
    size = int.from_bytes(data[:4], "little")
    return decode_header(data[4 : 4 + size])


def test_a_latched_message_comes_to_who_subscribes_later() -> None:
    world = World()
    publisher = world.node("talker").register_publisher("/x", STRING, latching=True)
    publisher.send(publisher.new(data="early"))
    publisher.send(publisher.new(data="last"))
    subscriber = world.node("listener", OTHER_IP).register_subscriber("/x", STRING)
    world.until(lambda: subscriber.queue)
    assert words(subscriber.pop) == ["last"]


def test_without_latching_earlier_messages_are_gone() -> None:
    world = World()
    publisher = world.node("talker").register_publisher("/x", STRING)
    publisher.send(publisher.new(data="early"))
    subscriber = world.node("listener", OTHER_IP).register_subscriber("/x", STRING)
    world.until(lambda: publisher.subscribers)
    world.run(10)
    assert words(subscriber.pop) == []


@pytest.mark.parametrize("latching", [True, False])
def test_the_header_tells_the_truth_about_latching(latching: bool) -> None:
    world = World()
    node = world.node("talker")
    node.register_publisher("/chatter", STRING, latching=latching)
    fields = header_of(world.receive(world.subscribe_raw(node)))
    assert fields["latching"] == str(int(latching))
    assert fields["md5sum"] == STRING_MD5
    assert fields["type"] == STRING
    assert fields["callerid"] == "/talker"
    assert fields["message_definition"].strip() == "string data"


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"topic": "/nothing"}, "does not publish /nothing"),
        ({"md5sum": "0" * 32}, "does not match"),
    ],
)
def test_a_subscriber_that_does_not_fit_is_told_why(fields: dict[str, str], reason: str) -> None:
    world = World()
    node = world.node("talker")
    publisher = node.register_publisher("/chatter", STRING)
    answer = header_of(world.receive(world.subscribe_raw(node, **fields)))
    assert reason in answer["error"]
    assert publisher.subscribers == 0
    assert news(node, StatusKind.PEER_REFUSED)


def test_a_header_without_callerid_is_refused() -> None:
    world = World()
    node = world.node("talker")
    node.register_publisher("/chatter", STRING)
    data = encode_header({"topic": "/chatter", "md5sum": "*"})
    socket = world.dial(PLC_IP, node.topic_listener.port, data)
    assert "callerid" in header_of(world.receive(socket))["error"]


def test_unknown_fields_are_ignored_and_a_header_may_come_byte_by_byte() -> None:
    world = World()
    node = world.node("talker")
    publisher = node.register_publisher("/chatter", STRING)
    fields = {"callerid": "/raw", "topic": "/chatter", "md5sum": STRING_MD5, "type": STRING}
    header = encode_header(fields | {"nobody_knows": "this", "message_definition": "x" * 5000})
    socket = world.dial(PLC_IP, node.topic_listener.port)
    for place in range(60):
        world.send(socket, header[place : place + 1])
    assert publisher.subscribers == 0
    world.send(socket, header[60:])
    world.until(lambda: publisher.subscribers == 1, 50)


def test_when_one_subscriber_leaves_the_others_go_on() -> None:
    world = World()
    node = world.node("talker")
    publisher = node.register_publisher("/chatter", STRING)
    leaver = world.subscribe_raw(node)
    stayer = world.node("listener", OTHER_IP).register_subscriber("/chatter", STRING)
    world.until(lambda: publisher.subscribers == 2)
    leaver.close()
    world.until(lambda: publisher.subscribers == 1)
    for number in range(10):
        publisher.send(publisher.new(data=str(number)))
        world.run(2)
    assert words(stayer.pop) == [str(number) for number in range(10)]


def test_subscribers_may_come_and_go_often() -> None:
    world = World()
    node = world.node("talker")
    publisher = node.register_publisher("/chatter", STRING)
    for round_number in range(30):
        sockets = [world.subscribe_raw(node) for _ in range(3)]
        world.until(lambda: publisher.subscribers == 3, 50)
        publisher.send(publisher.new(data=str(round_number)))
        assert all(str(round_number).encode() in world.receive(s, 3) for s in sockets[:1])
        for socket in sockets:
            socket.close()
        world.until(lambda: publisher.subscribers == 0, 50)


def test_a_subscriber_that_does_not_read_holds_nobody() -> None:
    world = World()
    node = world.node("talker")
    publisher = node.register_publisher("/chatter", STRING, queue_size=5)
    world.subscribe_raw(node)
    reader = world.node("listener", OTHER_IP).register_subscriber("/chatter", STRING)
    world.until(lambda: publisher.subscribers == 2)
    got: list[str] = []
    for number in range(300):
        publisher.send(publisher.new(data=f"{number:04}" * 250))
        world.run(2)
        got += words(reader.pop)
    assert len(got) == 300
    deaf = min(publisher.links.values(), key=lambda owner: -owner.queue.dropped)
    assert deaf.queue.dropped > 100
    assert publisher.dropped == deaf.queue.dropped
    waiting = [link.waiting for link in publisher.links]
    assert max(waiting) < 200_000


def test_the_queue_drops_the_oldest() -> None:
    world = World()
    publisher = world.node("talker").register_publisher("/x", STRING, queue_size=3)
    subscriber = world.node("listener", OTHER_IP).register_subscriber("/x", STRING, queue_size=100)
    world.until(lambda: publisher.subscribers)
    world.run(10)  # until a step has its budget left
    for number in range(20):
        publisher.send(publisher.new(data=str(number)))
    world.run(5)
    heard = [int(word) for word in words(subscriber.pop)]
    assert heard[-3:] == [17, 18, 19]
    at_once = heard[:-3]  # within the budget of the step
    assert at_once == list(range(len(at_once)))
    assert 0 < len(at_once) < 17
    assert publisher.dropped == 17 - len(at_once)


def test_a_message_is_asked_for_once_a_period_and_missed_ones_are_not_caught_up() -> None:
    world = World()
    publisher = world.node("talker").register_publisher("/x", STRING, loop_period_ns=10 * MS)
    asked = []
    for tick in range(45):
        world.run(1)
        if publisher.pop() is not None:
            asked.append(tick)
    assert asked == [0, 10, 20, 30, 40]
    world.run(100)
    assert len(drain(publisher.pop)) == 1


def test_seq_is_counted_as_all_of_ros_does() -> None:
    world = World()
    publisher = world.node("t").register_publisher("/x", "geometry_msgs/PoseStamped")
    subscriber = world.node("l", OTHER_IP).register_subscriber("/x", "geometry_msgs/PoseStamped")
    world.until(lambda: publisher.subscribers)
    message = publisher.new()
    message.header.seq = 99  # type: ignore[attr-defined]
    publisher.send(message)
    publisher.send(message)
    world.run(5)
    assert [m.header.seq for m in drain(subscriber.pop)] == [0, 1]


def test_a_wrong_value_is_an_error_of_the_program_and_nothing_is_sent() -> None:
    world = World()
    publisher = world.node("talker").register_publisher("/x", STRING)
    with pytest.raises(MessageValueError, match="data"):
        publisher.send(publisher.new(data=3))
    assert publisher.sent == 0


def test_what_a_subscriber_sends_after_its_header_is_thrown_away() -> None:
    world = World()
    node = world.node("talker")
    publisher = node.register_publisher("/chatter", STRING)
    socket = world.subscribe_raw(node)
    world.send(socket, bytes(100_000))
    world.run(50)
    publisher.send(publisher.new(data="still here"))
    assert b"still here" in world.receive(socket)


def test_the_definition_in_the_header_holds_all_types_it_needs() -> None:
    world = World()
    node = world.node("talker")
    node.register_publisher("/chatter", "geometry_msgs/Twist")
    definition = header_of(world.receive(world.subscribe_raw(node)))["message_definition"]
    assert "MSG: geometry_msgs/Vector3" in definition
    assert definition.count("=" * 80) == 1


@pytest.mark.parametrize("linger", [None, 0])
def test_a_subscriber_may_leave_while_messages_wait_for_it(linger: int | None) -> None:
    world = World()
    node = world.node("talker")
    publisher = node.register_publisher("/chatter", STRING)
    for wait in range(20):
        socket = world.subscribe_raw(node)
        world.until(lambda: publisher.subscribers)
        for _ in range(wait):
            publisher.send(publisher.new(data="word"))
            world.run(1)
        socket.set_linger(linger)
        socket.close()
        while publisher.subscribers:
            publisher.send(publisher.new(data="word"))
            world.run(1)
    assert not node.is_shut_down


def test_unregistering_with_messages_in_the_queue_harms_nobody() -> None:
    world = World()
    node = world.node("talker")
    publisher = node.register_publisher("/chatter", STRING)
    world.subscribe_raw(node)
    world.until(lambda: publisher.subscribers)
    publisher.send(publisher.new(data="word"))
    node.unregister(publisher)
    world.run(20)
    assert publisher.subscribers == 0


def test_a_queue_of_no_length_is_an_error_when_it_is_registered() -> None:
    with pytest.raises(ValueError, match="above 0"):
        World().node("talker").register_publisher("/x", STRING, queue_size=0)
