"""Table [ros] of plc.toml: the master, the host, packages, and the bridge without code."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from crosnode.errors import CrosnodeError
from crosnode.graph.arguments import node_settings, parse_arguments
from crosnode.graph.dns import NameServers
from crosnode.graph.hosts import is_ipv6_wanted, loopback, parse_hosts
from crosnode.graph.names import check_base_name, check_name
from crosnode.graph.uri import DEFAULT_PORT, make_uri, parse_uri
from crosnode.node.parameter import check_parameters
from plcsim.core.errors import Findings
from plcsim.network.protocol import is_ip
from plcsim.project.project_file import FILE_NAME
from plcsim.settings import Converted, Duration, Key, PathTo, Size, Whole, settings

if TYPE_CHECKING:
    from plcsim.settings import Table

EMBEDDED: Final = "embedded"
NO_SERVERS: Final = NameServers()
MOST: Final = 1 << 30
"""Of anything that bounds a step."""


def _ip(text: str) -> str:
    if not is_ip(text):
        raise ValueError(f"{text!r} is not an IP address")
    return text


def _master(text: str) -> str:
    if text != EMBEDDED:
        parse_uri(text, "http")
    return text


def _host(text: str) -> str:
    return parse_uri(make_uri("http", text, DEFAULT_PORT), "http").host


def _namespace(text: str) -> str:
    node_settings("x", namespace=text)
    return text


def _arguments_fault(arguments: tuple[str, ...]) -> str:
    """Return what is wrong with remapping arguments, "" where nothing is."""
    try:
        found = parse_arguments(arguments)
        node_settings("x", arguments)
        check_parameters(found.parameters)
    except CrosnodeError as error:
        return str(error)
    if "name" in found.special:
        return "__name would give all nodes of the project one name"
    return ""


@settings
class Publication:
    """An entry of [ros.publish]: a tag that is published.

    Attributes:
        tag: path of the tag.
        type_name: ``pkg/Name``.
        every_ns: nanoseconds between two messages, 0 for one in each cycle.
        on_change: only when the tag has another value than in the last message.
        status: path of a tag that is told whether anybody listens (`BridgeStatus`).
    """

    tag: str
    type_name: Annotated[str, Key("type")]
    every_ns: Annotated[int, Duration()] = 0
    on_change: bool = False
    status: str | None = None


@settings
class Subscription:
    """An entry of [ros.subscribe]: a tag that takes the newest message.

    Attributes:
        tag: path of the tag.
        type_name: ``pkg/Name``.
        timeout_ns: nanoseconds after which the last message is old; 0 leaves it good as long as a
            publisher is connected.
        status: path of a tag that is told how good the value is (`BridgeStatus`).
        age: path of a TIME tag that is told how old the value is.
    """

    tag: str
    type_name: Annotated[str, Key("type")]
    timeout_ns: Annotated[int, Duration()] = 0
    status: str | None = None
    age: str | None = None


@settings
class ParameterEntry:
    """An entry of [ros.parameters]: a tag that follows a parameter."""

    tag: str


@settings
class ServiceEntry:
    """An entry of [ros.services]: a service that a program answers by tags.

    Attributes:
        type_name: ``pkg/Name``.
        call: path of a BOOL tag that is set for a request; the program resets it when it has one
            answer.
        request: path of the tag that takes the request, None where nobody wants it.
        response: path of the tag that is the response, None for one of defaults.
        timeout_ns: nanoseconds that the program has for an answer.
    """

    type_name: Annotated[str, Key("type")]
    call: str
    request: str | None = None
    response: str | None = None
    timeout_ns: Annotated[int, Duration(minimum_ns=1)] = 5_000_000_000


@settings
class CallEntry:
    """An entry of [ros.calls]: a service of others that a program calls by tags.

    Attributes:
        type_name: ``pkg/Name``.
        call: path of a BOOL tag that the program sets; it is reset when the call is over.
        request: path of the tag that is the request, None for one of defaults.
        response: path of the tag that takes the response, None where nobody wants it.
        status: path of a tag that is told what came of it (`CallStatus`).
        timeout_ns: nanoseconds after which a call has failed.
    """

    type_name: Annotated[str, Key("type")]
    call: str
    request: str | None = None
    response: str | None = None
    status: str | None = None
    timeout_ns: Annotated[int, Duration(minimum_ns=1)] = 5_000_000_000


@settings
class StepTable:
    """The keys of [ros.step]: bounds of one step of each node, as in `StepLimits`.

    Those that are given hold for each step as they are, whatever its cycle is; the others are the
    default's, times the milliseconds of the cycle.
    """

    bytes_in: Annotated[int, Whole(1, MOST)] | None = None
    bytes_out: Annotated[int, Whole(1, MOST)] | None = None
    bytes_parsed: Annotated[int, Whole(1, MOST)] | None = None
    messages: Annotated[int, Whole(1, MOST)] | None = None
    accepts: Annotated[int, Whole(1, MOST)] | None = None
    calls: Annotated[int, Whole(1, MOST)] | None = None
    polls: Annotated[int, Whole(1, MOST)] | None = None
    work: Annotated[int, Whole(1, MOST)] | None = None


@settings
class LimitsTable:
    """The keys of [ros.limits]: what is beyond is refused, and told once.

    Attributes:
        message: bytes of a message, a request or a response that is received.
        service_timeout_ns: nanoseconds that a provider may take for an answer.
        parameter: bytes of a parameter, or of all below a namespace, as XML-RPC carries it.
    """

    message: Annotated[int, Size(1 << 10, MOST)] = 16 << 20
    service_timeout_ns: Annotated[int, Duration(minimum_ns=1_000_000)] = 10_000_000_000
    parameter: Annotated[int, Size(1 << 10, MOST)] = 4 << 20


@settings
class RosTable:
    """The keys of [ros].

    Attributes:
        master: URI of the master, or "embedded"; None for that of the environment.
        master_port: of the embedded master.
        host: name or number under which nodes are reached, None for that of the environment.
        bind: own interface to listen on, None for that of ``host``.
        namespace: of nodes, "" where the table names none.
        arguments: remapping arguments.
        packages: folders of message packages, searched first.
        ipv6: whether names stand for addresses of IPv6; None for ROS_IPV6 of the environment.
        hosts: addresses by host name.
        respawn: whether nodes return that others end: rosnode kill, or another of their name.
        step: bounds of one step.
        limits: of what comes in.
        node: base name of the bridge's node.
        publish: tags to topics, by topic.
        subscribe: topics to tags, by topic.
        parameters: parameters to tags, by name.
        services: services by tags, by name.
        calls: services of others that are called by tags, by name.
    """

    master: Annotated[str | None, Converted(_master)] = None
    master_port: Annotated[int, Whole(1, 65_535)] = DEFAULT_PORT
    host: Annotated[str | None, Converted(_host)] = None
    bind: Annotated[str | None, Converted(_ip)] = None
    ipv6: bool | None = None
    namespace: Annotated[str, Converted(_namespace)] = ""
    arguments: tuple[str, ...] = ()
    packages: tuple[Annotated[Path, PathTo("folder")], ...] = ()
    hosts: Mapping[str, Annotated[str, Converted(_ip)]] = field(default_factory=dict)
    respawn: bool = False
    step: StepTable = StepTable()
    limits: LimitsTable = LimitsTable()
    node: Annotated[str, Converted(check_base_name)] = "plc_bridge"
    publish: Mapping[str, Publication] = field(default_factory=dict)
    subscribe: Mapping[str, Subscription] = field(default_factory=dict)
    parameters: Mapping[str, ParameterEntry] = field(default_factory=dict)
    services: Mapping[str, ServiceEntry] = field(default_factory=dict)
    calls: Mapping[str, CallEntry] = field(default_factory=dict)

    @property
    def has_bridge(self) -> bool:
        """Whether anything goes between tags and ROS without code."""
        tables = (self.publish, self.subscribe, self.parameters, self.services, self.calls)
        return any(tables)


@dataclass(frozen=True)
class RosSettings:
    """What [ros] and the environment say together.

    Attributes:
        file: plc.toml, for errors.
        table: the keys.
        master_uri: of the master.
        host: name or number under which nodes are reached.
        bind_ip: own interface to listen on, "" for all, None for that of ``host``.
        ipv6: whether names stand for addresses of IPv6.
        packages: folders of message packages, those of the table first.
        hosts: addresses of host names.
        environment: ROS_* variables of the process.
        name_servers: who is asked for names that ``hosts`` has not.
        is_in_process: whether an embedded master runs in the scan, and not in a process beside it.
    """

    file: Path
    table: RosTable
    master_uri: str
    host: str
    bind_ip: str | None
    packages: tuple[Path, ...]
    hosts: Mapping[str, str]
    environment: Mapping[str, str]
    is_in_process: bool = False
    ipv6: bool = False
    name_servers: NameServers = NO_SERVERS

    @property
    def is_embedded(self) -> bool:
        """Whether the project brings the master."""
        return self.table.master == EMBEDDED


def read_settings(
    table: Table, environment: Mapping[str, str], hosts_text: str = ""
) -> RosSettings:
    """Read [ros].

    Args:
        table: of plc.toml.
        environment: ROS_MASTER_URI, ROS_IP, ROS_HOSTNAME, ROS_IPV6, ROS_NAMESPACE and
            ROS_PACKAGE_PATH are read where the table does not say.
        hosts_text: in the form of /etc/hosts.

    Raises:
        ConfigurationError: something is wrong; file and fields are named.
    """
    keys = table.read(RosTable)
    _check(table, keys)
    ipv6 = is_ipv6_wanted(environment) if keys.ipv6 is None else keys.ipv6
    own = node_settings("x", keys.arguments, environment, host=loopback(ipv6=ipv6))
    host = keys.host or own.host
    embedded = make_uri("http", host, keys.master_port)
    others = environment.get("ROS_PACKAGE_PATH", "").split(":")
    return RosSettings(
        file=table.folder / FILE_NAME,
        table=keys,
        master_uri=embedded if keys.master == EMBEDDED else keys.master or own.master_uri,
        host=host,
        bind_ip=keys.bind,
        packages=(*keys.packages, *(Path(path) for path in others if path)),
        ipv6=ipv6,
        hosts=parse_hosts(hosts_text, ipv6=ipv6)
        | {name.lower(): ip for name, ip in keys.hosts.items()},
        environment=environment,
    )


def _check(table: Table, keys: RosTable) -> None:
    """Check what no single key can say."""
    findings = Findings()
    if fault := _arguments_fault(keys.arguments):
        findings.add(table.error("arguments", fault))
    for key in ("publish", "subscribe", "parameters", "services", "calls"):
        for name in getattr(keys, key):
            try:
                check_name(name)
            except CrosnodeError as error:
                findings.add(table.error(f"{key}.{name}", str(error)))
    findings.check()
