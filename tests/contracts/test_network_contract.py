"""Both networks pass the same suite."""

from __future__ import annotations

import time

from plcsim.network import Link, OsNetwork, VirtualNetwork

from .network_contract import NetworkContract, Rig


class OsRig(Rig):
    server_ip = "127.0.0.1"

    def __init__(self) -> None:
        super().__init__()
        self.server = self.client = OsNetwork()

    def wait(self) -> None:
        time.sleep(0.0005)


class VirtualRig(Rig):
    """Two hosts and a slow, unsteady link that cuts data small."""

    server_ip = "192.168.0.10"

    def __init__(self) -> None:
        super().__init__()
        self.now_ns = 0
        link = Link(latency_ns=300_000, jitter_ns=200_000, largest_packet=700, smallest_packet=1)
        net = VirtualNetwork(lambda: self.now_ns, link=link)
        self.server = net.host(self.server_ip)
        self.client = net.host("192.168.0.20")

    def wait(self) -> None:
        self.now_ns += 100_000


class TestOsNetwork(NetworkContract):
    def make_rig(self) -> Rig:
        return OsRig()


class TestVirtualNetwork(NetworkContract):
    def make_rig(self) -> Rig:
        return VirtualRig()
