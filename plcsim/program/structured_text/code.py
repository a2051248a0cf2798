"""The code of programs in Structured Text: checked, compiled, and made tasks of."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from plcsim.core.errors import ConfigurationError, CycleTimeViolation
from plcsim.core.suggestion import did_you_mean
from plcsim.core.task import Task, Unit
from plcsim.program.structured_text.check.program import check_program, is_meant, unit_scope
from plcsim.program.structured_text.code_cache import Stored, code_cache, find, keep, key_of
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.coverage import MEASURING, keep_possible
from plcsim.program.structured_text.layout import OWN, VariableLayout, addresses
from plcsim.program.structured_text.linkage import Linkage, missing
from plcsim.program.structured_text.lower.module import lower
from plcsim.program.structured_text.lower.semantics import AUTOMATION_STUDIO, IEC
from plcsim.program.structured_text.sources import UnitDeclarations, check_syntax
from plcsim.program.structured_text.syntax.tree import ProgramUnit
from st_types.errors import DiagnosticSeverity
from st_types.resolve import dialect as dialects

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.library.catalogue import Catalogue
    from plcsim.machine import Instance, Machine
    from plcsim.program.language import ProgramSource
    from plcsim.program.site import Site
    from plcsim.program.structured_text.check.typed import CheckedProgram, Storage
    from plcsim.program.structured_text.codegen.object_code import ObjectCode
    from plcsim.program.structured_text.sources import UnitFile
    from plcsim.program.structured_text.syntax.tree import StructuredTextFile
    from plcsim.program.variables import DeclaredVariables
    from st_types.resolve.scope import Scope


def load(source: ProgramSource) -> StructuredTextCode:
    """Check and compile a program.

    Raises:
        ConfigurationError: there are errors in it; all are told, with file, line and column.
    """
    scope = source.declarations.scope if source.only else source.scope
    files = [each.unit_file for each in scope.files if isinstance(each, UnitDeclarations)]
    name = scope.name if source.only else source.name
    catalogue = source.declarations.catalogue
    return compile_program(name, files, scope, source.shared, catalogue, source.only)


def compile_program(
    name: str,
    files: Sequence[UnitFile],
    scope: Scope,
    shared: DeclaredVariables,
    catalogue: Catalogue,
    only: str = "",
) -> StructuredTextCode:
    """Check and compile a program.

    Args:
        name: of the program.
        files: with its units.
        scope: what it declares and sees.
        shared: the global variables of the project.
        catalogue: libraries of the project.
        only: of several PROGRAMs in the files the one that is meant: what the files declare outside
            of them is global then; "" where all are units of one program.

    Raises:
        ConfigurationError: there are errors; all are told, with file, line and column.
    """
    names = (name, only, scope.dialect.name, repr(MEASURING.options))
    cache, key = code_cache(), key_of(names, files, scope, shared)
    stored = find(cache, key)
    if stored is None:
        check_syntax(files)
        _check_only(files, only)
        stored, layout = _compiled(name, [file.parsed for file in files], scope, shared, only)
        keep(cache, key, stored)
    else:
        layout = VariableLayout(name, _own_scopes(files, scope, only), scope.chain, shared)
    keep_possible(stored.code.profile, {file.path: file.source.text for file in files})
    absent = missing(catalogue, scope, stored.code.imports)
    if absent:
        raise ConfigurationError(*(f"{Path(files[0].path).parent}: {each}" for each in absent))
    return StructuredTextCode(stored.code, scope, layout.variables, stored.warnings)


def _check_only(files: Sequence[UnitFile], only: str) -> None:
    """Raise a ConfigurationError where no file holds the PROGRAM that is meant."""
    units = [unit for file in files for unit in file.parsed.units]
    names = [unit.name for unit in units if isinstance(unit, ProgramUnit)]
    if only and only.upper() not in map(str.upper, names):
        near = did_you_mean(only, names)
        told = ", ".join(file.path for file in files)
        raise ConfigurationError(f"{told}: no PROGRAM {only} is there{near}")


def _own_scopes(files: Sequence[UnitFile], scope: Scope, only: str) -> list[Scope]:
    """Return the scopes whose variables are those of a program, as checking it does."""
    parsed = [file.parsed for file in files if file.may_declare]
    units = [(unit, file) for file in parsed for unit in file.units]
    found = [
        unit_scope(unit, file, scope)
        for unit, file in units
        if isinstance(unit, ProgramUnit) and is_meant(unit, only)
    ]
    return [*([] if only else [scope]), *(each for each in found if each is not None)]


def _compiled(
    name: str,
    files: Sequence[StructuredTextFile],
    scope: Scope,
    shared: DeclaredVariables,
    only: str,
) -> tuple[Stored, VariableLayout]:
    program, warnings = checked(name, files, scope, "global" if only else "program", only)
    if not any(body.kind == "unit" for body in program.bodies):
        raise ConfigurationError(
            f"{files[0].path}: no PROGRAM is here or in the files beside it; "
            "one of them holds PROGRAM _CYCLIC ... END_PROGRAM"
        )
    layout = VariableLayout(name, program.scopes, scope.chain, shared)
    semantics = IEC if scope.dialect is dialects.IEC else AUTOMATION_STUDIO
    module = lower(program, layout.areas, semantics)
    module.name = f"{name}.{only}" if only else name
    return Stored(generate(module, MEASURING.options), warnings), layout


def checked(
    name: str,
    files: Sequence[StructuredTextFile],
    scope: Scope,
    storage: Storage = "program",
    only: str = "",
) -> tuple[CheckedProgram, list[str]]:
    """Check bodies; return what is to be lowered, and the warnings about them.

    Raises:
        ConfigurationError: there are errors; all are told.
    """
    known = {id(record) for file in files for record in file.diagnostics.records}
    program = check_program(name, files, scope, storage=storage, only=only)
    records = [each for file in files for each in file.diagnostics.records if id(each) not in known]
    errors = [each.render() for each in records if each.severity is DiagnosticSeverity.ERROR]
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
        variables: DeclaredVariables,
        warnings: Sequence[str] = (),
    ) -> None:
        self._code = code
        self._scope = scope
        self._variables = variables
        self.warnings = warnings

    @property
    def imported(self) -> frozenset[str]:
        """Names of the blocks and functions of libraries that it calls."""
        return frozenset(each.name for each in self._code.imports)

    def task(self, name: str, site: Site) -> Task:
        """Return a task with variables of its own."""
        variables, constants = self._variables.allocate(site.memory, name)
        linkage = Linkage.of(site)
        own = addresses(OWN, (variables, constants))
        instance = linkage.link(self._code, self._scope, own, name)
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
