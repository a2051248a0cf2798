"""Simulated PLC: task classes on a tick, function blocks, tags and networks."""

from typing import TYPE_CHECKING

from plcsim.core.lazy import lazy_names

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.core.errors import PageFault, PlcError
    from plcsim.core.function_block import FunctionBlock
    from plcsim.core.memory import adr, sizeof
    from plcsim.library.executable import function
    from plcsim.program.python.program import Globals, Program
    from plcsim.program.python.shared import var_external

__all__ = [
    "Context",
    "FunctionBlock",
    "Globals",
    "PageFault",
    "PlcError",
    "Program",
    "adr",
    "function",
    "sizeof",
    "var_external",
]

__getattr__ = lazy_names(
    __name__,
    {
        "Context": "plcsim.core.context",
        "FunctionBlock": "plcsim.core.function_block",
        "PageFault": "plcsim.core.errors",
        "PlcError": "plcsim.core.errors",
        "Globals": "plcsim.program.python.program",
        "Program": "plcsim.program.python.program",
        "adr": "plcsim.core.memory",
        "function": "plcsim.library.executable",
        "sizeof": "plcsim.core.memory",
        "var_external": "plcsim.program.python.shared",
    },
)
