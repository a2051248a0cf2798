"""Provider and caller of a service, joined without a network."""

import pytest

from crosnode.tcpros import (
    ANY,
    HeaderReceived,
    Refused,
    ReplyReceived,
    RequestReceived,
    ServiceClientConnection,
    ServiceServerConnection,
    TcprosLimits,
    TypeInfo,
)
from crosnode.tcpros.connection import TcprosConnection
from crosnode.tcpros.header import encode_header
from crosnode.transport.connection import Closed, ConnectionState, Failed, Silent

TWO_INTS = TypeInfo("roscpp_tutorials/TwoInts", "6a2e")
LIMITS = TcprosLimits(timeout_ns=1000)


def carry(sender: TcprosConnection, receiver: TcprosConnection) -> None:
    for data in sender.data_to_send():
        receiver.receive_data(data)


def pair(
    *, persistent: bool = False, probe: bool = False, md5sum: str = "6a2e"
) -> tuple[ServiceServerConnection, ServiceClientConnection]:
    """Return both ends after the handshake."""
    client = ServiceClientConnection(
        "/add", TWO_INTS._replace(md5sum=md5sum), "/caller",
        persistent=persistent, probe=probe, limits=LIMITS, now_ns=0,
    )  # fmt: skip
    server = ServiceServerConnection(LIMITS, 0)
    carry(client, server)
    assert isinstance(server.next_event(0), HeaderReceived)
    server.accept(TWO_INTS, "/provider")
    carry(server, client)
    return server, client


def call(server: ServiceServerConnection, client: ServiceClientConnection, body: bytes) -> None:
    client.send_request(body, 0)
    carry(client, server)
    assert server.next_event(0) == RequestReceived(body)


def test_one_call() -> None:
    server, client = pair()
    assert client.next_event(0) == HeaderReceived(
        {
            "callerid": "/provider",
            "md5sum": "6a2e",
            "request_type": "roscpp_tutorials/TwoIntsRequest",
            "response_type": "roscpp_tutorials/TwoIntsResponse",
            "type": "roscpp_tutorials/TwoInts",
        }
    )
    call(server, client, b"request")
    server.send_response(b"response")
    assert server.state is ConnectionState.CLOSED
    carry(server, client)
    assert client.next_event(0) == ReplyReceived(ok=True, body=b"response")
    assert client.state is ConnectionState.CLOSED


def test_persistent_calls_with_empty_bodies_and_an_error() -> None:
    server, client = pair(persistent=True)
    client.next_event(0)
    for body in (b"", b"x"):
        call(server, client, body)
        server.send_response(body)
        carry(server, client)
        assert client.next_event(0) == ReplyReceived(ok=True, body=body)
    call(server, client, b"bad")
    server.send_error("division by zero")
    carry(server, client)
    assert client.next_event(0) == ReplyReceived(ok=False, body=b"division by zero")
    call(server, client, b"again")
    client.close()
    server.receive_eof()
    assert server.next_event(0) is None
    server.send_response(b"")
    assert server.next_event(0) == Closed()


def test_error_ends_a_single_call() -> None:
    server, client = pair()
    client.next_event(0)
    call(server, client, b"")
    server.send_error("")
    assert server.state is ConnectionState.CLOSED
    assert server.data_to_send() == [b"\0\0\0\0\0", b""]


def test_probe() -> None:
    server, client = pair(probe=True, md5sum=ANY)
    assert server.state is ConnectionState.CLOSED
    event = client.next_event(0)
    assert isinstance(event, HeaderReceived)
    assert event.fields["type"] == "roscpp_tutorials/TwoInts"
    assert client.state is ConnectionState.CLOSED


def test_wrong_md5sum() -> None:
    server, client = pair(md5sum="0000")
    assert server.state is ConnectionState.CLOSED
    assert client.next_event(0) == Refused("md5sum 0000 does not match 6a2e")


@pytest.mark.parametrize("missing", ["callerid", "service", "md5sum"])
def test_missing_fields_are_refused(missing: str) -> None:
    fields = {"callerid": "/c", "service": "/add", "md5sum": ANY}
    del fields[missing]
    server = ServiceServerConnection(LIMITS, 0)
    server.receive_data(encode_header(fields))
    server.next_event(0)
    assert not server.accept(TWO_INTS, "/provider")
    assert server.data_to_send() == [
        encode_header({"error": f"missing required '{missing}' field"})
    ]


@pytest.mark.parametrize(
    ("value", "persistent"),
    [("1", True), ("true", True), ("True", True), ("0", False), ("", False)],
)
def test_words_for_persistent(value: str, persistent: bool) -> None:
    server = ServiceServerConnection(LIMITS, 0)
    fields = {"callerid": "/c", "service": "/add", "md5sum": "*", "persistent": value}
    server.receive_data(encode_header(fields))
    server.next_event(0)
    assert server.is_persistent is persistent


def test_requests_wait_for_the_reply_before_them() -> None:
    server, client = pair(persistent=True)
    client.next_event(0)
    server.receive_data(b"\x01\0\0\0a\x01\0\0\0b")
    assert server.next_event(0) == RequestReceived(b"a")
    assert server.next_event(0) is None
    assert not server.wants_data
    server.send_response(b"")
    assert server.next_event(0) == RequestReceived(b"b")


def test_reply_without_a_request() -> None:
    _, client = pair(persistent=True)
    client.next_event(0)
    client.receive_data(b"\x01\0\0\0\0")
    assert client.next_event(0) == Failed("bytes without a request")


def test_server_closes_instead_of_a_reply() -> None:
    _, client = pair()
    client.next_event(0)
    client.send_request(b"", 0)
    client.receive_data(b"\x01\x05\0\0\0abc")
    client.receive_eof()
    assert client.next_event(0) == Failed("connection closed after 3 of 5 bytes")


def test_idle_server_closes() -> None:
    _, client = pair(persistent=True)
    client.next_event(0)
    client.receive_eof()
    assert client.next_event(0) == Closed()


def test_deadlines() -> None:
    server, client = pair()
    client.next_event(10)
    assert client.deadline_ns is None
    client.send_request(b"", 500)
    assert client.deadline_ns == 1500
    assert client.handle_timer(1500) == Silent("silent for 1000 ns")
    assert server.deadline_ns == 1000
    assert server.handle_timer(1000) == Silent("silent for 1000 ns")


def test_persistent_client_may_take_its_time() -> None:
    server, _ = pair(persistent=True)
    assert server.deadline_ns is None
    server.receive_data(b"\0\0\0\0")
    server.next_event(0)
    assert server.deadline_ns is None
