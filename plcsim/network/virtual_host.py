"""A host on a virtual net: its ports and sockets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.network.datagrams import OpenedDatagrams
from plcsim.network.protocol import (
    ANY_IP,
    ANY_IPS,
    ANY_IPV6,
    Address,
    Opened,
    Outcome,
    canonical_ipv6,
    is_ip,
)
from plcsim.network.virtual_datagrams import VirtualDatagramSocket
from plcsim.network.virtual_socket import VirtualSocket
from plcsim.network.wire import is_loopback

if TYPE_CHECKING:
    from plcsim.network.virtual_network import VirtualNetwork

FIRST_FREE_PORT = 49_152
LAST_PORT = 65_535


def hears(bound_ip: str, ip: str) -> bool:
    """Whether who listens at an address hears what is sent to another one."""
    return bound_ip in (ip, ANY_IPV6) or (bound_ip == ANY_IP and ":" not in ip)


class VirtualHost:
    """A host's access to TCP and UDP on a virtual net; made by ``VirtualNetwork.host``.

    Attributes:
        net: the net.
        ip: the host's literal, of IPv4 or IPv6.
    """

    def __init__(self, net: VirtualNetwork, ip: str) -> None:
        self.net = net
        self.ip = ip
        self._count = 0
        self._ports: dict[int, list[VirtualSocket]] = {}
        self._datagrams: dict[int, VirtualDatagramSocket] = {}
        self._fading: dict[int, int] = {}
        self._last_free = LAST_PORT

    @property
    def socket_count(self) -> int:
        """Sockets in use: open ones, queued connections, closed ones that still fade out."""
        return self._count

    def open(self, ip: str, port: int, *, reuse_address: bool = False) -> Opened:
        """See ``Network.open``."""
        self.net.settle()
        ip = canonical_ipv6(ip) or ip
        outcome = self._bindable(ip, port)
        if outcome is not Outcome.OK:
            return Opened(outcome)
        port = port or self._free_port()
        if not port or self.full():
            return Opened(Outcome.NO_RESOURCES)
        local = Address(ip or ANY_IP, port)
        if self._in_use(local, reuse_address=reuse_address):
            return Opened(Outcome.IN_USE)
        made = VirtualSocket(self, local, reuse_address=reuse_address)
        self.add(made)
        return Opened(Outcome.OK, made)

    def look(self) -> list[VirtualSocket]:
        """See ``Network.look``."""
        self.net.settle()
        return [user for users in self._ports.values() for user in users if user.has_news]

    def open_datagrams(self, ip: str, port: int, *, reuse_address: bool = False) -> OpenedDatagrams:
        """See ``DatagramNetwork.open_datagrams``; two sockets never share a port here."""
        self.net.settle()
        outcome = Outcome.INVALID_ADDRESS if ":" in ip else self._bindable(ip, port)
        if outcome is not Outcome.OK:
            return OpenedDatagrams(outcome)
        free = (p for p in range(FIRST_FREE_PORT, LAST_PORT + 1) if p not in self._datagrams)
        port = port or next(free, 0)
        if not port or self.full():
            return OpenedDatagrams(Outcome.NO_RESOURCES)
        if port in self._datagrams:
            return OpenedDatagrams(Outcome.IN_USE)
        made = VirtualDatagramSocket(self, Address(ip or ANY_IP, port))
        self._datagrams[port] = made
        self._count += 1
        return OpenedDatagrams(Outcome.OK, made)

    def remove_datagrams(self, removed: VirtualDatagramSocket) -> None:
        """Give up a UDP socket."""
        if self._datagrams.pop(removed.bound.port, None) is not None:
            self._count -= 1

    def deliver_datagram(self, target: Address, data: bytes, source: Address) -> bool:
        """Give a datagram to the socket at its port; False where it is lost."""
        found = self._datagrams.get(target.port)
        if found is None or (is_loopback(found.bound.ip) and not is_loopback(source.ip)):
            return False
        return found.take(data, source)

    def _bindable(self, ip: str, port: int) -> Outcome:
        if ip and not is_ip(ip):
            return Outcome.INVALID_ADDRESS
        if not 0 <= port <= LAST_PORT:
            return Outcome.INVALID
        if ip not in ("", *ANY_IPS, self.ip) and not is_loopback(ip):
            return Outcome.NOT_LOCAL
        return Outcome.OK

    def full(self) -> bool:
        """Whether no further socket can be made."""
        return self._count >= self.net.limits.sockets

    def _free_port(self) -> int:
        """Return the next free port in turn, 0 if there is none."""
        for _ in range(FIRST_FREE_PORT, LAST_PORT + 1):
            self._last_free += 1
            if self._last_free > LAST_PORT:
                self._last_free = FIRST_FREE_PORT
            if self._last_free not in self._ports and not self._is_fading(self._last_free):
                return self._last_free
        return 0

    def _in_use(self, local: Address, *, reuse_address: bool) -> bool:
        """Whether binding fails, by the rules of socket(7), SO_REUSEADDR."""
        for other in self._ports.get(local.port, ()):
            same_ip = hears(local.ip, other.bound.ip) or hears(other.bound.ip, local.ip)
            if same_ip and not (reuse_address and other.reuse_address and not other.listening):
                return True
        return not reuse_address and self._is_fading(local.port)

    def _is_fading(self, port: int) -> bool:
        until_ns = self._fading.get(port, 0)
        if until_ns <= self.net.moment_ns:
            self._fading.pop(port, None)
        return port in self._fading

    def add(self, added: VirtualSocket) -> None:
        """Count a socket and occupy its port."""
        self._count += 1
        self._ports.setdefault(added.bound.port, []).append(added)

    def remove(self, removed: VirtualSocket, *, fading: bool) -> None:
        """Give up a socket; its port may fade out in TIME_WAIT."""
        port = removed.bound.port
        users = self._ports.get(port, [])
        if removed not in users:
            return
        self._count -= 1
        users.remove(removed)
        if not users:
            del self._ports[port]
        if fading:
            self._fading[port] = self.net.moment_ns + self.net.limits.fade_ns

    def listener(self, address: Address) -> VirtualSocket | None:
        """Return the socket that listens at an address of this host."""
        for user in self._ports.get(address.port, ()):
            if user.listening and hears(user.bound.ip, address.ip):
                return user
        return None

    def refuses(self, port: int) -> bool:
        """Whether a planned fault refuses connections to a port now."""
        return self.net.faults.refuses(self.ip, port, self.net.moment_ns)

    def reset_connections(self, peer_ip: str | None) -> None:
        """Tear down all connections with another host (None: with any other)."""
        for users in list(self._ports.values()):
            for user in list(users):
                user.lose_connection(peer_ip)
