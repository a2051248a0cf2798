"""Simulated PLC: task classes on a tick, function blocks, tags and networks."""

from typing import TYPE_CHECKING

from plcsim.lazy import lazy_names

if TYPE_CHECKING:
    from plcsim.errors import PageFault, PlcError
    from plcsim.function_block import FunctionBlock
    from plcsim.memory import adr, sizeof
    from plcsim.task import Program

__all__ = ["FunctionBlock", "PageFault", "PlcError", "Program", "adr", "sizeof"]

__getattr__ = lazy_names(
    __name__,
    {
        "FunctionBlock": "plcsim.function_block",
        "PageFault": "plcsim.errors",
        "PlcError": "plcsim.errors",
        "Program": "plcsim.task",
        "adr": "plcsim.memory",
        "sizeof": "plcsim.memory",
    },
)
