"""Publisher and subscriber, joined without a network."""

import pytest

from crosnode.tcpros import (
    ANY,
    HeaderReceived,
    MessagesReceived,
    PublisherConnection,
    Refused,
    SubscriberConnection,
    TcprosLimits,
    TypeInfo,
)
from crosnode.tcpros.connection import TcprosConnection
from crosnode.tcpros.header import encode_header
from crosnode.tcpros.reader import LARGE
from crosnode.transport.connection import Closed, ConnectionState, Failed

STRING = TypeInfo("std_msgs/String", "992c", "string data\n")
LIMITS = TcprosLimits()


def pair(type_info: TypeInfo = STRING) -> tuple[PublisherConnection, SubscriberConnection]:
    subscriber = SubscriberConnection(
        "/chatter", type_info, "/listener", tcp_nodelay=True, limits=LIMITS, now_ns=0
    )
    return PublisherConnection(LIMITS, 0), subscriber


def carry(sender: TcprosConnection, receiver: TcprosConnection) -> None:
    for data in sender.data_to_send():
        receiver.receive_data(data)


def test_handshake_and_messages() -> None:
    publisher, subscriber = pair()
    carry(subscriber, publisher)
    event = publisher.next_event(0)
    assert isinstance(event, HeaderReceived)
    assert event.fields == {
        "callerid": "/listener",
        "md5sum": "992c",
        "message_definition": "string data\n",
        "tcp_nodelay": "1",
        "topic": "/chatter",
        "type": "std_msgs/String",
    }
    assert publisher.accept(STRING, "/talker", latching=True)
    carry(publisher, subscriber)
    assert subscriber.next_event(0) == HeaderReceived(
        {
            "callerid": "/talker",
            "latching": "1",
            "md5sum": "992c",
            "message_definition": "string data\n",
            "topic": "/chatter",
            "type": "std_msgs/String",
        }
    )
    for body in (b"\x01", b"", memoryview(b"abc")):
        publisher.send_messages([body])
    carry(publisher, subscriber)
    subscriber.most = 2
    events = [subscriber.next_event(0) for _ in range(3)]
    assert events == [MessagesReceived([b"\x01", b""]), MessagesReceived([b"abc"]), None]
    publisher.close()
    subscriber.receive_eof()
    assert subscriber.next_event(0) == Closed()
    assert subscriber.state is ConnectionState.CLOSED


def test_subscriber_of_any_type_learns_the_type() -> None:
    publisher, subscriber = pair(TypeInfo(ANY, ANY))
    carry(subscriber, publisher)
    publisher.next_event(0)
    assert publisher.accept(STRING, "/talker")
    carry(publisher, subscriber)
    event = subscriber.next_event(0)
    assert isinstance(event, HeaderReceived)
    assert event.fields["md5sum"] == "992c"
    assert event.fields["latching"] == "0"


def test_wrong_md5sum_is_refused_with_the_reason() -> None:
    publisher, subscriber = pair(TypeInfo("std_msgs/String", "0000"))
    carry(subscriber, publisher)
    publisher.next_event(0)
    assert not publisher.accept(STRING, "/talker")
    assert publisher.state is ConnectionState.CLOSED
    carry(publisher, subscriber)
    assert subscriber.next_event(0) == Refused("md5sum 0000 does not match 992c")
    assert subscriber.state is ConnectionState.CLOSED


@pytest.mark.parametrize("missing", ["callerid", "topic", "md5sum"])
def test_missing_fields_are_refused(missing: str) -> None:
    fields = {"callerid": "/l", "topic": "/chatter", "md5sum": ANY, "unknown": "field"}
    del fields[missing]
    publisher = PublisherConnection(LIMITS, 0)
    publisher.receive_data(encode_header(fields))
    publisher.next_event(0)
    assert not publisher.accept(STRING, "/talker")
    (answer,) = publisher.data_to_send()
    assert answer == encode_header({"error": f"missing required '{missing}' field"})


@pytest.mark.parametrize("type_name", [None, "other/Type", ANY])
def test_wrong_or_missing_type_is_accepted(type_name: str | None) -> None:
    fields = {"callerid": "/l", "topic": "/chatter", "md5sum": "992c"}
    publisher = PublisherConnection(LIMITS, 0)
    publisher.receive_data(encode_header(fields | ({"type": type_name} if type_name else {})))
    publisher.next_event(0)
    assert publisher.accept(STRING, "/talker")


def test_refuse_unknown_topic() -> None:
    publisher, subscriber = pair()
    carry(subscriber, publisher)
    publisher.next_event(0)
    publisher.refuse("/chatter is not published here")
    carry(publisher, subscriber)
    assert subscriber.next_event(0) == Refused("/chatter is not published here")


def test_broken_header_is_answered() -> None:
    publisher = PublisherConnection(LIMITS, 0)
    publisher.receive_data(b"\x04\0\0\0\0\0\0\0")
    assert publisher.next_event(0) == Failed("header field without '=' at byte 4")
    assert publisher.data_to_send() == [
        encode_header({"error": "header field without '=' at byte 4"})
    ]


def test_answer_with_another_md5sum() -> None:
    _, subscriber = pair()
    subscriber.receive_data(encode_header({"md5sum": "0000", "type": "x/Y"}))
    assert subscriber.next_event(0) == Failed("md5sum 0000 answers our 992c")


def test_answer_without_fields_is_taken() -> None:
    _, subscriber = pair()
    subscriber.receive_data(encode_header({}))
    assert subscriber.next_event(0) == HeaderReceived({})


def test_what_a_subscriber_sends_later_is_dropped() -> None:
    publisher, subscriber = pair()
    carry(subscriber, publisher)
    publisher.next_event(0)
    publisher.accept(STRING, "/talker")
    for _ in range(3):
        publisher.receive_data(bytes(100))
        assert publisher.next_event(0) is None
        assert publisher.wants_data
    publisher.receive_eof()
    assert publisher.next_event(0) == Closed()


def test_message_above_the_limit() -> None:
    _, subscriber = pair()
    subscriber.receive_data(encode_header({}) + b"\xff\xff\xff\xff")
    subscriber.next_event(0)
    assert subscriber.next_event(0) == Failed(
        "message of 4294967295 bytes, at most 67108864 are read"
    )


def test_no_deadline_between_messages() -> None:
    _, subscriber = pair()
    subscriber.receive_data(encode_header({}))
    subscriber.next_event(5)
    assert subscriber.deadline_ns is None


def test_small_messages_leave_in_one_piece_and_large_ones_as_they_are() -> None:
    publisher, subscriber = pair()
    carry(subscriber, publisher)
    publisher.next_event(0)
    publisher.accept(STRING, "/talker")
    publisher.data_to_send()
    large = bytes(LARGE)
    publisher.send_messages([b"a", b"", large, b"bc"])
    pieces = publisher.data_to_send()
    assert pieces == [
        b"\1\0\0\0a" + b"\0\0\0\0" + LARGE.to_bytes(4, "little"),
        large,
        b"\2\0\0\0bc",
    ]
    assert pieces[1] is large
