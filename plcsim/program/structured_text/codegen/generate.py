"""From the intermediate representation of a module to its WebAssembly."""

from __future__ import annotations

from array import array
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from plcsim.machine.encoder import ModuleWriter, Signature, sleb
from plcsim.machine.opcodes import I32, I64, I64_CONST, UNREACHABLE
from plcsim.program.structured_text.codegen.accesses import Effects
from plcsim.program.structured_text.codegen.body import FunctionWriter, GenerationContext
from plcsim.program.structured_text.codegen.instrument import Instrument
from plcsim.program.structured_text.codegen.lines import FunctionLines, ModuleLines, pack
from plcsim.program.structured_text.codegen.loops import poll
from plcsim.program.structured_text.codegen.object_code import HOLES, Holes, ObjectCode
from plcsim.program.structured_text.codegen.operators import VALUE_TYPES
from plcsim.program.structured_text.codegen.options import CodegenOptions
from plcsim.program.structured_text.codegen.parts import parts_of
from plcsim.program.structured_text.codegen.profile import Profile
from plcsim.program.structured_text.codegen.runtime import MATHEMATICS, helper
from plcsim.program.structured_text.codegen.statements import statements
from plcsim.program.structured_text.ir import RUNTIME
from st_types.syntax.collector import collector_paused

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text import ir

PROGRAM_OPTIONS = CodegenOptions()

COUNTER: Final = "counter {}"
"""Name under which a counter is exported, from 1; 0 is what they have cost themselves."""

HELPER_OPTIONS = CodegenOptions(budget=False, copies=False)
"""Helpers end by themselves, and keep nothing but locals."""


@collector_paused()
def generate(module: ir.Module, options: CodegenOptions = PROGRAM_OPTIONS) -> ObjectCode:
    """Compile a module.

    The memory is imported as ``env.memory``, functions as ``block.NAME``, ``function.NAME`` and
    ``rt.NAME``; exported are the functions that the module exports.
    """
    functions = [part for function in module.functions for part in parts_of(function)]
    module = replace(module, functions=functions)
    compiler = _Compiler(module, options)
    for function in module.functions:
        compiler.compile(function)
    return compiler.finish()


class _Indices(dict[str, int]):
    """Indices of functions by name; a helper gets one when it is first called."""

    def __init__(self, writer: ModuleWriter) -> None:
        super().__init__()
        self._writer = writer
        self.helpers: list[ir.Function] = []

    def __missing__(self, name: str) -> int:
        function = helper(name)
        self.helpers.append(function)
        return self.announce(function)

    def announce(self, function: ir.Function) -> int:
        index = self[function.name] = self._writer.function(_signature(function), function.name)
        return index


class _Compiler:
    """A module while it is being compiled."""

    def __init__(self, module: ir.Module, options: CodegenOptions) -> None:
        self._module = module
        self._options = options
        self._writer = ModuleWriter(module.name)
        self._indices = _Indices(self._writer)
        segments = {id(segment): number for number, segment in enumerate(module.segments)}
        self._context = GenerationContext(self._indices, segments, Effects(module))
        self._bodies: list[FunctionWriter] = []
        has_frames = any(function.frame.size for function in module.functions)
        self._instrument = Instrument(first=int(has_frames)) if options.counters else None
        self._import(has_frames=has_frames)
        for function in module.functions:
            self._indices.announce(function)

    def _import(self, *, has_frames: bool) -> None:
        self._writer.import_memory("env", "memory")
        if has_frames:
            self._writer.import_global("env", "__stack_pointer", I32, mutable=True)
        for name in MATHEMATICS:
            field = name.removeprefix("rt.")
            index = self._writer.import_function("rt", field, _signature(RUNTIME[name]))
            self._indices[name] = index
        for name, what in self._module.imports.items():
            signature = _signature(what.signature)
            self._indices[name] = self._writer.import_function(what.space, what.name, signature)

    def compile(self, function: ir.Function) -> None:
        """Compile a function; where it calls, it polls the budget, so that calls end as well."""
        body = FunctionWriter(function, self._context, self._options, statements)
        if function.kind != "unit" and self._context.effects.calls_of(function.name):
            poll(body)
        if function.frame.size:
            body.take_frame()
        self._write(body)
        if function.exported:
            self._writer.export_function(function.name, self._indices[function.name])

    def _write(self, body: FunctionWriter) -> None:
        statements(body, body.function.body)
        if body.reached:
            body.give_frame_back()
        if body.function.result is not None:
            body.code += UNREACHABLE  # every path has returned, or goes on for ever
        if self._instrument:
            self._instrument.add(body, self._file_of(body.function))
        self._writer.body(self._indices[body.function.name], body.code, body.locals)
        self._bodies.append(body)

    def finish(self) -> ObjectCode:
        """Compile the helpers that were called, and put everything together."""
        for function in self._indices.helpers:
            self._write(FunctionWriter(function, self._context, HELPER_OPTIONS, statements))
        profile = self._profile()
        encoded = self._writer.encode()
        holes = self._holes(encoded.starts)
        lines = self._lines(encoded.starts)
        imports = list(self._module.imports.values())
        segments = self._module.segments
        return ObjectCode(self._module.name, encoded.wasm, segments, holes, lines, imports, profile)

    def _file_of(self, function: ir.Function) -> int:
        """Return the number of a function's file; each helper is a file of its own."""
        if function.kind != "helper" or function not in self._indices.helpers:
            return function.file
        return len(self._module.files) + self._indices.helpers.index(function)

    def _profile(self) -> Profile | None:
        """Define the counters, and return what they mean."""
        if not self._instrument:
            return None
        for number in range(self._instrument.counters + 1):
            variable = self._writer.global_(I64, I64_CONST + sleb(0))
            self._writer.export_global(COUNTER.format(number), variable)
        files = [*self._module.files, *(one.name for one in self._indices.helpers)]
        counted = self._instrument
        return Profile(files, counted.counters, counted.costs, counted.arcs)

    def _holes(self, starts: Sequence[int]) -> Holes:
        holes = array(HOLES)
        for body, start in zip(self._bodies, starts, strict=True):
            moved = [*body.holes]
            moved[::3] = [start + position for position in body.holes[::3]]
            holes.extend(moved)
        return holes

    def _lines(self, starts: Sequence[int]) -> ModuleLines:
        functions: list[FunctionLines] = []
        traps: dict[int, str] = {}
        for body, start in zip(self._bodies, starts, strict=True):
            function = body.function
            steps = pack(body.lines, function.line)
            file = self._module.files[function.file] if self._module.files else ""
            end = start + len(body.code) + 1
            functions.append(
                FunctionLines(function.name, function.kind, file, function.line, start, end, steps)
            )
            traps.update({start + position: reason for position, reason in body.traps})
        return ModuleLines(functions, traps)


def _signature(function: ir.Function | ir.Signature) -> Signature:
    params = bytes(VALUE_TYPES[kind] for kind in function.parameters)
    results = b"" if function.result is None else bytes([VALUE_TYPES[function.result]])
    return Signature(params, results)
