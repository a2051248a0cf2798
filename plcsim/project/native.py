"""A native project made of an Automation Studio project: what runs, in folders and a plc.toml.

The folders are those of the logical view, so that paths between sources stay as they are. Files
that every program sees lie beside plc.toml, under names that tell their packages; ``Private`` ones
stay in the folder of their package, where the programs inside it see them.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.errors import ConfigurationError
from plcsim.library.library import DECLARATIONS
from plcsim.program.c.sources import compiler_options
from plcsim.program.layout import library_folders
from plcsim.project.assembly import load, runnable
from plcsim.project.automation_studio.configuration import IO_MAP, PERMANENT, PV_MAP
from plcsim.project.automation_studio.file_devices import file_devices
from plcsim.project.project_file import FILE_NAME

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

    from plcsim.program.layout import LibraryPlace, ProgramPlace
    from plcsim.project.automation_studio.reader import AutomationStudioProject
    from plcsim.project.plc_toml import Project
    from plcsim.project.tables import ProgramEntry, TaskClassEntry

HEADERS: Final = (".h", ".hpp", ".hh", ".hxx", ".inc")
"""Suffixes of files that C includes and that no list needs to name."""

MADE_FILE: Final = "Mapp.var"
"""Declares the variables that a mapp configuration makes."""

_MAPS: Final = (("channels", IO_MAP), ("copies", PV_MAP), ("permanent", PERMANENT))


class NativeProject(NamedTuple):
    """What was written.

    Attributes:
        files: how many.
        left_out: what is not in it, a line for each.
    """

    files: int
    left_out: Sequence[str]


def write_native(project: Project, folder: Path) -> NativeProject:
    """Write what runs of an Automation Studio project as a native one.

    Args:
        project: as it was read.
        folder: is made.

    Raises:
        ConfigurationError: the folder is there, nothing of the project runs, or a file cannot be
            read or written.
    """
    found = project.automation_studio
    if found is None:
        raise ConfigurationError(f"{project.folder}: is no Automation Studio project")
    if folder.exists():
        raise ConfigurationError(f"{folder}: exists already; nothing was changed")
    try:
        left = runnable(project)
        return _Writer(left, found, folder).write()
    except OSError as err:
        raise ConfigurationError(f"{err.filename}: {err.strerror}") from None


class _Writer:
    """Writes one project."""

    def __init__(self, project: Project, found: AutomationStudioProject, folder: Path) -> None:
        self._project = project
        self._found = found
        self._folder = folder
        self._logical = found.view.root.folder.resolve()
        self._taken: dict[Path, Path] = {}
        self._folders: dict[str, str] = {}

    def write(self) -> NativeProject:
        layout = self._project.layout
        self._folder.mkdir(parents=True)
        for file in layout.common.files:
            if _declares(file):
                self._copy(file, Path("_".join(self._relative(file).parts)))
        for source, place in layout.programs.items():
            self._write_program(source, place)
        stubs = [place.name for place in layout.libraries if place.is_vendor]
        libraries = [self._write_library(place) for place in layout.libraries]
        self._copy_headers()
        made = self._write_made()
        devices = self._make_devices()
        include = [self._include(each) for each in layout.c_build.include_folders]
        tables = [
            self._plc(),
            *map(self._task_class, self._project.classes),
            self._libraries(libraries, stubs),
            self._c(include),
            self._io(),
            _table("library.FileIO.devices", devices),
            *(_table(f"simulate.{name}", rules) for name, rules in layout.simulate.items()),
        ]
        text = "\n".join(table for table in tables if table)
        (self._folder / FILE_NAME).write_text(text, "utf-8")
        return NativeProject(
            len(self._taken) + made + 1, [*self._project.left_out, *self._others()]
        )

    def _relative(self, path: Path) -> Path:
        """Return the place of a file or folder of the logical view; of others only the name."""
        path = path.resolve()
        if path.is_relative_to(self._logical):
            return path.relative_to(self._logical)
        return Path(path.name)

    def _copy(self, file: Path, place: Path) -> Path:
        """Copy a file; return its place, which has another name where one was taken."""
        stem, count = place.stem, 1
        while place in self._taken and self._taken[place] != file:
            count += 1
            place = place.with_name(f"{stem}_{count}{place.suffix}")
        if place not in self._taken:
            target = self._folder / place
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, target)
            self._taken[place] = file
        return place

    def _copy_own(self, files: Iterable[Path], folder: Path, target: Path) -> None:
        """Copy the files of a program or a library; declarations lie in its folder itself."""
        for file in files:
            inside = file.is_relative_to(folder)
            place = file.relative_to(folder) if inside else Path(file.name)
            if _declares(file):
                place = Path("_".join(place.parts))
            if file.is_file():
                self._copy(file, target / place)

    def _write_program(self, source: str, place: ProgramPlace) -> None:
        target = self._target(place.folder, source)
        self._folders[source] = target.as_posix()
        self._copy_own(place.own.files, place.folder, target)
        for around in place.around:
            for file in around.files:
                if _declares(file):
                    self._copy(file, self._relative(file))

    def _target(self, folder: Path, name: str) -> Path:
        """Return where the folder of a program or a library lies."""
        if folder.is_relative_to(self._logical):
            return folder.relative_to(self._logical)
        return Path("Referenced", name.replace(".", "_"))

    def _write_library(self, place: LibraryPlace) -> Path:
        target = self._target(place.folder, place.name)
        self._copy_own(place.files, place.folder, target)
        interfaces = [f for f in place.files if f.suffix.lower() == ".fun"]
        if len(interfaces) == 1 and interfaces[0].stem != place.name:
            named = self._folder / target / interfaces[0].name
            named.rename(named.with_name(f"{place.name}.fun"))
        return target

    def _copy_headers(self) -> None:
        """Copy all headers of the logical view: sources include them by their paths."""
        for file in sorted(self._logical.rglob("*")):
            if file.suffix.lower() in HEADERS and file.is_file():
                self._copy(file, self._relative(file))

    def _write_made(self) -> int:
        """Declare what the mapp configuration makes; return the number of files."""
        application = load(self._project)
        try:
            catalogue = application.setup.catalogue
            assert catalogue is not None
            names = {name for scope in catalogue.scopes for name in scope.index.names("types")}
        finally:
            application.unload()
        made = [each for each in self._project.layout.made_variables if each.data_type in names]
        if not made:
            return 0
        lines = "".join(f"\t{each.name} : {each.data_type};\n" for each in made)
        (self._folder / MADE_FILE).write_text(f"VAR\n{lines}END_VAR\n", "utf-8")
        return 1

    def _make_devices(self) -> dict[str, str]:
        """Make the folders of the file devices; return them by the names of the devices."""
        named = self._found.configuration.hardware.file_devices
        devices = {}
        for name, path in file_devices(named, self._folder).items():
            path.mkdir(parents=True, exist_ok=True)
            devices[name] = path.relative_to(self._folder).as_posix()
        return devices

    def _include(self, folder: Path) -> str:
        """Return where a folder of headers lies; one from outside is copied."""
        if folder.is_relative_to(self._logical):
            target = folder.relative_to(self._logical)
            (self._folder / target).mkdir(parents=True, exist_ok=True)
            return target.as_posix()
        target = Path("Referenced", folder.name)
        for file in sorted(folder.rglob("*")):
            if file.suffix.lower() in HEADERS and file.is_file():
                self._copy(file, target / file.relative_to(folder))
        (self._folder / target).mkdir(parents=True, exist_ok=True)
        return target.as_posix()

    def _plc(self) -> str:
        plc = self._project.plc
        keys: dict[str, object] = {
            "name": self._project.name,
            "tick": _duration(plc.tick_ns),
            "memory": f"{plc.memory_size // 1024}KiB",
        }
        return _table("plc", keys)

    def _task_class(self, each: TaskClassEntry) -> str:
        keys: dict[str, object] = {
            "cycle": _duration(each.cycle_ns),
            "tolerance": _duration(each.tolerance_ns),
        }
        if each.first_release_ns is not None:
            keys["first_release"] = _duration(each.first_release_ns)
        lines = "".join(f"    {self._program(entry)},\n" for entry in each.programs)
        return f"{_table(f'task_class.{each.number}', keys)}programs = [\n{lines}]\n"

    def _program(self, entry: ProgramEntry) -> str:
        source = self._folders[entry.source]
        return f"{{ name = {_text(entry.name)}, source = {_text(source)} }}"

    def _libraries(self, libraries: Collection[Path], stubs: Sequence[str]) -> str:
        programs = [self._folder.resolve() / each for each in self._folders.values()]
        seen = set(library_folders(self._folder.resolve(), programs))
        hidden = [each for each in libraries if self._folder.resolve() / each not in seen]
        keys: dict[str, object] = {}
        if hidden:
            keys["folders"] = [each.as_posix() for each in hidden]
        if stubs:
            keys["stub"] = stubs
        return _table("libraries", keys)

    def _c(self, include: Sequence[str]) -> str:
        build = self._project.layout.c_build
        options = compiler_options(build)
        keys: dict[str, object] = {"heap": f"{build.heap_size // 1024}KiB"}
        if include:
            keys["include"] = [*dict.fromkeys(include)]
        if options:
            keys["options"] = options
        return _table("c", keys)

    def _io(self) -> str:
        keys: dict[str, object] = {}
        for key, kind in _MAPS:
            files = self._found.configuration.files_of_kind(kind)
            copied = [self._copy(file, Path(file.name)).as_posix() for file in files]
            if copied:
                keys[key] = copied
        return _table("io", keys)

    def _others(self) -> Iterator[str]:
        """Yield what is left out besides tasks that cannot run."""
        names = {entry.name for entry in self._project.programs}
        skipped = [task.name for task in self._found.tasks if task.name not in names]
        told = " ".join(self._project.left_out)
        for name in (*skipped, *self._found.configuration.software.disabled):
            if f"{name} is left out" not in told:
                yield f"{name} is left out: it is skipped or disabled"
        for name in self._found.configurations:
            if name != self._found.configuration.name:
                yield f"the configuration {name} is left out"
        for name in self._project.extensions:
            yield f"the table [{name}] of plc.toml is left out"


def _declares(file: Path) -> bool:
    return file.suffix.lower() in DECLARATIONS


def _duration(duration_ns: int) -> str:
    """Return a duration exactly."""
    for unit, unit_ns in (("s", 1_000_000_000), ("ms", 1_000_000), ("us", 1_000)):
        if duration_ns and duration_ns % unit_ns == 0:
            return f"{duration_ns // unit_ns}{unit}"
    return f"{duration_ns}ns"


def _table(name: str, keys: Mapping[str, object]) -> str:
    """Return a table of plc.toml, "" for one without keys."""
    lines = "".join(f"{_key(key)} = {_text(value)}\n" for key, value in keys.items())
    return f"[{name}]\n{lines}" if keys else ""


def _key(name: str) -> str:
    return name if name.isidentifier() and name.isascii() else _text(name)


def _text(value: object) -> str:
    """Return a value as TOML has it, which is as JSON has it."""
    return json.dumps(value, ensure_ascii=False)
