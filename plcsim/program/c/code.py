"""The code of programs in C: compiled, linked, and made tasks of."""

from __future__ import annotations

from typing import TYPE_CHECKING, NoReturn

from plcsim.ansi_c.build import Order, build
from plcsim.ansi_c.c_library import CLibrary
from plcsim.ansi_c.headers import INCLUDE, program_headers, write_headers
from plcsim.ansi_c.heap import HEAP_SIZE, Heap, is_of_heap
from plcsim.ansi_c.module import CModule
from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError, CycleTimeViolation, Fault
from plcsim.core.tag import Tag
from plcsim.core.task import Task, Unit
from plcsim.machine import frames_of, trace_inside
from plcsim.machine.cache import CodeCache, default_folder
from plcsim.machine.shared_module import read_shared
from plcsim.program.c.blocks import block_classes, caller, library_scopes
from plcsim.program.c.variables import scope_of, variables_of
from plcsim.program.fault import describe, frames

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.machine import Extern, Machine
    from plcsim.machine.shared_module import SharedModule
    from plcsim.program.language import ProgramSource
    from plcsim.program.site import Site
    from st_types.types.derived import StructType

_UNIT_NAMES = {unit: f"_{unit.value}" for unit in Unit}


def load(source: ProgramSource) -> CCode:
    """Compile and link the files of a program.

    Raises:
        ConfigurationError: there are errors in it or in its declarations; all are told.
    """
    local = scope_of(source.name, source.folder, library_scopes())
    cache = default_folder()
    headers = program_headers(local, None, library_scopes())
    folder = write_headers(headers, cache.parent / "include" if cache else None)
    order = Order(source.name, source.files, [source.folder, folder, INCLUDE])
    built = build(order, find_toolchain(), CodeCache(cache.parent / "c" if cache else None))
    linked = read_shared(built.wasm)
    if not any(name in linked.functions for name in _UNIT_NAMES.values()):
        raise ConfigurationError(
            f"{source.folder}: no function of the program is marked _INIT, _CYCLIC or _EXIT"
        )
    return CCode(linked, variables_of(local, source.name))


class CCode:
    """A program in C; see `plcsim.program.language.ProgramCode`."""

    warnings: Sequence[str] = ()

    def __init__(self, linked: SharedModule, variables: StructType[object]) -> None:
        self._linked = linked
        self._variables = variables

    def task(self, name: str, site: Site) -> Task:
        """Return a task with variables and data of its own."""
        kind = self._variables
        variables = Tag(name, kind, site.memory.allocate(kind.size, kind.alignment))
        surroundings = _Surroundings(name, kind, variables.address, site)
        module = CModule(name, self._linked, site.machine, surroundings)
        units = {unit: _unit(module, unit, site.machine) for unit in Unit}
        units[Unit.INIT] = _fresh(module, surroundings, units[Unit.INIT])

        def fault_of(error: BaseException) -> Fault:
            return _fault(module, error)

        return Task(
            name,
            variables,
            units,
            fault_of=fault_of,
            interrupt=_interrupt,
            instructions=site.machine.meter,
        )


class _Surroundings:
    """What a program in C finds on its controller."""

    def __init__(self, name: str, variables: StructType[object], address: int, site: Site) -> None:
        self._name = name
        self._variables = variables
        self._address = address
        self._site = site
        self._library = site.machine.shared(CLibrary)
        self._externs: dict[str, Extern] = {}
        self.heap: Heap | None = None

    def variable(self, name: str) -> int | None:
        try:
            return self._address + self._variables.find(name)[1]
        except KeyError:
            return self._library.variable(name)

    def function(self, name: str) -> Extern | None:
        block = block_classes().get(name)
        if is_of_heap(name):
            return self._own_heap().extern(name)
        if block is None:
            return self._library.extern(name)
        if name not in self._externs:
            call = caller(block, self._site.context)
            self._externs[name] = self._site.machine.host_function(call, "I")
        return self._externs[name]

    def _own_heap(self) -> Heap:
        if self.heap is None:
            self.heap = Heap(self._name, self._site.machine, self._library, HEAP_SIZE)
        return self.heap


def _unit(module: CModule, unit: Unit, machine: Machine) -> Callable[[], None]:
    """Return what runs a unit."""
    name = _UNIT_NAMES[unit]
    return machine.unit(module.function(name)) if name in module else _nothing


def _fresh(
    module: CModule, surroundings: _Surroundings, run: Callable[[], None]
) -> Callable[[], None]:
    """Return the unit INIT: before it the program's data and heap are as they were at first."""

    def init() -> None:
        if surroundings.heap is not None:
            surroundings.heap.reset()
        module.reset()
        run()

    return init


def _nothing() -> None:
    pass


def _interrupt(reason: str) -> NoReturn:
    raise CycleTimeViolation(reason)


def _fault(module: CModule, error: BaseException) -> Fault:
    """Return what something that a unit raised means, with the chain of calls in C."""
    calls = [
        (module.location(frame), frame.function)
        for frame in reversed(frames_of(error))
        if frame.module == module.name
    ]
    calls = [(location, name) for location, name in calls if location]
    calls += frames(trace_inside(error))
    texts = tuple(f"{location} in {name}" for location, name in calls)
    return Fault(calls[-1][0] if calls else "", describe(error), texts)
