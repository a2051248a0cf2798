"""For tests of ROS 1 systems, never imported at run time.

The pytest plugin (`crosnode.testing.plugin`) brings the fixture ``ros``, a `Ros`: the network
around a controller under test. Hostile peers attack whatever listens in such a system.
"""

from typing import TYPE_CHECKING

from plcsim.core.lazy import lazy_names

if TYPE_CHECKING:
    from crosnode.testing.attacker import AttackedPort, Attacker
    from crosnode.testing.hostile import HostilePeer, HostilePeers, Speaks
    from crosnode.testing.ros import Ros, SystemState

__all__ = [
    "AttackedPort",
    "Attacker",
    "HostilePeer",
    "HostilePeers",
    "Ros",
    "Speaks",
    "SystemState",
]

__getattr__ = lazy_names(
    __name__,
    {
        "Attacker": "crosnode.testing.attacker",
        "AttackedPort": "crosnode.testing.attacker",
        "HostilePeer": "crosnode.testing.hostile",
        "HostilePeers": "crosnode.testing.hostile",
        "Ros": "crosnode.testing.ros",
        "Speaks": "crosnode.testing.hostile",
        "SystemState": "crosnode.testing.ros",
    },
)
