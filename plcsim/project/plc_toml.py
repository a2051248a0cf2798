"""A project on disk: plc.toml and a folder for each program.

The keys of plc.toml and their defaults are listed in docs/project.md. Everything wrong is a
ConfigurationError that names the file and the field.
"""

from __future__ import annotations

import itertools
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plcsim.core.duration import parse_duration_ns
from plcsim.core.errors import ConfigurationError
from plcsim.core.memory import DEFAULT_SIZE, MAX_SIZE, PAGE
from plcsim.core.task import HIGHEST_CLASS, LOWEST_CLASS, Policy
from plcsim.library.options import check_options
from plcsim.program.loader import ProgramLoader
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup
from plcsim.project.extension import extensions
from plcsim.project.table import Table

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.project.extension import Extension

FILE_NAME = "plc.toml"

DEFAULT_CYCLES_MS = {1: 10, 2: 20, 3: 50, 4: 100, 5: 200, 6: 500, 7: 1000, 8: 10}
"""Cycle time of each class where none is given, as in a new Automation Studio project."""

DEFAULT_TOLERANCE_OF_8_NS = 30_000_000_000
"""Class 8 tolerates 30 s, again as in a new Automation Studio project; others their cycle time."""

TOO_LONG_CYCLE_NS = 60_000_000_000
"""No cycle time is that long. "1m" is a minute, as T#1m is, but here it is a misspelt "1ms"."""

MOST_HINTS = 5
"""Projects that are named where one was not found."""

ANY_CPU, LAST_CPU = -1, 1023
"""The last is the last that sched_setaffinity(2) takes without a larger set."""

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_SIZE = re.compile(r"(\d+)\s*(KiB|MiB)?")


@dataclass(frozen=True)
class ProgramEntry:
    """A program in plc.toml: the name it runs under and the folder it lies in."""

    name: str
    source: str


@dataclass(frozen=True)
class TaskClassEntry:
    """A table [task_class.N] of plc.toml."""

    number: int
    cycle_ns: int
    tolerance_ns: int
    first_release_ns: int
    policy: Policy
    host_policy: Policy
    programs: tuple[ProgramEntry, ...]


@dataclass(frozen=True)
class Project:
    """What plc.toml says; no program is loaded yet.

    Attributes:
        folder: where plc.toml lies.
        name: from [plc], or the folder's.
        tick_ns: all cycle times are multiples of it.
        memory_size: bytes.
        watchdog_ns: after this time at least, a CYCLIC that does not return is ended.
        init_timeout_ns: the same for INIT and EXIT.
        realtime: "auto", "off" or "require".
        priority: of SCHED_FIFO.
        cpu: the processor to stay on, None for any.
        classes: in order of their numbers.
        exception_program: runs for violations under the policy "exception".
        options: tables [library.NAME] by NAME.
        extensions: settings of the extensions whose table is there, by table.
    """

    folder: Path
    name: str
    tick_ns: int
    memory_size: int
    watchdog_ns: int
    init_timeout_ns: int
    realtime: str
    priority: int
    cpu: int | None
    classes: tuple[TaskClassEntry, ...]
    exception_program: ProgramEntry | None
    options: Mapping[str, Mapping[str, object]] = field(default_factory=dict)
    extensions: Mapping[str, Any] = field(default_factory=dict)

    @property
    def programs(self) -> tuple[ProgramEntry, ...]:
        """All programs in configured order, the exception program last."""
        last = (self.exception_program,) if self.exception_program else ()
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


def read_project(path: Path) -> Project:
    """Read plc.toml of a project folder, without loading any program.

    Args:
        path: the folder, or its plc.toml.

    Raises:
        ConfigurationError: something is missing or wrong; file and field are named.
    """
    file = find_project(path)
    try:
        values = tomllib.loads(file.read_text("utf-8"))
    except (OSError, UnicodeDecodeError) as err:
        raise ConfigurationError(f"{file}: cannot be read: {err}") from None
    except tomllib.TOMLDecodeError as err:
        raise ConfigurationError(f"{file}: {err}") from None
    except RecursionError:
        raise ConfigurationError(f"{file}: brackets are nested too deep") from None
    top = Table(file, "", values)
    plc = Table(file, "plc", top.take("plc", dict, {}))
    class_tables = top.take("task_class", dict, {})
    options = top.take("library", dict, {})
    tables = {name: top.table(name) for name in extensions() if name in top}
    top.finish(*extensions())  # a misspelt table is not to be told as one that is missing
    tick_ns = plc.duration_ns("tick", 1_000_000)
    if tick_ns <= 0:
        raise plc.error("tick", "must be above 0")
    classes = _task_classes(file, class_tables, tick_ns)
    settings = {
        name: _extension_table(extensions()[name], table, file.parent)
        for name, table in tables.items()
    }
    project = _plc_table(file.parent, plc, tick_ns, classes, options, settings)
    _check_names(file, project)
    return project


def _extension_table(extension: Extension, table: Table, folder: Path) -> object:
    settings = extension.read(table, folder)
    table.finish()
    return settings


def _plc_table(
    folder: Path,
    plc: Table,
    tick_ns: int,
    classes: tuple[TaskClassEntry, ...],
    options: dict[str, Any],
    settings: dict[str, Any],
) -> Project:
    exception = plc.take("exception_program", str, "")
    exception_program = _program(plc, "exception_program", exception) if exception else None
    realtime = plc.take("realtime", str, "auto")
    if realtime not in ("auto", "off", "require"):
        raise plc.error("realtime", f'{realtime!r} is not "auto", "off" or "require"')
    cpu = plc.number("cpu", ANY_CPU, ANY_CPU, LAST_CPU)
    project = Project(
        folder=folder,
        name=plc.take("name", str, folder.resolve().name),
        tick_ns=tick_ns,
        memory_size=plc.convert("memory", DEFAULT_SIZE, _memory_size, '"16MiB"'),
        watchdog_ns=plc.duration_ns("watchdog", 500_000_000),
        init_timeout_ns=plc.duration_ns("init_timeout", 10_000_000_000),
        realtime=realtime,
        priority=plc.number("priority", 50, 1, 98),
        cpu=None if cpu == ANY_CPU else cpu,
        classes=classes,
        exception_program=exception_program,
        options=options,
        extensions=settings,
    )
    plc.finish()
    for name, value in options.items():
        if not isinstance(value, dict):
            raise ConfigurationError(f"{folder / FILE_NAME}: library.{name}: a table is expected")
    return project


def _memory_size(text: str) -> int:
    match = _SIZE.fullmatch(text)
    if match is None:
        raise ValueError(f'{text!r} is not a size such as "16MiB"')
    size = int(match[1]) * {"KiB": 1024, "MiB": 1024 * 1024, None: 1}[match[2]]
    if size % PAGE or not PAGE <= size <= MAX_SIZE:
        raise ValueError(f"{text!r} must be a multiple of {PAGE} bytes, at most {MAX_SIZE}")
    return size


def _task_classes(file: Path, tables: dict[str, Any], tick_ns: int) -> tuple[TaskClassEntry, ...]:
    if not tables:
        raise ConfigurationError(f"{file}: task_class: at least one, [task_class.1], is needed")
    numbers = {str(n): n for n in range(LOWEST_CLASS, HIGHEST_CLASS + 1)}
    for key in tables:
        if key not in numbers:
            raise ConfigurationError(
                f"{file}: task_class.{key}: task classes are [task_class.{LOWEST_CLASS}] to "
                f"[task_class.{HIGHEST_CLASS}]"
            )
    ordered = sorted(tables, key=lambda key: numbers[key])
    return tuple(
        _task_class(Table(file, f"task_class.{key}", tables[key]), numbers[key], tick_ns)
        for key in ordered
    )


def _task_class(table: Table, number: int, tick_ns: int) -> TaskClassEntry:
    default_ns = DEFAULT_CYCLES_MS[number] * 1_000_000
    cycle_ns = table.convert("cycle", default_ns, _cycle_ns, '"10ms"')
    if cycle_ns <= 0:
        raise table.error("cycle", "must be above 0")
    if cycle_ns % tick_ns:
        raise table.error("cycle", f"{cycle_ns} ns is not a multiple of the tick, {tick_ns} ns")
    tolerance_ns = DEFAULT_TOLERANCE_OF_8_NS if number == HIGHEST_CLASS else cycle_ns
    entry = TaskClassEntry(
        number=number,
        cycle_ns=cycle_ns,
        tolerance_ns=table.duration_ns("tolerance", tolerance_ns),
        first_release_ns=table.duration_ns("first_release", cycle_ns // 2),
        policy=table.convert("on_violation", Policy.SERVICE, _policy),
        host_policy=table.convert("on_host_violation", Policy.LOG, _policy),
        programs=tuple(
            _program(table, "programs", value) for value in table.take("programs", list, [])
        ),
    )
    table.finish()
    if not entry.programs:
        raise table.error("programs", "at least one program is needed")
    return entry


def _cycle_ns(text: str) -> int:
    cycle_ns = parse_duration_ns(text)
    if cycle_ns >= TOO_LONG_CYCLE_NS:
        minutes = text.strip().removesuffix("m").removesuffix("M").strip()
        hint = f'; did you mean "{minutes}ms"?' if minutes.isdecimal() else ""
        raise ValueError(f"{text!r} is a minute or more, too long for a cycle{hint}")
    return cycle_ns


def _policy(text: str) -> Policy:
    try:
        return Policy(text)
    except ValueError:
        raise ValueError(f'{text!r} is not "service", "log" or "exception"') from None


def _program(table: Table, key: str, value: object) -> ProgramEntry:
    if isinstance(value, str):
        value = {"name": value}
    if not isinstance(value, dict) or not isinstance(value.get("name"), str):
        raise table.error(key, f"{value!r} is neither a name nor {{name=..., source=...}}")
    name, source = value["name"], value.get("source", value["name"])
    unknown = sorted(set(value) - {"name", "source"})
    if unknown:
        raise table.error(key, f"{name}: unknown key {unknown[0]}")
    if not _NAME.fullmatch(name):
        raise table.error(key, f"{name!r} is not an identifier")
    if not isinstance(source, str) or Path(source).is_absolute() or ".." in Path(source).parts:
        raise table.error(key, f"{name}: source {source!r} is not a folder of the project")
    return ProgramEntry(name, source)


def _check_names(file: Path, project: Project) -> None:
    seen: set[str] = set()
    for program in project.programs:
        if program.name.upper() in seen:
            raise ConfigurationError(
                f"{file}: programs: two programs are called {program.name}; "
                f'give one a name of its own: {{name = "...", source = "{program.source}"}}'
            )
        seen.add(program.name.upper())
    uses = [c for c in project.classes if Policy.EXCEPTION in (c.policy, c.host_policy)]
    if uses and project.exception_program is None:
        raise ConfigurationError(
            f"{file}: task_class.{uses[0].number}: the policy exception needs plc.exception_program"
        )


def load_setup(project: Project) -> Setup:
    """Load the programs of a project and return what a controller is made from.

    Raises:
        ConfigurationError: a program is missing or cannot be loaded; file and line are named.
    """
    try:
        check_options(project.options)
    except ConfigurationError as err:
        raise ConfigurationError(f"{project.folder / FILE_NAME}: {err}") from None
    loader = ProgramLoader(project.folder)

    def setup_of(entry: ProgramEntry) -> ProgramSetup:
        return ProgramSetup(entry.name, loader.load(entry.source))

    return Setup(
        classes=[
            TaskClassSetup(
                number=c.number,
                cycle_ns=c.cycle_ns,
                programs=[setup_of(p) for p in c.programs],
                tolerance_ns=c.tolerance_ns,
                first_release_ns=c.first_release_ns,
                policy=c.policy,
                host_policy=c.host_policy,
            )
            for c in project.classes
        ],
        memory_size=project.memory_size,
        exception_program=setup_of(project.exception_program)
        if project.exception_program
        else None,
        options=project.options,
    )
