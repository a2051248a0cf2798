"""The code of programs in Structured Text: checked, compiled, and made tasks of."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from plcsim.core.errors import ConfigurationError, CycleTimeViolation
from plcsim.core.task import Task, Unit
from plcsim.program.structured_text.check.program import UnitDeclarations, check_program
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.layout import OWN, Layout, addresses
from plcsim.program.structured_text.linkage import Linkage, missing
from plcsim.program.structured_text.lower.module import lower
from plcsim.program.structured_text.lower.semantics import AUTOMATION_STUDIO, IEC
from st_types.errors import Severity
from st_types.resolve import dialect as dialects

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.library.catalogue import Catalogue
    from plcsim.machine import Instance, Machine
    from plcsim.program.language import ProgramSource
    from plcsim.program.site import Site
    from plcsim.program.structured_text.check.typed import Program, Storage
    from plcsim.program.structured_text.codegen.object_code import ObjectCode
    from plcsim.program.structured_text.syntax.tree import StructuredTextFile
    from plcsim.program.variables import Variables
    from st_types.resolve.scope import Scope


def load(source: ProgramSource) -> StructuredTextCode:
    """Check and compile a program.

    Raises:
        ConfigurationError: there are errors in it; all are told, with file, line and column.
    """
    files = [each.file for each in source.scope.files if isinstance(each, UnitDeclarations)]
    catalogue = source.declarations.catalogue
    return compile_program(source.name, files, source.scope, source.shared, catalogue)


def compile_program(
    name: str,
    files: Sequence[StructuredTextFile],
    scope: Scope,
    shared: Variables,
    catalogue: Catalogue,
    only: str = "",
) -> StructuredTextCode:
    """Check and compile a program.

    Args:
        name: of the program.
        files: parsed without errors.
        scope: what it declares and sees.
        shared: the global variables of the project.
        catalogue: libraries of the project.
        only: of several PROGRAMs in the files the one that is meant: what the files declare outside
            of them is global then; "" where all are units of one program.

    Raises:
        ConfigurationError: there are errors; all are told, with file, line and column.
    """
    program, warnings = checked(name, files, scope, "global" if only else "program", only)
    if not any(body.kind == "unit" for body in program.bodies):
        raise ConfigurationError(
            f"{files[0].path}: no PROGRAM is here or in the files beside it; "
            "one of them holds PROGRAM _CYCLIC ... END_PROGRAM"
        )
    layout = Layout(name, program.scopes, scope.chain, shared)
    semantics = IEC if scope.dialect is dialects.IEC else AUTOMATION_STUDIO
    module = lower(program, layout.areas, semantics)
    module.name = f"{name}.{only}" if only else name
    code = generate(module)
    absent = missing(catalogue, scope, code.imports)
    if absent:
        raise ConfigurationError(*(f"{Path(files[0].path).parent}: {each}" for each in absent))
    return StructuredTextCode(code, scope, layout.variables, warnings)


def checked(
    name: str,
    files: Sequence[StructuredTextFile],
    scope: Scope,
    storage: Storage = "program",
    only: str = "",
) -> tuple[Program, list[str]]:
    """Check bodies; return what is to be lowered, and the warnings about them.

    Raises:
        ConfigurationError: there are errors; all are told.
    """
    known = {id(record) for file in files for record in file.diagnostics.records}
    program = check_program(name, files, scope, storage=storage, only=only)
    records = [each for file in files for each in file.diagnostics.records if id(each) not in known]
    errors = [each.render() for each in records if each.severity is Severity.ERROR]
    if errors:
        raise ConfigurationError(*errors)
    return program, [each.render() for each in records]


class StructuredTextCode:
    """A program in Structured Text; see `plcsim.program.language.ProgramCode`.

    Args:
        code: of its units.
        scope: in which its names were looked up.
        variables: types of its variables and constants.
        warnings: about its text, each with file, line, column and caret.
    """

    def __init__(
        self,
        code: ObjectCode,
        scope: Scope,
        variables: Variables,
        warnings: Sequence[str] = (),
    ) -> None:
        self._code = code
        self._scope = scope
        self._variables = variables
        self.warnings = warnings

    def task(self, name: str, site: Site) -> Task:
        """Return a task with variables of its own."""
        variables, constants = self._variables.allocate(site.memory, name)
        linkage = Linkage.of(site)
        own = addresses(OWN, (variables, constants))
        instance = linkage.link(self._code, self._scope, own)
        units = {unit: _unit(instance, unit, site.machine) for unit in Unit}
        return Task(
            name,
            variables,
            units,
            constants=constants,
            fault_of=linkage.fault_of,
            interrupt=_interrupt,
            instructions=site.machine.meter,
        )


def _unit(instance: Instance, unit: Unit, machine: Machine) -> Callable[[], None]:
    name = unit.value.lower()
    return machine.unit(instance.function(name)) if name in instance else _nothing


def _nothing() -> None:
    """Run a unit that the program does not have."""


def _interrupt(reason: str) -> NoReturn:
    """End the program: compiled code ends by its budget, what it calls in Python by this."""
    raise CycleTimeViolation(reason)
