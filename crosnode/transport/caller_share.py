"""How many idents of a controller the callers of its nodes' APIs may hold.

AsTCP has a number of idents for all sockets of a controller. Callers of an XML-RPC server keep
their connections for a next call that may never come; if they could hold all idents, there would be
none for topics and services. So they have a share, and for one more the one that has been idle
longest goes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from crosnode.transport.connection import ConnectionState
from crosnode.transport.tcpip_socket import SocketPool

if TYPE_CHECKING:
    from crosnode.transport.link import PeerLink
    from plcsim.core.context import Context

LEAST: Final = 8
"""Callers at once, however few idents there are."""


class CallerShare:
    """Callers who share what idents they may hold: those of all nodes, or those of a master.

    Args:
        context: the controller's.
        part: one in so many idents is for them.

    Attributes:
        most: callers at once.
    """

    def __init__(self, context: Context, part: int) -> None:
        self.most = max(LEAST, context.library(SocketPool).idents // part)
        self._links: list[PeerLink] = []

    def admit(self, link: PeerLink, now_ns: int) -> bool:
        """Take a new caller, for which an idle one may have to go; False where none is idle."""
        self._links = [each for each in self._links if _is_there(each)]
        if len(self._links) >= self.most:
            idle = [each for each in self._links if each.connection.idle_since_ns is not None]
            if not idle:
                link.abort("too many callers at once", now_ns)
                return False
            min(idle, key=lambda each: each.connection.idle_since_ns or 0).close("idle")
        self._links.append(link)
        return True


class NodeCallers(CallerShare):
    """The callers of all nodes of one controller; ``context.library(NodeCallers)``."""

    def __init__(self, context: Context) -> None:
        super().__init__(context, 4)


def _is_there(link: PeerLink) -> bool:
    return link.connection.state is not ConnectionState.CLOSED
