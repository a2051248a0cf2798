"""Sockets around our sans-io objects, for tests against real peers only: blocking and simple."""

import queue
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

from crosnode.graph.uri import parse_uri
from crosnode.master.master import Master, OutgoingCall
from crosnode.transport.connection import ConnectionState, Progress
from crosnode.xmlrpc import (
    CallReceived,
    MethodCall,
    MethodFault,
    MethodResponse,
    ResponseReceived,
    XmlRpcClientConnection,
    XmlRpcLimits,
    XmlRpcServerConnection,
)

CHUNK = 700
"""Bytes per read, an odd number so that messages come in pieces."""

Answerer = Callable[[MethodCall], MethodResponse | MethodFault]


def flush(connection: Any, sock: socket.socket) -> None:
    for data in connection.data_to_send():
        sock.sendall(data)


def next_event(connection: Any, sock: socket.socket) -> Any:
    """Return the next event of a connection, reading as needed; None where it is closed."""
    while True:
        flush(connection, sock)
        event = connection.next_event(time.monotonic_ns())
        if event == Progress():
            continue
        if event is not None:
            return event
        if connection.state is ConnectionState.CLOSED:
            return None
        data = sock.recv(CHUNK)
        if data:
            connection.receive_data(data)
        else:
            connection.receive_eof()


def dial(uri: str, scheme: str) -> socket.socket:
    sock = socket.create_connection(parse_uri(uri, scheme), timeout=100)
    sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return sock


def call(uri: str, method: str, *params: object) -> Any:
    """Call a method over XML-RPC and return its value."""
    address = parse_uri(uri, "http")
    with dial(uri, "http") as sock:
        connection = XmlRpcClientConnection(f"{address.host}:{address.port}", XmlRpcLimits(), 0)
        connection.call(method, params, time.monotonic_ns())
        event = next_event(connection, sock)
    assert isinstance(event, ResponseReceived), event
    return event.value


@contextmanager
def listening(serve: Callable[[socket.socket], None]) -> Iterator[int]:
    """Serve each connection in a thread of its own; yield the port."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        stopped = threading.Event()

        def accept() -> None:
            while not stopped.is_set():
                with suppress(OSError):
                    sock, _ = listener.accept()
                    threading.Thread(target=guarded, args=(sock,), daemon=True).start()

        def guarded(sock: socket.socket) -> None:
            with sock, suppress(OSError):
                serve(sock)

        threading.Thread(target=accept, daemon=True).start()
        yield listener.getsockname()[1]
        stopped.set()
        listener.shutdown(socket.SHUT_RDWR)


@contextmanager
def xmlrpc_server(answer: Answerer) -> Iterator[int]:
    """Answer XML-RPC calls; yield the port."""

    def serve(sock: socket.socket) -> None:
        connection = XmlRpcServerConnection(XmlRpcLimits(), time.monotonic_ns())
        while isinstance(event := next_event(connection, sock), CallReceived):
            reply = answer(MethodCall(event.method, event.params))
            if isinstance(reply, MethodFault):
                connection.fault(*reply)
            else:
                connection.respond(reply.value)
        flush(connection, sock)

    with listening(serve) as port:
        yield port


@contextmanager
def running_master() -> Iterator[str]:
    """Run our master; yield its URI."""
    masters: list[Master] = []
    lock = threading.Lock()
    outgoing: queue.Queue[OutgoingCall] = queue.Queue()

    def answer(request: MethodCall) -> MethodResponse | MethodFault:
        with lock:
            reply, calls = masters[0].handle(request)
        for each in calls:
            outgoing.put(each)
        return reply

    def call_nodes() -> None:
        while True:
            each = outgoing.get()
            with suppress(OSError, AssertionError):
                value = call(each.uri, each.method, *each.params)
                with lock:
                    masters[0].handle_reply(each, value)

    with xmlrpc_server(answer) as port:
        uri = f"http://127.0.0.1:{port}/"
        masters.append(Master(uri, 4242, {"/run_id": "test"}))
        threading.Thread(target=call_nodes, daemon=True).start()
        yield uri
