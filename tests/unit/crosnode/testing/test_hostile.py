"""Hostile peers are repeatable, of all kinds, and never tell a node to end."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.testing import HostilePeers, Speaks
from crosnode.testing.hostile import _KINDS

MANY = 2_000


def peers_of(seed: int, speaks: Speaks, count: int) -> list[object]:
    peers = HostilePeers(seed)
    return [peers.next(speaks) for _ in range(count)]


@given(st.integers(), st.sampled_from(Speaks))
def test_equal_seeds_give_equal_peers(seed: int, speaks: Speaks) -> None:
    assert peers_of(seed, speaks, 5) == peers_of(seed, speaks, 5)


@pytest.mark.parametrize("speaks", Speaks)
def test_all_kinds_come_and_none_asks_a_node_to_end(speaks: Speaks) -> None:
    peers = HostilePeers(1)
    found = [peers.next(speaks) for _ in range(MANY)]
    assert len({peer.kind for peer in found}) == len(_KINDS[speaks])
    assert not any(b"shutdown" in peer.data for peer in found)


def test_topic_and_service_are_those_under_attack() -> None:
    peers = HostilePeers(1, "/mine", "/own")
    legal = (peers.next(Speaks.TCPROS) for _ in range(MANY))
    data = next(peer.data for peer in legal if not peer.reads)
    assert b"topic=/mine" in data
    assert b"service=/own" in data
