"""Runs compiled modules on a machine, with nothing else of a controller."""

import numpy as np

from plcsim.core.memory import FIRST, PAGE, Memory
from plcsim.machine import CodeCache, Machine
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.generate import COUNTER, PROGRAM_OPTIONS, generate
from plcsim.program.structured_text.codegen.runtime import MATHEMATICS

PAGES = 2
SIZE = PAGES * PAGE
END = FIRST + SIZE
"""Address behind the last variable."""

CODES = {"i32": "i", "i64": "q", "f32": "f", "f64": "d", None: ""}
SPACES = {"function": "function", "block": "block"}


class Compiled:
    """A module on the memory of a machine.

    Args:
        module: what to compile; its segment "program" lies at ``FIRST``.
        imports: by name; called with the memory and the arguments.
        options: of the back end.
        fuel: instructions are counted.

    Attributes:
        code: what the back end made.
    """

    def __init__(self, module, imports=None, options=PROGRAM_OPTIONS, *, fuel=False):
        self.memory = Memory(SIZE)
        self.memory.allocate(SIZE)
        self.machine = Machine(self.memory, fuel=fuel, cache=CodeCache(None))
        self.code = generate(module, options)
        self.wasm = self.code.place({one.name: FIRST for one in self.code.segments})
        externs = dict(self._mathematics()) | dict(self._imports(module, imports or {}))
        self.instance = self.machine.instantiate(self.machine.compile(self.wasm), externs)
        self.functions = {}

    def _mathematics(self):
        for name in MATHEMATICS:
            codes = "d" * len(ir.RUNTIME[name].parameters)
            call = self.machine.host_function(lambda *_: 1.0, codes, "d")
            yield ("rt", name.removeprefix("rt.")), call

    def _imports(self, module, imports):
        for name, what in module.imports.items():
            codes = "".join(CODES[kind] for kind in what.signature.parameters)
            call = self._bound(imports[name])
            extern = self.machine.host_function(call, codes, CODES[what.signature.result])
            yield (what.space, what.name), extern

    def _bound(self, function):
        return lambda *given: function(self, *given)

    def run(self, name="CYCLIC", *arguments):
        if name not in self.functions:
            self.functions[name] = self.instance.function(name)
        return self.functions[name](*arguments)

    def read(self, address, size):
        return self.memory.read(address, size)

    def write(self, address, data):
        self.memory.write(address, data)

    def fuel_of(self, name="CYCLIC", *arguments):
        """Instructions of one call."""
        before = self.machine.fuel
        self.run(name, *arguments)
        return before - self.machine.fuel

    def counts(self):
        """Values of all counters that were compiled in."""
        names = [COUNTER.format(1 + n) for n in range(self.code.profile.counters)]
        return np.array([self.instance.value(name) for name in names], np.int64)

    def close(self):
        self.machine.close()
