"""Our master, topics and services against Debian's rospy and command-line tools."""

import os
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from crosnode.messages import MessageTypes
from crosnode.tcpros import (
    ANY,
    HeaderReceived,
    MessagesReceived,
    PublisherConnection,
    Refused,
    ReplyReceived,
    RequestReceived,
    ServiceClientConnection,
    ServiceServerConnection,
    SubscriberConnection,
    TcprosLimits,
    TypeInfo,
)
from crosnode.transport.connection import ConnectionState
from crosnode.xmlrpc import MethodCall, MethodFault, MethodResponse

from . import shell

PYTHON = "/usr/bin/python3"
LIMITS = TcprosLimits()
TYPES = MessageTypes()
STRING = TYPES.message("std_msgs/String")
EMPTY = TYPES.message("std_msgs/Empty")
SET_BOOL = TYPES.service("std_srvs/SetBool")
STRING_INFO = TypeInfo(STRING.name, STRING.md5sum, STRING.full_text)
EMPTY_INFO = TypeInfo(EMPTY.name, EMPTY.md5sum, EMPTY.full_text)
SWITCH_INFO = TypeInfo(SET_BOOL.name, SET_BOOL.md5sum)


def has_rospy() -> bool:
    probe = [PYTHON, "-c", "import rospy, std_srvs.srv, rosnode, rostopic, rosservice, rosparam"]
    try:
        return subprocess.run(probe, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


pytestmark = pytest.mark.skipif(not has_rospy(), reason="Debian's rospy is not installed")


@pytest.fixture(name="uri")
def _uri() -> Iterator[str]:
    with shell.running_master() as uri:
        yield uri


def environment(uri: str, home: Path) -> dict[str, str]:
    kept = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    ros = {"ROS_MASTER_URI": uri, "ROS_IP": "127.0.0.1", "ROS_HOME": str(home)}
    return kept | ros | {"PATH": "/usr/bin:/bin", "PYTHONIOENCODING": "utf-8"}


Peer = Callable[..., subprocess.Popen[str]]


@pytest.fixture(name="peer")
def _peer(uri: str, tmp_path: Path) -> Iterator[Peer]:
    """Start rospy nodes and end them after the test."""
    started: list[subprocess.Popen[str]] = []

    def start(role: str, *arguments: str) -> subprocess.Popen[str]:
        command = [PYTHON, str(Path(__file__).with_name("rospy_peer.py")), role, *arguments]
        process = subprocess.Popen(
            command, stdout=subprocess.PIPE, text=True, env=environment(uri, tmp_path)
        )
        started.append(process)
        return process

    yield start
    for process in started:
        process.terminate()
        process.wait(timeout=100)
        assert process.stdout
        process.stdout.close()


def line_of(process: subprocess.Popen[str]) -> str:
    assert process.stdout
    return process.stdout.readline().strip()


def tool(uri: str, home: Path, *command: str) -> str:
    done = subprocess.run(
        ["timeout", "90", *command], env=environment(uri, home),
        capture_output=True, text=True, check=False, timeout=100,
    )  # fmt: skip
    assert done.returncode == 0, done
    return done.stdout.strip()


@contextmanager
def our_publisher(uri: str, topic: str, info: TypeInfo, body: bytes) -> Iterator[None]:
    """Publish one latched message, as the node ``/ours``."""

    def serve(sock: shell.socket.socket) -> None:
        connection = PublisherConnection(LIMITS, 0)
        assert isinstance(shell.next_event(connection, sock), HeaderReceived)
        if connection.accept(info, "/ours", latching=True):
            connection.send_messages([body])
        shell.next_event(connection, sock)

    with shell.listening(serve) as port:

        def answer(call: MethodCall) -> MethodResponse | MethodFault:
            if call.method == "requestTopic":
                return MethodResponse([1, "", ["TCPROS", "127.0.0.1", port]])
            return MethodResponse([1, "", 0])

        with shell.xmlrpc_server(answer) as slave:
            slave_uri = f"http://127.0.0.1:{slave}/"
            shell.call(uri, "registerPublisher", "/ours", topic, info.name, slave_uri)
            yield
            shell.call(uri, "unregisterPublisher", "/ours", topic, slave_uri)


def test_rospy_listener_hears_us(uri: str, peer: Peer) -> None:
    message = STRING.encode(STRING.new(data="Hello world!!! é"))
    listener = peer("listener")
    assert line_of(listener) == "ready"
    with our_publisher(uri, "/chatter", STRING_INFO, bytes(message)):
        assert line_of(listener) == "Hello world!!! é"
    with our_publisher(uri, "/nothing", EMPTY_INFO, b""):
        assert line_of(listener) == "empty"


def subscribe(publisher: str, info: TypeInfo) -> tuple[SubscriberConnection, shell.socket.socket]:
    code, _, protocol = shell.call(publisher, "requestTopic", "/ours", "/chatter", [["TCPROS"]])
    assert code == 1
    sock = shell.dial(f"http://127.0.0.1:{protocol[2]}/", "http")
    connection = SubscriberConnection(
        "/chatter", info, "/ours", tcp_nodelay=True, limits=LIMITS, now_ns=0
    )
    return connection, sock


def test_we_hear_a_rospy_talker(uri: str, peer: Peer) -> None:
    assert line_of(peer("talker")) == "ready"
    (publisher,) = shell.call(
        uri, "registerSubscriber", "/ours", "/chatter", STRING.name, "http://127.0.0.1:1/"
    )[2]
    for info in (STRING_INFO, TypeInfo(ANY, ANY)):
        connection, sock = subscribe(publisher, info)
        with sock:
            header = shell.next_event(connection, sock)
            assert header.fields["md5sum"] == STRING.md5sum
            assert header.fields["latching"] == "1"
            event = shell.next_event(connection, sock)
            assert isinstance(event, MessagesReceived)
            assert STRING.decode(event.bodies[0]) == STRING.new(data="hello " * 300)
    connection, sock = subscribe(publisher, STRING_INFO._replace(md5sum="0" * 32))
    with sock:
        event = shell.next_event(connection, sock)
        assert isinstance(event, Refused)
        assert STRING.md5sum in event.error


def service_uri(uri: str) -> str:
    code, _, found = shell.call(uri, "lookupService", "/ours", "/switch")
    assert code == 1
    return str(found)


@pytest.mark.parametrize("persistent", [False, True])
def test_we_call_a_rospy_service(uri: str, peer: Peer, persistent: bool) -> None:
    assert line_of(peer("provider")) == "ready"
    with shell.dial(service_uri(uri), "rosrpc") as sock:
        connection = ServiceClientConnection(
            "/switch", SWITCH_INFO, "/ours", persistent=persistent, limits=LIMITS, now_ns=0
        )
        assert isinstance(shell.next_event(connection, sock), HeaderReceived)
        if persistent:
            connection.send_request(SET_BOOL.request.encode(SET_BOOL.request.new()), 0)
            failed = shell.next_event(connection, sock)
            assert not failed.ok
            assert b"not today" in failed.body
        connection.send_request(SET_BOOL.request.encode(SET_BOOL.request.new(data=True)), 0)
        event = shell.next_event(connection, sock)
        assert isinstance(event, ReplyReceived)
        assert SET_BOOL.response.decode(event.body).message == "done"
        assert connection.state is (ConnectionState.IDLE if persistent else ConnectionState.CLOSED)


def test_rospy_calls_our_service(uri: str, peer: Peer) -> None:
    def serve(sock: shell.socket.socket) -> None:
        connection = ServiceServerConnection(LIMITS, 0)
        assert isinstance(shell.next_event(connection, sock), HeaderReceived)
        connection.accept(SWITCH_INFO, "/ours")
        while isinstance(event := shell.next_event(connection, sock), RequestReceived):
            if SET_BOOL.request.decode(event.body).data:
                response = SET_BOOL.response.new(success=True, message="é done")
                connection.send_response(SET_BOOL.response.encode(response))
            else:
                connection.send_error("not today")
        shell.flush(connection, sock)

    with (
        shell.listening(serve) as port,
        shell.xmlrpc_server(lambda _: MethodResponse([1, "", 0])) as slave,
    ):
        address = f"rosrpc://127.0.0.1:{port}"
        shell.call(
            uri, "registerService", "/ours", "/switch", address, f"http://127.0.0.1:{slave}/"
        )
        caller = peer("caller")
        lines = [line_of(caller) for _ in range(4)]
    assert lines[0::2] == ["é done"] * 2
    assert all("not today" in line for line in lines[1::2])


def test_parameters_and_arguments(uri: str, peer: Peer, tmp_path: Path) -> None:
    shell.call(uri, "setParam", "/ours", "/top", 1)
    watcher = peer("watcher", "_gain:=2.5", "__ns:=/deep/down", "__name:=w")
    assert [line_of(watcher) for _ in range(3)] == ["2.5", "/top", "ready"]
    value = shell.call(uri, "getParam", "/ours", "/deep/down/w/answer")[2]
    assert value == {"x": [1, 2.5, "é", True]}
    tool(uri, tmp_path, "rosparam", "set", "/a/b", "{c: [1, x], d: 1.0e-9}")
    assert shell.call(uri, "getParam", "/ours", "/a")[2] == {"b": {"c": [1, "x"], "d": 1e-9}}
    assert tool(uri, tmp_path, "rosparam", "get", "/a/b/c") == "- 1\n- x"
    assert "/a/b/d" in tool(uri, tmp_path, "rosparam", "list").split()
    tool(uri, tmp_path, "rosparam", "delete", "/a")
    assert shell.call(uri, "hasParam", "/ours", "/a")[2] is False


def test_command_line_tools_on_our_master(uri: str, peer: Peer, tmp_path: Path) -> None:
    assert line_of(peer("talker")) == "ready"
    assert line_of(peer("listener")) == "ready"
    topics = tool(uri, tmp_path, "rostopic", "list").split()
    assert topics == ["/chatter", "/nothing", "/rosout"]
    assert tool(uri, tmp_path, "rostopic", "type", "/chatter") == "std_msgs/String"
    assert "* /peer_listener" in tool(uri, tmp_path, "rostopic", "info", "/chatter")
    assert "hello" in tool(uri, tmp_path, "rostopic", "echo", "-n1", "/chatter")
    assert tool(uri, tmp_path, "rosnode", "list").split() == ["/peer_listener", "/peer_talker"]
    assert "/chatter [std_msgs/String]" in tool(uri, tmp_path, "rosnode", "info", "/peer_talker")
    assert "xmlrpc reply" in tool(uri, tmp_path, "rosnode", "ping", "-c1", "/peer_talker")
    services = tool(uri, tmp_path, "rosservice", "list").split()
    assert "/peer_talker/get_loggers" in services
    assert tool(uri, tmp_path, "rosservice", "type", services[0]) == "roscpp/GetLoggers"
    assert "loggers" in tool(uri, tmp_path, "rosservice", "call", services[0])
    tool(uri, tmp_path, "rosnode", "kill", "/peer_talker")
    until(lambda: tool(uri, tmp_path, "rosnode", "list") == "/peer_listener")


def until(condition: Callable[[], bool], timeout_s: float = 100.0) -> None:
    end = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.1)
