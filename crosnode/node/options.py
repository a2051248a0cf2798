"""What a node may take, and where it listens."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

from crosnode.graph.dns import NameServers
from crosnode.tcpros import TcprosLimits
from crosnode.xmlrpc import XmlRpcLimits

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from crosnode.node.ros_time import Epoch
    from crosnode.transport.budget import StepLimits
    from plcsim.core.traffic import Traffic


class NodeOptions(NamedTuple):
    """What a node may take and where it listens.

    Attributes:
        step: bounds of one step; those that a mapping does not name are the default's, times the
            milliseconds of the cycle.
        tcpros: bounds of a topic or service connection.
        xmlrpc: bounds of an XML-RPC connection.
        bind_ip: own interface to listen on, "" for all, None for that of the node's host.
        ipv6: names stand for addresses of IPv6: ``localhost``, all interfaces, and those that name
            servers are asked for.
        hosts: addresses of host names.
        name_servers: who is asked for other names.
        epoch: turns releases into nanoseconds since 1970, None for those that are so already.
        clock_ns: measures the step for ``statistics``; None measures nothing.
        respawns: whether the node returns when others end it.
        closing_steps: of the loop in ``destroy`` at most, within which the master can let the node
            go.
        traffic: is told of all messages; None for nobody.
        beside: called between the steps of ``destroy``: an embedded master that must answer.
    """

    step: StepLimits | Mapping[str, int] = MappingProxyType({})
    tcpros: TcprosLimits = TcprosLimits(max_message=16 << 20)
    xmlrpc: XmlRpcLimits = XmlRpcLimits()
    bind_ip: str | None = None
    ipv6: bool = False
    hosts: Mapping[str, str] | None = None
    name_servers: NameServers = NameServers()
    epoch: Epoch | None = None
    clock_ns: Callable[[], int] | None = None
    respawns: bool = False
    closing_steps: int = 20_000
    traffic: Traffic | None = None
    beside: Callable[[], None] | None = None
