"""The attacker on the virtual network, against a port that takes connections and bytes."""

import pytest

from crosnode.testing import AttackedPort, Attacker, HostilePeers, Speaks
from plcsim.network import Address, Outcome, Socket, VirtualNetwork

MS = 1_000_000
SERVER = "192.168.0.10"


class Port:
    """Takes all that comes, and counts."""

    def __init__(self) -> None:
        self.now_ns = 0
        self.net = VirtualNetwork(lambda: self.now_ns, seed=1)
        opened = self.net.host(SERVER).open("", 7).socket
        assert opened is not None
        opened.listen(100)
        self._listener = opened
        self.sockets: list[Socket] = []
        self.data = b""

    def attacker(self, most_open: int, seed: int = 1) -> Attacker:
        door = AttackedPort(Address(SERVER, 7), Speaks.TCPROS)
        return Attacker(self.net.host("192.168.0.99"), [door], HostilePeers(seed), most_open)

    def run(self, attacker: Attacker, ms: int) -> int:
        """Return the most connections that were open at once."""
        most = 0
        for _ in range(ms):
            self.now_ns += MS
            attacker.step()
            self._take()
            most = max(most, len(self.sockets))
        return most

    def _take(self) -> None:
        while (taken := self._listener.accept().socket) is not None:
            self.sockets.append(taken)
        left = []
        for each in self.sockets:
            outcome, data = each.recv(65_536)
            self.data += data
            if outcome in (Outcome.OK, Outcome.WOULD_BLOCK):
                left.append(each)
            else:
                each.close()
        self.sockets = left


def test_peers_come_speak_and_leave() -> None:
    port = Port()
    attacker = port.attacker(10)
    assert 1 < port.run(attacker, 3_000) <= 12  # two that have left may not be read to the end
    assert attacker.counts.total() > 50
    assert b"callerid=/evil" in port.data


def test_equal_seeds_attack_equally() -> None:
    counts = []
    for _ in range(2):
        port = Port()
        attacker = port.attacker(10, seed=5)
        port.run(attacker, 500)
        counts.append(attacker.counts)
    assert counts[0] == counts[1]


@pytest.mark.parametrize("most_open", [1, 50])
def test_a_flood_is_many_silent_connections_to_one_port(most_open: int) -> None:
    port = Port()
    attacker = port.attacker(most_open)
    attacker.flood()
    port.run(attacker, 20)
    assert len(port.sockets) == most_open
    assert port.data == b""
    attacker.close()
    port.run(port.attacker(0), 20)
    assert not port.sockets
