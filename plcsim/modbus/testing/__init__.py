"""For tests of projects with a table [modbus], never imported at run time.

The pytest plugin (`plcsim.modbus.testing.plugin`) brings the fixture ``modbus``, a `Modbus`: the
operator of an HMI, as tests have one.
"""

from typing import TYPE_CHECKING

from plcsim.core.lazy import lazy_names

if TYPE_CHECKING:
    from plcsim.modbus.service.errors import ModbusException
    from plcsim.modbus.testing.master import Modbus

__all__ = ["Modbus", "ModbusException"]

__getattr__ = lazy_names(
    __name__,
    {
        "Modbus": "plcsim.modbus.testing.master",
        "ModbusException": "plcsim.modbus.service.errors",
    },
)
