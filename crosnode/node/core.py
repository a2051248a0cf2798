"""What all parts of one node share."""

from __future__ import annotations

from itertools import count
from typing import TYPE_CHECKING, Protocol

from crosnode.node.status import Status, StatusKind
from crosnode.transport.budget import TRANSFER_WORK, StepBudget, StepLimits

if TYPE_CHECKING:
    from crosnode.graph.hosts import HostTable
    from crosnode.node.master_client import MasterClient
    from crosnode.node.parameter import ParameterSubscription
    from crosnode.node.publisher import Publisher
    from crosnode.node.queues import DropOldestQueue
    from crosnode.node.service_provider import ServiceProvider
    from crosnode.node.subscriber import Subscriber
    from crosnode.tcpros import TcprosLimits
    from crosnode.transport.event_loop import EventLoop, PortListener
    from crosnode.transport.link import PeerLink
    from crosnode.xmlrpc.api_caller import ApiCaller


class NodeCore:
    """The surroundings of publishers, subscribers and services.

    Attributes:
        name: of the node, resolved.
        loop: its connections.
        api: makes calls.
        master: registers.
        hosts: finds hosts.
        tcpros_limits: of each topic or service connection.
        statuses: news for the program.
        now_ns: time of the step.
        budget: of the step, what is left of it for the program that follows.
    """

    def __init__(
        self,
        name: str,
        loop: EventLoop,
        api: ApiCaller,
        master: MasterClient,
        hosts: HostTable,
        tcpros_limits: TcprosLimits,
        statuses: DropOldestQueue[Status],
    ) -> None:
        self.name = name
        self.loop = loop
        self.api = api
        self.master = master
        self.hosts = hosts
        self.tcpros_limits = tcpros_limits
        self.statuses = statuses
        self.now_ns = 0
        self.budget = StepBudget(StepLimits())
        self._numbers = count(1)

    def tell(self, kind: StatusKind, name: str, text: str = "") -> None:
        """Put news into the program's queue."""
        self.statuses.push(Status(kind, name, text[:1000]))

    def flush(self, link: PeerLink) -> None:
        """Write what waits in a link now, as far as the budget of the step allows."""
        link.wake()
        if self.budget.polls > 0 and self.budget.work >= TRANSFER_WORK:
            self.budget.polls -= 1
            link.flush(self.now_ns, self.budget)

    def next_number(self) -> int:
        """Return the number of a new connection, for getBusInfo."""
        return next(self._numbers)


class NodeView(Protocol):
    """What those who answer at its ports see of a node."""

    core: NodeCore
    host: str
    pid: int
    publishers: dict[str, Publisher]
    subscribers: dict[str, Subscriber]
    providers: dict[str, ServiceProvider]
    params: list[ParameterSubscription]
    topic_listener: PortListener

    def shut_down(self, reason: str) -> None:
        """End the node."""
