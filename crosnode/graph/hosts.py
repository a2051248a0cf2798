"""Names of hosts: those of tables, known before the first cycle, and whom else to ask."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from crosnode.errors import InvalidNameError
from crosnode.graph.uri import parse_uri
from plcsim.network import Address
from plcsim.network.protocol import ANY_IPV6, canonical_ipv6, is_ip, is_ipv4

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

HOSTS: Final = Path("/etc/hosts")

LOCALHOST: Final = "localhost"
LOOPBACK: Final = "127.0.0.1"
LOOPBACK_IPV6: Final = "::1"


def loopback(*, ipv6: bool) -> str:
    """Return the address of this machine for itself."""
    return LOOPBACK_IPV6 if ipv6 else LOOPBACK


def is_ipv6_wanted(environment: Mapping[str, str]) -> bool:
    """Whether ROS_IPV6 is on, as rospy and roscpp read it."""
    return environment.get("ROS_IPV6") == "on"


def hosts_text() -> str:
    """Return the text of ``/etc/hosts``, "" where there is none."""
    return HOSTS.read_text(errors="replace") if HOSTS.is_file() else ""


def parse_hosts(text: str, *, ipv6: bool = False) -> dict[str, str]:
    """Return the address of each name in a text in the form of ``/etc/hosts``.

    Args:
        text: lines of an address and names.
        ipv6: a name with addresses of both kinds has that of IPv6, otherwise that of IPv4.
    """
    wanted: dict[str, str] = {}
    others: dict[str, str] = {}
    for line in text.splitlines():
        ip, *names = line.partition("#")[0].split() or [""]
        if is_ip(ip):
            for name in names:
                (wanted if is_ipv4(ip) is not ipv6 else others).setdefault(name.lower(), ip)
    return others | wanted


def own_interface(host: str, *, ipv6: bool = False) -> str:
    """Return the address of the interface that others reach under a name, "" for all.

    Of a name only others may know what it means: /etc/hosts of Debian gives the own name a loopback
    address.
    """
    if is_ip(host):
        return host
    if host.lower() == LOCALHOST:
        return loopback(ipv6=ipv6)
    return ANY_IPV6 if ipv6 else ""


class HostTable:
    """Addresses by host name.

    Args:
        hosts: names and addresses beyond ``localhost``.
        ask: returns the address of any other name; raises as ``resolve`` does.
        ipv6: ``localhost`` is that of IPv6.
    """

    def __init__(
        self,
        hosts: Mapping[str, str] | None = None,
        ask: Callable[[str], str] | None = None,
        *,
        ipv6: bool = False,
    ) -> None:
        self._ask = ask
        own = {LOCALHOST: loopback(ipv6=ipv6)}
        self._hosts = own | {name.lower(): ip for name, ip in (hosts or {}).items()}

    def resolve(self, host: str) -> str:
        """Return the address of a host, one of IPv6 as RFC 5952 writes it.

        Raises:
            InvalidNameError: the name is not known.
            HostPendingError: it is being asked for.
        """
        ip = host if is_ip(host) else self._hosts.get(host.lower())
        if ip is None and self._ask is not None:
            ip = self._ask(host)
        if ip is None:
            raise InvalidNameError(f"host {host[:100]!r} is not known; add it to [ros.hosts].")
        return canonical_ipv6(ip) or ip

    def address(self, uri: str, scheme: str) -> Address:
        """Return the address that a URI leads to.

        Raises:
            InvalidNameError: not such a URI, or an unknown host.
            HostPendingError: the host is being asked for.
        """
        host, port = parse_uri(uri, scheme)
        return Address(self.resolve(host), port)
