"""A controller from a file of Structured Text alone, without a plc.toml.

A file as IEC 61131-3 has it tells by its CONFIGURATION which programs run in which tasks: they
become task classes, the highest priority first. Without one every PROGRAM runs in class 1. Of a
program of Automation Studio all files in its folder belong to it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.task import HIGHEST_CLASS
from plcsim.library.library import check_scope, declarations_of, read_declarations, sources_in
from plcsim.program.loader import installed_catalogue
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup
from plcsim.program.structured_text.code import compile_program
from plcsim.program.structured_text.dialect import is_standard
from plcsim.program.structured_text.language import STRUCTURED_TEXT
from plcsim.program.structured_text.layout import NOTHING
from plcsim.program.structured_text.sources import check_syntax, read_files
from plcsim.program.structured_text.syntax.tree import Configuration, ProgramUnit
from plcsim.program.variables import variables_of
from plcsim.project.assembly import Application
from st_types.errors import SourceError
from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC
from st_types.resolve.scope import Scope

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from plcsim.program.structured_text.code import StructuredTextCode
    from plcsim.program.structured_text.syntax.tree import (
        ProgramConfiguration,
        StructuredTextFile,
        TaskConfiguration,
    )
    from st_types.syntax.expressions import Expression

DEFAULT_CYCLE_NS: Final = 10_000_000
NS_PER_MS: Final = 1_000_000
LOWEST_PRIORITY: Final = 65535


class _Task(NamedTuple):
    """A TASK; of programs without one it has no name, and the lowest priority.

    Attributes:
        priority: 0 is the highest.
        name: of the task.
        cycle_ns: its INTERVAL.
    """

    priority: int
    name: str
    cycle_ns: int


def load_file(path: Path, cycle_ns: int | None = None) -> Application:
    """Load the programs of a file.

    Args:
        path: of a file with a PROGRAM.
        cycle_ns: cycle time of what no TASK has; 10 ms by default.

    Raises:
        ConfigurationError: it cannot be read, or is wrong; all findings are told.
    """
    (file,) = read_files([path])
    check_syntax([file])
    standard = is_standard(file.parsed)
    around = sources_in(path.parent)
    files = [file] if standard else read_files(STRUCTURED_TEXT.units(around))
    name = path.stem if standard else path.resolve().parent.name
    catalogue = installed_catalogue()
    declared = [
        *read_declarations(declarations_of(around)),
        *(each.declarations() for each in files),
    ]
    dialect = IEC if standard else AUTOMATION_STUDIO
    scope = Scope(name, declared, catalogue.scopes, dialect=dialect, strict=True)
    warnings = check_scope(scope)
    shared = variables_of("globals", scope.variables) if standard else NOTHING
    codes: dict[str, StructuredTextCode] = {}
    findings = Findings()
    for program in _programs(file.parsed) if standard else [""]:
        with findings.gathered():
            code = compile_program(name, files, scope, shared, catalogue, only=program)
            codes[program.upper()] = code
            warnings += code.warnings
    findings.check()
    default_ns = cycle_ns or DEFAULT_CYCLE_NS
    if standard:
        classes = _classes(file.parsed, codes, scope, default_ns)
    else:
        classes = [_class_of(1, default_ns, [ProgramSetup(name, codes[""])])]
    has_shared = any(kind.members for kind in shared)
    setup = Setup(classes, shared=shared if has_shared else None, catalogue=catalogue)
    return Application(name, setup, warnings=warnings)


def _programs(file: StructuredTextFile) -> list[str]:
    """Return the names of all PROGRAMs.

    Raises:
        ConfigurationError: there is none.
    """
    found = [unit.name for unit in file.units if isinstance(unit, ProgramUnit)]
    if not found:
        raise ConfigurationError(f"{file.path}: no PROGRAM is in it, so there is nothing to run")
    return found


def _class_of(number: int, cycle_ns: int, programs: Sequence[ProgramSetup]) -> TaskClassSetup:
    return TaskClassSetup(number, cycle_ns, programs, cycle_ns)


def _classes(
    file: StructuredTextFile, codes: Mapping[str, StructuredTextCode], scope: Scope, cycle_ns: int
) -> list[TaskClassSetup]:
    tasks: dict[str, _Task] = {"": _Task(LOWEST_PRIORITY, "", cycle_ns)}
    programs: list[tuple[str, ProgramSetup]] = []
    findings = Findings()
    for each in _configurations(file):
        for task in each.tasks:
            with findings.gathered():
                tasks[task.name.upper()] = _task(file, task, scope)
    findings.check()
    for each in _configurations(file):
        for program in each.programs:
            with findings.gathered():
                programs.append((program.task.upper(), _instance(file, program, codes, tasks)))
    findings.check()
    if not programs:
        programs = [("", ProgramSetup(_declared_name(file, key), codes[key])) for key in codes]
    used = {name for name, _ in programs}
    classes = sorted(task for name, task in tasks.items() if name in used)
    if len(classes) > HIGHEST_CLASS:
        raise ConfigurationError(
            f"{file.path}: {len(classes)} tasks; a controller has {HIGHEST_CLASS} task classes"
        )
    return [
        _class_of(number, task.cycle_ns, [p for name, p in programs if name == task.name.upper()])
        for number, task in enumerate(classes, 1)
    ]


def _configurations(file: StructuredTextFile) -> Iterator[Configuration]:
    for unit in file.units:
        if isinstance(unit, Configuration):
            yield unit
            yield from unit.resources


def _declared_name(file: StructuredTextFile, key: str) -> str:
    return next(name for name in _programs(file) if name.upper() == key)


def _task(file: StructuredTextFile, task: TaskConfiguration, scope: Scope) -> _Task:
    given = {each.name.upper(): each.value for each in task.arguments}
    interval, priority = given.get("INTERVAL"), given.get("PRIORITY")
    if interval is None:
        raise ConfigurationError(
            f"{file.location(task)}: error: TASK {task.name} has no INTERVAL; "
            "tasks that wait for an event are not supported"
        )
    milliseconds = _value(interval, scope)
    if not milliseconds > 0:
        raise ConfigurationError(
            f"{file.location(task)}: error: INTERVAL of TASK {task.name} must be above 0"
        )
    level = LOWEST_PRIORITY if priority is None else _value(priority, scope)
    return _Task(int(level), task.name, int(milliseconds * NS_PER_MS))


def _value(expression: Expression, scope: Scope) -> float:
    try:
        value = scope.evaluate(expression).value
    except SourceError as err:
        raise ConfigurationError(str(err)) from None
    return float(value)


def _instance(
    file: StructuredTextFile,
    program: ProgramConfiguration,
    codes: Mapping[str, StructuredTextCode],
    tasks: Mapping[str, _Task],
) -> ProgramSetup:
    place = f"{file.location(program)}: error: PROGRAM {program.name}"
    if program.arguments:
        raise ConfigurationError(f"{place}: values of its variables are not supported here")
    if program.task.upper() not in tasks:
        raise ConfigurationError(f"{place}: there is no TASK {program.task} before it")
    if program.type_name.upper() not in codes:
        raise ConfigurationError(f"{place}: the file has no PROGRAM {program.type_name}")
    return ProgramSetup(program.name, codes[program.type_name.upper()])
