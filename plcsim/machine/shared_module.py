"""Position-independent modules, as ``wasm-ld --shared`` links them out of C.

Such a module imports the addresses of its data (``__memory_base``), of its functions in the table
(``__table_base``) and of everything outside (``GOT.mem.NAME``, ``GOT.func.NAME``) as variables. For
a place in memory `plcsim.machine.placement` makes constants of them.

Source: Tool Conventions of WebAssembly, "Dynamic linking" (section dylink.0).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from plcsim.machine.api import FUNCTION as EXTERN_FUNCTION
from plcsim.machine.engine import Type
from plcsim.machine.errors import MachineError
from plcsim.machine.opcodes import F32, F64, I32, I64
from plcsim.machine.reader import (
    CODE,
    CUSTOM,
    EXPORTS,
    FUNCTION,
    GLOBAL,
    GLOBALS,
    IMPORTS,
    TYPES,
    ModuleImport,
    ModuleSection,
    Reader,
    constant,
    exports,
    function_types,
    imports,
    sections,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

MEMORY_BASE, TABLE_BASE = ("env", "__memory_base"), ("env", "__table_base")
ADDRESSES, FUNCTION_INDICES = "GOT.mem", "GOT.func"
"""Modules of imports that stand for the address of a variable, and for a function pointer."""

_MEMORY_INFO = 1  # WASM_DYLINK_MEM_INFO
_LARGEST_ALIGNMENT = 16  # a power of two


@dataclass
class SharedModule:
    """A module as it was linked.

    Attributes:
        wasm: the binary.
        memory_size: bytes of its data.
        memory_alignment: of them, in bytes.
        table_size: entries of its own in the table of functions.
        imports: all of them, in order.
        functions: names of the functions that it exports.
        variables: offset in its data of each variable that it exports, by name.
        data: initial values as (place in the wasm, end, expression of the address).
        debug: places of the sections with debug information, by name.
    """

    wasm: bytes
    memory_size: int = 0
    memory_alignment: int = 1
    table_size: int = 0
    imports: list[ModuleImport] = field(default_factory=list)
    functions: list[str] = field(default_factory=list)
    variables: dict[str, int] = field(default_factory=dict)
    sections: list[ModuleSection] = field(default_factory=list)

    @property
    def addresses(self) -> list[str]:
        """Names of the variables whose addresses it asks for, its own among them."""
        return [i.name for i in self.imports if i.module == ADDRESSES]

    @property
    def pointers(self) -> list[str]:
        """Names of the functions that it needs pointers to, its own among them."""
        return [i.name for i in self.imports if i.module == FUNCTION_INDICES]

    @property
    def called(self) -> dict[str, Type]:
        """Types of the functions that it calls and does not hold, by name."""
        types = [
            Type(EXTERN_FUNCTION, *map(_codes, both))
            for section in self.sections
            if section.number == TYPES
            for both in function_types(self.wasm, section)
        ]
        return {i.name: types[i.type] for i in self.imports if i.kind == FUNCTION}

    def section(self, name: str) -> bytes:
        """Return the content of a custom section, nothing where there is none."""
        for section in self.sections:
            if section.number == CUSTOM and section.name == name:
                return self.wasm[section.start : section.end]
        return b""

    @property
    def code_start(self) -> int:
        """Place of the content of the code section, from which debug information counts."""
        return next((s.start for s in self.sections if s.number == CODE), 0)


_CODES = {I32: "i", I64: "q", F32: "f", F64: "d"}


def _codes(types: bytes) -> str:
    return "".join(_CODES.get(each, "?") for each in types)


def read_shared(wasm: bytes) -> SharedModule:
    """Read the outer structure of a module.

    Raises:
        MachineError: it is none, or not position-independent.
    """
    module = SharedModule(wasm, sections=list(sections(wasm)))
    first = module.sections[0] if module.sections else None
    if first is None or first.name != "dylink.0":
        raise MachineError("the module is not position-independent")
    _read_memory_info(module, first)
    offsets: list[int] = []
    exported: list[tuple[str, int, int]] = []
    for section in module.sections:
        if section.number == IMPORTS:
            module.imports = list(imports(wasm, section))
        elif section.number == GLOBALS:
            offsets = list(_own_variables(module, section))
        elif section.number == EXPORTS:
            exported = list(exports(wasm, section))
    before = sum(i.kind == GLOBAL for i in module.imports)
    module.functions = [name for name, kind, _ in exported if kind == FUNCTION]
    own = dict(enumerate(offsets, before))
    module.variables = {
        name: own[index] for name, kind, index in exported if kind == GLOBAL and index in own
    }
    return module


def _read_memory_info(module: SharedModule, section: ModuleSection) -> None:
    reader = Reader(module.wasm, section.start, section.end)
    while reader.more:
        kind, size = reader.byte(), reader.uleb()
        end = reader.offset + size
        if kind == _MEMORY_INFO:
            module.memory_size, power = reader.uleb(), reader.uleb()
            module.table_size = reader.uleb()
            if power > _LARGEST_ALIGNMENT:
                raise MachineError(f"the module wants its data aligned to 2**{power} bytes")
            module.memory_alignment = 1 << power
        reader.offset = end


def _own_variables(module: SharedModule, section: ModuleSection) -> Iterator[int]:
    """Yield the initial values of the module's own global variables, relative to its bases."""
    zero = dict.fromkeys(range(len(module.imports)), 0)
    reader = Reader(module.wasm, section.start, section.end)
    for _ in range(reader.uleb()):
        reader.byte(), reader.byte()
        yield constant(reader, zero)
