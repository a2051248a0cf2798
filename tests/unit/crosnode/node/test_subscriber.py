"""Subscribers: publishers that come, go, return, refuse and misbehave."""

import struct
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from crosnode.node import CrosNode, StatusKind, Subscriber
from crosnode.node.publisher_link import PublisherState
from crosnode.node.subscriber import MAX_PUBLISHERS
from crosnode.tcpros import TcprosLimits
from crosnode.tcpros.header import encode_header
from plcsim.network import Outcome, Socket

from .world import MS, OTHER_IP, PEER_IP, PLC_IP, STRING, STRING_MD5, World, drain, news, words

PORT = 6000


class RawPublisher:
    """A publisher that speaks bytes; the subscriber is led to it by an answer of its own."""

    def __init__(self, world: World, subscriber: Subscriber) -> None:
        self.world = world
        self.subscriber = subscriber
        opened = world.peer().open("", PORT, reuse_address=True).socket
        assert opened is not None
        self.listener = opened
        self.listener.listen(5)
        self.socket: Socket | None = None
        uri = f"http://{PEER_IP}:5999/"
        subscriber.update([uri])
        self.link = subscriber.peers[uri]
        self.lead()

    def lead(self) -> None:
        self.link.state = PublisherState.LOCATED
        self.link._address = self.subscriber.core.hosts.address(f"http://{PEER_IP}:{PORT}/", "http")

    def accept(self) -> "RawPublisher":
        self.world.until(self._take, 300)
        return self

    def _take(self) -> bool:
        accepted = self.listener.accept()
        self.socket = accepted.socket
        return accepted.outcome is Outcome.OK

    def greet(self, **fields: str) -> "RawPublisher":
        answer = {"callerid": "/raw", "md5sum": STRING_MD5, "type": STRING, "latching": "0"}
        self.send(encode_header(answer | fields))
        return self

    def send(self, data: bytes) -> None:
        assert self.socket
        self.world.send(self.socket, data)


def frame(body: bytes) -> bytes:
    return struct.pack("<I", len(body)) + body


def text(word: str) -> bytes:
    return frame(frame(word.encode()))


def raw(**options: Any) -> tuple[World, CrosNode, Subscriber, RawPublisher]:
    world = World()
    node = world.node("listener", **options)
    subscriber = node.register_subscriber("/chatter", STRING)
    world.until(lambda: node.is_registered)
    return world, node, subscriber, RawPublisher(world, subscriber).accept()


def test_publishers_that_come_and_go_are_added_and_removed() -> None:
    world = World()
    subscriber = world.node("listener").register_subscriber("/x", STRING)
    one, two = world.node("one", OTHER_IP), world.node("two", "192.168.0.21")
    first, second = one.register_publisher("/x", STRING), two.register_publisher("/x", STRING)
    world.until(lambda: subscriber.publishers == 2)
    one.unregister(first)
    world.until(lambda: list(subscriber.peers) == [two.uri])
    one.register_publisher("/x", STRING)
    world.until(lambda: subscriber.publishers == 2)
    second.send(second.new(data="two"))
    world.run(5)
    assert words(subscriber.pop) == ["two"]


def test_a_publisher_whose_host_has_gone_without_a_word_is_noticed_within_half_a_minute() -> None:
    world = World()
    node = world.node("listener")
    subscriber = node.register_subscriber("/x", STRING)
    world.node("talker", OTHER_IP).register_publisher("/x", STRING)
    world.until(lambda: subscriber.publishers)
    drain(node.pop_status)
    world.faults.silence(OTHER_IP)
    world.run(29_000, step_ms=10)
    assert subscriber.publishers == 1
    world.run(6_000, step_ms=10)
    assert subscriber.publishers == 0
    assert len(news(node, StatusKind.DISCONNECTED)) == 1


def test_a_quiet_publisher_that_is_there_stays() -> None:
    world = World()
    node = world.node("listener")
    subscriber = node.register_subscriber("/x", STRING)
    publisher = world.node("talker", OTHER_IP).register_publisher("/x", STRING)
    world.until(lambda: subscriber.publishers)
    world.run(120_000, step_ms=50)
    assert (publisher.subscribers, subscriber.publishers) == (1, 1)
    assert not news(node, StatusKind.DISCONNECTED)


def test_a_lost_connection_is_made_again_without_the_master() -> None:
    world = World()
    subscriber = world.node("listener").register_subscriber("/x", STRING)
    publisher = world.node("talker", OTHER_IP).register_publisher("/x", STRING)
    world.until(lambda: publisher.subscribers)
    world.kill_master()
    world.faults.reset(PLC_IP, OTHER_IP)
    world.until(lambda: publisher.subscribers == 0, 50)
    world.until(lambda: publisher.subscribers == 1, 500)
    publisher.send(publisher.new(data="again"))
    world.run(5)
    assert words(subscriber.pop) == ["again"]


def test_attempts_become_rarer() -> None:
    world = World()
    node = world.node("listener")
    subscriber = node.register_subscriber("/x", STRING)
    world.until(lambda: node.is_registered)
    world.peer()
    subscriber.update([f"http://{PEER_IP}:1/"])
    world.run(3_000)
    assert 4 <= len({e.source for e in world.net.trace if e.target.ip == PEER_IP}) <= 6


def test_an_update_that_overtakes_the_answer_to_the_registration_counts_as_well() -> None:
    world = World()
    node = world.node("listener")
    subscriber = node.register_subscriber("/x", STRING)
    world.run(1)
    subscriber.publisher_update(["http://10.0.0.1:5/"])
    subscriber.registered(["http://10.0.0.2:5/"])
    assert list(subscriber.peers) == ["http://10.0.0.1:5/", "http://10.0.0.2:5/"]
    subscriber.registered([])
    assert subscriber.peers == {}


def test_messages_of_any_cut_arrive() -> None:
    world, _, subscriber, peer = raw()
    peer.greet()
    for byte in text("byte by byte"):
        peer.send(bytes([byte]))
    peer.send(text("one") + text("two") + text("thr")[:7])
    world.run(5)
    assert words(subscriber.pop) == ["byte by byte", "one", "two"]


def test_empty_messages_arrive() -> None:
    world = World()
    publisher = world.node("t").register_publisher("/e", "std_msgs/Empty")
    subscriber = world.node("l", OTHER_IP).register_subscriber("/e", "std_msgs/Empty")
    world.until(lambda: publisher.subscribers)
    publisher.send(publisher.new())
    publisher.send(publisher.new())
    world.run(5)
    assert subscriber.pop_raw() == b""
    assert subscriber.pop() == subscriber.message_type.new()
    assert subscriber.pop() is None


def test_an_error_of_the_publisher_is_told_to_the_program() -> None:
    world, node, _, peer = raw()
    peer.send(encode_header({"error": "I do not like you"}))
    world.run(5)
    assert news(node, StatusKind.PEER_REFUSED)[-1].text == "I do not like you"


def test_a_header_of_one_megabyte_ends_that_connection_only() -> None:
    world, node, subscriber, peer = raw()
    peer.send(struct.pack("<I", 1 << 20) + bytes(1000))
    world.run(5)
    assert "header of 1048576 bytes" in str(news(node, StatusKind.BAD_MESSAGE))
    assert subscriber.publishers == 0


def test_a_hostile_length_ends_that_connection_only() -> None:
    world, node, subscriber, peer = raw()
    publisher = world.node("good", OTHER_IP).register_publisher("/chatter", STRING)
    peer.greet()
    peer.send(b"\xff\xff\xff\xff" + bytes(100))
    world.until(lambda: news(node, StatusKind.BAD_MESSAGE), 50)
    world.until(lambda: publisher.subscribers == 1)
    publisher.send(publisher.new(data="good"))
    world.run(5)
    assert words(subscriber.pop) == ["good"]


def test_a_body_that_is_no_message_is_passed_over_and_ends_its_connection() -> None:
    world, node, subscriber, peer = raw()
    peer.greet()
    peer.send(text("fine") + frame(b"\xff\xff\xff\xff") + text("lost"))
    world.run(5)
    assert subscriber.pop() is not None
    rest = words(subscriber.pop)
    assert rest in ([], ["lost"])
    assert subscriber.bad_messages == 1
    world.run(10)
    assert subscriber.publishers == 0
    assert "std_msgs/String" in str(news(node, StatusKind.BAD_MESSAGE))


def test_a_string_that_is_not_utf8_is_kept_and_can_be_sent_on() -> None:
    """A roscpp node may send any bytes; rospy keeps such messages, too."""
    world, node, subscriber, peer = raw()
    other = world.node("other", OTHER_IP).register_subscriber("/relay", STRING)
    relay = node.register_publisher("/relay", STRING)
    world.until(lambda: relay.subscribers)
    peer.greet()
    peer.send(frame(frame(b"gr\xfc\xdfe")) + text("next"))
    world.run(5)
    message = subscriber.pop()
    assert message is not None
    assert message.data == "gr\udcfc\udcdfe"
    assert words(subscriber.pop) == ["next"]
    assert (subscriber.publishers, subscriber.bad_messages) == (1, 0)
    relay.send(relay.new(data=message.data))
    world.run(5)
    assert other.pop_raw() == frame(b"gr\xfc\xdfe")


def test_a_publisher_that_says_nothing_is_given_up_and_tried_again() -> None:
    world, _, subscriber, peer = raw()
    world.run(9_900)
    assert subscriber.peers[peer.link.uri].link is not None
    world.run(200)
    assert subscriber.peers.get(peer.link.uri, peer.link).link is None


def test_the_queue_of_the_program_drops_the_oldest_and_counts() -> None:
    world, _, subscriber, peer = raw()
    peer.greet()
    peer.send(b"".join(text(str(number)) for number in range(25)))
    world.run(5)
    assert words(subscriber.pop) == [str(number) for number in range(15, 25)]
    assert subscriber.dropped == subscriber.queue.dropped == 15


def test_what_the_master_names_is_bounded_and_checked() -> None:
    world = World()
    node = world.node("listener")
    subscriber = node.register_subscriber("/x", STRING)
    world.until(lambda: node.is_registered)
    for wrong in (None, 3, "http://x", {"a": 1}, [1, None, [], {}]):
        subscriber.update(wrong)
        assert subscriber.peers == {}
    subscriber.update(["", "http://", "x" * 10, "http://unknown:1/", "rosrpc://1.2.3.4:5"])
    world.run(200)
    assert subscriber.publishers == 0
    subscriber.update([f"http://1.2.3.4:{port}/" for port in range(1, 3000)])
    assert len(subscriber.peers) == MAX_PUBLISHERS


@settings(max_examples=30, deadline=None)
@given(st.lists(st.text(max_size=40), min_size=1, max_size=8), st.data())
def test_any_split_of_the_stream_gives_the_same_messages(
    found: list[str], data: st.DataObject
) -> None:
    world, _, subscriber, peer = raw()
    answer = {"callerid": "/raw", "md5sum": STRING_MD5, "type": STRING}
    stream = encode_header(answer) + b"".join(text(word) for word in found)
    while stream:
        size = data.draw(st.integers(1, len(stream)))
        peer.send(stream[:size])
        stream = stream[size:]
    world.run(5)
    assert words(subscriber.pop) == found


@settings(max_examples=40, deadline=None)
@given(st.binary(max_size=300), st.booleans())
def test_any_bytes_end_at_most_their_own_connection(data: bytes, greeted: bool) -> None:
    world, node, subscriber, peer = raw()
    if greeted:
        peer.greet()
    assert peer.socket
    peer.socket.send(data)
    world.run(10)
    words(subscriber.pop)
    peer.socket.close()
    world.run(10)
    assert not node.is_shut_down
    assert node.is_registered
    assert world.now_ns > 10 * MS


def test_a_publisher_of_what_is_too_large_is_not_tried_several_times_a_second() -> None:
    world = World()
    node = world.node("listener", tcpros=TcprosLimits(max_message=1_000))
    subscriber = node.register_subscriber("/x", STRING)
    publisher = world.node("talker", OTHER_IP).register_publisher("/x", STRING)
    world.until(lambda: subscriber.publishers)
    for _ in range(2_000):
        publisher.send(publisher.new(data="x" * 2_000))
        world.run(10, step_ms=10)
    told = news(node, StatusKind.BAD_MESSAGE)
    assert [status.text for status in told] == ["message of 2004 bytes, at most 1000 are read"] * 2
    world.until(lambda: subscriber.publishers, 30_000)
    publisher.send(publisher.new(data="small"))
    world.run(20)
    assert words(subscriber.pop) == ["small"]
