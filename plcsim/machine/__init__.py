"""WebAssembly, the one format that compiled programs run in, on the PLC's own memory.

The only package that knows wasmtime. A compiler writes a module with `plcsim.machine.encoder`; a
`Machine` on the memory of a controller compiles it, links it and calls it.
"""

from plcsim.machine.cache import CodeCache
from plcsim.machine.engine import MachineCode, compile_wasm
from plcsim.machine.errors import FaultKind, Frame, MachineError, MachineFault, frames_of
from plcsim.machine.machine import Extern, Instance, Machine
from plcsim.machine.store import trace_inside

__all__ = [
    "CodeCache",
    "Extern",
    "FaultKind",
    "Frame",
    "Instance",
    "Machine",
    "MachineCode",
    "MachineError",
    "MachineFault",
    "compile_wasm",
    "frames_of",
    "trace_inside",
]
