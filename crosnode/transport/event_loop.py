"""The bounded step that the node and the embedded master share: listeners and links, in turn.

Each step goes on at the connection where the budget of the step before ended, so that no peer can
keep the others from their turn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Protocol, TypeAlias

from crosnode.transport.budget import ACCEPT_WORK, POLL_WORK
from crosnode.transport.caller_share import CallerShare, NodeCallers
from crosnode.transport.link import LinkState, PeerLink
from crosnode.transport.tcpip_socket import SocketPool, TcpipSocketState
from plcsim.core.backoff import Backoff

if TYPE_CHECKING:
    from crosnode.transport.budget import StepBudget
    from crosnode.transport.connection import ProtocolConnection
    from crosnode.transport.link import Owner
    from plcsim.core.context import Context
    from plcsim.network import Address

BACKLOG: Final = 64
LARGE_BLOCK: Final = 8 << 20
"""Bytes; messages up to this size cost no page faults each time."""

TIMER_TURNS: Final = 16
"""Steps in which the time limits of all links are looked at, a part in each."""

REOPEN_NS: Final = 1_000_000_000
"""Nanoseconds between two attempts to open a port that is in use."""

Accepted: TypeAlias = "tuple[ProtocolConnection, Owner]"
"""The protocol for a new connection, and its owner."""


class Acceptor(Protocol):
    """Who takes the connections of a listener."""

    def accepted(self, now_ns: int) -> Accepted:
        """Return what a new connection speaks and who owns it."""


class PortListener:
    """A port that peers connect to.

    Args:
        loop: whose sockets and links are used.
        ip: address of the own interface, "" for all.
        port: 0 for any free one.
        acceptor: see ``Acceptor``.

    Attributes:
        port: the port listened at, the one wanted until it is open.
    """

    def __init__(self, loop: EventLoop, ip: str, port: int, acceptor: Acceptor) -> None:
        self.port = port
        self._ip = ip
        self._loop = loop
        self._acceptor = acceptor
        self._socket = loop.pool.get()
        self._next = loop.pool.get()
        self._backoff = Backoff(REOPEN_NS, REOPEN_NS)

    @property
    def is_open(self) -> bool:
        """Whether peers can connect."""
        return self._socket.is_open

    @property
    def status(self) -> int:
        """Status of the last block called, for messages."""
        return self._socket.status

    def open(self, now_ns: int) -> bool:
        """Open the port where it is not, at most once a second; return whether it is."""
        if self._socket.is_open:
            return True
        if not self._backoff.is_due(now_ns):
            return False
        self._backoff.failed(now_ns)
        self._socket.init(self._ip, self.port)
        if self._socket.open(listening=True) is not TcpipSocketState.DONE:
            return False
        self.port = self._socket.own_port
        # TcpServer listens with its first call; from here on peers may be told of the port.
        if self._socket.accept(self._next, BACKLOG) is TcpipSocketState.DONE:
            self._next.close()
        return True

    def has_work(self, news: set[int]) -> bool:
        """Whether the port is to be opened, or somebody is there: ``news`` has its ident."""
        return not self._socket.is_open or self._socket.ident in news

    def step(self, now_ns: int, budget: StepBudget) -> None:
        """Take waiting connections within the budget."""
        if not self.open(now_ns):
            return
        while budget.accepts > 0 and budget.affords(ACCEPT_WORK):
            client = self._next
            state = self._socket.accept(client, BACKLOG)
            if state is not TcpipSocketState.DONE:
                if state is not TcpipSocketState.IN_PROGRESS:
                    self._socket.close()
                return
            self._next = self._loop.pool.get()
            budget.accepts -= 1
            budget.work -= ACCEPT_WORK
            connection, owner = self._acceptor.accepted(now_ns)
            link = PeerLink(client, connection, owner, now_ns)
            if not connection.IS_PARSED or self._loop.callers.admit(link, now_ns):
                self._loop.add(link)
            else:
                self._loop.pool.put(client)

    def close(self) -> None:
        """Close the port."""
        self._loop.pool.put(self._socket)
        self._loop.pool.put(self._next)


def keep_large_blocks() -> None:
    """Let the memory of a large message be used again for the next one.

    glibc gives a block above a threshold back to the system when it is freed; the next one costs
    a page fault for each page; once a larger block was freed, the threshold is its size
    (mallopt(3), M_MMAP_THRESHOLD). Elsewhere this does nothing.
    """
    bytearray(LARGE_BLOCK)


class EventLoop:
    """All connections of a node or a master.

    Args:
        context: of the controller.
        callers: of servers that it listens for; those of all nodes unless given.

    Attributes:
        pool: sockets of the controller.
        callers: see above.
        links: all connections.
        listeners: all ports.
    """

    def __init__(self, context: Context, callers: CallerShare | None = None) -> None:
        self.pool = context.library(SocketPool)
        self.callers = callers or context.library(NodeCallers)
        keep_large_blocks()
        self.links: list[PeerLink] = []
        self.listeners: list[PortListener] = []
        self._new: list[PeerLink] = []
        self._turn = 0
        self._listener_turn = 0
        self._round = 0

    def listen(self, ip: str, port: int, acceptor: Acceptor) -> PortListener:
        """Add a port to listen at."""
        listener = PortListener(self, ip, port, acceptor)
        self.listeners.append(listener)
        return listener

    def connect(
        self, address: Address, connection: ProtocolConnection, owner: Owner, now_ns: int
    ) -> PeerLink:
        """Add a connection to a peer; it is made in the steps to come."""
        socket = self.pool.get()
        socket.init(*address)
        link = PeerLink(socket, connection, owner, now_ns)
        self.add(link)
        return link

    def add(self, link: PeerLink) -> None:
        """Add a link."""
        self.links.append(link)
        self._new.append(link)

    def step(self, now_ns: int, budget: StepBudget) -> None:
        """Look at one listener, then at each link in turn while the budget lasts.

        A link that has nothing to do costs next to nothing. Links with more to read have further
        turns. The next step begins with the first link that had to wait.
        """
        news = self.pool.look()
        self._listen(now_ns, budget, news)
        budget.is_short = False
        self._turn = self._go_round(now_ns, budget, news)
        while not budget.is_short and (busy := [link for link in self.links if link.has_more]):
            for link in busy:
                self._give_turn(link, now_ns, budget)
        if LinkState.OVER in [link.state for link in self.links]:
            self._remove_ended()

    def _listen(self, now_ns: int, budget: StepBudget, news: set[int]) -> None:
        """Let one listener with news have its turn, so that a flood leaves links theirs."""
        count = len(self.listeners)
        for turn in range(self._listener_turn + 1, self._listener_turn + 1 + count):
            listener = self.listeners[turn % count]
            if listener.has_work(news):
                self._listener_turn = turn % count
                listener.step(now_ns, budget)
                return

    def step_new(self, now_ns: int, budget: StepBudget) -> None:
        """Give links that were added in this step their first turn, at the end of it."""
        new, self._new = self._new, []
        for link in new:
            if budget.polls > 0 and not link.is_over:
                link.is_readable = True
                link.step(now_ns, budget)

    def _give_turn(self, link: PeerLink, now_ns: int, budget: StepBudget) -> None:
        """Give a link a further turn in this step, if there is one to give."""
        if budget.polls > 0 and not budget.is_short and not link.is_over:
            link.step(now_ns, budget)
        else:
            link.has_more = False

    def _go_round(self, now_ns: int, budget: StepBudget, news: set[int]) -> int:
        """Give links their turn while the budget lasts; return where the next step begins."""
        links, count = self.links, len(self.links)
        ending: list[PeerLink] = []
        start = self._turn if self._turn < count else 0
        self._round += 1
        for turn in range(start, start + count):
            place = turn % count
            link, work = links[place], budget.work
            if (place + self._round) % TIMER_TURNS == 0:
                link.check_time(now_ns)
            # Another link's event may have ended it.
            if link.state is LinkState.OVER or not link.has_work(news):
                continue
            if budget.polls <= 0:
                return place
            if link.may_wait(now_ns):
                ending.append(link)
                continue
            link.step(now_ns, budget)
            if budget.is_short:  # a link that could do nothing goes first, another goes last
                had_to_wait = work - budget.work <= POLL_WORK
                return place if had_to_wait else (turn + 1) % count
        for link in ending:
            self._give_turn(link, now_ns, budget)
        return (start + 1) % max(1, count)

    def _remove_ended(self) -> None:
        for link in self.links:
            if link.is_over:
                self.pool.put(link.socket)
        self.links = [link for link in self.links if not link.is_over]

    def end_links(self, now_ns: int) -> None:
        """End all links at once; the ports stay open."""
        for link in self.links:
            link.abort("", now_ns)
        self._remove_ended()

    def close(self, now_ns: int) -> None:
        """End all links and close all ports at once."""
        self.end_links(now_ns)
        for listener in self.listeners:
            listener.close()
        self.listeners.clear()
