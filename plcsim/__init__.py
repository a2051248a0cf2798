"""Simulated PLC: task classes on a tick, function blocks, tags and networks."""

from plcsim.errors import PageFault, PlcError
from plcsim.function_block import FunctionBlock
from plcsim.memory import adr, sizeof
from plcsim.task import Program

__all__ = ["FunctionBlock", "PageFault", "PlcError", "Program", "adr", "sizeof"]
