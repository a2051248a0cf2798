"""The task classes of an Automation Studio project, as a project of plcsim has them."""

from __future__ import annotations

from math import gcd
from typing import TYPE_CHECKING, Final

from plcsim.project.tables import ProgramEntry, TaskClassTable, task_class_entry

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

    from plcsim.project.automation_studio.hardware import Hardware
    from plcsim.project.automation_studio.reader import AutomationStudioProject, ProgramTask
    from plcsim.project.tables import TaskClassEntry

DEFAULT_TICK_NS: Final = 1_000_000


def tasks_to_run(project: AutomationStudioProject, skip: Collection[str] = ()) -> list[ProgramTask]:
    """Return the tasks that are not skipped, in order.

    Args:
        project: as it was read.
        skip: names of tasks.
    """
    skipped = {name.lower() for name in skip}
    return [task for task in project.tasks if task.name.lower() not in skipped]


def task_classes(
    tasks: Iterable[ProgramTask], hardware: Hardware, tables: Mapping[int, TaskClassTable]
) -> tuple[TaskClassEntry, ...]:
    """Return the task classes that run something.

    Args:
        tasks: in the order of Cpu.sw.
        hardware: gives the times.
        tables: of plc.toml, by number; what they give counts before Hardware.hw, and their programs
            run after those of Cpu.sw.
    """
    programs: dict[int, list[ProgramEntry]] = {}
    for task in tasks:
        programs.setdefault(task.task_class, []).append(ProgramEntry(task.name, task.source))
    for number, table in tables.items():
        programs.setdefault(number, []).extend(table.programs)
    return tuple(
        _entry(number, programs[number], hardware, tables.get(number, TaskClassTable()))
        for number in sorted(programs)
        if programs[number]
    )


def _entry(
    number: int, programs: Iterable[ProgramEntry], hardware: Hardware, table: TaskClassTable
) -> TaskClassEntry:
    cycle_ns, tolerance_ns = hardware.times(number)
    if table.tolerance_ns is not None:
        tolerance_ns = table.tolerance_ns
    whole = TaskClassTable(
        cycle_ns=table.cycle_ns or cycle_ns,
        tolerance_ns=tolerance_ns,
        first_release_ns=table.first_release_ns,
        policy=table.policy,
        host_policy=table.host_policy,
        programs=tuple(programs),
    )
    return task_class_entry(number, whole)


def tick_ns(hardware: Hardware, classes: Iterable[TaskClassEntry]) -> int:
    """Return the tick: that of Hardware.hw, or what all cycle times are a multiple of."""
    tick = hardware.tick_ns or DEFAULT_TICK_NS
    return gcd(tick, *(each.cycle_ns for each in classes))
