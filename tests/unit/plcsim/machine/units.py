"""A machine on a small memory, and modules for it in the text format."""

from functools import cache

import wasmtime

from plcsim.core.memory import PAGE, Memory
from plcsim.machine import CodeCache, Machine

NO_CACHE = CodeCache(None)


@cache
def assemble(text: str) -> bytes:
    """Return a module, which imports the PLC memory, as a binary."""
    return bytes(wasmtime.wat2wasm(f'(module $unit (import "env" "memory" (memory 0)) {text})'))


class Rig:
    """A machine on a memory of 16 pages, the first of them allocated."""

    def __init__(self, **settings):
        self.memory = Memory(16 * PAGE)
        self.address = self.memory.allocate(1024)
        self.machine = Machine(self.memory, cache=NO_CACHE, **settings)

    def load(self, text, imports=None):
        return self.machine.instantiate(self.machine.compile(assemble(text)), imports or {})


FAULTS = """
(table 4 funcref)
(elem (i32.const 1) $load)
(func $load (export "load") (param i32) (result i32) (i32.load (local.get 0)))
(func (export "store") (param i32) (i32.store (local.get 0) (i32.const -1)))
(func $loads (export "loads") (param i32) (drop (call $load (local.get 0))))
(func (export "divide") (param i32 i32) (result i32)
  (i32.div_s (local.get 0) (local.get 1)))
(func (export "truncate") (param f64) (result i32) (i32.trunc_f64_s (local.get 0)))
(func $recurse (export "recurse") (call $recurse))
(func (export "indirect") (param i32) (call_indirect (local.get 0)))
(func (export "unreachable") unreachable)
(func (export "endless") (i32.store (i32.const 0x120000) (i32.const 1)) (loop $again
  (if (i64.lt_s (i64.load (i32.const 0x100000)) (i64.const 0)) (then unreachable))
  (br $again)))
(func (export "fine") (result i32) (i32.const 42))
"""
"""Functions that trap, each in its way, and one that does not."""
