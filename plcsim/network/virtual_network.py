"""A simulated IP net in virtual time: repeatable, seeded, with faults at will."""

from __future__ import annotations

from collections import deque
from functools import partial
from random import Random
from typing import TYPE_CHECKING

from plcsim.network.datagrams import BROADCAST_IP
from plcsim.network.errors import NetworkSetupError
from plcsim.network.events import EventQueue, NetworkEvent
from plcsim.network.faults import NetworkFaults
from plcsim.network.protocol import ANY_IPS, canonical_ipv6, is_ip
from plcsim.network.virtual_host import VirtualHost
from plcsim.network.wire import SECOND_NS, Link, Packet, TraceEvent, WireLimits, is_loopback

if TYPE_CHECKING:
    from collections.abc import Callable

LONGEST_RETRY_NS = 60 * SECOND_NS
"""Repeats of a lost packet come at doubling distances up to this."""


class VirtualNetwork:
    """Hosts on one net. All that is due happens in each call of any socket or host.

    While the clock stands still, each call moves the time of the net on by ``call_ns``: a program
    that spins on BUSY inside one cycle gets its answer, as on the controller, where such a loop
    takes real time. The run depends on nothing but the calls, the clock and the seed.

    Args:
        clock_ns: gives nanoseconds that never go back, such as a virtual clock's ``now_ns``.
        seed: of jitter, packet sizes and short sends.
        link: the way between hosts that ``set_link`` did not name.
        limits: bounds of each host.
        call_ns: nanoseconds that a call takes while the clock stands still.
        trace_length: events kept in ``trace``, the newest ones.

    Attributes:
        faults: plans faults.
        trace: the newest arrivals and losses, oldest first.
        happened: how many events there were so far.
        random: source of all chance on this net.
    """

    def __init__(
        self,
        clock_ns: Callable[[], int],
        *,
        seed: int = 0,
        link: Link | None = None,
        limits: WireLimits | None = None,
        call_ns: int = 1_000,
        trace_length: int = 10_000,
    ) -> None:
        self.limits = limits or WireLimits()
        self.random = Random(seed)  # noqa: S311  # repeatable on purpose
        self.trace: deque[TraceEvent] = deque(maxlen=trace_length)
        self.happened = 0
        self.faults = NetworkFaults(lambda: self.now_ns, self._plan_reset)
        self._clock_ns = clock_ns
        self._call_ns = call_ns
        self._link = link or Link()
        self._links: dict[frozenset[str], Link] = {}
        self._hosts: dict[str, VirtualHost] = {}
        self._events = EventQueue()
        self._moment_ns = clock_ns()

    @property
    def now_ns(self) -> int:
        """Time of the net: the clock's, or a little later if it stands still."""
        return max(self._clock_ns(), self._moment_ns)

    @property
    def moment_ns(self) -> int:
        """Time of the event that is happening."""
        return self._moment_ns

    @property
    def next_event_ns(self) -> int | None:
        """Time at which something will happen by itself, None if nothing will."""
        return self._events.next_ns

    def host(self, ip: str) -> VirtualHost:
        """Return the host with this address; it comes into being when first asked for.

        Raises:
            NetworkSetupError: not a literal of a host.
        """
        ip = canonical_ipv6(ip) or ip
        if not is_ip(ip) or ip in ANY_IPS or is_loopback(ip):
            raise NetworkSetupError(f"{ip!r} is not an address of a host such as 192.168.0.10.")
        return self._hosts.setdefault(ip, VirtualHost(self, ip))

    def find_host(self, ip: str) -> VirtualHost | None:
        """Return the host with this address, None if there is none."""
        return self._hosts.get(ip)

    def hosts_at(self, ip: str, sender: VirtualHost) -> list[VirtualHost]:
        """Return the hosts that a datagram of a host to this address goes to."""
        if ip == BROADCAST_IP:
            return [*self._hosts.values()]
        host = sender if is_loopback(ip) else self._hosts.get(ip)
        return [] if host is None else [host]

    def set_link(self, a: str, b: str, link: Link) -> None:
        """Describe the way between two hosts, for packets sent from now on."""
        self._links[frozenset((a, b))] = link

    def link(self, a: str, b: str) -> Link:
        """Return the way between two hosts."""
        return self._links.get(frozenset((a, b)), self._link)

    def settle(self) -> None:
        """Let all happen that is due. Each call of a socket or a host begins with this."""
        clock_ns = self._clock_ns()
        until_ns = clock_ns if clock_ns > self._moment_ns else self._moment_ns + self._call_ns
        while (due := self._events.take_due(until_ns)) is not None:
            self._moment_ns, act = due
            self.happened += 1
            act()
        self._moment_ns = until_ns

    def plan(self, delay_ns: int, act: Callable[[], None]) -> NetworkEvent:
        """Plan an act for ``delay_ns`` from now."""
        return self._events.plan(self._moment_ns + delay_ns, act)

    def cancel(self, event: NetworkEvent) -> None:
        """Take a planned act back."""
        self._events.cancel(event)

    def send(self, packet: Packet, not_before_ns: int = 0) -> int:
        """Send a packet; return when it arrives if it is not lost."""
        packet.first_sent_ns = self._moment_ns
        arrival_ns = max(self._moment_ns + self._latency_ns(packet), not_before_ns)
        self._events.plan(arrival_ns, partial(self._arrive, packet))
        return arrival_ns

    def silent(self, a: str, b: str) -> bool:
        """Whether packets between ``a`` and ``b`` are lost at this moment."""
        return self.faults.silent(a, b, self._moment_ns)

    def send_limit(self, ip: str) -> int | None:
        """Choose how many bytes one ``send`` of a host may take, None for as many as fit."""
        largest = self.faults.largest_send(ip, self._moment_ns)
        return None if largest is None else self.random.randint(1, largest)

    def _latency_ns(self, packet: Packet) -> int:
        a, b = packet.source.ip, packet.target.ip
        if a == b or is_loopback(b):
            return 0
        link = self.link(a, b)
        jitter_ns = self.random.randint(0, link.jitter_ns) if link.jitter_ns else 0
        return link.latency_ns + jitter_ns + self.faults.extra_delay_ns(a, b, self._moment_ns)

    def _arrive(self, packet: Packet) -> None:
        lost = self.silent(packet.source.ip, packet.target.ip) or not packet.deliver()
        self.trace.append(
            TraceEvent(
                self._moment_ns, packet.kind, packet.source, packet.target, packet.size, lost
            )
        )
        if lost:
            self._retry(packet)

    def _retry(self, packet: Packet) -> None:
        last_ns = packet.first_sent_ns + packet.patience_ns
        if self._moment_ns >= last_ns:
            packet.give_up()
            return
        again_ns = min(self._moment_ns + packet.retry_ns, last_ns)
        packet.retry_ns = min(2 * packet.retry_ns, LONGEST_RETRY_NS)
        self._events.plan(again_ns, partial(self._arrive, packet))

    def _plan_reset(self, a: str, b: str | None, at_ns: int) -> None:
        self._events.plan(at_ns, partial(self._reset, a, b))

    def _reset(self, a: str, b: str | None) -> None:
        host = self._hosts.get(a)
        if host is not None:
            host.reset_connections(b)
