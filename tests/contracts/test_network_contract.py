"""Both networks pass the same suite."""

from __future__ import annotations

from .network_contract import NetworkContract
from .network_rigs import OsRig, VirtualRig


class TestOsNetwork(NetworkContract):
    rig_class = OsRig


class TestVirtualNetwork(NetworkContract):
    rig_class = VirtualRig
