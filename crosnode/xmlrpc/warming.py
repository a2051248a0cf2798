"""A call and its answer in memory: what a node says and reads first is not said and read first."""

from __future__ import annotations

from crosnode.xmlrpc.connection import (
    XmlRpcClientConnection,
    XmlRpcLimits,
    XmlRpcServerConnection,
)


def warm_api(now_ns: int) -> None:
    """Let a client call a server, both in memory, so that a cycle is not the first to do it."""
    limits = XmlRpcLimits()
    for _ in range(2):
        client = XmlRpcClientConnection("localhost:11311", limits, now_ns)
        server = XmlRpcServerConnection(limits, now_ns)
        client.call("requestTopic", ["/node", "/topic", [["TCPROS"]]], now_ns)
        server.receive_data(b"".join(client.data_to_send()))
        while server.next_event(now_ns) is not None:
            pass
        server.respond([1, "ready", ["TCPROS", "localhost", 1]])
        client.receive_data(b"".join(server.data_to_send()))
        while client.next_event(now_ns) is not None:
            pass
