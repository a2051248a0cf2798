"""The ROS 1 master and parameter server, as logic without input and output.

A request goes in; the reply comes out, and the calls that must now be made to nodes. All methods
answer ``[code, message, value]`` with code 1 for success, -1 for a fault of the caller and 0 for a
failure. Sources: wiki.ros.org/ROS/Master_API, wiki.ros.org/ROS/Parameter Server API; messages
follow rosmaster where tools read them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

from crosnode.errors import InvalidNameError, MessageTypeError, MessageValueError
from crosnode.graph.names import PRIVATE, SEPARATOR, join, namespace_of
from crosnode.graph.uri import parse_uri
from crosnode.master.parameters import ParameterTree, changes_for, slashed
from crosnode.master.registrations import ANY_TYPE, Graph, RegisteredNode, Registrations, Replaced
from crosnode.messages.definition import split_type_name
from crosnode.xmlrpc import (
    MULTICALL,
    MethodCall,
    MethodFault,
    MethodResponse,
    Value,
    check_value,
    run_multicall,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

MASTER_NAME: Final = "/master"

MAX_NAME: Final = 1000
"""Characters of a name or a URI that the master keeps."""

SUCCESS: Final = 1
ERROR: Final = -1
FAILURE: Final = 0


class OutgoingCall(NamedTuple):
    """A call that the owner must make, after those before it to the same URI."""

    uri: str
    method: str
    params: list[Value]


class MasterAnswer(NamedTuple):
    """The reply to a request, and the calls that it causes."""

    reply: MethodResponse | MethodFault
    calls: list[OutgoingCall]


class MasterLimits(NamedTuple):
    """What nodes may store.

    Attributes:
        max_registrations: publishers, subscribers, services and parameter subscriptions together.
        max_parameters: bytes, roughly, of all parameters.
    """

    max_registrations: int = 20_000
    max_parameters: int = 16 << 20


ApiReply: TypeAlias = tuple[int, str, Any]
Check: TypeAlias = "Callable[[Value, str], Any]"


class Master:
    """A master.

    Args:
        uri: where nodes reach it.
        pid: what getPid answers.
        parameters: what the parameter server holds at the start, by global name.
        limits: see ``MasterLimits``.
    """

    def __init__(
        self,
        uri: str,
        pid: int,
        parameters: Mapping[str, Value] | None = None,
        limits: MasterLimits | None = None,
    ) -> None:
        limits = limits or MasterLimits()
        self.uri = uri
        self.is_shut_down = False
        self._pid = pid
        self._graph = Graph(limits.max_registrations)
        self._parameters = ParameterTree(limits.max_parameters)
        self._calls: list[OutgoingCall] = []
        for name, value in (parameters or {}).items():
            self._parameters.set(name, value)

    def handle(self, call: MethodCall) -> MasterAnswer:
        """Answer a request, ``system.multicall`` included."""
        self._calls = []
        if call.method == MULTICALL:
            reply: MethodResponse | MethodFault = MethodResponse(
                list(run_multicall(call.params, self._answer))
            )
        else:
            reply = self._answer(call)
        return MasterAnswer(reply, self._calls)

    def handle_reply(self, call: OutgoingCall, value: Value) -> None:
        """Take the reply to a call: a node that refuses a parameter is no longer told of it."""
        if call.method != "paramUpdate" or not isinstance(value, list) or value[:1] != [ERROR]:
            return
        key = join(SEPARATOR, str(call.params[1]))
        for node in list(self._graph.parameters.nodes.get(key, [])):
            if node.uri == call.uri:
                self._graph.unregister(self._graph.parameters, key, node)

    def _answer(self, call: MethodCall) -> MethodResponse | MethodFault:
        if call.method == "system.listMethods":
            return MethodResponse([*METHODS, "system.listMethods", MULTICALL])
        method = METHODS.get(call.method)
        if method is None:
            return MethodFault(1, f"method {call.method[:100]!r} is not supported")
        return MethodResponse(list(self._run(method, call.params)))

    def _run(self, method: Method, params: list[Value]) -> ApiReply:
        if not params or not isinstance(params[0], str) or len(params[0]) > MAX_NAME:
            return ERROR, "caller_id must be a string, and no long one", method.fallback
        caller, *rest = params
        if len(rest) != len(method.checks):
            return ERROR, f"expected {len(method.checks) + 1} parameters", method.fallback
        try:
            checked = [
                check(value, caller) for check, value in zip(method.checks, rest, strict=True)
            ]
            return method.run(self, caller, *checked)
        except (InvalidNameError, MessageTypeError, MessageValueError) as error:
            return ERROR, str(error), method.fallback
        except ValueError as error:  # a limit of ours
            return FAILURE, str(error), method.fallback

    def _register(self, kind: Registrations, key: str, node: RegisteredNode) -> None:
        self._shut_down(self._graph.register(kind, key, node))

    def _shut_down(self, replaced: Replaced | None) -> None:
        """Tell a node that another one took its name, and its subscribers that it has gone."""
        if replaced:
            name, uri = replaced.node
            reason = f"[{name}] Reason: new node registered with same name"
            self._calls.append(OutgoingCall(uri, "shutdown", [MASTER_NAME, reason]))
            for topic in replaced.topics:
                self._tell_subscribers(topic)

    def _tell_subscribers(self, topic: str) -> None:
        publishers = self._graph.publishers.uris(topic)
        self._calls += [
            OutgoingCall(uri, "publisherUpdate", [MASTER_NAME, topic, publishers])
            for uri in self._graph.subscribers.uris(topic)
        ]

    def _tell_watchers(self, name: str, value: Value, setter: str | None) -> None:
        """Tell all who subscribed; who set the parameter knows, but not of the parts below it."""
        for subscribed, nodes in self._graph.parameters.nodes.items():
            for change in changes_for(subscribed, name, value):
                knows = setter if change.key == slashed(name) else None
                self._calls += [
                    OutgoingCall(node.uri, "paramUpdate", [MASTER_NAME, *change])
                    for node in nodes
                    if node.name != knows
                ]

    # The master API

    def register_publisher(self, caller: str, topic: str, type_name: str, uri: str) -> ApiReply:
        """Add a publisher, tell the subscribers, and give their URIs."""
        self._register(self._graph.publishers, topic, RegisteredNode(caller, uri))
        self._graph.set_topic_type(topic, type_name, by_publisher=True)
        self._tell_subscribers(topic)
        subscribers = self._graph.subscribers.uris(topic)
        return SUCCESS, f"Registered [{caller}] as publisher of [{topic}]", subscribers

    def unregister_publisher(self, caller: str, topic: str, uri: str) -> ApiReply:
        """Remove a publisher and tell the subscribers."""
        removed = self._graph.unregister(self._graph.publishers, topic, RegisteredNode(caller, uri))
        if removed:
            self._tell_subscribers(topic)
        return _unregistered(caller, topic, removed=removed)

    def register_subscriber(self, caller: str, topic: str, type_name: str, uri: str) -> ApiReply:
        """Add a subscriber and give the URIs of the publishers."""
        self._register(self._graph.subscribers, topic, RegisteredNode(caller, uri))
        self._graph.set_topic_type(topic, type_name, by_publisher=False)
        return SUCCESS, f"Subscribed to [{topic}]", self._graph.publishers.uris(topic)

    def unregister_subscriber(self, caller: str, topic: str, uri: str) -> ApiReply:
        """Remove a subscriber."""
        removed = self._graph.unregister(
            self._graph.subscribers, topic, RegisteredNode(caller, uri)
        )
        return _unregistered(caller, topic, removed=removed)

    def register_service(self, caller: str, service: str, service_uri: str, uri: str) -> ApiReply:
        """Make the caller the provider of a service."""
        self._shut_down(
            self._graph.register_service(service, service_uri, RegisteredNode(caller, uri))
        )
        return SUCCESS, f"Registered [{caller}] as provider of [{service}]", 1

    def unregister_service(self, caller: str, service: str, service_uri: str) -> ApiReply:
        """Remove a provider, where it is still the one."""
        removed = self._graph.unregister_service(service, service_uri, caller)
        return _unregistered(caller, service, removed=removed)

    def lookup_service(self, _caller: str, service: str) -> ApiReply:
        """Give the rosrpc URI of a service."""
        uri = self._graph.service_uris.get(service)
        return (SUCCESS, f"rosrpc URI: [{uri}]", uri) if uri else (ERROR, "no provider", "")

    def lookup_node(self, _caller: str, name: str) -> ApiReply:
        """Give the URI of a node."""
        node = self._graph.find(name)
        return (SUCCESS, "node api", node.uri) if node else (ERROR, f"unknown node [{name}]", "")

    def get_published_topics(self, _caller: str, subgraph: str) -> ApiReply:
        """Give ``[topic, type]`` of all topics with a publisher below a namespace."""
        below = subgraph.rstrip(SEPARATOR) + SEPARATOR
        types = self._graph.topic_types
        topics = [t for t in self._graph.publishers.nodes if t.startswith(below)]
        return SUCCESS, "current topics", [[topic, types[topic]] for topic in topics]

    def get_topic_types(self, _caller: str) -> ApiReply:
        """Give ``[topic, type]`` of all topics."""
        return SUCCESS, "current topic types", [list(it) for it in self._graph.topic_types.items()]

    def get_system_state(self, _caller: str) -> ApiReply:
        """Give publishers, subscribers and services with the names of their nodes."""
        graph = self._graph
        kinds = (graph.publishers, graph.subscribers, graph.services)
        return SUCCESS, "current system state", [kind.state() for kind in kinds]

    def get_uri(self, _caller: str) -> ApiReply:
        """Give the URI of the master."""
        return SUCCESS, "", self.uri

    def get_pid(self, _caller: str) -> ApiReply:
        """Give the process number."""
        return SUCCESS, "", self._pid

    def shutdown(self, _caller: str, _reason: Value) -> ApiReply:
        """Ask the owner to end the master: ``is_shut_down`` is True from here on."""
        self.is_shut_down = True
        return SUCCESS, "shutdown", 0

    # The parameter server API

    def set_param(self, caller: str, name: str, value: Value) -> ApiReply:
        """Set a parameter or a whole namespace."""
        check_value(value)
        self._parameters.set(name, value)
        self._tell_watchers(name, value, caller)
        return SUCCESS, f"parameter {name} set", 0

    def get_param(self, _caller: str, name: str) -> ApiReply:
        """Give a parameter or a whole namespace."""
        try:
            return SUCCESS, f"Parameter [{name}]", self._parameters.get(name)
        except KeyError:
            return ERROR, f"Parameter [{name}] is not set", 0

    def has_param(self, _caller: str, name: str) -> ApiReply:
        """Give whether a parameter is set."""
        return SUCCESS, name, name in self._parameters

    def delete_param(self, _caller: str, name: str) -> ApiReply:
        """Delete a parameter or a whole namespace."""
        try:
            self._parameters.delete(name)
        except KeyError:
            return ERROR, f"parameter [{name}] is not set", 0
        self._tell_watchers(name, {}, None)
        return SUCCESS, f"parameter {name} deleted", 0

    def search_param(self, caller: str, key: str) -> ApiReply:
        """Give the name of a parameter, searched from the caller's name upwards."""
        name = self._parameters.search(join(SEPARATOR, caller), key)
        if name is None:
            return ERROR, f"Cannot find parameter [{key}] in an upwards search", ""
        return SUCCESS, f"Found [{name}]", name

    def get_param_names(self, _caller: str) -> ApiReply:
        """Give the names of all parameters."""
        return SUCCESS, "Parameter names", self._parameters.names()

    def subscribe_param(self, caller: str, uri: str, name: str) -> ApiReply:
        """Add a watcher and give the value, an empty dictionary where there is none."""
        self._register(self._graph.parameters, name, RegisteredNode(caller, uri))
        value = self._parameters.get(name) if name in self._parameters else {}
        return SUCCESS, f"Subscribed to parameter [{name}]", value

    def unsubscribe_param(self, caller: str, uri: str, name: str) -> ApiReply:
        """Remove a watcher."""
        removed = self._graph.unregister(self._graph.parameters, name, RegisteredNode(caller, uri))
        return _unregistered(caller, name, removed=removed)


def _unregistered(caller: str, key: str, *, removed: bool) -> ApiReply:
    if removed:
        return SUCCESS, f"Unregistered [{caller}] as provider of [{key}]", 1
    return SUCCESS, f"[{caller}] is not a known provider of [{key}]", 0


def _text(value: Value, _caller: str) -> str:
    if not isinstance(value, str) or not value:
        raise InvalidNameError("ERROR: parameter must be a non-empty string")
    if len(value) > MAX_NAME:
        raise InvalidNameError(f"ERROR: {value[:100]!r}... is longer than {MAX_NAME}")
    return value


def _name(value: Value, caller: str) -> str:
    """Resolve a name in the caller's namespace; any characters, as rosmaster takes them."""
    name, node = _text(value, caller), join(SEPARATOR, caller)
    if name.startswith(PRIVATE):
        return join(node, name[1:].lstrip(SEPARATOR))
    return join(namespace_of(node), name)


def _graph_name(value: Value, caller: str) -> str:
    name = _name(value, caller)
    if ":" in name or " " in name or name == SEPARATOR:
        raise InvalidNameError(f"ERROR: {name[:100]!r} is not the name of a topic or a service")
    return name


def _subgraph(value: Value, caller: str) -> str:
    return _name(value, caller) if value else SEPARATOR


def _type_name(value: Value, caller: str) -> str:
    text = _text(value, caller)
    return text if text == ANY_TYPE else "/".join(split_type_name(text))


def _uri(value: Value, caller: str) -> str:
    parse_uri(_text(value, caller), "http")
    return str(value)


def _service_uri(value: Value, caller: str) -> str:
    parse_uri(_text(value, caller), "rosrpc")
    return str(value)


def _any(value: Value, _caller: str) -> Value:
    return value


class Method(NamedTuple):
    """A method: what answers it, how its parameters are checked, and its value on an error."""

    run: Callable[..., ApiReply]
    checks: tuple[Check, ...]
    fallback: Value


METHODS: Final[dict[str, Method]] = {
    "registerPublisher": Method(Master.register_publisher, (_graph_name, _type_name, _uri), []),
    "unregisterPublisher": Method(Master.unregister_publisher, (_graph_name, _uri), 0),
    "registerSubscriber": Method(Master.register_subscriber, (_graph_name, _type_name, _uri), []),
    "unregisterSubscriber": Method(Master.unregister_subscriber, (_graph_name, _uri), 0),
    "registerService": Method(Master.register_service, (_graph_name, _service_uri, _uri), 0),
    "unregisterService": Method(Master.unregister_service, (_graph_name, _service_uri), 0),
    "lookupService": Method(Master.lookup_service, (_graph_name,), ""),
    "lookupNode": Method(Master.lookup_node, (_name,), ""),
    "getPublishedTopics": Method(Master.get_published_topics, (_subgraph,), []),
    "getTopicTypes": Method(Master.get_topic_types, (), []),
    "getSystemState": Method(Master.get_system_state, (), [[], [], []]),
    "getUri": Method(Master.get_uri, (), ""),
    "getPid": Method(Master.get_pid, (), -1),
    "shutdown": Method(Master.shutdown, (_any,), 0),
    "setParam": Method(Master.set_param, (_name, _any), 0),
    "getParam": Method(Master.get_param, (_name,), 0),
    "hasParam": Method(Master.has_param, (_name,), fallback=False),
    "deleteParam": Method(Master.delete_param, (_name,), 0),
    "searchParam": Method(Master.search_param, (_text,), ""),
    "getParamNames": Method(Master.get_param_names, (), []),
    "subscribeParam": Method(Master.subscribe_param, (_uri, _name), 0),
    "unsubscribeParam": Method(Master.unsubscribe_param, (_uri, _name), 0),
}
"""The master API and the parameter server API."""
