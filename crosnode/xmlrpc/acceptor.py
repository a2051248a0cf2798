"""Who takes the callers of an API: the slave API of a node, the master's."""

from __future__ import annotations

from typing import TYPE_CHECKING

from crosnode.xmlrpc.connection import LastUse, XmlRpcServerConnection

if TYPE_CHECKING:
    from crosnode.transport.event_loop import Accepted
    from crosnode.transport.link import Owner
    from crosnode.xmlrpc.connection import XmlRpcLimits


class ApiAcceptor:
    """Takes callers of an XML-RPC server.

    Args:
        owner: answers the calls.
        limits: of each connection.
    """

    def __init__(self, owner: Owner, limits: XmlRpcLimits) -> None:
        self._owner = owner
        self._limits = limits
        self._last_use = LastUse()

    def accepted(self, now_ns: int) -> Accepted:
        """Serve a new caller."""
        return XmlRpcServerConnection(self._limits, now_ns, self._last_use), self._owner
