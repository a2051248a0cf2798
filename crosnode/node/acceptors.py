"""Who takes the connections at a node's three ports."""

from __future__ import annotations

from typing import TYPE_CHECKING

from crosnode.node.publisher import SubscriberLink
from crosnode.node.service_provider import CallerLink
from crosnode.tcpros import PublisherConnection, ServiceServerConnection
from crosnode.xmlrpc import XmlRpcServerConnection

if TYPE_CHECKING:
    from crosnode.node.slave_api import NodeView
    from crosnode.transport.event_loop import Accepted
    from crosnode.transport.link import Owner
    from crosnode.xmlrpc import Limits


class SlaveAcceptor:
    """Takes callers of an XML-RPC server.

    Args:
        owner: answers the calls.
        limits: of each connection.
    """

    def __init__(self, owner: Owner, limits: Limits) -> None:
        self._owner = owner
        self._limits = limits

    def accepted(self, now_ns: int) -> Accepted:
        """Serve a new caller."""
        return XmlRpcServerConnection(self._limits, now_ns), self._owner, True


class TopicAcceptor:
    """Takes subscribers of a node's topics.

    Args:
        node: that publishes.
    """

    def __init__(self, node: NodeView) -> None:
        self._node = node

    def accepted(self, now_ns: int) -> Accepted:
        """Serve a new subscriber."""
        core = self._node.core
        connection = PublisherConnection(core.tcpros_limits, now_ns)
        owner = SubscriberLink(connection, self._node.publishers, core)
        return connection, owner, False


class ServiceAcceptor:
    """Takes callers of a node's services.

    Args:
        node: that provides.
    """

    def __init__(self, node: NodeView) -> None:
        self._node = node

    def accepted(self, now_ns: int) -> Accepted:
        """Serve a new caller."""
        core = self._node.core
        connection = ServiceServerConnection(core.tcpros_limits, now_ns)
        return connection, CallerLink(connection, self._node.providers, core), False
