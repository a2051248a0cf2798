"""Calls and answers over HTTP, whole and in pieces."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import LocalProtocolError, MessageValueError
from crosnode.transport.budget import ALONE_WORK, ANSWER_WORK, COLD_PART_WORK, PART_WORK
from crosnode.transport.connection import (
    Closed,
    ConnectionEvent,
    ConnectionState,
    Failed,
    Progress,
    Silent,
    Trigger,
)
from crosnode.xmlrpc import (
    CallReceived,
    FaultReceived,
    LastUse,
    ResponseReceived,
    ValueLimits,
    XmlRpcClientConnection,
    XmlRpcConnection,
    XmlRpcLimits,
    XmlRpcServerConnection,
)
from crosnode.xmlrpc.connection import CLIENT, PARSE_ERROR, SERVER, WARM_NS
from crosnode.xmlrpc.writer import AT_ONCE, dump_call

LIMITS = XmlRpcLimits(values=ValueLimits(max_size=2000), max_head=1000, timeout_ns=1000)


def server() -> XmlRpcServerConnection:
    return XmlRpcServerConnection(LIMITS, 0)


def client() -> XmlRpcClientConnection:
    return XmlRpcClientConnection("host:11311", LIMITS, 0)


def event_of(connection: XmlRpcConnection, now_ns: int) -> ConnectionEvent | None:
    """Return the next event that an owner is told."""
    while (event := connection.next_event(now_ns)) == Progress():
        pass
    return event


def sent(connection: XmlRpcConnection) -> bytes:
    return b"".join(connection.data_to_send())


def request(body: bytes, *headers: str, version: str = "1.1") -> bytes:
    head = [f"POST / HTTP/{version}", "Host: h:1", f"Content-length: {len(body)}", *headers]
    return "\r\n".join(head).encode() + b"\r\n\r\n" + body


GET_PID = dump_call("getPid", ["/n"])


def test_two_calls_on_one_connection() -> None:
    ours, theirs = client(), server()
    for value in ([1, "", 42], "x"):
        ours.call("getPid", ["/n"], 0)
        theirs.receive_data(sent(ours))
        assert event_of(theirs, 0) == CallReceived("getPid", ["/n"])
        assert event_of(theirs, 0) is None
        theirs.respond(value)
        ours.receive_data(sent(theirs))
        assert event_of(ours, 0) == ResponseReceived(value)
        assert (ours.state, theirs.state) == (ConnectionState.IDLE, ConnectionState.REQUEST)
    ours.close()
    theirs.receive_eof()
    assert event_of(theirs, 0) == Closed()


def test_fault() -> None:
    ours, theirs = client(), server()
    ours.call("nonsense", [], 0)
    theirs.receive_data(sent(ours))
    event_of(theirs, 0)
    theirs.fault(1, "no such method")
    ours.receive_data(sent(theirs))
    assert event_of(ours, 0) == FaultReceived(1, "no such method")


@pytest.mark.parametrize(
    "data",
    [
        request(GET_PID),
        request(GET_PID, version="1.0"),
        request(GET_PID, "User-Agent: XMLRPC++ 0.7", "Content-Type: text/xml"),
        request(GET_PID).replace(b"length: ", b"length:"),
        request(GET_PID).replace(b"length: ", b"length: 00000"),
        request(b"", "Transfer-Encoding: chunked").replace(b"Content-length: 0\r\n", b"")
        + b"%x\r\n%s\r\n0\r\n\r\n" % (len(GET_PID), GET_PID),
    ],
)
def test_requests_of_many_clients(data: bytes) -> None:
    for size in (1, 10**6):
        theirs, events = server(), []
        for start in range(0, len(data), size):
            theirs.receive_data(data[start : start + size])
            events.append(event_of(theirs, 0))
        assert [event for event in events if event] == [CallReceived("getPid", ["/n"])]


def test_http_1_0_ends_after_one_call() -> None:
    theirs = server()
    theirs.receive_data(request(GET_PID, version="1.0"))
    event_of(theirs, 0)
    theirs.respond(1)
    assert theirs.state is ConnectionState.CLOSED
    assert b"Connection: close" in sent(theirs)


def test_answer_of_roscpp() -> None:
    ours = client()
    ours.call("getPid", ["/n"], 0)
    body = b"<?xml version='1.0'?><methodResponse><params><param>\r\n\t<value>x</value>\r\n</param>"
    body += b"</params></methodResponse>\r\n"
    ours.receive_data(
        b"HTTP/1.1 200 OK\r\nServer: XMLRPC++ 0.7\r\nContent-Type: text/xml\r\n"
        b"Content-length: %d\r\n\r\n%s" % (len(body), body)
    )
    assert event_of(ours, 0) == ResponseReceived("x")


def test_answer_that_ends_with_the_connection() -> None:
    ours = client()
    ours.call("m", [], 0)
    theirs = server()
    theirs.receive_data(request(GET_PID))
    event_of(theirs, 0)
    theirs.respond([1])
    body = sent(theirs).partition(b"\r\n\r\n")[2]
    ours.receive_data(b"HTTP/1.0 200 OK\r\n\r\n" + body)
    assert event_of(ours, 0) is None
    ours.receive_eof()
    assert event_of(ours, 0) == ResponseReceived([1])
    assert ours.state is ConnectionState.CLOSED


def test_pipelined_calls_wait_for_the_answer_before_them() -> None:
    theirs = server()
    theirs.receive_data(request(dump_call("a", [])) + request(dump_call("b", [])))
    assert event_of(theirs, 0) == CallReceived("a", [])
    assert event_of(theirs, 0) is None
    assert not theirs.wants_data
    theirs.respond(1)
    assert event_of(theirs, 0) == CallReceived("b", [])


def test_client_that_waits_for_100() -> None:
    theirs = server()
    head, _, body = request(GET_PID, "Expect: 100-continue").partition(b"\r\n\r\n")
    theirs.receive_data(head + b"\r\n\r\n")
    assert event_of(theirs, 0) is None
    assert sent(theirs).startswith(b"HTTP/1.1 100 ")
    theirs.receive_data(body)
    assert event_of(theirs, 0) == CallReceived("getPid", ["/n"])


@pytest.mark.parametrize(
    ("data", "status", "reason"),
    [
        (b"\x16\x03\x01\0\xa5\x01\0\0\r\n\r\n", b"400", "not HTTP"),
        (b"GET / HTTP/1.1\r\nHost: h\r\n\r\n", b"405", "only POST"),
        (b"x" * 2000, b"431", "not HTTP"),
        (request(b"<methodCall>"), b"200", "not an XML-RPC document"),
        (request(b""), b"200", "not an XML-RPC document"),
        (request(b"<!DOCTYPE x><x/>"), b"200", "document type"),
        (request(b" " * 3000), b"200", "more than 2000 bytes"),
        (request(b"<methodResponse><params><param><value/></param></params></methodResponse>"),
         b"200", "a reply, where a call was expected"),
    ],
)  # fmt: skip
def test_refused_with_the_reason(data: bytes, status: bytes, reason: str) -> None:
    theirs = server()
    theirs.receive_data(data)
    event = event_of(theirs, 0)
    assert isinstance(event, Failed)
    assert reason in event.reason
    assert theirs.state is ConnectionState.CLOSED
    answer = sent(theirs)
    assert answer.startswith(b"HTTP/1.1 " + status)
    assert str(PARSE_ERROR).encode() in answer
    assert b"Connection: close" in answer


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n", "HTTP status 404"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 0\r\n\r\n", "not an XML-RPC document"),
        (b"SSH-2.0-OpenSSH\r\n\r\n", "not HTTP"),
        (b"HTTP/1.1 200 OK\r\n\r\n" + GET_PID, "a call, where a reply was expected"),
        (b"", "not HTTP"),
    ],
)
def test_bad_answers(data: bytes, reason: str) -> None:
    ours = client()
    ours.call("m", [], 0)
    ours.receive_data(data)
    event = event_of(ours, 0)
    if event is None:
        ours.receive_eof()
        event = event_of(ours, 0)
    assert isinstance(event, Failed)
    assert reason in event.reason
    assert ours.state is ConnectionState.CLOSED


def test_server_that_closes_between_calls() -> None:
    ours = client()
    ours.receive_eof()
    assert event_of(ours, 0) == Closed()


def test_deadlines() -> None:
    theirs = server()
    assert theirs.deadline_ns == 1000
    theirs.receive_data(request(GET_PID))
    event_of(theirs, 5)
    assert theirs.deadline_ns is None
    theirs.respond(1)
    assert event_of(theirs, 50) is None
    assert theirs.idle_since_ns == 5
    assert theirs.deadline_ns == 5 + LIMITS.idle_ns
    theirs.receive_data(b"P")
    event_of(theirs, 5000)
    assert theirs.deadline_ns == 6000
    theirs.receive_data(b"OST")
    event_of(theirs, 5500)
    assert theirs.handle_timer(6000) == Silent("silent for 1000 ns")
    ours = client()
    assert ours.deadline_ns is None
    assert ours.idle_since_ns is None
    ours.call("m", [], 70)
    assert ours.deadline_ns == 1070


def test_a_caller_that_is_idle_for_too_long_just_ends() -> None:
    theirs = server()
    theirs.receive_data(request(GET_PID))
    event_of(theirs, 5)
    theirs.respond(1)
    assert event_of(theirs, 6) is None
    assert theirs.handle_timer(4 + LIMITS.idle_ns) is None
    assert theirs.state is ConnectionState.REQUEST
    assert theirs.handle_timer(5 + LIMITS.idle_ns) is None
    assert theirs.state is ConnectionState.CLOSED


def test_out_of_turn() -> None:
    with pytest.raises(LocalProtocolError):
        server().respond(1)
    ours = client()
    ours.call("m", [], 0)
    with pytest.raises(LocalProtocolError):
        ours.call("m", [], 0)


def test_value_that_cannot_be_sent() -> None:
    theirs = server()
    theirs.receive_data(request(GET_PID))
    event_of(theirs, 0)
    with pytest.raises(MessageValueError):
        theirs.respond(None)
    theirs.fault(0, "unmarshallable")
    assert b"unmarshallable" in sent(theirs)


STREAM = (
    request(GET_PID) + request(dump_call("a", [{"b": [1, 2.5, "é"]}])) + request(b"<methodCall>")
)


def events_of(pieces: list[bytes]) -> tuple[list[ConnectionEvent], bytes]:
    theirs, events = server(), []
    for piece in pieces:
        theirs.receive_data(piece)
        while event := event_of(theirs, 0):
            events.append(event)
            if theirs.state is ConnectionState.REPLY:
                theirs.respond(len(events))
    return events, sent(theirs)


@given(st.sets(st.integers(0, len(STREAM)), max_size=6))
def test_any_split_gives_the_same_events(cuts: set[int]) -> None:
    edges = [0, *sorted(cuts), len(STREAM)]
    pieces = [STREAM[a:b] for a, b in pairwise(edges)]
    whole = events_of([STREAM])
    assert len(whole[0]) == 3
    assert events_of(pieces)[0] == whole[0]


@given(
    st.lists(st.binary(max_size=40) | st.sampled_from([request(GET_PID), b"POST / HTTP/1.1\r\n"]))
)
def test_any_bytes(pieces: list[bytes]) -> None:
    for connection in (server(), client()):
        if isinstance(connection, XmlRpcClientConnection):
            connection.call("m", [], 0)
        for piece in pieces:
            connection.receive_data(piece)
            connection.next_event(0)
            if (
                isinstance(connection, XmlRpcServerConnection)
                and connection.state is ConnectionState.REPLY
            ):
                connection.respond("")
        assert connection.state in connection.TABLE


@pytest.mark.parametrize("table", [SERVER, CLIENT])
def test_every_state_can_end(table: dict[ConnectionState, dict[Trigger, ConnectionState]]) -> None:
    assert table[ConnectionState.CLOSED] == {}
    assert all(
        state is ConnectionState.CLOSED or Trigger.END in row for state, row in table.items()
    )


def long_pair() -> tuple[XmlRpcClientConnection, XmlRpcServerConnection]:
    limits = XmlRpcLimits(timeout_ns=1000)
    return XmlRpcClientConnection("h:1", limits, 0), XmlRpcServerConnection(limits, 0)


def progress(connection: XmlRpcConnection, now_ns: int = 0) -> int:
    """Take Progress as long as it comes; return how often."""
    count = 0
    while connection.next_event(now_ns) == Progress():
        count += 1
    return count


def test_a_long_answer_is_written_and_read_a_part_at_a_time() -> None:
    ours, theirs = long_pair()
    value = [[number, str(number)] for number in range(500)]
    ours.call("m", [], 0)
    theirs.receive_data(sent(ours))
    event_of(theirs, 0)
    theirs.respond(value)
    assert sent(theirs) == b""
    assert not theirs.wants_data
    assert progress(theirs) == 500 * 4 // AT_ONCE
    answer = sent(theirs)
    ours.receive_data(answer)
    turns = 0
    while (event := ours.next_event(900 * turns)) == Progress():
        turns += 1
        assert ours.handle_timer(900 * turns) is None  # what comes is no silence
    assert event == ResponseReceived(value)
    assert turns > 50
    ours.call("m", [], 0)
    theirs.receive_data(sent(ours))
    assert event_of(theirs, 0) == CallReceived("m", [])


def test_a_long_call_is_read_a_part_at_a_time() -> None:
    ours, theirs = long_pair()
    value = {f"key{number}": number for number in range(500)}
    ours.call("setParam", ["/n", "/x", value], 0)
    theirs.receive_data(sent(ours))
    parts = []
    while (event := theirs.next_event(0)) == Progress():
        parts.append(event)
    assert event == CallReceived("setParam", ["/n", "/x", value])
    assert len(parts) > 10


def test_what_cannot_be_sent_is_a_fault_where_it_comes_late() -> None:
    ours, theirs = long_pair()
    ours.call("m", [], 0)
    theirs.receive_data(sent(ours))
    event_of(theirs, 0)
    theirs.respond([*range(500), None])
    with pytest.raises(LocalProtocolError):
        theirs.respond(1)
    progress(theirs)
    ours.receive_data(sent(theirs))
    fault = event_of(ours, 0)
    assert isinstance(fault, FaultReceived)
    assert "NoneType" in fault.text


def test_an_end_while_a_long_answer_is_written() -> None:
    ours, theirs = long_pair()
    ours.call("m", [], 0)
    theirs.receive_data(sent(ours))
    event_of(theirs, 0)
    theirs.respond(list(range(1_000)))
    theirs.close()
    assert event_of(theirs, 0) is None
    assert sent(theirs) == b""


def test_a_caller_that_names_no_host_is_served_again_and_again() -> None:
    theirs = server()
    bare = request(GET_PID).replace(b"Host: h:1\r\n", b"")
    assert b"Host" not in bare
    for _ in range(3):
        theirs.receive_data(bare)
        assert event_of(theirs, 0) == CallReceived("getPid", ["/n"])
        theirs.respond(1)
        assert sent(theirs).startswith(b"HTTP/1.1 200")


def test_a_document_is_taken_in_three_parts() -> None:
    ours, theirs = client_and_server_in_time()
    parts = 2  # and what follows of it
    for now_ns in (0, WARM_NS, 3 * WARM_NS, 3 * WARM_NS + 1):
        ours.call("getPid", ["/n"], now_ns)
        theirs.receive_data(sent(ours))
        assert progress_then(theirs, now_ns) == (parts, CallReceived("getPid", ["/n"]))
        theirs.respond(42)
        ours.receive_data(sent(theirs))
        for _ in range(parts):
            assert ours.next_event(now_ns) == Progress()
            assert not ours.wants_data  # the rest is there
        assert ours.next_event(now_ns) == ResponseReceived(42)


def test_a_document_in_parts_that_comes_byte_by_byte() -> None:
    last_use = LastUse()
    last_use.note(0)
    theirs = XmlRpcServerConnection(XmlRpcLimits(), 0, last_use)
    events = []
    for byte in request(GET_PID):
        theirs.receive_data(bytes([byte]))
        while (event := theirs.next_event(2 * WARM_NS)) is not None:
            events.append(event)
    assert [event for event in events if event != Progress()] == [CallReceived("getPid", ["/n"])]


def test_connections_that_share_their_last_use_warm_each_other() -> None:
    last_use = LastUse()
    cold, warm = (COLD_PART_WORK, ALONE_WORK), (PART_WORK, PART_WORK)
    for now_ns, prices in ((0, cold), (2 * WARM_NS, cold), (2 * WARM_NS + 1, warm)):
        theirs = XmlRpcServerConnection(XmlRpcLimits(), now_ns, last_use)
        theirs.receive_data(request(GET_PID))
        for price in prices:
            assert theirs.event_price(now_ns) == price
            assert theirs.next_event(now_ns) == Progress()
        assert theirs.event_price(now_ns) == ANSWER_WORK
        assert theirs.next_event(now_ns) == CallReceived("getPid", ["/n"])


def client_and_server_in_time() -> tuple[XmlRpcClientConnection, XmlRpcServerConnection]:
    limits = XmlRpcLimits()
    return XmlRpcClientConnection("h:1", limits, 0), XmlRpcServerConnection(limits, 0)


def progress_then(connection: XmlRpcConnection, now_ns: int) -> tuple[int, ConnectionEvent | None]:
    """Take Progress as long as it comes; return how often, and the event that follows."""
    count = 0
    while (event := connection.next_event(now_ns)) == Progress():
        count += 1
    return count, event
