"""The pytest plugin, on wherever crosnode is installed: it brings the fixture ``ros``.

Every run of pytest imports it, so it imports nothing before a test asks for the fixture.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from crosnode.testing.ros import Ros
    from plcsim.testing import Plc

__tracebackhide__ = True


@pytest.fixture
def ros(plc: Plc) -> Ros:
    """Give the other hosts of the controller's ROS network: a master, and nodes of the test."""
    with import_module("plcsim.testing.session").plain_errors():
        network: Ros = import_module("crosnode.testing.ros").Ros(plc)
    return network
