"""What tests of plcsim projects use; never imported at run time.

The pytest plugin (`plcsim.testing.plugin`) brings the fixture ``plc``; what a test names itself is
here. docs/testing.md is the tutorial, docs/testing-reference.md the reference.
"""

from typing import TYPE_CHECKING

from plcsim.core.lazy import lazy_names

if TYPE_CHECKING:
    from plcsim.testing.errors import (
        ControllerFault,
        ExpectationFailed,
        PlantError,
        PlcTestError,
        StimulusError,
    )
    from plcsim.testing.interleavings import Interleaving
    from plcsim.testing.machine import PlcMachine, every_cycle
    from plcsim.testing.plc import Plc
    from plcsim.testing.strategies import stimuli, tag_values
    from plcsim.testing.target import open_plc
    from plcsim.testing.trace import Trace

__all__ = [
    "ControllerFault",
    "ExpectationFailed",
    "Interleaving",
    "PlantError",
    "Plc",
    "PlcMachine",
    "PlcTestError",
    "StimulusError",
    "Trace",
    "every_cycle",
    "open_plc",
    "stimuli",
    "tag_values",
]

__getattr__ = lazy_names(
    __name__,
    {
        "ControllerFault": "plcsim.testing.errors",
        "ExpectationFailed": "plcsim.testing.errors",
        "Interleaving": "plcsim.testing.interleavings",
        "PlantError": "plcsim.testing.errors",
        "Plc": "plcsim.testing.plc",
        "PlcMachine": "plcsim.testing.machine",
        "PlcTestError": "plcsim.testing.errors",
        "StimulusError": "plcsim.testing.errors",
        "Trace": "plcsim.testing.trace",
        "every_cycle": "plcsim.testing.machine",
        "open_plc": "plcsim.testing.target",
        "stimuli": "plcsim.testing.strategies",
        "tag_values": "plcsim.testing.strategies",
    },
)
