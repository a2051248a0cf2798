"""Names of hosts: those of tables, known before the first cycle, and whom else to ask."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from crosnode.errors import InvalidNameError
from crosnode.graph.uri import parse_uri
from plcsim.network import Address
from plcsim.network.protocol import is_ipv4

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

LOCAL: Final = {"localhost": "127.0.0.1", "::1": "127.0.0.1"}


def parse_hosts(text: str) -> dict[str, str]:
    """Return the IPv4 address of each name in a text in the form of ``/etc/hosts``."""
    hosts: dict[str, str] = {}
    for line in text.splitlines():
        ip, *names = line.partition("#")[0].split() or [""]
        if is_ipv4(ip):
            for name in names:
                hosts.setdefault(name.lower(), ip)
    return hosts


def own_interface(host: str) -> str:
    """Return the address of the interface that others reach under a name, "" for all.

    Of a name only others may know what it means: /etc/hosts of Debian gives the own name a loopback
    address.
    """
    return host if is_ipv4(host) else LOCAL.get(host.lower(), "")


class HostTable:
    """IPv4 addresses by host name.

    Args:
        hosts: names and addresses beyond ``localhost``.
        ask: returns the address of any other name; raises as ``resolve`` does.
    """

    def __init__(
        self, hosts: Mapping[str, str] | None = None, ask: Callable[[str], str] | None = None
    ) -> None:
        self._ask = ask
        self._hosts = LOCAL | {name.lower(): ip for name, ip in (hosts or {}).items()}

    def resolve(self, host: str) -> str:
        """Return the IPv4 address of a host.

        Raises:
            InvalidNameError: the name is not known.
            HostPendingError: it is being asked for.
        """
        ip = host if is_ipv4(host) else self._hosts.get(host.lower())
        if ip is None and self._ask is not None:
            ip = self._ask(host)
        if ip is None:
            raise InvalidNameError(f"host {host[:100]!r} is not known; add it to [ros.hosts].")
        return ip

    def address(self, uri: str, scheme: str) -> Address:
        """Return the address that a URI leads to.

        Raises:
            InvalidNameError: not such a URI, or an unknown host.
            HostPendingError: the host is being asked for.
        """
        host, port = parse_uri(uri, scheme)
        return Address(self.resolve(host), port)
