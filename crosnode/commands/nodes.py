"""What ``plcsim ros node``, ``service`` and ``param`` do."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

from crosnode.commands.client import PATIENCE_NS, acting
from crosnode.commands.topics import message_of
from crosnode.graph.arguments import parse_parameter
from crosnode.messages.yaml_text import to_yaml
from plcsim.core.errors import PlcError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterable

    from crosnode.commands.client import RosClient


def _print(text: str) -> None:
    sys.stdout.write(text + "\n")


def _names(state: Any) -> list[str]:
    return sorted({name for kind in state for _, names in kind for name in names})


def list_nodes(client: RosClient, _options: argparse.Namespace) -> None:
    """Print the nodes."""
    for name in _names(client.call_master("getSystemState")):
        _print(name)


def tell_node(client: RosClient, options: argparse.Namespace) -> None:
    """Print what a node publishes, subscribes to and provides, and its connections.

    Raises:
        PlcError: the master does not know the node.
    """
    name = client.settings.names.resolve(options.node)
    state = client.call_master("getSystemState")
    types = dict(client.call_master("getTopicTypes"))
    uri = client.call_master("lookupNode", name)
    publications, subscriptions, services = (
        sorted(key for key, names in kind if name in names) for kind in state
    )
    _print(f"Node [{name}]")
    _section("Publications", (f"{topic} [{types.get(topic, '*')}]" for topic in publications))
    _section("Subscriptions", (f"{topic} [{types.get(topic, '*')}]" for topic in subscriptions))
    _section("Services", services)
    _print(f"\nURI: {uri}")
    _print(f"Pid: {client.call(uri, 'getPid', whom=name)}")
    _section("Connections", map(_connection, client.call(uri, "getBusInfo", whom=name)))


def _section(title: str, lines: Iterable[str]) -> None:
    found = list(lines)
    _print(f"\n{title}:" + ("" if found else " None"))
    for line in found:
        _print(f" * {line}")


def _connection(entry: list[Any]) -> str:
    """Return a line for an entry of getBusInfo: id, peer, direction, transport, topic, ..."""
    _, peer, direction, transport, topic, *_ = entry
    way = {"i": "from", "o": "to"}.get(direction, direction)
    return f"{topic} {way} {peer} ({transport})"


def list_services(client: RosClient, _options: argparse.Namespace) -> None:
    """Print the services and who provides them."""
    _, _, services = client.call_master("getSystemState")
    for service, names in sorted(services):
        _print(f"{service} ({', '.join(names)})")


def call_service(client: RosClient, options: argparse.Namespace) -> None:
    """Call a service and print its response.

    Raises:
        PlcError: nobody provides it, its type is not known here, or the call fails.
    """
    name = client.settings.names.resolve(options.service)
    service_type = client.types.service(client.service_type(name))
    request = message_of(client.types, service_type.request, options.value)
    caller = client.node.register_service_caller(name, service_type.name)
    caller.call(request)
    if not client.wait(lambda: caller.replies, 3 * PATIENCE_NS):
        raise PlcError(f"{name}: no reply")
    reply = caller.pop()
    assert reply
    if reply.response is None:
        raise PlcError(f"{name}: {reply.error}")
    sys.stdout.write(to_yaml(client.types, service_type.response, reply.response))


def list_params(client: RosClient, _options: argparse.Namespace) -> None:
    """Print the names of all parameters."""
    for name in sorted(client.call_master("getParamNames")):
        _print(name)


def get_param(client: RosClient, options: argparse.Namespace) -> None:
    """Print a parameter, or all of a namespace, as JSON."""
    value = client.call_master("getParam", client.settings.names.resolve(options.name))
    _print(json.dumps(value, ensure_ascii=False, indent=2, default=str))


def set_param(client: RosClient, options: argparse.Namespace) -> None:
    """Set a parameter: a number, true or false, a list, members in braces, or a text."""
    name = client.settings.names.resolve(options.name)
    client.call_master("setParam", name, parse_parameter(options.value))


def delete_param(client: RosClient, options: argparse.Namespace) -> None:
    """Delete a parameter or a namespace."""
    client.call_master("deleteParam", client.settings.names.resolve(options.name))


node_list = acting(list_nodes)
node_info = acting(tell_node)
service_list = acting(list_services)
service_call = acting(call_service)
param_list = acting(list_params)
param_get = acting(get_param)
param_set = acting(set_param)
param_delete = acting(delete_param)
