"""The AsTCP blocks behave alike on both networks."""

from __future__ import annotations

from .astcp_contract import AsTcpContract
from .network_rigs import OsRig, VirtualRig


class TestOnOsNetwork(AsTcpContract):
    rig_class = OsRig


class TestOnVirtualNetwork(AsTcpContract):
    rig_class = VirtualRig
