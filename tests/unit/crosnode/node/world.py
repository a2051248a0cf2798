"""Nodes and the embedded master on the virtual network and clock, one context for each host."""

from collections.abc import Callable
from typing import Any

import pytest

from crosnode.graph.arguments import node_settings
from crosnode.master.server import MasterOptions, MasterServer
from crosnode.node import CrosNode, NodeOptions, Status, StatusKind
from crosnode.tcpros.header import encode_header
from crosnode.transport.budget import StepBudget, StepLimits
from crosnode.xmlrpc import XmlRpcServerConnection
from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.network import Address, Link, Outcome, Socket, VirtualNetwork
from plcsim.network.virtual_host import VirtualHost

MS = 1_000_000
SECOND = 1_000 * MS
MASTER_IP = "192.168.0.1"
PLC_IP = "192.168.0.10"
OTHER_IP = "192.168.0.20"
PEER_IP = "192.168.0.99"
STRING = "std_msgs/String"
STRING_MD5 = "992ce8a1687cec8c8bd883ec73ca41d1"


class World:
    """A net, and who takes part; ``run`` lets each do a step per millisecond."""

    def __init__(self, *, seed: int = 0, link: Link | None = None, master: bool = True) -> None:
        self.now_ns = 0
        self.net = VirtualNetwork(lambda: self.now_ns, seed=seed, link=link)
        self._contexts: list[Context] = []
        self.steps: list[Callable[[], object]] = []
        self.master_uri = f"http://{MASTER_IP}:11311/"
        self.master = self.start_master() if master else None

    @property
    def faults(self) -> Any:
        return self.net.faults

    def context(self, ip: str) -> Context:
        context = Context(Memory(), self.net.host(ip))
        context.release_ns = self.now_ns
        self._contexts.append(context)
        return context

    def start_master(self, **options: Any) -> MasterServer:
        server = MasterServer(self.context(MASTER_IP), MasterOptions(host=MASTER_IP, **options))
        self.steps.append(server.step)
        return server

    def kill_master(self) -> None:
        """End the master as kill -9 does: its connections end, its knowledge is gone."""
        assert self.master
        self.steps.remove(self.master.step)
        self.master.close()
        self.master = None

    def restart_master(self) -> None:
        """Start another master, as if it had the same pid."""
        self.master = self.start_master()

    def node(
        self,
        name: str,
        ip: str = PLC_IP,
        *arguments: str,
        step: StepLimits | None = None,
        environment: dict[str, str] | None = None,
        **options: Any,
    ) -> CrosNode:
        given = {"ROS_MASTER_URI": self.master_uri} | (environment or {})
        settings = node_settings(name, arguments, given, host=ip)
        limits = NodeOptions(step={} if step is None else step, **options)
        node = CrosNode(self.context(ip), settings, options=limits)
        self.steps.append(node.do_events_loop)
        return node

    def leave_to_its_connections(self, node: CrosNode) -> None:
        """Let a node do as rospy does: it does not register again with a master that is new."""
        self.steps.remove(node.do_events_loop)
        loop, context = node.core.loop, node._context
        self.steps.append(lambda: loop.step(context.release_ns, StepBudget(StepLimits())))

    def run(self, ms: int = 50, step_ms: int = 1) -> None:
        for _ in range(0, ms, step_ms):
            self.now_ns += step_ms * MS
            for context in self._contexts:
                context.release_ns = self.now_ns
            for step in list(self.steps):
                step()

    def until(self, condition: Callable[[], object], ms: int = 3_000) -> int:
        """Run until something is so; return the milliseconds it took."""
        for passed in range(ms):
            if condition():
                return passed
            self.run(1)
        raise AssertionError(f"not so within {ms} ms")

    def peer(self, ip: str = PEER_IP) -> VirtualHost:
        return self.net.host(ip)

    def dial(self, ip: str, port: int, data: bytes = b"") -> Socket:
        """Connect as a peer that speaks bytes, and send them."""
        socket = self.peer().open("", 0).socket
        assert socket is not None
        for _ in range(20):
            if socket.connect(Address(ip, port)) is Outcome.OK:
                self.send(socket, data)
                return socket
            self.run(1)
        raise AssertionError(f"no connection to {ip}:{port}")

    def send(self, socket: Socket, data: bytes) -> None:
        while data:
            sent = socket.send(data)
            if sent.outcome not in (Outcome.OK, Outcome.WOULD_BLOCK):
                return
            data = data[sent.taken :]
            self.run(1)

    def receive(self, socket: Socket, ms: int = 30) -> bytes:
        """Return what comes within a time."""
        data = b""
        for _ in range(ms):
            self.run(1)
            data += socket.recv(65_536).data
        return data

    def subscribe_raw(self, node: CrosNode, **fields: str) -> Socket:
        """Connect to a node's topic port with a header of our own."""
        header = {"callerid": "/raw", "topic": "/chatter", "md5sum": "*", "type": "*"} | fields
        return self.dial(node.host, node.topic_listener.port, encode_header(header))


def drain(pop: Callable[[], Any]) -> list[Any]:
    """Return all that a queue gives."""
    found = []
    while (entry := pop()) is not None:
        found.append(entry)
    return found


def words(pop: Callable[[], Any]) -> list[str]:
    """Return the texts of all std_msgs/String of a queue."""
    return [message.data for message in drain(pop)]


def news(node: CrosNode, kind: StatusKind) -> list[Status]:
    """Return all news of a kind, and forget the others."""
    return [status for status in drain(node.pop_status) if status.kind is kind]


def end_behind_answers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let all servers do as those of HTTP/1.0."""
    send = XmlRpcServerConnection._send_document

    def send_last(connection: XmlRpcServerConnection, document: bytes, status: int) -> None:
        send(connection, document, status, ("Connection", "close"))

    monkeypatch.setattr(XmlRpcServerConnection, "_send_document", send_last)
