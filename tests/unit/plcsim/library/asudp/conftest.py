"""Two controllers on a virtual net."""

import pytest

from plcsim.network import VirtualNetwork

IPS = ("192.168.0.10", "192.168.0.20")


@pytest.fixture
def net():
    return VirtualNetwork(lambda: 0, call_ns=0)


@pytest.fixture
def pair(make_plc, net):
    """Two controllers; each ``plc.do(Block, ...)`` calls a block that is enabled."""

    class Udp(make_plc):
        def do(self, view, **inputs):
            given = {
                name: self.text(value) if isinstance(value, str) else value
                for name, value in inputs.items()
            }
            return self.call(view, **given)

    return [Udp(network=net.host(ip)) for ip in IPS]
