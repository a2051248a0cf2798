"""An Automation Studio project, read from its folder; nothing is loaded or compiled yet.

Everything that is wrong is found in one go, and what can be read is read.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError
from plcsim.core.suggestion import did_you_mean
from plcsim.project.automation_studio.configuration import (
    IO_MAP,
    PERMANENT,
    PV_MAP,
    Configuration,
    Configurations,
)
from plcsim.project.automation_studio.document import DocumentError, read_document
from plcsim.project.automation_studio.finding import Finding
from plcsim.project.automation_studio.logical_view import (
    LogicalView,
    Package,
    SourceFolder,
    project_file,
    read_logical_view,
)
from plcsim.project.automation_studio.mapp import MappVariable, read_mapp_variables
from plcsim.project.automation_studio.mapping import (
    Channel,
    Pv,
    PvMapLine,
    read_channels,
    read_copies,
    read_permanent,
)
from plcsim.project.automation_studio.names import FileNames

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path
    from typing import TypeVar

    T = TypeVar("T")


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
        channels: of IoMap.iom.
        copies: of PvMap.vvm.
        permanent: variables of Cpu.per.
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
    channels: tuple[Channel, ...]
    copies: tuple[PvMapLine, ...]
    permanent: tuple[Pv, ...]
    has_preprocessor: bool
    findings: tuple[Finding, ...]


def read_automation_studio(folder: Path, configuration: str = "") -> AutomationStudioProject:
    """Read the Automation Studio project in a folder.

    Args:
        folder: where the project file (``*.apj``) lies.
        configuration: the one to read; "" for the active one, else one for simulation, else the
            first.

    Raises:
        ConfigurationError: there is no project, no logical view, or no such configuration.
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
    chosen = configurations.read(_chosen(folder, configurations, configuration))
    findings += (*view.findings, *configurations.findings)
    tasks = _tasks(chosen, view.root, findings)
    mapp_variables, found = read_mapp_variables(chosen.folder)
    findings += found
    return AutomationStudioProject(
        folder,
        file.stem,
        view,
        tuple(configurations.folders),
        chosen,
        tuple(tasks),
        tuple(mapp_variables),
        tuple(_all(read_channels, chosen.files_of_kind(IO_MAP), findings)),
        tuple(_all(read_copies, chosen.files_of_kind(PV_MAP), findings)),
        tuple(_all(read_permanent, chosen.files_of_kind(PERMANENT), findings)),
        has_preprocessor,
        tuple(findings),
    )


def _all(
    read: Callable[[Path], tuple[Sequence[T], list[Finding]]],
    files: Sequence[Path],
    findings: list[Finding],
) -> list[T]:
    result: list[T] = []
    for file in files:
        found, wrong = read(file)
        result += found
        findings += wrong
    return result


def _has_preprocessor(file: Path, findings: list[Finding]) -> bool:
    try:
        root = read_document(file)
    except DocumentError as err:
        findings.append(Finding(file, err.line, str(err)))
        return False
    return any(element.is_true("Preprocessor") for element in root.all("IEC"))


def _chosen(folder: Path, configurations: Configurations, name: str) -> str:
    """Return the name of the configuration to read, in the case it has there."""
    known = configurations.folders
    preferred = configurations.preferred()
    if preferred is None:
        problems = "".join(f"\n{finding}" for finding in configurations.findings)
        raise ConfigurationError(f"{folder}: the project has no configuration{problems}")
    if not name:
        return preferred
    for each in known:
        if each.lower() == name.lower():
            return each
    hint = did_you_mean(name, known) or f"; there are {', '.join(known)}"
    raise ConfigurationError(f"{folder}: there is no configuration {name}{hint}")


_Place = tuple[SourceFolder, tuple[Package, ...]]


def _tasks(chosen: Configuration, root: Package, findings: list[Finding]) -> list[ProgramTask]:
    programs = _programs(root)
    in_small_letters = {_key(path): found for path, found in programs.items()}
    tasks = []
    for line in chosen.software.tasks:
        path = line.source
        found = programs.get(path) or in_small_letters.get(_key(path))
        source = ".".join(path)
        if found is None:
            message = f"task {line.name}: the logical view has no program {source}"
            findings.append(Finding(chosen.software_file, line.line, message, source))
        program, around = found or (None, ())
        number = line.task_class
        tasks.append(ProgramTask(line.name, number, source, program, around, line.line))
    return tasks


def _key(path: Sequence[str]) -> tuple[str, ...]:
    return tuple(part.lower() for part in path)


def _programs(
    package: Package, around: tuple[Package, ...] = ()
) -> Mapping[tuple[str, ...], _Place]:
    around = (*around, package)
    found: dict[tuple[str, ...], _Place] = {p.path: (p, around) for p in package.programs}
    for inner in package.packages:
        found |= _programs(inner, around)
    return found
