"""A linked module of C on the machine of a controller: placed, bound, its data initialised."""

from __future__ import annotations

import hashlib
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol, Self, TypeVar

from plcsim.ansi_c.line_table import read_line_table
from plcsim.ansi_c.nonlocal_jumps import NonlocalJumps
from plcsim.ansi_c.plain_words import first_use, plain_name
from plcsim.core.errors import ConfigurationError
from plcsim.machine.placement import Placement, initial_values, place

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from plcsim.ansi_c.line_table import LineTable
    from plcsim.machine import Extern, Frame, Instance, Machine, MachineCode
    from plcsim.machine.engine import Type
    from plcsim.machine.placement import PlacedModule
    from plcsim.machine.shared_module import SharedModule

V = TypeVar("V")

_ALIGNMENT = 16
"""Bytes; of the data of every module, as clang takes it for granted of its stack."""


class ModuleSurroundings(Protocol):
    """What a module of C finds outside."""

    def variable(self, name: str) -> int | None:
        """Return the address of a variable of the controller, None where there is none."""

    def function(self, name: str, wanted: Type | None = None) -> Extern | None:
        """Return a function or a block's body, None where there is none.

        Args:
            name: its name.
            wanted: its type, where it is known; of several with the name it is one of this type.
        """


class CModule:
    """A module of C that was placed; `compile` and `link` make it ready.

    Args:
        name: in messages, and in the frames of faults; no other module of the machine has it.
        linked: the module.
        machine: what it runs on.
        surroundings: where it finds what it does not hold itself.
        address: of its data; None allocates it.
        sources: its files, to tell where it uses what is nowhere.

    Attributes:
        name: as above.
        address: of its data.
        instance: its functions, after `link`.

    Raises:
        ConfigurationError: a variable that it uses is nowhere; all of them are told.
    """

    def __init__(
        self,
        name: str,
        linked: SharedModule,
        machine: Machine,
        surroundings: ModuleSurroundings,
        address: int | None = None,
        sources: Sequence[Path] = (),
    ) -> None:
        self.name = name
        self._sources = sources
        self._linked = linked
        self._machine = machine
        self._surroundings = surroundings
        alignment = max(linked.memory_alignment, _ALIGNMENT)
        memory = machine.memory
        self.address = (
            memory.allocate(linked.memory_size, alignment) if address is None else address
        )
        self._placement = Placement(
            self.address,
            machine.reserve_functions(linked.table_size),
            self._addresses(),
            self._pointers(),
        )
        self.instance: Instance

    @cached_property
    def _code(self) -> MachineCode:
        return self._machine.compile_made(self._identity(), lambda: self._placed.wasm)

    def compile(self) -> bool:
        """Compile it to machine code; return whether that was in no cache."""
        return self._code.is_new

    def link(self) -> Self:
        """Give its functions what they call, and return the module, ready but for a `reset`.

        Raises:
            ConfigurationError: a function that it uses is nowhere; all of them are told.
        """
        self.instance = self._machine.instantiate(self._code, self._functions())
        for pointer, index in self._placement.pointers.items():
            self._machine.set_function(index, self.extern(pointer))
        self._relocate = self._optional("__wasm_apply_data_relocs")
        self._construct = self._optional("__wasm_call_ctors")
        return self

    @cached_property
    def _placed(self) -> PlacedModule:
        """The module as it is compiled; after that it is needed for faults only."""
        return place(self._linked, self._placement, self.name)

    def _identity(self) -> bytes:
        """Return what the compiled code depends on."""
        where = repr((self.name, self._placement)).encode()
        return hashlib.blake2b(self._linked.wasm).digest() + where

    def _addresses(self) -> dict[str, int]:
        own = self._linked.variables
        found = {
            name: self._surroundings.variable(name)
            or (self.address + own[name] if name in own else None)
            for name in self._linked.addresses
        }
        return self._complete(found, "variable")

    def _pointers(self) -> dict[str, int]:
        """Give each function that the module needs a pointer to an entry of the table."""
        names = self._linked.pointers
        first = self._machine.reserve_functions(len(names))
        return {name: first + number for number, name in enumerate(names)}

    def _functions(self) -> dict[tuple[str, str], Extern | int]:
        find, jumps = self._surroundings.function, self._machine.shared(NonlocalJumps)
        called = self._linked.called.items()
        found = {name: find(name, type_) or jumps.extern(name) for name, type_ in called}
        return {("env", name): extern for name, extern in self._complete(found, "function").items()}

    def _complete(self, found: Mapping[str, V | None], kind: str) -> dict[str, V]:
        missing = sorted(name for name, value in found.items() if value is None)
        if missing:
            raise ConfigurationError(*(self._told_missing(kind, name) for name in missing))
        return {name: value for name, value in found.items() if value is not None}

    def _told_missing(self, kind: str, symbol: str) -> str:
        name = plain_name(symbol)
        place = first_use(name, self._sources)
        who = f"{place}: {self.name}" if place else f"{self.name}:"
        return f"{who} uses {kind} {name}, which is nowhere"

    def __contains__(self, name: str) -> bool:
        return name in self._linked.functions

    def extern(self, name: str) -> Extern:
        """Return a function of the module, or of its surroundings, for others to import."""
        if name in self._linked.functions:
            return self.instance.extern(name)
        found = self._surroundings.function(name)
        if found is None:
            raise ConfigurationError(self._told_missing("function", name))
        return found

    def function(self, name: str, params: str | None = None, results: str | None = None) -> Any:
        """Return a function of the module as a Python callable."""
        return self.instance.function(name, params, results)

    def _optional(self, name: str) -> Callable[[], None]:
        return self.instance.function(name) if name in self._linked.functions else _nothing

    def address_of(self, variable: str) -> int | None:
        """Return the address of a variable that the module itself defines, None without one."""
        offset = self._linked.variables.get(variable)
        return None if offset is None else self.address + offset

    def reset(self) -> None:
        """Give all its variables their initial values, as before its first call."""
        self.initialise()
        self.construct()

    def initialise(self) -> None:
        """Give its variables the initial values that the linker knows."""
        memory = self._machine.memory
        memory.write(self.address, bytes(self._linked.memory_size))
        for address, content in initial_values(self._linked, self._placement):
            memory.write(address, content)
        self._relocate()

    def construct(self) -> None:
        """Run the constructors of C++ of its variables."""
        self._construct()

    def location(self, frame: Frame) -> str:
        """Return "file:line" of a frame in this module, "" where it is not known."""
        offset = self._placed.linked_offset(frame.offset)
        return self._lines.location(offset - self._linked.code_start)

    @cached_property
    def _lines(self) -> LineTable:
        return read_line_table(self._linked.section(".debug_line"))


def _nothing() -> None:
    pass
