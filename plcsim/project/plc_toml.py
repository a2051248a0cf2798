"""A project on disk: plc.toml and a folder for each program, or an Automation Studio project.

The keys of plc.toml and their defaults are listed in docs/project.md, what it may say beside an
Automation Studio project in docs/automation-studio.md. Everything wrong is a ConfigurationError
that names the file and the field.
"""

from __future__ import annotations

import shlex
import tomllib
from dataclasses import dataclass, field, replace
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.memory import DEFAULT_SIZE
from plcsim.core.task import HIGHEST_CLASS, LOWEST_CLASS, Policy
from plcsim.library.library import PLAIN, files_in
from plcsim.program.layout import folder_layout, outside_libraries, program_places
from plcsim.project.automation_studio.layout import ALL_VENDORS, layout_of
from plcsim.project.automation_studio.logical_view import project_file as automation_studio_file
from plcsim.project.automation_studio.mapping import NO_MAPS, Maps, read_maps
from plcsim.project.automation_studio.reader import read_automation_studio
from plcsim.project.automation_studio.task_classes import task_classes, tasks_to_run, tick_ns
from plcsim.project.extension import extensions
from plcsim.project.project_file import FILE_NAME, find_project
from plcsim.project.tables import (
    AutomationStudioTable,
    CTable,
    IoTable,
    LibrariesTable,
    PlcSettings,
    ProjectKey,
    TaskClassTable,
    task_class_entry,
)
from plcsim.settings import Table

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping
    from pathlib import Path

    from plcsim.library.library import CBuild
    from plcsim.program.layout import SourceLayout
    from plcsim.project.automation_studio.reader import AutomationStudioProject
    from plcsim.project.tables import ProgramEntry, TaskClassEntry

PROJECT: Final = "project"
"""Key with the path of an Automation Studio project."""

_NOTHING: Final[Mapping[str, Mapping[str, Any]]] = MappingProxyType({})

AUTOMATION_STUDIO_MEMORY: Final = 128 << 20
"""Bytes of PLC memory of an Automation Studio project where plc.toml does not say; what no variable
takes costs the host nothing."""

COMPILING_NS: Final = 900_000_000_000
"""Loading an Automation Studio project, or C, may take so long at least, on a slow host too."""

_OWN_TABLES: Final = (
    *("plc", "task_class", "library", "libraries", PROJECT, "as", "simulate", "c", "io"),
)


@dataclass(frozen=True)
class Project:
    """What plc.toml and the files of Automation Studio say; no program is loaded yet.

    Attributes:
        folder: where plc.toml lies, or the project file of Automation Studio.
        name: from [plc], or the folder's, or the project file's.
        plc: table [plc].
        classes: the task classes, in order of their numbers.
        layout: where its sources lie.
        libraries: tables [library.NAME] by NAME; a library knows what it may be told.
        extensions: settings of the extensions whose table is there, by table.
        automation_studio: the Automation Studio project that this is, None where it is none.
        maps: of variables to I/O channels and other variables.
        keep_going: what cannot run is left out, and the rest runs.
        left_out: what was left out already, and why.
    """

    folder: Path
    name: str
    plc: PlcSettings
    classes: tuple[TaskClassEntry, ...]
    layout: SourceLayout
    libraries: Mapping[str, Table] = field(default_factory=dict)
    extensions: Mapping[str, Any] = field(default_factory=dict)
    automation_studio: AutomationStudioProject | None = None
    maps: Maps = NO_MAPS
    keep_going: bool = False
    left_out: tuple[str, ...] = ()

    def without(self, sources: Collection[str], left_out: Iterable[str]) -> Project:
        """Return the project without some programs.

        Args:
            sources: of the programs.
            left_out: what the run tells about them.
        """
        classes = [
            each._replace(programs=tuple(p for p in each.programs if p.source not in sources))
            for each in self.classes
        ]
        places = self.layout.programs.items()
        layout = replace(self.layout, programs={n: p for n, p in places if n not in sources})
        return replace(
            self,
            classes=tuple(each for each in classes if each.programs),
            layout=layout,
            left_out=(*self.left_out, *left_out),
        )

    @property
    def load_timeout_ns(self) -> int:
        """How long loading may take; what is compiled takes longer than Python, and always ends."""
        timeout_ns = self.plc.init_timeout_ns
        is_compiled = self.automation_studio is not None or self.layout.is_compiled
        return max(timeout_ns, COMPILING_NS) if is_compiled else timeout_ns

    @property
    def programs(self) -> tuple[ProgramEntry, ...]:
        """All programs in configured order, the exception program last."""
        last = (self.plc.exception_program,) if self.plc.exception_program else ()
        return tuple(p for c in self.classes for p in c.programs) + last


def read_project(path: Path, given: Mapping[str, Mapping[str, Any]] = _NOTHING) -> Project:
    """Read a project, without loading any program.

    Args:
        path: its folder, its plc.toml, or its Automation Studio project file.
        given: keys by table that count more than those of plc.toml.

    Raises:
        ConfigurationError: something is missing or wrong; all of it is told, with file and field.
    """
    file = find_project(path)
    values = _toml(file) if file.name == FILE_NAME else {}
    for name, keys in given.items():
        values[name] = {**values.get(name, {}), **keys}
    top = Table(file, "", values)
    top.check_keys(*_OWN_TABLES, *extensions())
    findings = Findings()
    parts = _Parts(file, top)
    with findings.gathered():
        parts.read_settings()
    project = None
    with findings.gathered():
        project = parts.project()
    settings = {}
    for name in extensions():
        if name not in top:
            continue  # an extension that is not used is not imported
        with findings.gathered():
            settings[name] = extensions()[name].read(top.table(name))
    if project is not None:
        with findings.gathered():
            _check_programs(file, project)
    findings.check()
    assert project is not None  # or a finding had said why
    return replace(project, extensions=settings)


class _Parts:
    """Reads the parts of a project.

    Args:
        file: plc.toml, or the Automation Studio project file.
        top: what plc.toml holds.
    """

    def __init__(self, file: Path, top: Table) -> None:
        self._file = file
        self._top = top
        self._plc = PlcSettings()
        self._libraries: Mapping[str, Table] = {}
        self._folders = LibrariesTable()
        self._c = CTable()

    def read_settings(self) -> None:
        findings = Findings()
        with findings.gathered():
            self._plc = self._top.table("plc").read(PlcSettings)
        with findings.gathered():
            self._libraries = self._top.table("library").tables()
        with findings.gathered():
            self._folders = self._top.table("libraries").read(LibrariesTable)
        with findings.gathered():
            self._c = self._top.table("c").read(CTable)
        findings.check()

    def project(self) -> Project:
        automation_studio = self._automation_studio_folder()
        if automation_studio is not None:
            return self._of_automation_studio(automation_studio)
        for name in ("as", PROJECT):
            if name in self._top:
                raise self._top.error(name, "there is no Automation Studio project here")
        classes = self._classes()
        entries = [entry for each in classes for entry in each.programs]
        if self._plc.exception_program is not None:
            entries.append(self._plc.exception_program)
        folder = self._file.parent
        sources = [*dict.fromkeys(entry.source for entry in entries)]
        stubs = self._folders.stub or ()
        layout = folder_layout(folder, sources, self._folders.folders, stubs)
        layout = replace(
            layout,
            c_build=self._c_build(PLAIN),
            dialect=self._plc.dialect,
            simulate=_simulated(self._top.table("simulate")),
        )
        name = self._plc.name or folder.resolve().name
        maps = self._maps()
        return Project(folder, name, self._plc, classes, layout, self._libraries, maps=maps)

    def _maps(self) -> Maps:
        """Return what the files of [io] say.

        Raises:
            ConfigurationError: a line of them is none.
        """
        files = self._top.table("io").read(IoTable)
        maps, findings = read_maps(files.channels, files.copies, files.permanent)
        if findings:
            raise ConfigurationError(*map(str, findings))
        return maps

    def _classes(self) -> tuple[TaskClassEntry, ...]:
        """Return the task classes of plc.toml, else those of a CONFIGURATION beside it."""
        files = [] if "task_class" in self._top else self._unit_files()
        if not files:
            return _task_classes(self._top.table("task_class"), self._plc.tick_ns)
        # Imported here, for most projects have no need of the parser.
        configuration = import_module("plcsim.project.configuration")
        found: tuple[TaskClassEntry, ...] = configuration.configured_classes(files)
        return found

    def _unit_files(self) -> list[Path]:
        return [f for f in files_in(self._file.parent) if f.suffix.lower() == ".st"]

    def _automation_studio_folder(self) -> Path | None:
        """Return the folder of the Automation Studio project that this is, None for none."""
        here = self._file.parent
        named = self._top.only(PROJECT).read(ProjectKey).project
        if named is not None:
            return named
        return here if automation_studio_file(here) is not None else None

    def _of_automation_studio(self, folder: Path) -> Project:
        if "io" in self._top:
            raise self._top.error("io", "the maps of an Automation Studio project are its own")
        findings = Findings()
        settings, tables = AutomationStudioTable(), {}
        with findings.gathered():
            settings = self._top.table("as").read(AutomationStudioTable)
        with findings.gathered():
            tables = _class_tables(self._top.table("task_class"))
        findings.check()
        found = read_automation_studio(folder, settings.config)
        tasks = tasks_to_run(found, settings.skip)
        hardware = found.configuration.hardware
        classes = task_classes(tasks, hardware, tables)
        if not classes:
            where = f"{found.configuration.software_file}: no task runs"
            others = ", ".join(name for name in found.configurations)
            chosen = f" in the configuration {found.configuration.name}; there are {others}"
            raise ConfigurationError(
                where + chosen if others else f"{where}: the logical view has no program",
                *map(str, found.findings),
            )
        stubs = self._folders.stub
        names = frozenset([ALL_VENDORS] if stubs is None else (name.lower() for name in stubs))
        layout = layout_of(found, self._file.parent, tasks, names)
        c_build = self._c_build(layout.c_build)
        simulate = _simulated(self._top.table("simulate"))
        layout = replace(layout, c_build=c_build, simulate=simulate)
        return Project(
            self._file.parent,
            self._plc.name or found.name,
            replace(self._plc, tick_ns=tick_ns(hardware, classes), memory_size=self._memory_size()),
            classes,
            self._with_own(layout, tables),
            self._libraries,
            automation_studio=found,
            maps=found.maps,
        )

    def _c_build(self, given: CBuild) -> CBuild:
        """Return how C is compiled: as its project says, and what [c] adds."""
        return given._replace(
            include_folders=(*self._c.include, *given.include_folders),
            options=" ".join([given.options, shlex.join(self._c.options)]).strip(),
            heap_size=self._c.heap,
        )

    def _memory_size(self) -> int:
        """Return the memory of a project that was written for a controller with much of it."""
        size = self._plc.memory_size
        return AUTOMATION_STUDIO_MEMORY if size == DEFAULT_SIZE else size

    def _with_own(self, layout: SourceLayout, tables: Mapping[int, TaskClassTable]) -> SourceLayout:
        """Add programs and libraries that plc.toml names beside an Automation Studio project."""
        entries = [entry for table in tables.values() for entry in table.programs]
        if self._plc.exception_program is not None:
            entries.append(self._plc.exception_program)
        sources = [*dict.fromkeys(e.source for e in entries if e.source not in layout.programs)]
        programs = program_places(layout.folder, sources)
        libraries = outside_libraries(self._folders.folders)
        return replace(
            layout,
            programs={**layout.programs, **programs},
            libraries=(*libraries, *layout.libraries),
        )


def _toml(file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text("utf-8-sig"))  # some editors put a mark first
    except (OSError, UnicodeDecodeError) as err:
        raise ConfigurationError(f"{file}: cannot be read: {err}") from None
    except tomllib.TOMLDecodeError as err:
        raise ConfigurationError(f"{file}: {err}") from None
    except RecursionError:
        raise ConfigurationError(f"{file}: brackets are nested too deep") from None


def _simulated(table: Table) -> Mapping[str, Mapping[str, Any]]:
    """Return tables [simulate.BLOCK]: an output by the input that it follows, or its value."""
    findings = Findings()
    found: dict[str, Mapping[str, Any]] = {}
    for name, each in table.tables().items():
        with findings.gathered():
            rules = each.values()
            for key, value in rules.items():
                if not isinstance(value, str | bool | int | float) and not _is_names(value):
                    raise each.error(key, f"{value!r} is neither the name of an input nor a value")
            found[name] = rules
    findings.check()
    return found


def _is_names(value: object) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(n, str) for n in value)


def _class_tables(table: Table) -> dict[int, TaskClassTable]:
    """Return tables [task_class.N] by number."""
    numbers = {str(n): n for n in range(LOWEST_CLASS, HIGHEST_CLASS + 1)}
    findings = Findings()
    found = {}
    for key, each in table.tables().items():
        with findings.gathered():
            if key not in numbers:
                raise table.error(
                    key,
                    f"task classes are [task_class.{LOWEST_CLASS}] to [task_class.{HIGHEST_CLASS}]",
                )
            found[numbers[key]] = each.read(TaskClassTable)
    findings.check()
    return found


def _task_classes(table: Table, tick_ns: int) -> tuple[TaskClassEntry, ...]:
    tables = _class_tables(table)
    if not tables:
        raise table.error("", f"at least one, [task_class.{LOWEST_CLASS}], is needed")
    findings = Findings()
    entries = []
    for number, each in sorted(tables.items()):
        with findings.gathered():
            entries.append(_task_class(table, number, each, tick_ns))
    findings.check()
    return tuple(entries)


def _task_class(table: Table, number: int, each: TaskClassTable, tick_ns: int) -> TaskClassEntry:
    entry = task_class_entry(number, each)
    if entry.cycle_ns % tick_ns:
        raise table.error(
            f"{number}.cycle", f"{entry.cycle_ns} ns is not a multiple of the tick, {tick_ns} ns"
        )
    if not entry.programs:
        raise table.error(f"{number}.programs", "at least one program is needed")
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
