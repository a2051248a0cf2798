"""The pytest plugin, on wherever plcsim is installed: it brings the fixture ``modbus``.

Every run of pytest imports it, so it imports nothing before a test asks for the fixture.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from plcsim.modbus.testing.master import Modbus
    from plcsim.testing.plc import Plc

__tracebackhide__ = True


@pytest.fixture
def modbus(plc: Plc) -> Modbus:
    """Give a Modbus master that is connected to the controller; the project has [modbus]."""
    with import_module("plcsim.testing.session").plain_errors():
        master: Modbus = import_module("plcsim.modbus.testing.master").Modbus(plc)
    return master
