"""The code of programs in C: compiled, linked, and made tasks of."""

from __future__ import annotations

import re
from functools import partial
from typing import TYPE_CHECKING, NoReturn

from plcsim.ansi_c.module import CModule
from plcsim.ansi_c.variables import global_variables, own_variables
from plcsim.core.errors import ConfigurationError, CycleTimeViolation
from plcsim.core.tag import Tag
from plcsim.core.task import Task, Unit
from plcsim.program.c.sources import compile_program
from plcsim.program.c.surroundings import ProgramSurroundings, heap_size_of
from plcsim.program.compiled import CallSite, CompiledPrograms
from plcsim.program.language import PlacedProgram
from plcsim.program.variables import variables_of
from st_types.types.derived import StructType

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.machine import Frame, Machine
    from plcsim.program.c.sources import LinkedModule
    from plcsim.program.compiled import Locate
    from plcsim.program.language import ProgramSource
    from plcsim.program.site import Site
    from plcsim.program.variables import DeclaredVariables
    from st_types.resolve.scope import Scope
    from st_types.types.derived import Member

_UNIT_NAMES = {unit: f"_{unit.value}" for unit in Unit}


def load(source: ProgramSource) -> CCode:
    """Compile and link the files of a program.

    Raises:
        ConfigurationError: there are errors in it, or no compiler; all are told.
    """
    compiled = compile_program(source)
    if not any(name in compiled.module.functions for name in _UNIT_NAMES.values()):
        raise ConfigurationError(
            f"{source.folder}: no function of the program is marked _INIT, _CYCLIC or _EXIT"
        )
    twice = [name for name in _UNIT_NAMES.values() if compiled.module.functions.count(name) > 1]
    if twice:
        raise ConfigurationError(*(_told_twice(source, name) for name in twice))
    heap_size = source.declarations.layout.c_build.heap_size
    variables = variables_of(source.name, source.scope.variables)
    return CCode(compiled, source.scope, variables, heap_size)


def _told_twice(source: ProgramSource, unit: str) -> str:
    mark = re.compile(rf"^(?!\s*(?://|\*)).*\b{unit}\b")
    places = [
        f"{file}:{number}"
        for file in source.files
        for number, line in enumerate(file.read_text("latin-1").splitlines(), 1)
        if mark.match(line)
    ]
    return f"{source.name}: {unit} is there more than once: {' and '.join(places)}"


class CCode:
    """A program in C; see `plcsim.program.language.ProgramCode`.

    Args:
        compiled: its module.
        scope: in which its names are looked up.
        variables: types of its variables and constants.
        heap_size: in bytes, of its heap where it does not say itself.
    """

    def __init__(
        self, compiled: LinkedModule, scope: Scope, variables: DeclaredVariables, heap_size: int
    ) -> None:
        self._default_heap = heap_size
        self._module = compiled.module
        self._sources = compiled.sources
        self._scope = scope
        self._variables = variables
        self._global_sizes = global_variables(compiled.module, scope)
        self.warnings = compiled.warnings

    def place(self, name: str, site: Site) -> PlacedProgram:
        """Give a task variables, data and a heap of its own."""
        variables, constants = self._variables.allocate(site.memory, name)
        own = [variables] if constants is None else [variables, constants]
        size = heap_size_of(self._module, self._default_heap)
        folders = [file.parent for file in self._sources]
        surroundings = ProgramSurroundings(
            name, site, self._scope, own, size, self._global_sizes, folders
        )
        module = CModule(name, self._module, site.machine, surroundings, sources=self._sources)
        surroundings.define(module.address_of)
        placed = partial(self._task, name, site, own, surroundings, module)
        return PlacedProgram(module.compile, placed)

    def _task(
        self,
        name: str,
        site: Site,
        own: Sequence[Tag],
        surroundings: ProgramSurroundings,
        module: CModule,
    ) -> Task:
        """Link a module, and return its task."""
        module.link()
        variables, *constants = own
        compiled = CompiledPrograms.of(site)
        compiled.locate_by(name, locator(module))
        names = [each.name for tag in (*own, *site.shared) for each in _members(tag)]
        names += surroundings.foreign
        data = own_variables(self._module, self._scope, names, name)
        more = [] if data is None else [Tag(name, data, module.address)]
        if surroundings.heap is not None:
            more.append(surroundings.heap.tag(name))
        units = {unit: _unit(module, unit, site.machine) for unit in Unit}
        site.memory.at_boot(module.initialise)  # before retained variables get what they had
        units[Unit.INIT] = _fresh(module, surroundings, units[Unit.INIT])
        return Task(
            name,
            variables,
            units,
            constants=constants[0] if constants else None,
            more=more,
            fault_of=compiled.fault_of,
            interrupt=_interrupt,
            instructions=site.machine.meter,
        )


def _members(tag: Tag) -> Sequence[Member]:
    assert isinstance(tag.data_type, StructType)
    return tag.data_type.members


def locator(module: CModule) -> Locate:
    """Return what locates the frames of a module."""

    def locate(frame: Frame) -> CallSite | None:
        location = module.location(frame)
        return CallSite(location, frame.function) if location else None

    return locate


def _unit(module: CModule, unit: Unit, machine: Machine) -> Callable[[], None]:
    name = _UNIT_NAMES[unit]
    return machine.unit(module.function(name)) if name in module else _nothing


def _fresh(
    module: CModule, surroundings: ProgramSurroundings, run: Callable[[], None]
) -> Callable[[], None]:
    """Return the unit INIT: before it the heap is as it was at first, and constructors run."""

    def init() -> None:
        surroundings.reset()
        module.construct()
        run()

    return init


def _nothing() -> None:
    """Run a unit that the program does not have."""


def _interrupt(reason: str) -> NoReturn:
    """End the program: compiled code ends by its budget, what it calls in Python by this."""
    raise CycleTimeViolation(reason)
