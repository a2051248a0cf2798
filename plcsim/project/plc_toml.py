"""A project on disk: plc.toml and a folder for each program.

The keys of plc.toml and their defaults are listed in docs/project.md. Everything wrong is a
ConfigurationError that names the file and the field.
"""

from __future__ import annotations

import itertools
import tomllib
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.task import HIGHEST_CLASS, LOWEST_CLASS, Policy
from plcsim.project.extension import extensions
from plcsim.project.tables import LibrariesTable, PlcSettings, TaskClassTable, task_class_entry
from plcsim.settings import Table

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from plcsim.project.tables import ProgramEntry, TaskClassEntry

FILE_NAME: Final = "plc.toml"

_NOTHING: Final[Mapping[str, Mapping[str, Any]]] = MappingProxyType({})
MOST_HINTS: Final = 5
"""Projects that are named where one was not found."""

_OWN_TABLES: Final = ("plc", "task_class", "library", "libraries")


@dataclass(frozen=True)
class Project:
    """What plc.toml says; no program is loaded yet.

    Attributes:
        folder: where plc.toml lies.
        name: from [plc], or the folder's.
        plc: table [plc].
        classes: tables [task_class.N], in order of their numbers.
        libraries: tables [library.NAME] by NAME; a library knows what it may be told.
        library_folders: of libraries outside the project.
        extensions: settings of the extensions whose table is there, by table.
    """

    folder: Path
    name: str
    plc: PlcSettings
    classes: tuple[TaskClassEntry, ...]
    libraries: Mapping[str, Table] = field(default_factory=dict)
    library_folders: tuple[Path, ...] = ()
    extensions: Mapping[str, Any] = field(default_factory=dict)

    @property
    def programs(self) -> tuple[ProgramEntry, ...]:
        """All programs in configured order, the exception program last."""
        last = (self.plc.exception_program,) if self.plc.exception_program else ()
        return tuple(p for c in self.classes for p in c.programs) + last


def find_project(path: Path) -> Path:
    """Return the plc.toml of a project that a person named by its folder or by that file.

    Raises:
        ConfigurationError: there is none; projects nearby are named.
    """
    file = path if path.name == FILE_NAME else path / FILE_NAME
    try:
        file.stat()
    except (FileNotFoundError, NotADirectoryError):
        raise ConfigurationError(f"{file}: there is no such file{_nearby(path)}") from None
    except (OSError, ValueError) as err:
        raise ConfigurationError(f"{file}: cannot be read: {err}") from None
    return file


def _nearby(path: Path) -> str:
    """Return a hint at the project that ``path`` lies in, or at those below it or beside it."""
    for parent in path.resolve().parents:
        if (parent / FILE_NAME).is_file():
            return f"; did you mean {parent}?"
    folder = path if path.is_dir() else path.parent
    found = sorted(
        str(f.parent) for f in itertools.islice(folder.glob(f"*/{FILE_NAME}"), MOST_HINTS)
    )
    return f"; there are projects in {', '.join(found)}" if found else "; a project has one"


def read_project(path: Path, given: Mapping[str, Mapping[str, Any]] = _NOTHING) -> Project:
    """Read plc.toml of a project folder, without loading any program.

    Args:
        path: the folder, or its plc.toml.
        given: keys by table that count more than those of the file.

    Raises:
        ConfigurationError: something is missing or wrong; all of it is told, with file and field.
    """
    file = find_project(path)
    values = _toml(file)
    for name, keys in given.items():
        values[name] = {**values.get(name, {}), **keys}
    top = Table(file, "", values)
    top.check_keys(*_OWN_TABLES, *extensions())
    findings = Findings()
    plc = PlcSettings()
    classes: tuple[TaskClassEntry, ...] = ()
    libraries: Mapping[str, Table] = {}
    settings = {}
    with findings.gathered():
        plc = top.table("plc").read(PlcSettings)
    with findings.gathered():
        classes = _task_classes(top.table("task_class"), plc.tick_ns)
    with findings.gathered():
        libraries = top.table("library").tables()
    folders: tuple[Path, ...] = ()
    with findings.gathered():
        folders = top.table("libraries").read(LibrariesTable).folders
    for name in extensions():
        if name not in top:
            continue  # an extension that is not used is not imported
        with findings.gathered():
            settings[name] = extensions()[name].read(top.table(name))
    name = plc.name or file.parent.resolve().name
    project = Project(file.parent, name, plc, classes, libraries, folders, settings)
    with findings.gathered():
        _check_programs(file, project)
    findings.check()
    return project


def _toml(file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text("utf-8-sig"))  # some editors put a mark first
    except (OSError, UnicodeDecodeError) as err:
        raise ConfigurationError(f"{file}: cannot be read: {err}") from None
    except tomllib.TOMLDecodeError as err:
        raise ConfigurationError(f"{file}: {err}") from None
    except RecursionError:
        raise ConfigurationError(f"{file}: brackets are nested too deep") from None


def _task_classes(table: Table, tick_ns: int) -> tuple[TaskClassEntry, ...]:
    tables = table.tables()
    if not tables:
        raise table.error("", f"at least one, [task_class.{LOWEST_CLASS}], is needed")
    numbers = {str(n): n for n in range(LOWEST_CLASS, HIGHEST_CLASS + 1)}
    findings = Findings()
    entries = []
    for key, each in tables.items():
        with findings.gathered():
            if key not in numbers:
                raise table.error(
                    key,
                    f"task classes are [task_class.{LOWEST_CLASS}] to [task_class.{HIGHEST_CLASS}]",
                )
            entries.append(_task_class(each, numbers[key], tick_ns))
    findings.check()
    return tuple(sorted(entries))


def _task_class(table: Table, number: int, tick_ns: int) -> TaskClassEntry:
    entry = task_class_entry(number, table.read(TaskClassTable))
    if entry.cycle_ns % tick_ns:
        raise table.error(
            "cycle", f"{entry.cycle_ns} ns is not a multiple of the tick, {tick_ns} ns"
        )
    if not entry.programs:
        raise table.error("programs", "at least one program is needed")
    return entry


def _check_programs(file: Path, project: Project) -> None:
    seen: set[str] = set()
    for program in project.programs:
        if program.name.upper() in seen:
            raise ConfigurationError(
                f"{file}: programs: two programs are called {program.name}; "
                f'give one a name of its own: {{name = "...", source = "{program.source}"}}'
            )
        seen.add(program.name.upper())
    uses = [c for c in project.classes if Policy.EXCEPTION in (c.policy, c.host_policy)]
    if uses and project.plc.exception_program is None:
        raise ConfigurationError(
            f"{file}: task_class.{uses[0].number}: the policy exception needs plc.exception_program"
        )
