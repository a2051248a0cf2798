"""A process that is in a ROS network for a while: ``plcsim ros topic``, ``node``, ``service``."""

from __future__ import annotations

import os
import time
from contextlib import suppress
from functools import cached_property, partial
from typing import TYPE_CHECKING, Final

from crosnode.commands.message_types import message_types
from crosnode.graph.arguments import DEFAULT_MASTER_URI, NodeSettings, node_settings
from crosnode.graph.hosts import HostTable, hosts_text, is_ipv6_wanted, loopback, parse_hosts
from crosnode.graph.uri import make_uri, parse_uri
from crosnode.messages import MessageTypes
from crosnode.node import CrosNode, NodeOptions
from crosnode.node.ros_time import Epoch
from crosnode.tcpros import (
    ANY,
    HeaderReceived,
    Refused,
    ServiceClientConnection,
    SubscriberConnection,
    TypeInfo,
)
from crosnode.transport.budget import UNPACED, StepBudget
from crosnode.transport.connection import Failed
from crosnode.transport.event_loop import EventLoop
from crosnode.xmlrpc.api_caller import ApiCall, ApiCaller, CallState
from plcsim.core.context import Context
from plcsim.core.errors import PlcError
from plcsim.core.memory import Memory
from plcsim.network import OsNetwork

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

    from crosnode.messages import MessageType
    from crosnode.transport.connection import ConnectionEvent, ProtocolConnection
    from crosnode.transport.link import PeerLink
    from crosnode.xmlrpc import Value

REST_S: Final = 0.001
PATIENCE_NS: Final = 5_000_000_000
"""Nanoseconds within which a master, a node or a service must answer."""

CALLER: Final = "/plcsim"
"""How a process without a node calls itself."""

ANY_TYPE: Final = TypeInfo(ANY, ANY)


class RosClient:
    """Calls of APIs and, where one is needed, a node of its own.

    Args:
        context: of a controller without programs.
        settings: of the node.
        types: message types.
        turn: lets a little time pass and sets the context's release.
        options: hosts and epoch of the node.
    """

    def __init__(
        self,
        context: Context,
        settings: NodeSettings,
        types: MessageTypes,
        turn: Callable[[], None],
        options: NodeOptions | None = None,
    ) -> None:
        self.types = types
        self.settings = settings
        self._context = context
        self._turn = turn
        self._options = (options or NodeOptions())._replace(step=UNPACED)
        self._loop = EventLoop(context)
        self._hosts = HostTable(self._options.hosts, ipv6=self._options.ipv6)
        self._api = ApiCaller(self._loop, self._hosts, self._options.xmlrpc)
        self._made: CrosNode | None = None

    @property
    def now_ns(self) -> int:
        """Nanoseconds of the monotonic clock."""
        return self._context.release_ns

    @cached_property
    def node(self) -> CrosNode:
        """The node, which is registered with the master from here on."""
        self._made = CrosNode(self._context, self.settings, self.types, self._options)
        return self._made

    def close(self) -> None:
        """Take back what the node has registered, and end all connections."""
        if self._made:
            self._made.close()
            end_ns = self.now_ns + PATIENCE_NS
            while not self._made.is_closed and self.now_ns < end_ns:
                self.step()
        self._loop.close(self.now_ns)

    def step(self) -> None:
        """Let a little time pass."""
        now_ns, budget = self.now_ns, StepBudget(UNPACED)
        self._api.step(now_ns, budget)
        self._loop.step(now_ns, budget)
        if self._made:
            self._made.do_events_loop()
        self._turn()

    def wait(self, condition: Callable[[], object], patience_ns: int | None = PATIENCE_NS) -> bool:
        """Go on until something is so; return whether it is, and not the time over before."""
        end_ns = None if patience_ns is None else self.now_ns + patience_ns
        while not condition():
            if end_ns is not None and self.now_ns >= end_ns:
                return False
            self.step()
        return True

    def wait_until(self, time_ns: int) -> None:
        """Go on until a time."""
        while self.now_ns < time_ns:
            self.step()

    def call_master(self, method: str, *params: Value) -> Value:
        """Return the value of a call of the master.

        Raises:
            PlcError: it cannot be reached, or refuses.
        """
        return self.call(self.settings.master_uri, method, *params, whom="the master")

    def call(self, uri: str, method: str, *params: Value, whom: str) -> Value:
        """Return the value of a call of an API; raises as ``call_master`` does."""
        call = self._api.start(ApiCall(uri, method, [CALLER, *params]))
        self.wait(lambda: call.state is not CallState.WAITING)
        if call.state is CallState.DONE:
            return call.value
        if call.was_answered:
            raise PlcError(call.error)
        raise PlcError(f"no answer of {whom} at {uri}: {call.error or 'it is silent'}")

    def service_type(self, service: str) -> str:
        """Return the type of a service, as its provider tells it.

        Raises:
            PlcError: nobody provides it, or the provider does not say.
        """
        uri = self.call_master("lookupService", service)
        probe = ServiceClientConnection(
            service, ANY_TYPE, CALLER, probe=True, limits=self._options.tcpros, now_ns=self.now_ns
        )
        return self._header(uri, probe, f"{service} at {uri}")["type"]

    def topic_type(self, topic: str) -> MessageType:
        """Return the type of a topic; a publisher tells its definition, so any type is known.

        Raises:
            PlcError: nobody publishes or subscribes to it, or its type cannot be had.
        """
        names = dict(self.call_master("getTopicTypes"))
        if topic not in names:
            raise PlcError(f"{topic}: nobody publishes it or subscribes to it")
        publishers = dict(self.call_master("getSystemState")[0])
        for publisher in publishers.get(topic, []):
            with suppress(PlcError):
                fields = self._publisher_header(topic, publisher)
                self.types = MessageTypes()  # not those of packages, which may be others
                return self.types.define(fields["type"], fields["message_definition"])
        return self.types.message(names[topic])

    def _publisher_header(self, topic: str, publisher: str) -> dict[str, str]:
        uri = self.call_master("lookupNode", publisher)
        answer = self.call(uri, "requestTopic", topic, [["TCPROS"]], whom=publisher)
        _, host, port = answer
        connection = SubscriberConnection(
            topic,
            ANY_TYPE,
            CALLER,
            tcp_nodelay=False,
            limits=self._options.tcpros,
            now_ns=self.now_ns,
        )
        return self._header(make_uri("rosrpc", host, port), connection, publisher)

    def _header(self, uri: str, connection: ProtocolConnection, whom: str) -> dict[str, str]:
        """Connect, and return the fields of the header that is answered."""
        asked = _Header()
        address = self._hosts.address(uri, "rosrpc")
        link = self._loop.connect(address, connection, asked, self.now_ns)
        self.wait(lambda: asked.fields or asked.error)
        link.close()
        if "type" not in asked.fields:
            raise PlcError(f"{whom}: {asked.error or 'it tells no type'}")
        return asked.fields


class _Header:
    """Owner of a link that only wants the header of the peer."""

    def __init__(self) -> None:
        self.fields: dict[str, str] = {}
        self.error = ""

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Take the header."""
        if isinstance(event, HeaderReceived):
            self.fields = event.fields
        elif isinstance(event, Refused):
            self.error = event.error
        elif isinstance(event, Failed):
            self.error = event.reason

    def expects_data(self, link: PeerLink) -> bool:
        """A header is expected."""
        return True

    def fill(self, link: PeerLink) -> None:
        """Nothing is sent behind our header."""

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """Note why there is no header."""
        self.error = self.error or reason or "the connection was closed"


def open_client(options: argparse.Namespace) -> RosClient:
    """Return a client on the network of the host.

    Raises:
        PlcError: the URI of the master is none.
    """
    environment = os.environ
    uri = options.master or environment.get("ROS_MASTER_URI") or DEFAULT_MASTER_URI
    try:
        parse_uri(uri, "http")
    except ValueError as error:
        raise PlcError(f"master: {error}") from None
    context = Context(Memory(), OsNetwork())
    turn = partial(_turn, context)
    turn()
    name = f"plcsim_{os.getpid()}_{time.time_ns() // 1_000_000}"
    ipv6 = is_ipv6_wanted(environment)
    own = loopback(ipv6=ipv6)
    settings = node_settings(name, (), {**environment, "ROS_MASTER_URI": uri}, host=own)
    text = hosts_text()
    epoch = Epoch(time.time_ns() - context.release_ns)
    node_options = NodeOptions(hosts=parse_hosts(text, ipv6=ipv6), ipv6=ipv6, epoch=epoch)
    return RosClient(context, settings, message_types(options.path), turn, node_options)


def _turn(context: Context) -> None:
    time.sleep(REST_S)
    context.release_ns = time.monotonic_ns()


def acting(
    act: Callable[[RosClient, argparse.Namespace], None],
) -> Callable[[argparse.Namespace], None]:
    """Return a command that acts until done or Ctrl-C, and takes back what it registered."""

    def run(options: argparse.Namespace) -> None:
        client = open_client(options)
        try:
            act(client, options)
        except KeyboardInterrupt:
            pass  # the way to end what goes on for ever
        finally:
            client.close()

    return run
