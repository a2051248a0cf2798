"""Arguments and environment of a node, and the settings that they make.

Source: wiki.ros.org/Remapping Arguments, wiki.ros.org/ROS/EnvironmentVariables. Nothing here reads
the process: arguments and environment are handed in.
"""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

from crosnode.errors import InvalidNameError
from crosnode.graph.flow_yaml import Value, parse_flow, plain_value
from crosnode.graph.names import (
    PRIVATE,
    SEPARATOR,
    NodeNames,
    check_base_name,
    check_name,
    join,
    resolve,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

REMAP: Final = ":="
DEFAULT_MASTER_URI: Final = "http://localhost:11311/"

Parameter: TypeAlias = bool | int | float | str | list[object] | dict[str, object]


class Arguments(NamedTuple):
    """Command-line arguments of a node, sorted out.

    Attributes:
        remappings: ``a:=b``, as written.
        parameters: ``_p:=v``, by the name without its underscore.
        special: ``__name:=n`` and the like, by the name without its underscores.
        rest: everything else.
    """

    remappings: dict[str, str]
    parameters: dict[str, Parameter]
    special: dict[str, str]
    rest: list[str]


def parse_arguments(arguments: Iterable[str]) -> Arguments:
    """Sort out remapping arguments.

    Raises:
        InvalidNameError: one side of a remapping is not a legal name.
    """
    found = Arguments({}, {}, {}, [])
    for argument in arguments:
        left, remap, right = argument.partition(REMAP)
        if not remap:
            found.rest.append(argument)
        elif left.startswith("__"):
            found.special[left[2:]] = right
        elif left.startswith("_"):
            found.parameters[check_name(left[1:])] = parse_parameter(right)
        else:
            found.remappings[check_name(left)] = check_name(right)
    return found


def parse_parameter(text: str) -> Parameter:
    """Return the value that an argument stands for: number, bool, list, members, or text."""
    value: Value = text
    if text[:1] in ("[", "{"):
        with suppress(ValueError, RecursionError):
            value = parse_flow(text)
    else:
        value = plain_value(text)
    return value if value is not None and not isinstance(value, str) else text


class NodeSettings(NamedTuple):
    """What a node starts with.

    Attributes:
        names: its names and remappings.
        master_uri: URI of the master.
        host: name or number under which others reach it.
        parameters: values for its private parameters, by resolved name.
        arguments: arguments that are no remapping.
    """

    names: NodeNames
    master_uri: str
    host: str
    parameters: dict[str, Parameter]
    arguments: list[str]


def node_settings(
    name: str,
    arguments: Iterable[str] = (),
    environment: Mapping[str, str] | None = None,
    *,
    namespace: str = "",
    host: str = "localhost",
) -> NodeSettings:
    """Return the settings of a node; arguments go before the environment, that before defaults.

    Args:
        name: base name of the node.
        arguments: remapping arguments; ``__name``, ``__ns``, ``__master``, ``__hostname`` and
            ``__ip`` are read, other special ones left.
        environment: ROS_MASTER_URI, ROS_NAMESPACE, ROS_HOSTNAME and ROS_IP are read.
        namespace: the default for ROS_NAMESPACE.
        host: the default for ROS_HOSTNAME and ROS_IP.

    Raises:
        InvalidNameError: a name or a namespace is not legal.
    """
    given = parse_arguments(arguments)
    environment = environment or {}
    names = _node_names(
        check_base_name(given.special.get("name", name)),
        given.special.get("ns") or environment.get("ROS_NAMESPACE") or namespace,
        given.remappings,
    )
    hosts = (
        given.special.get("hostname"),
        given.special.get("ip"),
        environment.get("ROS_HOSTNAME"),
        environment.get("ROS_IP"),
    )
    return NodeSettings(
        names,
        given.special.get("master") or environment.get("ROS_MASTER_URI") or DEFAULT_MASTER_URI,
        next(filter(None, hosts), host),
        {join(names.node, key): value for key, value in given.parameters.items()},
        given.rest,
    )


def _node_names(name: str, namespace: str, remappings: Mapping[str, str]) -> NodeNames:
    namespace = join(SEPARATOR, check_name(namespace or SEPARATOR))
    if PRIVATE in namespace:
        raise InvalidNameError(f"namespace {namespace!r} is private.")
    node = join(namespace, name)
    resolved = {
        resolve(left, namespace, node): resolve(right, namespace, node)
        for left, right in remappings.items()
    }
    return NodeNames(node, namespace, resolved)
