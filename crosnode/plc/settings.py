"""Table [ros] of plc.toml: the master, the host, packages, and the bridge without code."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.errors import CrosnodeError
from crosnode.graph.arguments import node_settings, parse_arguments
from crosnode.graph.hosts import parse_hosts
from crosnode.graph.names import check_base_name, check_name
from crosnode.graph.uri import DEFAULT_PORT, make_uri, parse_uri
from crosnode.node.parameter import check_parameters
from plcsim.network.protocol import is_ipv4
from plcsim.project.plc_toml import FILE_NAME
from plcsim.settings.table import Table

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

EMBEDDED: Final = "embedded"


class Publication(NamedTuple):
    """An entry of [ros.publish]: a tag that is published.

    Attributes:
        topic: name, resolved by the bridge's node.
        tag: path of the tag.
        type_name: ``pkg/Name``.
        every_ns: nanoseconds between two messages, 0 for one in each cycle.
        on_change: only when the tag has another value than in the last message.
    """

    topic: str
    tag: str
    type_name: str
    every_ns: int
    on_change: bool


class Subscription(NamedTuple):
    """An entry of [ros.subscribe]: a tag that takes the newest message; fields as above."""

    topic: str
    tag: str
    type_name: str


class RosSettings(NamedTuple):
    """What [ros] says.

    Attributes:
        file: plc.toml, for errors.
        master_uri: of the master.
        is_embedded: whether the project brings the master.
        is_in_process: whether an embedded master runs in the scan, and not in a process beside it.
        master_port: of the embedded master.
        host: name or number under which nodes are reached.
        bind_ip: own interface to listen on, "" for all.
        namespace: of nodes, "" where the table names none.
        arguments: remapping arguments.
        packages: folders of message packages, searched first.
        hosts: addresses of host names.
        node: name of the bridge's node.
        publish: tags to topics.
        subscribe: topics to tags.
        environment: ROS_* variables of the process.
    """

    file: Path
    master_uri: str
    is_embedded: bool
    is_in_process: bool
    master_port: int
    host: str
    bind_ip: str
    namespace: str
    arguments: tuple[str, ...]
    packages: tuple[Path, ...]
    hosts: Mapping[str, str]
    node: str
    publish: tuple[Publication, ...]
    subscribe: tuple[Subscription, ...]
    environment: Mapping[str, str]


def read_settings(
    table: Table, folder: Path, environment: Mapping[str, str], hosts_text: str = ""
) -> RosSettings:
    """Read [ros].

    Args:
        table: of plc.toml.
        folder: of the project; packages are relative to it.
        environment: ROS_MASTER_URI, ROS_IP, ROS_HOSTNAME, ROS_NAMESPACE and ROS_PACKAGE_PATH are
            read where the table does not say.
        hosts_text: in the form of /etc/hosts.

    Raises:
        ConfigurationError: something is wrong; file and field are named.
    """
    arguments = table.strings("arguments")
    try:
        own = node_settings("x", arguments, environment, host="127.0.0.1")
        check_parameters(parse_arguments(arguments).parameters)
    except CrosnodeError as error:
        raise table.error("arguments", str(error)) from None
    if "name" in parse_arguments(arguments).special:
        raise table.error("arguments", "__name would give all nodes of the project one name")
    host = table.take("host", str, own.host)
    port = table.number("master_port", DEFAULT_PORT, 1, 65_535)
    _checked(table, "host", lambda: parse_uri(make_uri("http", host, port), "http"))
    master = table.take("master", str, own.master_uri)
    is_embedded = master == EMBEDDED
    if not is_embedded:
        _checked(table, "master", lambda: parse_uri(master, "http"))
    hosts = parse_hosts(hosts_text) | _hosts(table)
    return RosSettings(
        file=folder / FILE_NAME,
        master_uri=make_uri("http", host, port) if is_embedded else master,
        is_embedded=is_embedded,
        is_in_process=False,
        master_port=port,
        host=host,
        bind_ip=_bind_ip(table),
        namespace=_namespace(table),
        arguments=arguments,
        packages=_packages(table, folder, environment),
        hosts=hosts,
        node=_node(table),
        publish=tuple(_publication(*entry) for entry in _entries(table, folder, "publish")),
        subscribe=tuple(_subscription(*entry) for entry in _entries(table, folder, "subscribe")),
        environment=environment,
    )


def _namespace(table: Table) -> str:
    namespace = table.take("namespace", str, "")
    _checked(table, "namespace", lambda: node_settings("x", namespace=namespace))
    return namespace


def _node(table: Table) -> str:
    node = table.take("node", str, "plc_bridge")
    _checked(table, "node", lambda: check_base_name(node))
    return node


def _bind_ip(table: Table) -> str:
    ip = table.take("bind", str, "")
    if ip and not is_ipv4(ip):
        raise table.error("bind", f"{ip!r} is not an IPv4 address")
    return ip


def _checked(table: Table, key: str, check: Callable[[], object]) -> None:
    try:
        check()
    except CrosnodeError as error:
        raise table.error(key, str(error)) from None


def _name(table: Table, key: str, name: str) -> str:
    _checked(table, key, lambda: check_name(name))
    return name


def _hosts(table: Table) -> dict[str, str]:
    hosts = table.take("hosts", dict, {})
    for name, ip in hosts.items():
        if not isinstance(ip, str) or not is_ipv4(ip):
            raise table.error(f"hosts.{name}", f"{ip!r} is not an IPv4 address")
    return {name.lower(): ip for name, ip in hosts.items()}


def _packages(table: Table, folder: Path, environment: Mapping[str, str]) -> tuple[Path, ...]:
    own = [folder / name for name in table.strings("packages")]
    for path in own:
        if not path.is_dir():
            raise table.error("packages", f"{path}: there is no such folder")
    others = environment.get("ROS_PACKAGE_PATH", "").split(":")
    return (*own, *(Path(path) for path in others if path))


def _entries(table: Table, folder: Path, key: str) -> Iterator[tuple[str, Table]]:
    """Iterate over the topics of [ros.publish] or [ros.subscribe] and their tables."""
    for topic, values in table.take(key, dict, {}).items():
        entry = Table(folder / FILE_NAME, f"ros.{key}.{topic}", values)
        _name(entry, "", topic)
        yield topic, entry


def _publication(topic: str, entry: Table) -> Publication:
    publication = Publication(
        topic,
        _required(entry, "tag"),
        _required(entry, "type"),
        entry.duration_ns("every", 0),
        on_change=entry.take("on_change", bool, default=False),
    )
    entry.finish()
    return publication


def _subscription(topic: str, entry: Table) -> Subscription:
    subscription = Subscription(topic, _required(entry, "tag"), _required(entry, "type"))
    entry.finish()
    return subscription


def _required(table: Table, key: str) -> str:
    value = table.take(key, str, "")
    if not value:
        raise table.error(key, "is missing")
    return value
