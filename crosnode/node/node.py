"""CrosNode: a ROS 1 node that does one bounded step per scan cycle.

The shape is that of cROS: a program registers what it publishes, subscribes, provides and calls,
runs ``do_events_loop`` once a cycle, and drains queues. Nothing calls back and nothing waits.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final, TypeVar

from crosnode.errors import InvalidNameError, NodeError
from crosnode.graph.hosts import HostTable, own_interface
from crosnode.graph.uri import make_uri
from crosnode.messages import MessageTypes
from crosnode.node.border import Border
from crosnode.node.core import NodeCore
from crosnode.node.life import Life, LifeState
from crosnode.node.master_client import MasterClient
from crosnode.node.options import NodeOptions
from crosnode.node.pace import Pace
from crosnode.node.parameter import ParameterSubscription, check_parameters
from crosnode.node.publisher import Publisher, TopicAcceptor
from crosnode.node.queues import DropOldestQueue
from crosnode.node.registration import Registration
from crosnode.node.resolver import Resolver
from crosnode.node.ros_time import Epoch, RosTime
from crosnode.node.rosout import LogLevel, Rosout
from crosnode.node.service_caller import ServiceCaller
from crosnode.node.service_provider import ServiceAcceptor, ServiceProvider
from crosnode.node.slave_api import SlaveApi
from crosnode.node.status import Status, StatusKind
from crosnode.node.subscriber import Subscriber
from crosnode.transport.budget import UNPACED, StepBudget, StepLimits
from crosnode.transport.event_loop import EventLoop
from crosnode.transport.tcpip_socket import OPTIONS
from crosnode.xmlrpc.acceptor import ApiAcceptor
from crosnode.xmlrpc.api_caller import ApiCall, ApiCaller, CallState
from crosnode.xmlrpc.warming import warm_api
from plcsim.core.statistics import Histogram
from plcsim.core.traffic import Topic
from plcsim.library.astcp import tcpERR_INTERFACE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from crosnode.graph.arguments import NodeSettings
    from crosnode.messages import MessageType
    from crosnode.xmlrpc import Value
    from plcsim.core.context import Context

Role = TypeVar("Role", Publisher, Subscriber, ServiceProvider)

STATUSES: Final = 200
SHORTAGE_NS: Final = 10_000_000_000
"""Nanoseconds in which it is told at most once that no ident is free."""


class CrosNode:
    """A node.

    Args:
        context: of the controller.
        settings: name, namespace, master, host and remappings
            (`crosnode.graph.arguments.node_settings`).
        types: message types; ``MessageTypes()`` has the common ones.
        options: see ``NodeOptions``.

    Raises:
        MessageValueError: a private parameter has a value that XML-RPC cannot carry.
        NodeError: no port can be opened.

    Attributes:
        name: resolved.
        host: name or number under which others reach it.
        uri: of its slave API, "" until its ports are open.
        publishers: by topic. ``subscribers`` by topic, ``providers`` by service.
        statuses: news for the program, to be popped.
        statistics: how long the steps took.
        pace: how much it may do in a step, and whether that suffices.
        life: how far it is from its start to its end, and who ended it.
    """

    def __init__(
        self,
        context: Context,
        settings: NodeSettings,
        types: MessageTypes | None = None,
        options: NodeOptions | None = None,
    ) -> None:
        check_parameters(settings.parameters)
        self.options = options or NodeOptions()
        self.types = types or MessageTypes()
        self.name = settings.names.node
        self.host = settings.host
        self.pid = os.getpid()
        self.publishers: dict[str, Publisher] = {}
        self.subscribers: dict[str, Subscriber] = {}
        self.providers: dict[str, ServiceProvider] = {}
        self.params: list[ParameterSubscription] = []
        self.callers: list[ServiceCaller] = []
        self.statuses: DropOldestQueue[Status] = DropOldestQueue(STATUSES)
        self.statistics = Histogram()
        step = self.options.step
        self.pace = Pace(step._asdict() if isinstance(step, StepLimits) else step)
        self._shortages = 0
        self._is_first = True
        self._next_shortage_ns = 0
        self._context = context
        self._names = settings.names
        self._open(settings.master_uri)
        self._time = RosTime(self, self.options.epoch or Epoch())
        self._rosout = Rosout(self)
        self._connect_master()
        for key, value in settings.parameters.items():
            self.set_param(key, value)

    def _open(self, master_uri: str) -> None:
        """Open the three ports and make what needs their numbers."""
        now_ns, options = self._context.release_ns, self.options
        loop = EventLoop(self._context)
        slave = ApiAcceptor(SlaveApi(self), options.xmlrpc)
        topics, services = TopicAcceptor(self), ServiceAcceptor(self)
        bind_ip = options.bind_ip
        if bind_ip is None:
            bind_ip = own_interface(self.host, ipv6=options.ipv6)
        self._slave_listener = loop.listen(bind_ip, 0, slave)
        self.topic_listener = loop.listen(bind_ip, 0, topics)
        self._service_listener = loop.listen(bind_ip, 0, services)
        for listener in loop.listeners:
            if not listener.open(now_ns):
                raise NodeError(f"{self.name}: {_no_port(bind_ip, listener.status)}.")
        self.uri = make_uri("http", self.host, self._slave_listener.port)
        self._resolver = Resolver(self._context, options.name_servers, ipv6=options.ipv6)
        hosts = HostTable(options.hosts, self._resolver.find, ipv6=options.ipv6)
        api = ApiCaller(loop, hosts, options.xmlrpc)
        master = MasterClient(api, master_uri, self.name, self.uri, self.statuses)
        self.core = NodeCore(self.name, loop, api, master, hosts, options.tcpros, self.statuses)
        self.life = Life(self.core, respawns=options.respawns)

    def _connect_master(self) -> None:
        """Connect to the master now, where it is there: INIT has more time than a cycle."""
        now_ns, core = self._context.release_ns, self.core
        warm_api(now_ns)
        core.api.open(core.master.uri, now_ns, StepBudget(UNPACED))
        for _ in OPTIONS:
            core.loop.step(now_ns, StepBudget(UNPACED))
            core.loop.step_new(now_ns, StepBudget(UNPACED))

    @property
    def now_ns(self) -> int:
        """ROS time of this cycle: nanoseconds since 1970, or simulated; 0 before it is known."""
        return self._time.now_ns(self._context.release_ns)

    @property
    def is_shut_down(self) -> bool:
        """Whether the node ends for good: others ended it, or ``close`` was called."""
        return self.life.is_over

    @property
    def is_closed(self) -> bool:
        """Whether all is taken back and closed."""
        return self.life.state is LifeState.ENDED

    @property
    def is_registered(self) -> bool:
        """Whether the master knows all that shall be registered."""
        return self.core.master.is_registered

    def resolve_name(self, name: str) -> str:
        """Return the global name that the program means, remapped.

        Raises:
            InvalidNameError: not a legal name.
        """
        return self._names.resolve(name)

    # What a program registers

    def register_publisher(
        self,
        topic: str,
        type_name: str,
        *,
        queue_size: int = 10,
        latching: bool = False,
        loop_period_ns: int = 0,
    ) -> Publisher:
        """Publish a topic; call it in INIT, for a type's first use takes milliseconds.

        Args:
            topic: name, resolved and remapped by the node's rules.
            type_name: ``pkg/Name``.
            queue_size: messages that may wait for each subscriber.
            latching: a new subscriber gets the last message at once.
            loop_period_ns: nanoseconds after which ``pop`` gives the next message to fill, 0 for
                never.

        Raises:
            InvalidNameError: not a legal name, or the topic is published already.
            MessageTypeError: the type cannot be had.
        """
        topic = self._new_name(topic, self.publishers)
        message_type = self.types.message(type_name)
        message_type.warm()
        registration = Registration(
            topic,
            ("registerPublisher", [topic, message_type.name, self.uri]),
            ("unregisterPublisher", [topic, self.uri]),
        )
        publisher = self.publishers[topic] = Publisher(
            topic,
            message_type,
            registration,
            queue_size=queue_size,
            latching=latching,
            loop_period_ns=loop_period_ns,
            border=self._border(topic, message_type, is_sent=True, is_latching=latching),
        )
        self._register(registration)
        return publisher

    def register_subscriber(
        self, topic: str, type_name: str, *, queue_size: int = 10, tcp_nodelay: bool = True
    ) -> Subscriber:
        """Subscribe to a topic; arguments and errors as for ``register_publisher``."""
        topic = self._new_name(topic, self.subscribers)
        message_type = self.types.message(type_name)
        message_type.warm()
        registration = Registration(
            topic,
            ("registerSubscriber", [topic, message_type.name, self.uri]),
            ("unregisterSubscriber", [topic, self.uri]),
        )
        subscriber = self.subscribers[topic] = Subscriber(
            topic,
            message_type,
            registration,
            self.core,
            queue_size=queue_size,
            tcp_nodelay=tcp_nodelay,
            border=self._border(topic, message_type),
        )
        registration.on_value = subscriber.registered
        self._register(registration)
        return subscriber

    def _register(self, registration: Registration) -> None:
        """Let the master know; in INIT, which has more time than a cycle, it is told at once."""
        core, now_ns = self.core, self._context.release_ns
        core.master.add(registration)
        if self._is_first and core.api.is_connected(core.master.uri):
            core.master.step(now_ns)
            core.api.step(now_ns, StepBudget(UNPACED))

    def _border(
        self,
        topic: str,
        message_type: MessageType,
        *,
        is_sent: bool = False,
        is_latching: bool = False,
    ) -> Border:
        """Return what tells of the messages of a topic."""
        found = message_type
        told = Topic(
            topic, found.name, found.md5sum, found.full_text, self.name, is_sent, is_latching
        )
        return Border(self.options.traffic, told)

    def register_service_provider(
        self, service: str, type_name: str, *, queue_size: int = 100
    ) -> ServiceProvider:
        """Provide a service; errors as for ``register_publisher``.

        Args:
            service: name, resolved and remapped by the node's rules.
            type_name: ``pkg/Name``.
            queue_size: requests that may wait for the program; further ones are refused.
        """
        service = self._new_name(service, self.providers)
        service_type = self.types.service(type_name)
        service_type.warm()
        uri = make_uri("rosrpc", self.host, self._service_listener.port)
        registration = Registration(
            service,
            ("registerService", [service, uri, self.uri]),
            ("unregisterService", [service, uri]),
        )
        provider = self.providers[service] = ServiceProvider(
            service, service_type, registration, queue_size=queue_size
        )
        self._register(registration)
        return provider

    def register_service_caller(
        self,
        service: str,
        type_name: str,
        *,
        persistent: bool = False,
        queue_size: int = 10,
        loop_period_ns: int = 0,
    ) -> ServiceCaller:
        """Make ready to call a service; errors as for ``register_publisher``.

        Args:
            service: name, resolved and remapped by the node's rules.
            type_name: ``pkg/Name``.
            persistent: keep the connection from call to call.
            queue_size: calls that may wait, and replies.
            loop_period_ns: nanoseconds after which ``pop_packet`` gives the next request to fill.
        """
        service_type = self.types.service(type_name)
        service_type.warm()
        caller = ServiceCaller(
            self.resolve_name(service),
            service_type,
            self.core,
            persistent=persistent,
            queue_size=queue_size,
            loop_period_ns=loop_period_ns,
        )
        self.callers.append(caller)
        return caller

    def subscribe_param(self, name: str, *, queue_size: int = 10) -> ParameterSubscription:
        """Follow a parameter, or all below a namespace."""
        name = self.resolve_name(name)
        registration = Registration(
            name,
            ("subscribeParam", [self.uri, name]),
            ("unsubscribeParam", [self.uri, name]),
        )
        param = ParameterSubscription(name, registration, queue_size=queue_size)
        registration.on_value = param.registered
        self.params.append(param)
        self._register(registration)
        return param

    def unregister(
        self, role: Publisher | Subscriber | ServiceProvider | ServiceCaller | ParameterSubscription
    ) -> None:
        """Take a registration back and end its connections; other roles are not touched.

        A role that was taken back before stays so.
        """
        if isinstance(role, ServiceCaller):
            if role in self.callers:
                self.callers.remove(role)
            role.close()
            return
        self.core.master.remove(role.registration)
        if isinstance(role, Publisher):
            _drop(self.publishers, role.topic, role)
            role.close()
        elif isinstance(role, Subscriber):
            _drop(self.subscribers, role.topic, role)
            role.close()
        elif isinstance(role, ServiceProvider):
            _drop(self.providers, role.service, role)
        elif role in self.params:
            self.params.remove(role)
        for link in self.core.loop.links:
            if role in (
                getattr(link.owner, "publisher", None),
                getattr(link.owner, "provider", None),
            ):
                link.close("unregistered")

    def _new_name(self, name: str, taken: Mapping[str, object]) -> str:
        name = self.resolve_name(name)
        if name in taken:
            raise InvalidNameError(f"{self.name} has {name} already.")
        return name

    # Calls to the master and to other nodes; the result is in the ApiCall when it is there

    def get_param(self, name: str) -> ApiCall:
        """Ask for a parameter or a whole namespace."""
        return self.core.master.call("getParam", [self.resolve_name(name)])

    def set_param(self, name: str, value: Value) -> ApiCall:
        """Set a parameter, or a whole namespace by a dict."""
        return self._change_param("setParam", self.resolve_name(name), value)

    def has_param(self, name: str) -> ApiCall:
        """Ask whether a parameter is set."""
        return self.core.master.call("hasParam", [self.resolve_name(name)])

    def delete_param(self, name: str) -> ApiCall:
        """Delete a parameter or a whole namespace."""
        return self._change_param("deleteParam", self.resolve_name(name))

    def _change_param(self, method: str, name: str, *value: Value) -> ApiCall:
        def done(call: ApiCall) -> None:
            if call.state is CallState.DONE:
                for param in self.params:
                    param.own_change(name, value[0] if value else {})

        return self.core.master.call(method, [name, *value], done)

    def search_param(self, name: str) -> ApiCall:
        """Ask for the name of a parameter, searched from the node's namespace upwards."""
        return self.core.master.call("searchParam", [name])

    def get_param_names(self) -> ApiCall:
        """Ask for the names of all parameters."""
        return self.core.master.call("getParamNames", [])

    def call_master(self, method: str, *params: Value) -> ApiCall:
        """Call any other method of the master API, such as ``getSystemState``."""
        return self.core.master.call(method, list(params))

    def call_node(self, uri: str, method: str, *params: Value) -> ApiCall:
        """Call a method of another node's slave API, such as ``getBusInfo``."""
        return self.core.api.start(ApiCall(uri, method, [self.name, *params]))

    # The step

    def do_events_loop(self) -> None:
        """Do one bounded step; call it once a cycle. It never waits."""
        if self.is_closed:
            return
        clock_ns = self.options.clock_ns
        start_ns = clock_ns() if clock_ns else 0
        now_ns = self._context.release_ns
        self._step(now_ns, self.pace.begin(now_ns))
        if clock_ns:
            self.statistics.record(clock_ns() - start_ns)

    def _step(self, now_ns: int, budget: StepBudget) -> None:
        core = self.core
        core.now_ns, core.budget = now_ns, budget
        if self._is_first:
            self._is_first = False
            core.api.settle(now_ns)
        self._resolver.step()
        core.api.step_first(now_ns, budget)
        core.loop.step(now_ns, budget)
        if self.pace.end(now_ns, budget) and self.pace.is_behind:
            core.tell(StatusKind.BEHIND, self.name, "peers send more than steps can take")
        for publisher in self.publishers.values():
            publisher.tick(now_ns)
        for subscriber in list(self.subscribers.values()):
            subscriber.step(now_ns, budget)
        for caller in self.callers:
            caller.step(now_ns, budget)
        self._rosout.step()
        self._time.step()
        core.api.step(now_ns, budget)
        core.master.step(now_ns)
        core.loop.step_new(now_ns, budget)
        if core.loop.pool.shortages != self._shortages:
            self._tell_shortage(now_ns)
        self.life.step(now_ns)

    def _tell_shortage(self, now_ns: int) -> None:
        """Tell that AsTCP had no ident, but not in every step."""
        pool = self.core.loop.pool
        self._shortages = pool.shortages
        if now_ns >= self._next_shortage_ns:
            self._next_shortage_ns = now_ns + SHORTAGE_NS
            text = f"all {pool.idents} are in use; [library.AsTCP] idents says how many there are"
            self.core.tell(StatusKind.NO_IDENT, self.name, text)

    def pop_status(self) -> Status | None:
        """Return the oldest news, None where there is none."""
        return self.statuses.pop()

    def log(
        self, level: LogLevel, text: str, *, file: str = "", line: int = 0, function: str = ""
    ) -> None:
        """Publish an entry on ``/rosout``, where its level is not below the node's."""
        self._rosout.log(level, text, file, line, function)

    # The end

    def shut_down(self, reason: str) -> None:
        """End the node because others ask for it; with `NodeOptions.respawns` it returns."""
        self.life.kill(reason, self._context.release_ns)
        if not self.is_shut_down:
            for subscriber in self.subscribers.values():
                subscriber.close()

    def close(self) -> None:
        """Begin to take all registrations back; ``do_events_loop`` goes on until ``is_closed``."""
        self.life.close(self._context.release_ns)

    def destroy(self, steps: int | None = None) -> None:
        """Close at once: for EXIT, which has no further cycles.

        Args:
            steps: of the loop at most, those of the options where none are given.
        """
        self.close()
        steps = self.options.closing_steps if steps is None else steps
        while not self.is_closed and steps:
            self.do_events_loop()
            if self.options.beside:
                self.options.beside()
            steps -= 1
        self.life.finish(self._context.release_ns)


def _no_port(bind_ip: str, status: int) -> str:
    """Return why a port cannot be opened."""
    if status == tcpERR_INTERFACE:
        return f'{bind_ip} is no address of this host; bind = "0.0.0.0" in [ros] listens on all'
    return f"no port: AsTCP status {status}"


def _drop(roles: dict[str, Role], name: str, role: Role) -> None:
    """Take a role out, but not another one that has its name by now."""
    if roles.get(name) is role:
        del roles[name]
