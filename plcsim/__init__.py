"""Simulated PLC: task classes on a tick, function blocks, tags and networks."""

from typing import TYPE_CHECKING

from plcsim.core.lazy import lazy_names

if TYPE_CHECKING:
    from plcsim.core.errors import PageFault, PlcError
    from plcsim.core.function_block import FunctionBlock
    from plcsim.core.memory import adr, sizeof
    from plcsim.program.python.program import Program

__all__ = ["FunctionBlock", "PageFault", "PlcError", "Program", "adr", "sizeof"]

__getattr__ = lazy_names(
    __name__,
    {
        "FunctionBlock": "plcsim.core.function_block",
        "PageFault": "plcsim.core.errors",
        "PlcError": "plcsim.core.errors",
        "Program": "plcsim.program.python.program",
        "adr": "plcsim.core.memory",
        "sizeof": "plcsim.core.memory",
    },
)
