"""Task classes as a CONFIGURATION of IEC 61131-3 names them.

The TASKs that a PROGRAM runs in become task classes, the highest priority first. Without a
CONFIGURATION every PROGRAM runs in class 1.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.task import HIGHEST_CLASS
from plcsim.program.layout import INSTANCE_OF
from plcsim.program.structured_text.program_uses import program_uses
from plcsim.program.structured_text.sources import check_syntax, read_files
from plcsim.program.structured_text.syntax.tree import Configuration, ProgramUnit
from plcsim.project.tables import ProgramEntry, TaskClassTable, task_class_entry
from st_types.errors import SourceError
from st_types.resolve.dialect import IEC
from st_types.resolve.scope import Scope

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from pathlib import Path

    from plcsim.program.structured_text.program_uses import ProgramUses
    from plcsim.program.structured_text.sources import UnitFile
    from plcsim.program.structured_text.syntax.tree import (
        ProgramConfiguration,
        StructuredTextFile,
        TaskConfiguration,
    )
    from plcsim.project.tables import TaskClassEntry
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


def configured_classes(
    paths: Iterable[Path], cycle_ns: int = DEFAULT_CYCLE_NS
) -> tuple[TaskClassEntry, ...]:
    """Return the task classes of the programs in some files.

    Args:
        paths: of the files.
        cycle_ns: cycle time of what no TASK has.

    Returns:
        the classes; the source of a program is the name of its PROGRAM.

    Raises:
        ConfigurationError: the files have no PROGRAM, or are wrong; all findings are told.
    """
    files = read_files(paths)
    check_syntax(files)
    names = {name.upper(): name for file in files for name in _programs(file.parsed)}
    if not names:
        told = ", ".join(file.path for file in files)
        raise ConfigurationError(f"{told}: no PROGRAM is in it, so there is nothing to run")
    scope = Scope("configuration", [file.declarations() for file in files], dialect=IEC)
    uses = program_uses(file.source.text for file in files)
    return _Classes(scope, names, cycle_ns, uses).of(files)


def class_entry(number: int, cycle_ns: int, programs: Sequence[ProgramEntry]) -> TaskClassEntry:
    """Return a task class as nothing but its cycle time is given."""
    table = TaskClassTable(cycle_ns=cycle_ns, tolerance_ns=cycle_ns, programs=tuple(programs))
    return task_class_entry(number, table)


def _programs(file: StructuredTextFile) -> Iterator[str]:
    return (unit.name for unit in file.units if isinstance(unit, ProgramUnit))


class _Classes:
    """Reads the CONFIGURATIONs of files.

    Args:
        scope: knows the constants that they name.
        names: of the PROGRAMs, by the name in capitals.
        cycle_ns: of what no TASK has.
        uses: which PROGRAMs others name.
    """

    def __init__(
        self, scope: Scope, names: Mapping[str, str], cycle_ns: int, uses: ProgramUses
    ) -> None:
        self._uses = uses
        self._instances: set[str] = set()
        self._scope = scope
        self._names = names
        self._tasks: dict[str, _Task] = {"": _Task(LOWEST_PRIORITY, "", cycle_ns)}

    def of(self, files: Sequence[UnitFile]) -> tuple[TaskClassEntry, ...]:
        findings = Findings()
        found = [(file.parsed, each) for file in files for each in _configurations(file.parsed)]
        for file, each in found:
            for task in each.tasks:
                with findings.gathered():
                    self._tasks[task.name.upper()] = self._task(file, task)
        findings.check()
        programs: list[tuple[str, ProgramEntry]] = []
        for file, each in found:
            for program in each.programs:
                with findings.gathered():
                    programs.append((program.task.upper(), self._instance(file, program)))
        findings.check()
        if not programs:
            called = self._uses.called
            first = [name for upper, name in self._names.items() if upper not in called]
            programs = [("", ProgramEntry(name, name)) for name in first or self._names.values()]
        return self._entries(programs, files[0].path)

    def _entries(
        self, programs: Sequence[tuple[str, ProgramEntry]], path: str
    ) -> tuple[TaskClassEntry, ...]:
        used = {name for name, _ in programs}
        tasks = sorted(task for name, task in self._tasks.items() if name in used)
        if len(tasks) > HIGHEST_CLASS:
            message = f"{len(tasks)} tasks; a controller has {HIGHEST_CLASS} task classes"
            raise ConfigurationError(f"{path}: {message}")
        return tuple(
            class_entry(
                number, task.cycle_ns, [p for name, p in programs if name == task.name.upper()]
            )
            for number, task in enumerate(tasks, 1)
        )

    def _task(self, file: StructuredTextFile, task: TaskConfiguration) -> _Task:
        given = {each.name.upper(): each.value for each in task.arguments}
        interval, priority = given.get("INTERVAL"), given.get("PRIORITY")
        if interval is None:
            raise ConfigurationError(
                f"{file.location(task)}: error: TASK {task.name} has no INTERVAL; "
                "tasks that wait for an event are not supported"
            )
        milliseconds = self._value(interval)
        if not milliseconds > 0:
            raise ConfigurationError(
                f"{file.location(task)}: error: INTERVAL of TASK {task.name} must be above 0"
            )
        level = LOWEST_PRIORITY if priority is None else self._value(priority)
        return _Task(int(level), task.name, int(milliseconds * NS_PER_MS))

    def _value(self, expression: Expression) -> float:
        try:
            value = self._scope.evaluate(expression).value
        except SourceError as err:
            raise ConfigurationError(str(err)) from None
        return float(value)

    def _instance(self, file: StructuredTextFile, program: ProgramConfiguration) -> ProgramEntry:
        place = f"{file.location(program)}: error: PROGRAM {program.name}"
        if program.task.upper() not in self._tasks:
            raise ConfigurationError(f"{place}: there is no TASK {program.task} before it")
        source = self._names.get(program.type_name.upper())
        if source is None:
            raise ConfigurationError(f"{place}: the file has no PROGRAM {program.type_name}")
        if source.upper() in self._uses.named:
            if source in self._instances:
                raise ConfigurationError(
                    f"{place}: {source} exists once, for other programs name it; it has a task"
                )
            self._instances.add(source)
        return ProgramEntry(
            program.name,
            f"{program.name}{INSTANCE_OF}{source}" if program.arguments else source,
        )


def _configurations(file: StructuredTextFile) -> Iterator[Configuration]:
    for unit in file.units:
        if isinstance(unit, Configuration):
            yield unit
            yield from unit.resources
