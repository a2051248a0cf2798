"""Both networks pass the same suite of datagrams."""

from __future__ import annotations

import pytest

from .datagram_contract import DatagramContract
from .network_rigs import OsRig, VirtualRig


class TestOsNetwork(DatagramContract):
    @pytest.fixture
    def rig(self) -> OsRig:
        return OsRig()


class TestVirtualNetwork(DatagramContract):
    @pytest.fixture
    def rig(self) -> VirtualRig:
        return VirtualRig()
