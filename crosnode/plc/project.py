"""Nodes of programs: ``create_node`` in INIT, with what [ros] in plc.toml says.

The settings lie in the controller's context, where `crosnode.plc.extension` put
them; without a table [ros] the ROS_* environment counts.
"""

from __future__ import annotations

import os
import time
from dataclasses import fields
from functools import partial
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.graph.arguments import NodeSettings, node_settings
from crosnode.graph.hosts import is_ipv6_wanted, loopback
from crosnode.messages import MessageTypes
from crosnode.node import CrosNode, NodeOptions
from crosnode.node.ros_time import Epoch
from crosnode.plc.node_watch import NodeWatch
from crosnode.tcpros import TcprosLimits
from crosnode.xmlrpc import ValueLimits, XmlRpcLimits
from plcsim.network import OsNetwork, network_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.master.server import MasterServer
    from crosnode.plc.settings import RosSettings, StepTable
    from crosnode.transport.budget import StepLimits
    from plcsim.core.context import Context

MASTER_IP: Final = "192.168.0.1"
"""Where tests have the master, unless it is embedded (`crosnode.testing.Ros`)."""

VIRTUAL_CLOSING_STEPS: Final = 1_000
"""Virtual time stands still in EXIT: what has not come by then will not come."""


class RosContext(NamedTuple):
    """What the extension knows of the controller.

    Attributes:
        settings: table [ros].
        epoch: turns releases into nanoseconds since 1970.
        clock_ns: measures steps.
        master: the embedded master, where it runs in the scan.
        beside: steps the other hosts of a test, which answer nothing while no cycle ends.
    """

    settings: RosSettings
    epoch: Epoch
    clock_ns: Callable[[], int]
    master: Callable[[Context], MasterServer] | None = None
    beside: Callable[[], None] | None = None


def surroundings(context: Context) -> RosContext | None:
    """Return what the extension left, None where the project has no table [ros]."""
    return context.settings(RosContext)


class SharedTypes(MessageTypes):
    """The message types of one controller, read and compiled once for all its nodes.

    Args:
        context: of the controller.
    """

    def __init__(self, context: Context) -> None:
        found = surroundings(context)
        super().__init__(found.settings.packages if found else ())


def create_node(
    context: Context,
    name: str,
    *arguments: str,
    namespace: str = "",
    step: StepLimits | None = None,
) -> CrosNode:
    """Make a node; call it in INIT, and ``do_events_loop`` of the node in CYCLIC.

    Args:
        context: of the program.
        name: base name of the node.
        arguments: remapping arguments such as ``chatter:=/other``, beside those of [ros].
        namespace: of the node, where [ros] and the environment name none.
        step: bounds of one step, by default those of [ros.step].

    Raises:
        InvalidNameError: a name is not legal.
        MessageValueError: an argument sets a parameter to a value that XML-RPC cannot carry.
        NodeError: no port can be opened.
    """
    node = make_node(context, name, *arguments, namespace=namespace, step=step)
    context.library(NodeWatch).add(node)
    return node


def make_node(
    context: Context,
    name: str,
    *arguments: str,
    namespace: str = "",
    step: StepLimits | None = None,
) -> CrosNode:
    """Make a node that nobody watches; for the rest see ``create_node``."""
    found = surroundings(context)
    options = NodeOptions() if step is None else NodeOptions(step=step)
    if not is_real(context):
        options = options._replace(closing_steps=VIRTUAL_CLOSING_STEPS)
    if found is None:
        ipv6 = is_ipv6_wanted(os.environ)
        settings = node_settings(
            name, arguments, os.environ, namespace=namespace, host=loopback(ipv6=ipv6)
        )
        options = options._replace(epoch=_epoch_now(context), ipv6=ipv6)
        return CrosNode(context, settings, context.library(SharedTypes), options)
    ros = found.settings
    options = options._replace(
        bind_ip=ros.bind_ip,
        ipv6=ros.ipv6,
        hosts=ros.hosts,
        name_servers=ros.name_servers,
        epoch=found.epoch,
        clock_ns=found.clock_ns,
        respawns=ros.table.respawn,
        tcpros=TcprosLimits(
            max_message=ros.table.limits.message, timeout_ns=ros.table.limits.service_timeout_ns
        ),
        xmlrpc=XmlRpcLimits(values=_values(ros.table.limits.parameter)),
        traffic=context.traffic,
        beside=partial(step_beside, context),
    )
    if step is None:
        options = options._replace(step=_step(ros.table.step))
    settings = _settings(ros, name, arguments, namespace)
    return CrosNode(context, settings, context.library(SharedTypes), options)


def _step(table: StepTable) -> dict[str, int]:
    """Return the bounds that [ros.step] names."""
    found = {each.name: getattr(table, each.name) for each in fields(table)}
    return {name: bound for name, bound in found.items() if bound is not None}


def _values(size: int) -> ValueLimits:
    """Return the limits of a document of ``size`` bytes; a large one may have more elements."""
    default = ValueLimits()
    elements = default.max_elements * max(1, size // default.max_size)
    return ValueLimits(max_size=size, max_elements=elements)


def _epoch_now(context: Context) -> Epoch:
    """Return the epoch of a controller whose clock only its releases tell."""
    return Epoch(time.time_ns() - time.monotonic_ns() if is_real(context) else 0)


def is_real(context: Context) -> bool:
    """Whether a controller is on the host's network, and with it on the host's clock."""
    return isinstance(network_of(context), OsNetwork)


def step_beside(context: Context) -> None:
    """Step what must answer a node that waits in EXIT: a master in the scan, hosts of a test."""
    found = surroundings(context)
    if found and found.master:
        context.library(found.master).step()
    if found and found.beside:
        found.beside()


def _settings(
    ros: RosSettings, name: str, arguments: tuple[str, ...], namespace: str
) -> NodeSettings:
    """Return the node's settings; [ros] goes before the environment."""
    given = [*ros.table.arguments, *arguments]
    own = ros.table.namespace
    environment = {"ROS_NAMESPACE": own} if own else ros.environment
    found = node_settings(name, given, environment, namespace=namespace)
    return found._replace(master_uri=ros.master_uri, host=ros.host)
