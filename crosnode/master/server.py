"""The master on its port: `crosnode.master.master.Master` over the bounded step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.graph.hosts import HostTable, own_interface
from crosnode.graph.uri import DEFAULT_PORT, make_uri
from crosnode.master.master import Master, OutgoingCall
from crosnode.transport.budget import StepBudget, StepLimits
from crosnode.transport.caller_share import CallerShare
from crosnode.transport.event_loop import EventLoop
from crosnode.xmlrpc import (
    CallReceived,
    MethodCall,
    MethodFault,
    Value,
    XmlRpcLimits,
    XmlRpcServerConnection,
)
from crosnode.xmlrpc.acceptor import ApiAcceptor
from crosnode.xmlrpc.api_caller import ApiCall, ApiCaller

if TYPE_CHECKING:
    from collections.abc import Mapping

    from crosnode.transport.connection import ConnectionEvent
    from crosnode.transport.link import PeerLink
    from plcsim.core.context import Context

ANSWER_NS: Final = 3_600_000_000_000
"""Nanoseconds that a node which stands still may take to hear the news, such as a controller that
is halted; rosmaster waits without an end. A host that has gone is noticed by TCP."""

PATIENCE_NS: Final = 120_000_000_000
"""Nanoseconds that news wait for a node which cannot be reached: as long as Linux tries to connect
for rosmaster (tcp(7), tcp_syn_retries)."""

NEWS: Final = ("publisherUpdate", "paramUpdate")

CALLERS_PART: Final = 2
"""One in so many idents is for those who call the master; it calls nodes with the others."""


def first_parameters(run_id: str) -> dict[str, Value]:
    """Return what rosmaster and roslaunch set at the start of a master."""
    return {"/run_id": run_id, "/rosdistro": "noetic\n", "/rosversion": "1.15.15\n"}


class MasterOptions(NamedTuple):
    """Where a master listens and what a step may take.

    Attributes:
        host: name or number in its URI.
        port: to listen at.
        bind_ip: own interface to listen on, "" for all, None for that of ``host``.
        ipv6: whether names stand for addresses of IPv6.
        pid: what getPid answers.
        parameters: what the parameter server holds at the start.
        hosts: addresses of host names in the URIs of nodes.
        step: bounds of one step.
        xmlrpc: bounds of a connection.
    """

    host: str = "localhost"
    port: int = DEFAULT_PORT
    bind_ip: str | None = None
    ipv6: bool = False
    pid: int = 0
    parameters: Mapping[str, Value] | None = None
    hosts: Mapping[str, str] | None = None
    step: StepLimits = StepLimits()
    xmlrpc: XmlRpcLimits = XmlRpcLimits()


class MasterServer:
    """A ROS 1 master and parameter server; ``step`` does its bounded step.

    Args:
        context: of the controller.
        options: see ``MasterOptions``.

    Attributes:
        uri: where nodes reach it.
        bind_ip: own interface it listens on, "" for all.
        master: the logic.
    """

    def __init__(self, context: Context, options: MasterOptions | None = None) -> None:
        self.options = options = options or MasterOptions()
        self._context = context
        self._loop = EventLoop(context, CallerShare(context, CALLERS_PART))
        acceptor = ApiAcceptor(self, options.xmlrpc)
        bind_ip = options.bind_ip
        if bind_ip is None:
            bind_ip = own_interface(options.host, ipv6=options.ipv6)
        self.bind_ip = bind_ip
        self._listener = self._loop.listen(self.bind_ip, options.port, acceptor)
        hosts = HostTable(options.hosts, ipv6=options.ipv6)
        limits = options.xmlrpc._replace(timeout_ns=ANSWER_NS)
        self._api = ApiCaller(self._loop, hosts, limits)
        self.uri = make_uri("http", options.host, options.port)
        self.master = Master(self.uri, options.pid, options.parameters)

    @property
    def is_open(self) -> bool:
        """Whether nodes can connect; a port in use is tried again once a second."""
        return self._listener.is_open

    @property
    def status(self) -> int:
        """Status of the last AsTCP block that the port called, for messages."""
        return self._listener.status

    def step(self) -> None:
        """Answer calls and make those that they cause, within the budget of a step."""
        now_ns, budget = self._context.release_ns, StepBudget(self.options.step)
        self._api.step_first(now_ns, budget)
        self._loop.step(now_ns, budget)
        self._api.step(now_ns, budget)
        self._loop.step_new(now_ns, budget)

    def close(self) -> None:
        """Close the port and all connections."""
        self._loop.close(self._context.release_ns)

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Answer a call."""
        connection = link.connection
        if not isinstance(event, CallReceived) or not isinstance(
            connection, XmlRpcServerConnection
        ):
            return
        reply, calls = self.master.handle(MethodCall(event.method, event.params))
        if isinstance(reply, MethodFault):
            connection.fault(*reply)
        else:
            connection.respond(reply.value)
        for call in calls:
            self._start(call)

    def _start(self, call: OutgoingCall) -> None:
        def answered(answer: ApiCall) -> None:
            if answer.was_answered:
                self.master.handle_reply(call, answer.reply)

        patience_ns = PATIENCE_NS if call.method in NEWS else 0
        self._api.start(
            ApiCall(call.uri, call.method, call.params, answered, patience_ns=patience_ns)
        )

    def expects_data(self, link: PeerLink) -> bool:
        """A caller may always call."""
        return True

    def fill(self, link: PeerLink) -> None:
        """Answers go to the connection at once."""

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """Nothing is kept for a caller."""
