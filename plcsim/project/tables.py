"""Tables [plc], [task_class.N] and [libraries] of plc.toml; docs/project.md lists their keys."""

from __future__ import annotations

import re
from datetime import UTC, date, datetime, time
from pathlib import Path
from typing import Annotated, Final, Literal, NamedTuple

from plcsim.core.duration import parse_duration_ns
from plcsim.core.memory import DEFAULT_SIZE, MAX_SIZE, PAGE
from plcsim.core.task import HIGHEST_CLASS, Policy
from plcsim.settings import Converted, Duration, Key, PathTo, SettingKind, Size, Whole, settings
from plcsim.settings.kinds import of_kind

DEFAULT_CYCLES_MS: Final = {1: 10, 2: 20, 3: 50, 4: 100, 5: 200, 6: 500, 7: 1000, 8: 10}
"""Cycle time of each class where none is given, as in a new Automation Studio project."""

DEFAULT_TOLERANCE_OF_8_NS: Final = 30_000_000_000
"""Class 8 tolerates 30 s, again as in a new Automation Studio project; others their cycle time."""

TOO_LONG_CYCLE_NS: Final = 60_000_000_000
"""No cycle time is that long. "1m" is a minute, as T#1m is, but here it is a misspelt "1ms"."""

ANY_CPU: Final = -1
LAST_CPU: Final = 1023
"""The last that sched_setaffinity(2) takes without a larger set."""

LAST_SECOND: Final = 4_102_444_799
"""The last second of 2099, the largest DATE_AND_TIME of the controller."""

HEAP_UNIT: Final = 1 << 10
DEFAULT_HEAP: Final = 1 << 20
"""Bytes of the heap of a program in C."""

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


class ProgramEntry(NamedTuple):
    """A program in plc.toml: the name it runs under and the folder it lies in."""

    name: str
    source: str


class ProgramKind(SettingKind):
    """A program: its name, which is its folder's, or ``{name = ..., source = ...}``."""

    def convert(self, value: object, _folder: Path) -> ProgramEntry:
        """Return the entry."""
        table = {"name": value} if isinstance(value, str) else value
        if isinstance(table, dict) and isinstance(table.get("name"), str):
            return _entry(table["name"], table)
        raise ValueError(f"{value!r} is neither a name nor {{name=..., source=...}}")


def _entry(name: str, table: dict[str, object]) -> ProgramEntry:
    source = table.get("source", name)
    unknown = sorted(set(table) - {"name", "source"})
    if unknown:
        raise ValueError(f"{name}: unknown key {unknown[0]}")
    if not _NAME.fullmatch(name):
        raise ValueError(f"{name!r} is not an identifier")
    if not isinstance(source, str) or Path(source).is_absolute() or ".." in Path(source).parts:
        raise ValueError(f"{name}: source {source!r} is not a folder of the project")
    return ProgramEntry(name, source)


def _cycle_ns(text: str) -> int:
    cycle_ns = parse_duration_ns(text)
    if cycle_ns <= 0:
        raise ValueError("must be above 0")
    if cycle_ns >= TOO_LONG_CYCLE_NS:
        minutes = text.strip().removesuffix("m").removesuffix("M").strip()
        hint = f'; did you mean "{minutes}ms"?' if minutes.isdecimal() else ""
        raise ValueError(f"{text!r} is a minute or more, too long for a cycle{hint}")
    return cycle_ns


class Date(SettingKind):
    """A date and time such as ``2026-03-31T06:00:00``, in nanoseconds since 1970."""

    def convert(self, value: object, _folder: Path) -> int:
        """Return the nanoseconds; a date alone means its midnight."""
        if type(value) is date:
            value = datetime.combine(value, time())
        found = of_kind(datetime, value, "2026-03-31T06:00:00")
        if found.tzinfo is None:
            found = found.replace(tzinfo=UTC)
        seconds = int(found.timestamp())
        if not 0 <= seconds <= LAST_SECOND:
            raise ValueError(f"{value} does not lie between 1970 and 2099")
        return seconds * 1_000_000_000 + found.microsecond * 1000


@settings
class PlcSettings:
    """Table [plc].

    Attributes:
        name: of the project, "" for that of its folder.
        tick_ns: all cycle times are multiples of it.
        memory_size: bytes of PLC memory.
        watchdog_ns: after this time at least, a CYCLIC that does not return is ended.
        init_timeout_ns: the same for INIT and EXIT.
        realtime: whether real-time rights are asked for, and whether the run needs them.
        priority: of SCHED_FIFO.
        cpu: the processor to stay on, `ANY_CPU` for any.
        exception_program: runs for violations under the policy "exception".
        dialect: of its programs in Structured Text; "" where each program's files tell.
        start_date_ns: the controller's date at its start (key "start_date"), as people read it
            there; None for the host's on the real clock, 2000-01-01 on the virtual one.
    """

    name: str = ""
    tick_ns: Annotated[int, Duration(minimum_ns=1)] = 1_000_000
    memory_size: Annotated[int, Key("memory"), Size(PAGE, MAX_SIZE, unit=PAGE)] = DEFAULT_SIZE
    watchdog_ns: Annotated[int, Duration()] = 500_000_000
    init_timeout_ns: Annotated[int, Duration()] = 10_000_000_000
    realtime: Literal["auto", "off", "require"] = "auto"
    priority: Annotated[int, Whole(1, 98)] = 50
    cpu: Annotated[int, Whole(ANY_CPU, LAST_CPU)] = ANY_CPU
    exception_program: Annotated[ProgramEntry | None, ProgramKind()] = None
    dialect: Literal["", "iec", "automation-studio"] = ""
    start_date_ns: Annotated[int | None, Key("start_date"), Date()] = None

    @property
    def pinned_cpu(self) -> int | None:
        """The processor to stay on, None for any."""
        return None if self.cpu == ANY_CPU else self.cpu


@settings
class TaskClassTable:
    """Table [task_class.N]; what is None depends on the number of the class."""

    cycle_ns: Annotated[int | None, Key("cycle"), Converted(_cycle_ns, '"10ms"')] = None
    tolerance_ns: Annotated[int | None, Duration()] = None
    first_release_ns: Annotated[int | None, Duration()] = None
    policy: Annotated[Policy, Key("on_violation")] = Policy.SERVICE
    host_policy: Annotated[Policy, Key("on_host_violation")] = Policy.LOG
    programs: tuple[Annotated[ProgramEntry, ProgramKind()], ...] = ()


@settings
class LibrariesTable:
    """Table [libraries].

    Attributes:
        folders: of libraries outside the project; a relative path begins at the project's folder.
        stub: libraries in which what has no body is idle; None for all of an Automation Studio
            project that come without source, and for none of another project.
    """

    folders: tuple[Annotated[Path, PathTo("folder")], ...] = ()
    stub: tuple[str, ...] | None = None


@settings
class IoTable:
    """Table [io]: maps as Automation Studio writes them; relative paths begin at the project.

    Attributes:
        channels: files as IoMap.iom: variables by I/O channel.
        copies: files as PvMap.vvm: variables by variable.
        permanent: files as Cpu.per: variables that outlive a cold restart.
    """

    channels: tuple[Annotated[Path, PathTo("file")], ...] = ()
    copies: tuple[Annotated[Path, PathTo("file")], ...] = ()
    permanent: tuple[Annotated[Path, PathTo("file")], ...] = ()


@settings
class CTable:
    """Table [c]: how programs and libraries in C are compiled.

    Attributes:
        include: further folders of headers; a relative path begins at the project's folder.
        options: for the compiler, such as "-DSIMULATION=1".
        heap: bytes of the heap of a program or library that does not say how many it needs.
    """

    include: tuple[Annotated[Path, PathTo("folder")], ...] = ()
    options: tuple[str, ...] = ()
    heap: Annotated[int, Size(HEAP_UNIT, MAX_SIZE, unit=HEAP_UNIT)] = DEFAULT_HEAP


@settings
class ProjectKey:
    """The key ``project`` of plc.toml.

    Attributes:
        project: folder of an Automation Studio project.
    """

    project: Annotated[Path, PathTo("folder")] | None = None


@settings
class AutomationStudioTable:
    """Table [as], beside an Automation Studio project.

    Attributes:
        config: the configuration that runs, "" for the active one.
        skip: names of tasks that do not run.
    """

    config: str = ""
    skip: tuple[str, ...] = ()


class TaskClassEntry(NamedTuple):
    """A task class as plc.toml has it; for the fields see `plcsim.core.task.TaskClass`."""

    number: int
    cycle_ns: int
    tolerance_ns: int
    first_release_ns: int
    policy: Policy
    host_policy: Policy
    programs: tuple[ProgramEntry, ...]


def task_class_entry(number: int, table: TaskClassTable) -> TaskClassEntry:
    """Return a task class with all its times, as a new Automation Studio project has them."""
    cycle_ns = table.cycle_ns or DEFAULT_CYCLES_MS[number] * 1_000_000
    tolerance_ns, first_ns = table.tolerance_ns, table.first_release_ns
    if tolerance_ns is None:
        tolerance_ns = DEFAULT_TOLERANCE_OF_8_NS if number == HIGHEST_CLASS else cycle_ns
    return TaskClassEntry(
        number=number,
        cycle_ns=cycle_ns,
        tolerance_ns=tolerance_ns,
        first_release_ns=cycle_ns // 2 if first_ns is None else first_ns,
        policy=table.policy,
        host_policy=table.host_policy,
        programs=table.programs,
    )
