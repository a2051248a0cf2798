"""Hostile peers on a network, the virtual one or the host's, many at once."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.testing.hostile import HostilePeer, Speaks
from plcsim.network import Address, Network, Outcome, Socket

if TYPE_CHECKING:
    from collections.abc import Sequence

    from crosnode.testing.hostile import HostilePeers

ARRIVES: Final = 0.2
"""Chance of a step that a peer connects."""

SPEAKS: Final = 0.5
"""Chance of a turn that a peer sends something."""

TURNS: Final = 20
"""Peers that have their turn in a step, so that a step costs the same however many there are."""

_GONE: Final = frozenset({Outcome.CLOSED, Outcome.RESET, Outcome.TIMED_OUT})
_FLOOD: Final = HostilePeer("many at once, silent", b"", leaves=0.0005)


class AttackedPort(NamedTuple):
    """A port to attack."""

    address: Address
    speaks: Speaks


class Attacker:
    """Connects to random doors as random peers; each step is one bounded piece of that.

    Args:
        network: whose peers attack.
        doors: all ports under attack.
        peers: who comes.
        most_open: connections at once.

    Attributes:
        counts: connections by kind.
    """

    def __init__(
        self,
        network: Network,
        doors: Sequence[AttackedPort],
        peers: HostilePeers,
        most_open: int = 60,
    ) -> None:
        self.counts: Counter[str] = Counter()
        self._network = network
        self._doors = doors
        self._peers = peers
        self._most_open = most_open
        self._visits: list[_Visit] = []

    def step(self) -> None:
        """Let one peer come, perhaps, and some of those that are there go on."""
        random = self._peers.random
        if random.random() < ARRIVES and len(self._visits) < self._most_open:
            door = random.choice(self._doors)
            self._enter(door, self._peers.next(door.speaks))
        turns = min(TURNS, len(self._visits))
        for visit in random.sample(self._visits, turns):
            self._turn(visit)
        self._visits = [visit for visit in self._visits if not visit.is_over]

    def flood(self) -> None:
        """Part from all, and connect as often as may be to one door, to say nothing."""
        self.close()
        door = self._peers.random.choice(self._doors)
        for _ in range(self._most_open):
            self._enter(door, _FLOOD)

    def close(self) -> None:
        """Part from all."""
        for visit in self._visits:
            visit.leave()
        self._visits.clear()

    def _enter(self, door: AttackedPort, peer: HostilePeer) -> None:
        socket = self._network.open("", 0).socket
        if socket is None:
            return
        self.counts[peer.kind] += 1
        self._visits.append(_Visit(socket, door.address, peer))

    def _turn(self, visit: _Visit) -> None:
        random = self._peers.random
        if random.random() < visit.peer.leaves:
            visit.leave(reset=random.random() < 0.5)
        elif not visit.is_connected:
            visit.connect()
        else:
            visit.listen()
            if random.random() < SPEAKS:
                visit.speak(random.choice((1, 3, 50, 4000, 65_536)))


class _Visit:
    """One connection of a peer."""

    def __init__(self, socket: Socket, address: Address, peer: HostilePeer) -> None:
        self.peer = peer
        self.is_connected = False
        self.is_over = False
        self._socket = socket
        self._address = address
        self._rest = memoryview(peer.data)
        self.connect()

    def connect(self) -> None:
        outcome = self._socket.connect(self._address)
        self.is_connected = outcome is Outcome.OK
        if outcome not in (Outcome.OK, Outcome.WOULD_BLOCK):
            self.leave()

    def listen(self) -> None:
        """Throw away what came; leave where the other end has."""
        if self.peer.reads and self._socket.recv(65_536).outcome in _GONE:
            self.leave()

    def speak(self, most: int) -> None:
        if self._rest and not self.is_over:
            sent = self._socket.send(self._rest[: self.peer.piece or most])
            self._rest = self._rest[sent.taken :]

    def leave(self, *, reset: bool = False) -> None:
        if reset:
            self._socket.set_linger(0)
        self._socket.close()
        self.is_over = True
