"""An Automation Studio project, read from its folder; nothing is loaded or compiled yet.

Everything that is wrong is found in one go, and what can be read is read.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError
from plcsim.core.suggestion import did_you_mean
from plcsim.library.document import DocumentError, read_document
from plcsim.library.library import CBuild
from plcsim.project.automation_studio.assumed_links import assumed_links
from plcsim.project.automation_studio.configuration import (
    IO_MAP,
    PERMANENT,
    PV_MAP,
    Configuration,
    Configurations,
)
from plcsim.project.automation_studio.data_objects import read_data_objects
from plcsim.project.automation_studio.finding import Finding
from plcsim.project.automation_studio.hardware import Hardware
from plcsim.project.automation_studio.logical_view import (
    LogicalView,
    Package,
    SourceFolder,
    project_file,
    read_logical_view,
)
from plcsim.project.automation_studio.mapp import MappVariable, read_mapp_variables
from plcsim.project.automation_studio.mapping import Maps, read_maps
from plcsim.project.automation_studio.names import FileNames, in_any_case
from plcsim.project.automation_studio.software import Software, TaskLine

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from pathlib import Path

    from plcsim.library.dataobj.settings import MadeObjects

ALL_PROGRAMS_CLASS: Final = 4
"""Task class of all programs of a project without a configuration; Cyclic#4 is where a new task
stands."""


@dataclass(frozen=True)
class ProgramTask:
    """A task and the program that it runs.

    Attributes:
        name: of the task.
        task_class: 1 to 8.
        source: the program as Cpu.sw names it, with dots.
        program: None where the logical view has no such program.
        around: the packages around it, from the outside in.
        line: of Cpu.sw.
    """

    name: str
    task_class: int
    source: str
    program: SourceFolder | None
    around: tuple[Package, ...]
    line: int


@dataclass(frozen=True)
class AutomationStudioProject:
    """An Automation Studio project in one of its configurations.

    Attributes:
        folder: where the project file lies.
        name: of the project file.
        view: the logical view.
        configurations: the names of all.
        configuration: the one that was read.
        tasks: in the order of Cpu.sw.
        mapp_variables: global variables that the configuration makes.
        maps: of the configuration.
        data_objects: that are there before any program runs.
        has_preprocessor: whether Structured Text may have ``#ifdef``.
        findings: what is wrong in all of this.
    """

    folder: Path
    name: str
    view: LogicalView
    configurations: tuple[str, ...]
    configuration: Configuration
    tasks: tuple[ProgramTask, ...]
    mapp_variables: tuple[MappVariable, ...]
    maps: Maps
    data_objects: MadeObjects
    has_preprocessor: bool
    findings: tuple[Finding, ...]


def read_automation_studio(folder: Path, configuration: str = "") -> AutomationStudioProject:
    """Read the Automation Studio project in a folder.

    Args:
        folder: where the project file (``*.apj``) lies.
        configuration: the one to read; "" for the active one, else one for simulation, else the
            first.

    Raises:
        ConfigurationError: there is no project, no logical view, or no such configuration. A
            project without any runs all its programs.
    """
    file = project_file(folder)
    if file is None:
        raise ConfigurationError(f"{folder}: there is no project file (*.apj)")
    names = FileNames(folder)
    logical = names.below(folder, "Logical")
    if logical is None:
        raise ConfigurationError(f"{folder}: there is no folder Logical")
    findings: list[Finding] = []
    has_preprocessor = _has_preprocessor(file, findings)
    view = read_logical_view(logical, names)
    configurations = Configurations(names)
    chosen = _configuration(folder, configurations, configuration, view.root)
    findings += (*view.findings, *configurations.findings)
    tasks = _tasks(chosen, view.root, findings)
    mapp_variables, found = (
        read_mapp_variables(chosen.folder, names) if chosen.name else assumed_links(logical)
    )
    findings += found
    lines = chosen.software.data_objects
    objects, found = read_data_objects(chosen.software_file, lines, view.root, names)
    findings += found
    maps, found = read_maps(*(chosen.files_of_kind(kind) for kind in (IO_MAP, PV_MAP, PERMANENT)))
    findings += found
    return AutomationStudioProject(
        folder,
        folder.resolve().name if file.is_dir() else file.stem,
        view,
        tuple(configurations.folders),
        chosen,
        tuple(tasks),
        tuple(mapp_variables),
        maps,
        objects,
        has_preprocessor,
        tuple(findings),
    )


def _has_preprocessor(file: Path, findings: list[Finding]) -> bool:
    if file.is_dir():
        return False
    try:
        root = read_document(file)
    except DocumentError as err:
        findings.append(Finding(file, err.line, str(err)))
        return False
    return any(element.is_true("Preprocessor") for element in root.all("IEC"))


def _configuration(
    folder: Path, configurations: Configurations, name: str, root: Package
) -> Configuration:
    """Return the configuration to read; one with all programs where the project has none."""
    if name or configurations.folders:
        return configurations.read(_chosen(folder, configurations, name))
    message = f"there is no configuration: all programs run in Cyclic#{ALL_PROGRAMS_CLASS}"
    configurations.findings[:] = [Finding(folder, 0, message, "Physical")]
    tasks = tuple(
        TaskLine(name, path, ALL_PROGRAMS_CLASS, 0) for name, path in _unique(_programs(root))
    )
    return Configuration("", folder, Hardware(), Software(tasks), (), CBuild(), folder)


def _unique(programs: Iterable[tuple[str, ...]]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the names of tasks and their programs; a name that is taken gets a number."""
    taken: set[str] = set()
    for path in programs:
        names = itertools.chain([path[-1]], (f"{path[-1]}{n}" for n in itertools.count(1)))
        name = next(each for each in names if each.upper() not in taken)
        taken.add(name.upper())
        yield name, path


def _chosen(folder: Path, configurations: Configurations, name: str) -> str:
    """Return the name of the configuration to read, in the case it has there."""
    known = configurations.folders
    if not name:
        return configurations.preferred() or ""
    for each in known:
        if each.lower() == name.lower():
            return each
    hint = did_you_mean(name, known) or f"; there are {', '.join(known)}"
    raise ConfigurationError(f"{folder}: there is no configuration {name}{hint}")


_Place = tuple[SourceFolder, tuple[Package, ...]]


def _tasks(chosen: Configuration, root: Package, findings: list[Finding]) -> list[ProgramTask]:
    programs = _programs(root)
    in_small_letters = {in_any_case(path): found for path, found in programs.items()}
    tasks = []
    for line in chosen.software.tasks:
        path = line.source
        found = programs.get(path) or in_small_letters.get(in_any_case(path))
        source = ".".join(path)
        if found is None:
            message = f"task {line.name}: the logical view has no program {source}"
            findings.append(Finding(chosen.software_file, line.line, message, source))
        program, around = found or (None, ())
        number = line.task_class
        tasks.append(ProgramTask(line.name, number, source, program, around, line.line))
    return tasks


def _programs(
    package: Package, around: tuple[Package, ...] = ()
) -> Mapping[tuple[str, ...], _Place]:
    around = (*around, package)
    found: dict[tuple[str, ...], _Place] = {p.path: (p, around) for p in package.programs}
    for inner in package.packages:
        found |= _programs(inner, around)
    return found
