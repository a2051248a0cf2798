"""What a node may take, and where it listens."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from crosnode.tcpros import TcprosLimits
from crosnode.transport.budget import StepLimits
from crosnode.xmlrpc import XmlRpcLimits

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from crosnode.node.ros_time import Epoch


class NodeOptions(NamedTuple):
    """What a node may take and where it listens.

    Attributes:
        step: bounds of one step.
        tcpros: bounds of a topic or service connection.
        xmlrpc: bounds of an XML-RPC connection.
        bind_ip: own interface to listen on, "" for all, None for that of the node's host.
        hosts: addresses of host names.
        epoch: turns releases into nanoseconds since 1970, None for those that are so already.
        clock_ns: measures the step for ``statistics``; None measures nothing.
        respawns: whether the node returns when others end it.
        beside: called between the steps of ``destroy``: an embedded master that must answer.
    """

    step: StepLimits = StepLimits()
    tcpros: TcprosLimits = TcprosLimits(max_message=16 << 20)
    xmlrpc: XmlRpcLimits = XmlRpcLimits()
    bind_ip: str | None = None
    hosts: Mapping[str, str] | None = None
    epoch: Epoch | None = None
    clock_ns: Callable[[], int] | None = None
    respawns: bool = False
    beside: Callable[[], None] | None = None
