"""The slave API: what the master and other nodes may ask of a node.

All methods answer ``[code, message, value]``. Source: wiki.ros.org/ROS/Slave_API; the shapes of
getBusInfo and getBusStats follow rospy where rosnode, roswtf and rqt read them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from crosnode.graph.names import canonical
from crosnode.node.status import StatusKind
from crosnode.xmlrpc import (
    MULTICALL,
    CallReceived,
    MethodCall,
    MethodFault,
    MethodResponse,
    Value,
    XmlRpcServerConnection,
    run_multicall,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.node.core import NodeView
    from crosnode.transport.connection import ConnectionEvent
    from crosnode.transport.link import PeerLink

SUCCESS: Final = 1
ERROR: Final = -1
LARGEST: Final = 2**31 - 1
"""XML-RPC has no larger integer; counters stop there."""

TRANSPORT: Final = "TCPROS"


class SlaveApi:
    """Answers calls, and owns the links they come by.

    Args:
        node: asked for everything.
    """

    def __init__(self, node: NodeView) -> None:
        self._node = node

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Answer a call at once."""
        connection = link.connection
        if not isinstance(event, CallReceived) or not isinstance(
            connection, XmlRpcServerConnection
        ):
            return
        if event.method == MULTICALL:
            connection.respond(run_multicall(event.params, self.answer))
            return
        reply = self.answer(MethodCall(event.method, event.params))
        if isinstance(reply, MethodFault):
            connection.fault(*reply)
        else:
            connection.respond(reply.value)

    def expects_data(self, link: PeerLink) -> bool:
        """A caller may always call."""
        return True

    def fill(self, link: PeerLink) -> None:
        """Answers go to the connection at once."""

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """Tell of a call that was too large, such as paramUpdate: its value is not the newest."""
        connection = link.connection
        if isinstance(connection, XmlRpcServerConnection) and connection.is_beyond_limits:
            self._node.core.tell(StatusKind.PEER_REFUSED, link.peer, reason)

    def answer(self, call: MethodCall) -> MethodResponse | MethodFault:
        """Answer one call."""
        if call.method == "system.listMethods":
            return MethodResponse([*_METHODS, "system.listMethods", MULTICALL])
        method = _METHODS.get(call.method)
        if method is None:
            return MethodFault(1, f"method {call.method[:100]!r} is not supported")
        run, kinds = method
        params = call.params[1:]
        if len(call.params) < 1 + len(kinds) or not all(map(isinstance, params, kinds)):
            names = ", ".join(kind.__name__ for kind in (str, *kinds))
            return MethodResponse([ERROR, f"{call.method} takes ({names})", 0])
        return MethodResponse(run(self, *params[: len(kinds)]))

    def get_bus_stats(self) -> Value:
        """Give counts of bytes and messages of all connections."""
        node = self._node
        published = [
            [p.topic, _int(p.bytes_sent), [
                [owner.number, _int(link.bytes_out), _int(owner.queue.pushed), True]
                for link, owner in p.links.items()
            ]]
            for p in node.publishers.values()
        ]  # fmt: skip
        subscribed = [
            [s.topic, [
                [peer.number, _int(peer.link.bytes_in), _int(peer.received), -1, peer.is_streaming]
                for peer in s.peers.values() if peer.link
            ]]
            for s in node.subscribers.values()
        ]  # fmt: skip
        requests = sum(p.requests for p in node.providers.values())
        service = [_int(requests), _int(sum(p.bytes_in for p in node.providers.values())), 0]
        return [SUCCESS, "", [published, subscribed, service]]

    def get_bus_info(self) -> Value:
        """Give number, peer, direction, transport, topic, and whether connected, of each."""
        node = self._node
        port = node.topic_listener.port
        out = [
            [o.number, o.subscriber, "o", TRANSPORT, p.topic, True,
             f"TCPROS connection on port {port} to [{link.peer}]"]
            for p in node.publishers.values() for link, o in p.links.items()
        ]  # fmt: skip
        inwards = [
            [peer.number, peer.uri, "i", TRANSPORT, s.topic, peer.is_streaming,
             f"TCPROS connection to [{peer.link.peer}]"]
            for s in node.subscribers.values() for peer in s.peers.values() if peer.link
        ]  # fmt: skip
        return [SUCCESS, "bus info", [*out, *inwards]]

    def get_master_uri(self) -> Value:
        """Give the URI of the master."""
        return [SUCCESS, "", self._node.core.master.uri]

    def shutdown(self) -> Value:
        """End the node, which goes on until its registrations are taken back."""
        self._node.shut_down("rosnode kill, or another node of its name")
        return [SUCCESS, "shutdown", 0]

    def get_pid(self) -> Value:
        """Give the process number."""
        return [SUCCESS, "", self._node.pid]

    def get_subscriptions(self) -> Value:
        """Give topic and type of all subscribers."""
        found = [[s.topic, s.message_type.name] for s in self._node.subscribers.values()]
        return [SUCCESS, "subscriptions", found]

    def get_publications(self) -> Value:
        """Give topic and type of all publishers."""
        found = [[p.topic, p.message_type.name] for p in self._node.publishers.values()]
        return [SUCCESS, "publications", found]

    def param_update(self, name: str, value: Value) -> Value:
        """Take a change of a parameter; a name that nobody subscribed to is an error."""
        name = canonical(name)
        covering = [p for p in self._node.params if p.covers(name)]
        for param in covering:
            param.param_update(name, value)
            self._node.core.tell(StatusKind.PARAM_UPDATE, name)
        return [SUCCESS if covering else ERROR, name[:100], 0]

    def publisher_update(self, topic: str, publishers: list[Value]) -> Value:
        """Take the publishers of a topic."""
        subscriber = self._node.subscribers.get(topic)
        if subscriber:
            subscriber.publisher_update(publishers)
        return [SUCCESS, "", 0]

    def request_topic(self, topic: str, protocols: list[Value]) -> Value:
        """Say where a topic can be had."""
        node = self._node
        if topic not in node.publishers:
            return [ERROR, f"not a publisher of [{topic[:100]}]", 0]
        if not any(isinstance(p, list) and p[:1] == [TRANSPORT] for p in protocols):
            return [0, "no supported protocol implementations", 0]
        return [SUCCESS, f"ready on port {node.topic_listener.port}",
                [TRANSPORT, node.host, node.topic_listener.port]]  # fmt: skip


def _int(value: int) -> int:
    return min(value, LARGEST)


_METHODS: Final[dict[str, tuple[Callable[..., Value], tuple[type, ...]]]] = {
    "getBusStats": (SlaveApi.get_bus_stats, ()),
    "getBusInfo": (SlaveApi.get_bus_info, ()),
    "getMasterUri": (SlaveApi.get_master_uri, ()),
    "shutdown": (SlaveApi.shutdown, ()),
    "getPid": (SlaveApi.get_pid, ()),
    "getSubscriptions": (SlaveApi.get_subscriptions, ()),
    "getPublications": (SlaveApi.get_publications, ()),
    "paramUpdate": (SlaveApi.param_update, (str, object)),
    "publisherUpdate": (SlaveApi.publisher_update, (str, list)),
    "requestTopic": (SlaveApi.request_topic, (str, list)),
}
"""The slave API: what answers a method, and the kinds of its parameters behind the caller's."""
