"""The slave API over XML-RPC, as the command-line tools and hostile callers use it."""

import xmlrpc.client
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crosnode.graph.uri import parse_uri
from crosnode.node.slave_api import LARGEST

from .world import OTHER_IP, PLC_IP, STRING, World

METHODS = {
    "getBusStats": [], "getBusInfo": [], "getMasterUri": [], "getPid": [],
    "getSubscriptions": [], "getPublications": [],
    "publisherUpdate": ["/none", []], "paramUpdate": ["/none", 1],
    "requestTopic": ["/chatter", [["TCPROS"]]], "shutdown": ["why"],
}  # fmt: skip


class Caller:
    """Calls a node by bytes of its own."""

    def __init__(self) -> None:
        self.world = World()
        self.node = self.world.node("n")
        self.publisher = self.node.register_publisher("/chatter", STRING)
        self.world.until(lambda: self.node.is_registered)

    def post(self, document: bytes) -> bytes:
        head = b"POST /RPC2 HTTP/1.1\r\nHost: x\r\nContent-Length:%d\r\n\r\n" % len(document)
        return self.raw(head + document)

    def raw(self, data: bytes) -> bytes:
        socket = self.world.dial(PLC_IP, parse_uri(self.node.uri, "http").port, data)
        answer = self.world.receive(socket, 20)
        socket.close()
        return answer.partition(b"\r\n\r\n")[2]

    def call(self, method: str, *params: Any) -> Any:
        answer = self.post(xmlrpc.client.dumps(params, method).encode())
        return xmlrpc.client.loads(answer, use_builtin_types=True)[0][0]


@pytest.mark.parametrize("method", METHODS)
def test_every_method_answers_code_message_value(method: str) -> None:
    code, message, _ = Caller().call(method, "/caller", *METHODS[method])
    assert isinstance(code, int)
    assert isinstance(message, str)


@pytest.mark.parametrize("method", METHODS)
def test_missing_and_wrong_arguments_are_answered(method: str) -> None:
    caller = Caller()
    assert caller.call(method)[0] == -1
    if METHODS[method] and method != "shutdown":
        assert caller.call(method, "/caller")[0] == -1
        wrong: list[Any] = [{"a": 1}] * len(METHODS[method])
        assert caller.call(method, "/caller", *wrong)[0] == -1
    assert not caller.node.is_shut_down or method == "shutdown"


def test_bus_info_names_both_ends_and_the_topic() -> None:
    caller = Caller()
    node, world = caller.node, caller.world
    node.register_subscriber("/other", STRING)
    other = world.node("other", OTHER_IP)
    other.register_publisher("/other", STRING)
    other.register_subscriber("/chatter", STRING)
    world.until(lambda: caller.publisher.subscribers and node.subscribers["/other"].publishers)
    entries = {tuple(entry[1:6]) for entry in caller.call("getBusInfo", "/c")[2]}
    assert ("/other", "o", "TCPROS", "/chatter", True) in entries
    assert (other.uri, "i", "TCPROS", "/other", True) in entries
    published, subscribed, service = caller.call("getBusStats", "/c")[2]
    assert [p[0] for p in published] == ["/rosout", "/chatter"]
    assert subscribed[0][0] == "/other"
    assert service[0] == 0


def test_a_peer_may_call_itself_what_xml_cannot_carry() -> None:
    caller = Caller()
    caller.world.subscribe_raw(caller.node, callerid="/e\x00vil\ud7ff\uffff<&" + "x" * 5000)
    caller.world.until(lambda: caller.publisher.subscribers)
    (entry,) = caller.call("getBusInfo", "/c")[2]
    assert entry[1].startswith("/e?vil")
    assert len(entry[1]) == 1000


def test_counters_stop_at_the_largest_integer_of_xml_rpc() -> None:
    caller = Caller()
    caller.publisher.bytes_sent = 1 << 40
    assert caller.call("getBusStats", "/c")[2][0][1][1] == LARGEST


def test_request_topic_wants_tcpros() -> None:
    caller = Caller()
    code, _, answer = caller.call("requestTopic", "/c", "/chatter", [["UDPROS"], ["TCPROS"]])
    assert (code, answer[:2]) == (1, ["TCPROS", PLC_IP])
    assert caller.call("requestTopic", "/c", "/chatter", [["UDPROS"]])[0] == 0
    assert caller.call("requestTopic", "/c", "/none", [["TCPROS"]])[0] == -1


def test_multicall_and_list_methods() -> None:
    caller = Caller()
    calls = [{"methodName": "getPid", "params": ["/c"]}, {"methodName": "none", "params": []}]
    pid, fault = caller.call("system.multicall", calls)
    assert pid[0][2] == caller.node.pid
    assert fault["faultCode"] == 1
    assert "requestTopic" in caller.call("system.listMethods")


@pytest.mark.parametrize(
    "document",
    [
        b"<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>",
        b"<a>" * 5_000,
        b"<methodCall><methodName>getPid</methodName></methodCall><x/>",
        b"\x00" * 2_000,
        b"",
    ],
)
def test_hostile_documents_end_their_connection_only(document: bytes) -> None:
    caller = Caller()
    caller.post(document)
    assert caller.call("getPid", "/c")[2] == caller.node.pid


@settings(max_examples=40, deadline=None)
@given(st.binary(max_size=400))
def test_any_bytes_end_at_most_their_own_connection(data: bytes) -> None:
    caller = Caller()
    caller.raw(data)
    assert caller.call("getPid", "/c")[2] == caller.node.pid
