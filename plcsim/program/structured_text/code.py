"""The code of programs in Structured Text: checked, compiled, and made tasks of."""

from __future__ import annotations

from typing import TYPE_CHECKING, NoReturn

from plcsim.core.errors import ConfigurationError, CycleTimeViolation
from plcsim.core.task import Task, Unit
from plcsim.program.structured_text.check.program import UnitDeclarations, check_program
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.layout import OWN, Layout, addresses
from plcsim.program.structured_text.linkage import Linkage, missing
from plcsim.program.structured_text.lower.module import lower
from st_types.errors import Severity

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

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
    scope = source.scope
    files = [each.file for each in scope.files if isinstance(each, UnitDeclarations)]
    program, warnings = checked(source.name, files, scope)
    if not any(body.kind == "unit" for body in program.bodies):
        raise ConfigurationError(
            f"{source.folder}: no PROGRAM is in its files; "
            "one of them holds PROGRAM _CYCLIC ... END_PROGRAM"
        )
    layout = Layout(source.name, program.scopes, scope.chain, source.shared)
    code = generate(lower(program, layout.areas))
    absent = missing(source.declarations.catalogue, scope, code.imports)
    if absent:
        raise ConfigurationError(*(f"{source.folder}: {each}" for each in absent))
    return StructuredTextCode(code, scope, layout.variables, warnings)


def checked(
    name: str, files: Sequence[StructuredTextFile], scope: Scope, storage: Storage = "program"
) -> tuple[Program, list[str]]:
    """Check bodies; return what is to be lowered, and the warnings about them.

    Raises:
        ConfigurationError: there are errors; all are told.
    """
    known = {id(record) for file in files for record in file.diagnostics.records}
    program = check_program(name, files, scope, storage=storage)
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
        )


def _unit(instance: Instance, unit: Unit, machine: Machine) -> Callable[[], None]:
    name = unit.value.lower()
    return machine.unit(instance.function(name)) if name in instance else _nothing


def _nothing() -> None:
    """Run a unit that the program does not have."""


def _interrupt(reason: str) -> NoReturn:
    """End the program: compiled code ends by its budget, what it calls in Python by this."""
    raise CycleTimeViolation(reason)
