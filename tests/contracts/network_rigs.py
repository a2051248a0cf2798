"""Two hosts that can talk, on each network, for the contract suites."""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING

from plcsim.network import Link, OsNetwork, VirtualNetwork

if TYPE_CHECKING:
    from plcsim.network import Network


class Rig(ABC):
    """The networks of a server's and a client's host, and the time between calls."""

    server: Network
    client: Network
    server_ip: str
    client_ip: str

    @abstractmethod
    def wait(self) -> None:
        """Let a little time pass."""


class OsRig(Rig):
    """The loopback of this host."""

    server_ip = client_ip = "127.0.0.1"

    def __init__(self) -> None:
        self.server = self.client = OsNetwork()

    def wait(self) -> None:
        time.sleep(0.0005)


class VirtualRig(Rig):
    """Two hosts and a slow, unsteady link that cuts data small."""

    server_ip = "192.168.0.10"
    client_ip = "192.168.0.20"

    def __init__(self) -> None:
        self.now_ns = 0
        link = Link(latency_ns=300_000, jitter_ns=200_000, smallest_packet=1, largest_packet=700)
        net = VirtualNetwork(lambda: self.now_ns, link=link)
        self.server = net.host(self.server_ip)
        self.client = net.host(self.client_ip)

    def wait(self) -> None:
        self.now_ns += 100_000
