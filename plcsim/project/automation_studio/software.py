"""``Cpu.sw``: which program runs as which task in which task class."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.library.document import DocumentError, read_document
from plcsim.project.automation_studio.finding import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from plcsim.library.document import XmlElement

SUFFIX: Final = ".prg"
DATA_OBJECT_SUFFIX: Final = ".dob"

_CLASS = re.compile(r"Cyclic#([1-8])", re.IGNORECASE)


class TaskLine(NamedTuple):
    """A task as Cpu.sw has it.

    Attributes:
        name: of the task.
        source: names of the packages around the program, and its own.
        task_class: 1 to 8.
        line: of Cpu.sw.
        build_options: for the compiler of C.
    """

    name: str
    source: tuple[str, ...]
    task_class: int
    line: int
    build_options: str = ""


class DataObjectLine(NamedTuple):
    """A data object as Cpu.sw has it.

    Attributes:
        name: of the object.
        source: names of the packages around its folder, and its own.
        line: of Cpu.sw.
    """

    name: str
    source: tuple[str, ...]
    line: int


class Software(NamedTuple):
    """What Cpu.sw says.

    Attributes:
        tasks: that run, in its order.
        disabled: names of those that do not.
        data_objects: that the project has as text.
    """

    tasks: tuple[TaskLine, ...] = ()
    disabled: tuple[str, ...] = ()
    data_objects: tuple[DataObjectLine, ...] = ()


def read_software(file: Path) -> tuple[Software, list[Finding]]:
    """Read Cpu.sw; tasks of technology packages, which have no source, are left out.

    Of a file that was saved half the tasks that are in it are read.
    """
    findings: list[Finding] = []
    root: XmlElement | None
    try:
        root = read_document(file)
    except DocumentError as err:
        findings.append(Finding(file, err.line, str(err)))
        root = err.root
    if root is None:
        return Software(), findings
    tasks: list[TaskLine] = []
    disabled: list[str] = []
    for element in root.all("TaskClass"):
        number = _CLASS.fullmatch(element.get("Name").strip())
        for task in element.all("Task"):
            if not task.get("Source").strip():
                continue
            if number is None:
                message = f"{element.get('Name')!r} is no task class; task {task.get('Name')}"
                findings.append(Finding(file, element.line, message))
            elif task.is_true("Disabled"):
                disabled.append(task.get("Name"))
            else:
                tasks.append(_task(task, int(number[1])))
    named, doubled = _named_once(file, tasks)
    return Software(named, tuple(disabled), tuple(_data_objects(root))), findings + doubled


def _task(element: XmlElement, number: int) -> TaskLine:
    path = _path(element, SUFFIX)
    name = element.get("Name").strip() or path[-1]
    return TaskLine(name, path, number, element.line, element.get("BuildOptions"))


def _path(element: XmlElement, suffix: str) -> tuple[str, ...]:
    source = element.get("Source").strip()
    return tuple((source[: -len(suffix)] if source.lower().endswith(suffix) else source).split("."))


def _data_objects(root: XmlElement) -> Iterator[DataObjectLine]:
    """Yield the data objects that have values in the project; others are for drives and panels."""
    for element in root.all("DataObject"):
        path = _path(element, DATA_OBJECT_SUFFIX)
        if path[-1] and element.get("Language").lower() == "simple":
            yield DataObjectLine(element.get("Name").strip() or path[-1], path, element.line)


def _named_once(file: Path, tasks: list[TaskLine]) -> tuple[tuple[TaskLine, ...], list[Finding]]:
    """Return tasks without those whose name another has, and what is to be told of these."""
    seen: dict[str, TaskLine] = {}
    findings = []
    for task in tasks:
        other = seen.setdefault(task.name.upper(), task)
        if other is not task:
            message = f"a task is called {task.name} in line {other.line} already"
            findings.append(Finding(file, task.line, message))
    return tuple(seen.values()), findings
