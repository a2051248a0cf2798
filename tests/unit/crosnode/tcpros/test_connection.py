"""What holds for all four roles: any split of any bytes, limits, time, one table each."""

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import LocalProtocolError
from crosnode.tcpros import (
    HeaderReceived,
    MessagesReceived,
    PublisherConnection,
    ServiceClientConnection,
    ServiceServerConnection,
    SubscriberConnection,
    TcprosLimits,
    TypeInfo,
)
from crosnode.tcpros.connection import TcprosConnection
from crosnode.tcpros.header import encode_header
from crosnode.tcpros.reader import length_of
from crosnode.transport.connection import ConnectionEvent, ConnectionState, Failed, Silent, Trigger

STRING = TypeInfo("std_msgs/String", "992c", "string data\n")
LIMITS = TcprosLimits(max_header=300, max_message=50, timeout_ns=1000)


def publisher() -> TcprosConnection:
    return PublisherConnection(LIMITS, 0)


def subscriber() -> TcprosConnection:
    return SubscriberConnection("/t", STRING, "/n", tcp_nodelay=True, limits=LIMITS, now_ns=0)


def server() -> TcprosConnection:
    return ServiceServerConnection(LIMITS, 0)


def client() -> TcprosConnection:
    connection = ServiceClientConnection("/s", STRING, "/n", limits=LIMITS, now_ns=0)
    connection.data_to_send()
    return connection


ROLES = [publisher, subscriber, server, client]
roles = pytest.mark.parametrize("role", ROLES)


def events_of(connection: TcprosConnection) -> list[ConnectionEvent]:
    """Take all events, and answer them as an owner does."""
    events: list[ConnectionEvent] = []
    while event := connection.next_event(0):
        events.append(event)
        if connection.state is ConnectionState.DECISION:
            assert isinstance(connection, (PublisherConnection, ServiceServerConnection))
            connection.accept(STRING, "/us")
        elif connection.state is ConnectionState.IDLE:
            assert isinstance(connection, ServiceClientConnection)
            connection.send_request(b"", 0)
        elif connection.state is ConnectionState.REPLY and isinstance(
            connection, ServiceServerConnection
        ):
            connection.send_response(b"")
    return events


def fed(
    connection: TcprosConnection, pieces: list[bytes]
) -> tuple[list[ConnectionEvent], ConnectionState, bytes]:
    events: list[ConnectionEvent] = []
    for piece in pieces:
        connection.receive_data(piece)
        events += events_of(connection)
    connection.receive_eof()
    events += events_of(connection)
    return events, connection.state, b"".join(connection.data_to_send())


HEADER = encode_header(
    {
        "callerid": "/n",
        "topic": "/t",
        "service": "/s",
        "md5sum": "992c",
        "persistent": "1",
        "x": "y",
    }
)
BLOCKS = st.lists(
    st.one_of(
        st.just(HEADER),
        st.just(encode_header({"error": "no"})),
        st.binary(max_size=60).map(lambda body: length_of(body) + body),
        st.binary(max_size=60).map(lambda body: b"\x01" + length_of(body) + body),
        st.binary(max_size=5),
    ),
    max_size=4,
).map(b"".join)
STREAMS = st.tuples(st.sampled_from([b"", HEADER]), BLOCKS).map(b"".join)


@given(st.sampled_from(ROLES), STREAMS, st.data())
def test_any_split_gives_the_same_events(
    role: Callable[[], TcprosConnection], stream: bytes, data: st.DataObject
) -> None:
    cuts = sorted(data.draw(st.sets(st.integers(0, len(stream)), max_size=5)))
    pieces = [stream[a:b] for a, b in zip([0, *cuts], [*cuts, len(stream)], strict=True)]
    whole = fed(role(), [stream])
    assert fed(role(), pieces) == whole
    assert fed(role(), [stream[i : i + 1] for i in range(len(stream))]) == whole
    assert whole[1] in (ConnectionState.CLOSED, ConnectionState.DECISION)


@roles
def test_silent_peer(role: Callable[[], TcprosConnection]) -> None:
    connection = role()
    assert connection.deadline_ns == 1000
    assert connection.handle_timer(999) is None
    assert connection.handle_timer(1000) == Silent("silent for 1000 ns")
    assert connection.state is ConnectionState.CLOSED
    assert connection.handle_timer(9999) is None


@roles
def test_header_above_the_limit(role: Callable[[], TcprosConnection]) -> None:
    connection = role()
    connection.receive_data(b"\0\0\x10\0" + bytes(400))
    assert connection.next_event(0) == Failed("header of 1048576 bytes, at most 300 are read")
    assert connection.state is ConnectionState.CLOSED


@roles
def test_closed_connection_takes_nothing(role: Callable[[], TcprosConnection]) -> None:
    connection = role()
    connection.close()
    connection.receive_data(HEADER)
    assert connection.next_event(0) is None
    assert not connection.wants_data
    connection.close()


@roles
def test_reading_waits_until_events_are_taken(role: Callable[[], TcprosConnection]) -> None:
    connection = role()
    assert connection.wants_data
    connection.receive_data(HEADER + bytes(2))  # and the begin of what follows it
    assert not connection.wants_data
    assert isinstance(connection.next_event(0), HeaderReceived)
    assert not connection.wants_data


def test_where_nothing_is_left_reading_goes_on_without_a_look_for_another_event() -> None:
    connection = subscriber()
    connection.receive_data(HEADER)
    assert isinstance(connection.next_event(0), HeaderReceived)
    assert connection.wants_data
    connection.receive_data(length_of(b"a") + b"a" + length_of(b"b"))
    assert connection.next_event(0) == MessagesReceived([b"a"])
    assert not connection.wants_data
    assert connection.next_event(0) is None
    connection.receive_data(b"b")
    assert not connection.wants_data
    assert connection.next_event(0) == MessagesReceived([b"b"])
    assert connection.wants_data


@pytest.mark.parametrize(
    "act",
    [
        lambda: publisher().send_messages([b""]),  # type: ignore[attr-defined]
        lambda: publisher().accept(STRING, "/us"),  # type: ignore[attr-defined]
        lambda: server().send_response(b""),  # type: ignore[attr-defined]
        lambda: server().refuse("no"),  # type: ignore[attr-defined]
        lambda: client().send_request(b"", 0),  # type: ignore[attr-defined]
    ],
)
def test_out_of_turn(act: Callable[[], object]) -> None:
    with pytest.raises(LocalProtocolError, match="in state HANDSHAKE"):
        act()


@roles
def test_table_is_closed_and_every_state_is_reached(role: Callable[[], TcprosConnection]) -> None:
    table = role().TABLE
    reached = {ConnectionState.HANDSHAKE} | {
        state for row in table.values() for state in row.values()
    }
    assert reached == set(table)
    assert table[ConnectionState.CLOSED] == {}
    for state, row in table.items():
        assert state is ConnectionState.CLOSED or row[Trigger.END] is ConnectionState.CLOSED
