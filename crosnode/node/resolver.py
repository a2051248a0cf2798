"""Names of hosts by DNS, a step in each cycle: nobody waits for the answers."""

from __future__ import annotations

import secrets
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.errors import HostPendingError, InvalidNameError
from crosnode.graph.dns import MAX_ANSWER, PORT, is_name, parse_answer, question
from plcsim.network import Address, Outcome
from plcsim.network.datagrams import datagrams_of

if TYPE_CHECKING:
    from crosnode.graph.dns import NameAnswer, NameServers
    from plcsim.core.context import Context
    from plcsim.network import DatagramSocket

ASK_AGAIN_NS: Final = 1_000_000_000
ATTEMPTS: Final = 4
"""Questions for a name, the servers in turn."""

LEAST_NS: Final = 5_000_000_000
LONGEST_NS: Final = 3_600_000_000_000
"""For which an answer is believed, whatever it says."""

FORGET_NS: Final = 10_000_000_000
"""After which a name that was not found is asked for again."""

MOST_NAMES: Final = 200
MOST_ANSWERS: Final = 8
"""Taken in a step."""


class _Candidate(NamedTuple):
    """What a server is asked for."""

    name: str
    ipv6: bool


class _Name:
    """A name that is or was asked for."""

    def __init__(self, candidates: list[_Candidate], number: int) -> None:
        self.candidates = candidates
        self.number = number
        self.attempts = 0
        self.next_ns = 0
        self.ip: str | None = None
        self.until_ns = 0


class Resolver:
    """Asks name servers for names that no table has.

    Args:
        context: of the controller.
        servers: who is asked.
        ipv6: ask for addresses of IPv6 first, and of IPv4 where there are none.
    """

    def __init__(self, context: Context, servers: NameServers, *, ipv6: bool = False) -> None:
        self._kinds = (True, False) if ipv6 else (False,)
        self._context = context
        self._servers = servers
        self._names: dict[str, _Name] = {}
        self._socket: DatagramSocket | None = None

    def find(self, host: str) -> str:
        """Return the address of a host.

        Raises:
            HostPendingError: it is being asked for.
            InvalidNameError: it has none, or nobody can be asked.
        """
        host = host.lower()
        found = self._names.get(host)
        if found is None or (found.ip is not None and self._context.release_ns >= found.until_ns):
            found = self._ask(host)
        if found.ip is None:
            raise HostPendingError(f"the name server is asked for {host[:100]!r}.")
        if not found.ip:
            raise InvalidNameError(f"no name server knows host {host[:100]!r}.")
        return found.ip

    def _ask(self, host: str) -> _Name:
        if not self._servers.servers or not is_name(host):
            raise InvalidNameError(f"host {host[:100]!r} is not known; add it to [ros.hosts].")
        if len(self._names) >= MOST_NAMES:
            del self._names[next(iter(self._names))]
        names = [] if "." in host else [f"{host}.{each}" for each in self._servers.domains]
        candidates = [_Candidate(name, kind) for name in (*names, host) for kind in self._kinds]
        # Nobody can guess the number, and nothing of the run depends on it.
        found = self._names[host] = _Name(candidates, secrets.randbits(16))
        return found

    def step(self) -> None:
        """Take answers, and ask where it is time; nothing where no name is asked for."""
        waiting = [name for name in self._names.values() if name.ip is None]
        if not waiting:
            self._close()
            return
        if self._socket is None and not self._open():
            return
        now_ns = self._context.release_ns
        self._take(waiting, now_ns)
        for name in waiting:
            if name.ip is None and now_ns >= name.next_ns:
                self._send(name, now_ns)

    def _open(self) -> bool:
        network = datagrams_of(self._context)
        # A run that is recorded has no datagrams: then nothing is found.
        opener = getattr(network, "open_datagrams", None)
        self._socket = None if opener is None else opener("", 0).socket
        return self._socket is not None

    def _close(self) -> None:
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    def _send(self, name: _Name, now_ns: int) -> None:
        servers = self._servers.servers
        if name.attempts == ATTEMPTS:
            self._next_candidate(name, now_ns)
            return
        assert self._socket is not None
        target = Address(servers[name.attempts % len(servers)], PORT)
        asked = name.candidates[0]
        self._socket.send(question(name.number, asked.name, ipv6=asked.ipv6), target)
        name.attempts += 1
        name.next_ns = now_ns + ASK_AGAIN_NS

    def _take(self, waiting: list[_Name], now_ns: int) -> None:
        assert self._socket is not None
        for _ in range(MOST_ANSWERS):
            outcome, data, peer = self._socket.recv(MAX_ANSWER)
            if outcome is not Outcome.OK:
                return
            if peer.ip not in self._servers.servers or peer.port != PORT:
                continue
            for name in waiting:
                asked = name.candidates[0]
                answer = parse_answer(name.number, asked.name, data, ipv6=asked.ipv6)
                if name.ip is None and answer is not None:
                    self._answered(name, answer, now_ns)

    def _answered(self, name: _Name, answer: NameAnswer, now_ns: int) -> None:
        if answer.ip:
            name.ip = answer.ip
            name.until_ns = now_ns + min(max(answer.ttl_s * 10**9, LEAST_NS), LONGEST_NS)
        else:
            self._next_candidate(name, now_ns)

    def _next_candidate(self, name: _Name, now_ns: int) -> None:
        """Go on with the next domain, or give up for a while."""
        name.attempts, name.next_ns = 0, now_ns
        if len(name.candidates) > 1:
            del name.candidates[0]
        else:
            name.ip, name.until_ns = "", now_ns + FORGET_NS
