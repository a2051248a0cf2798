"""Hostile peers, for tests of whatever listens in a ROS 1 system; never imported at run time."""

from crosnode.testing.attacker import Attacker, Door
from crosnode.testing.hostile import HostilePeer, HostilePeers, Speaks

__all__ = ["Attacker", "Door", "HostilePeer", "HostilePeers", "Speaks"]
