"""The code of programs in Structured Text: checked, compiled, and made tasks of."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from plcsim.core.errors import ConfigurationError, CycleTimeViolation
from plcsim.core.suggestion import did_you_mean
from plcsim.core.task import Task, Unit
from plcsim.program.language import PlacedProgram
from plcsim.program.structured_text.check.declared import unit_scope
from plcsim.program.structured_text.check.program import check_program
from plcsim.program.structured_text.check.programs import ALL_PROGRAMS, MeantProgram
from plcsim.program.structured_text.code_cache import Stored, code_cache, find, keep, key_of
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.codegen.text import text_of
from plcsim.program.structured_text.coverage import MEASURING, keep_possible
from plcsim.program.structured_text.layout import OWN, VariableLayout, addresses, variables_in
from plcsim.program.structured_text.linkage import Linkage, missing
from plcsim.program.structured_text.lower.module import lower
from plcsim.program.structured_text.lower.semantics import semantics_of
from plcsim.program.structured_text.program_uses import program_uses
from plcsim.program.structured_text.sources import UnitDeclarations, check_syntax
from plcsim.program.structured_text.syntax.tree import ProgramUnit
from st_types.errors import DiagnosticSeverity

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from plcsim.core.tag import Tag
    from plcsim.library.catalogue import Catalogue
    from plcsim.machine import Instance, Machine
    from plcsim.program.language import ProgramSource
    from plcsim.program.site import Site
    from plcsim.program.structured_text import ir
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
    meant = MeantProgram(source.only, source.instance)
    return compile_program(name, files, scope, source.shared, catalogue, meant)


def compile_program(
    name: str,
    files: Sequence[UnitFile],
    scope: Scope,
    shared: DeclaredVariables,
    catalogue: Catalogue,
    meant: MeantProgram = ALL_PROGRAMS,
) -> StructuredTextCode:
    """Check and compile a program.

    Args:
        name: of the program.
        files: with its units.
        scope: what it declares and sees.
        shared: the global variables of the project.
        catalogue: libraries of the project.
        meant: of several PROGRAMs in the files the one that is compiled: what the files declare
            outside of them is global then; all are units of one program where it has no name.

    Raises:
        ConfigurationError: there are errors; all are told, with file, line and column.
    """
    names = (name, *meant, scope.dialect.name, repr(MEASURING.options))
    cache, key = code_cache(), key_of(names, files, scope, shared)
    stored = find(cache, key)
    if stored is None:
        check_syntax(files)
        _check_meant(files, meant.name)
        parsed = [file.parsed for file in files]
        stored, variables = _compiled(name, parsed, scope, shared, meant)
        keep(cache, key, stored)
    else:
        variables = variables_in(name, _own_scopes(files, scope, meant))
    keep_possible(stored.code.profile, {file.path: file.source.text for file in files})
    absent = missing(catalogue, scope, stored.code.imports)
    if absent:
        raise ConfigurationError(*(f"{_caller(files, each)}: {text}" for each, text in absent))
    return StructuredTextCode(stored.code, scope, variables, stored.warnings)


def _caller(files: Sequence[UnitFile], wanted: ir.Import) -> str:
    """Return where a function is called first; the folder for a block, which has instances."""
    call = [wanted.name.upper(), "("]
    for file in files if wanted.space == "function" else ():
        tokens = file.parsed.tokens
        texts = [text.upper() for text in tokens.texts]
        for at in range(1, len(texts)):
            if texts[at : at + 2] == call and texts[at - 1] != ".":
                return f"{tokens.location(at)}: error"
    return str(Path(files[0].path).parent)


def _check_meant(files: Sequence[UnitFile], meant: str) -> None:
    """Raise a ConfigurationError where no file holds the PROGRAM that is meant."""
    units = [unit for file in files for unit in file.parsed.units]
    names = [unit.name for unit in units if isinstance(unit, ProgramUnit)]
    if meant and meant.upper() not in map(str.upper, names):
        near = did_you_mean(meant, names)
        told = ", ".join(file.path for file in files)
        raise ConfigurationError(f"{told}: no PROGRAM {meant} is there{near}")


def _own_scopes(files: Sequence[UnitFile], scope: Scope, meant: MeantProgram) -> list[Scope]:
    """Return the scopes whose variables are those of a program, as checking it does."""
    uses = program_uses(file.source.text for file in files)
    parsed = [file.parsed for file in files if file.may_declare]
    units = [(unit, file) for file in parsed for unit in file.units]
    found = [
        unit_scope(unit, file, scope, uses)
        for unit, file in units
        if isinstance(unit, ProgramUnit) and meant.includes(unit)
    ]
    return [*([] if meant.name else [scope]), *(each for each in found if each is not None)]


def _compiled(
    name: str,
    files: Sequence[StructuredTextFile],
    scope: Scope,
    shared: DeclaredVariables,
    meant: MeantProgram,
) -> tuple[Stored, DeclaredVariables]:
    program, warnings = checked(name, files, scope, "global" if meant.name else "program", meant)
    if not any(body.kind == "unit" for body in program.bodies):
        raise ConfigurationError(
            f"{files[0].path}: no PROGRAM is here or in the files beside it; "
            "one of them holds PROGRAM _CYCLIC ... END_PROGRAM"
        )
    layout = VariableLayout(name, program.scopes, scope.chain, shared)
    module = lower(program, layout.areas, semantics_of(scope))
    module.name = ".".join(filter(None, (name, *meant)))
    return Stored(generate(module, MEASURING.options), warnings), layout.variables


def checked(
    name: str,
    files: Sequence[StructuredTextFile],
    scope: Scope,
    storage: Storage = "program",
    meant: MeantProgram = ALL_PROGRAMS,
) -> tuple[CheckedProgram, list[str]]:
    """Check bodies; return what is to be lowered, and the warnings about them.

    Raises:
        ConfigurationError: there are errors; all are told.
    """
    known = {id(record) for file in files for record in file.diagnostics.records}
    program = check_program(name, files, scope, storage=storage, meant=meant)
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

    def wat(self) -> Iterator[str]:
        """Yield the lines of its WebAssembly as text; addresses are told by their segments."""
        return text_of(self._code)

    def place(self, name: str, site: Site) -> PlacedProgram:
        """Give a task variables of its own."""
        variables, constants = self._variables.allocate(site.memory, name)
        linkage = Linkage.of(site)
        own = addresses(OWN, (variables, constants))
        placed = linkage.place(self._code, self._scope, own, name)
        return PlacedProgram(
            placed.compile, lambda: _task(name, site, variables, constants, placed.link())
        )


def _task(name: str, site: Site, variables: Tag, constants: Tag | None, instance: Instance) -> Task:
    units = {unit: _unit(instance, unit, site.machine) for unit in Unit}
    return Task(
        name,
        variables,
        units,
        constants=constants,
        fault_of=Linkage.of(site).fault_of,
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
