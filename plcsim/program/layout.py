"""Where a project's sources lie: its programs, its libraries, and the places that declare names.

A project of folders::

    my_plc/
      plc.toml
      Global.typ Global.var       any .typ and .var file here: what all programs see
      conveyor/                   a program
        Variables.var Types.typ   any .typ, .var and .fun file here: its own
      my_lib/                     a folder with a .fun file that is no program: a library

An Automation Studio project says all this in its lists
(`plcsim.project.automation_studio.layout`).
"""

from __future__ import annotations

import contextlib
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.library.library import NESTED, PLAIN, CBuild, files_in, sources_in

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

    from plcsim.library.simulated import Value

DEEPEST: Final = 4
"""Folders below the project's in which libraries are looked for."""

INSTANCE_OF: Final = " : "
"""Stands between the name of an instance and that of its PROGRAM."""

_NOT_LOOKED_INTO: Final = frozenset(["tests", "Temp", "Binaries"])
"""Folders of a project that hold no libraries; neither do those that begin with "." or "_"."""


class DeclarationPlace(NamedTuple):
    """A place that declares names for the programs inside it.

    Attributes:
        name: of the project, the package or the program.
        files: that belong to it.
    """

    name: str
    files: tuple[Path, ...]


class ProgramPlace(NamedTuple):
    """A program.

    Attributes:
        folder: where it lies.
        own: its files.
        around: the places between the project and it, from the outside in.
        only: of a PROGRAM that stands among others in the common files, as IEC 61131-3 has it: its
            name; "" for a program of files of its own.
        instance: of that one, where a CONFIGURATION connects variables to it; "" for none.
    """

    folder: Path
    own: DeclarationPlace
    around: tuple[DeclarationPlace, ...] = ()
    only: str = ""
    instance: str = ""


class LibraryPlace(NamedTuple):
    """A library.

    Attributes:
        name: of it; "" for that of its .fun file.
        folder: where it lies.
        files: that belong to it.
        package: name of its folder for Python, below the project's.
        is_vendor: it comes without source; what plcsim has itself stands before it.
        dependencies: names of libraries that it needs.
    """

    name: str
    folder: Path
    files: tuple[Path, ...]
    package: str
    is_vendor: bool = False
    dependencies: tuple[str, ...] = ()


class MadeVariable(NamedTuple):
    """A global variable that no file declares: a configuration makes it.

    Attributes:
        name: of it.
        data_type: name of its type, which a library declares, or there is no variable.
    """

    name: str
    data_type: str


@dataclass(frozen=True)
class SourceLayout:
    """Where the sources of a project lie.

    Attributes:
        folder: of the project.
        common: what all programs see.
        programs: by the names that task classes give them.
        libraries: in the order in which names are looked up in them.
        made_variables: global variables besides those that files declare.
        c_build: how C is compiled.
        stubs: libraries of which a block without a body is idle, in small letters; "*" for all
            that come without source.
        simulate: rules for blocks of such libraries (`plcsim.library.simulated`), by block.
        dialect: of its programs in Structured Text, a key of `plcsim.program.loader.DIALECTS`; ""
            where each program's files tell.
    """

    folder: Path
    common: DeclarationPlace
    programs: Mapping[str, ProgramPlace] = field(default_factory=dict)
    libraries: tuple[LibraryPlace, ...] = ()
    made_variables: tuple[MadeVariable, ...] = ()
    c_build: CBuild = PLAIN
    stubs: frozenset[str] = frozenset()
    simulate: Mapping[str, Mapping[str, Value]] = field(default_factory=dict)
    dialect: str = ""

    @property
    def is_compiled(self) -> bool:
        """Whether a program or a library is written in Structured Text, C or C++."""
        programs = (file for place in self.programs.values() for file in place.own.files)
        libraries = (file for place in self.libraries for file in place.files)
        return any(f.suffix.lower() in NESTED for f in (*programs, *libraries))


def folder_layout(
    folder: Path,
    sources: Sequence[str] = (),
    libraries: Sequence[Path] = (),
    stubs: Iterable[str] = (),
) -> SourceLayout:
    """Return the layout of a project of folders.

    Args:
        folder: where plc.toml lies.
        sources: folders of its programs, as plc.toml names them.
        libraries: folders of libraries outside it.
        stubs: names of libraries in which what has no body is idle; one without sources is a
            vendor's.

    Raises:
        ConfigurationError: two libraries have one name, or a folder cannot be read.
    """
    folder = folder.resolve()
    programs = program_places(folder, sources)
    inside = library_folders(folder, [place.folder for place in programs.values()])
    found = [_library(path, ".".join(path.relative_to(folder).parts)) for path in inside]
    others = [each for each in outside_libraries(libraries) if each.folder not in inside]
    idle = frozenset(name.lower() for name in stubs)
    places = tuple(_as_vendors(place, idle) for place in (*found, *others))
    return SourceLayout(folder, _place(folder), programs, places, stubs=idle)


def _as_vendors(place: LibraryPlace, stubs: Collection[str]) -> LibraryPlace:
    """Return a library as a vendor's, where it is among ``stubs`` and has no sources."""
    name = _name_of(place)
    if name.lower() not in stubs or has_sources(place.files):
        return place
    return place._replace(name=name, is_vendor=True)


def _name_of(place: LibraryPlace) -> str:
    """Return the name that a library gets (`plcsim.library.library.Library`)."""
    interfaces = [file.stem for file in place.files if file.suffix.lower() == ".fun"]
    return place.name or (interfaces[0] if len(interfaces) == 1 else place.folder.name)


def has_sources(files: Iterable[Path]) -> bool:
    """Return whether any of the files of a library is compiled, or is Python."""
    return any(file.suffix.lower() in (*NESTED, ".py") for file in files)


def program_places(folder: Path, sources: Iterable[str]) -> dict[str, ProgramPlace]:
    """Return the programs of a project of folders, by the names that plc.toml has for them.

    What is no folder may be a PROGRAM of the .st files that lie in the project's folder itself.
    """
    return {
        source: unit_place(folder, source)
        if not _is_folder(folder / source) and any(folder.glob("*.[sS][tT]"))
        else _program(folder, source)
        for source in sources
    }


def unit_place(folder: Path, name: str) -> ProgramPlace:
    """Return the place of a PROGRAM among others in the common files.

    Args:
        folder: of the project.
        name: of the PROGRAM; ``instance : name`` where a CONFIGURATION connects variables to it.
    """
    instance, _, only = name.rpartition(INSTANCE_OF)
    return ProgramPlace(folder, DeclarationPlace(name, ()), only=only, instance=instance)


def outside_libraries(folders: Iterable[Path]) -> tuple[LibraryPlace, ...]:
    """Return the libraries in folders outside a project, each once."""
    return tuple(_library(path, path.name) for path in dict.fromkeys(p.resolve() for p in folders))


def _place(folder: Path) -> DeclarationPlace:
    return DeclarationPlace(folder.name, tuple(files_in(folder)) if _is_folder(folder) else ())


def _is_folder(path: Path) -> bool:
    return os.path.isdir(path)  # noqa: PTH112  # no error for what can be no path


def _program(folder: Path, source: str) -> ProgramPlace:
    place = folder / source
    around = [parent for parent in reversed(place.parents) if folder in parent.parents]
    files = sources_in(place) if _is_folder(place) else []
    return ProgramPlace(
        place, DeclarationPlace(place.name, tuple(files)), tuple(map(_place, around))
    )


def _library(folder: Path, package: str) -> LibraryPlace:
    return LibraryPlace("", folder, tuple(sources_in(folder)), package)


def library_folders(folder: Path, programs: Collection[Path] = ()) -> list[Path]:
    """Return the folders of a project that are libraries, in order.

    A folder with a .fun file is one, unless it is a program or lies in one.
    """
    found = _libraries_below(os.fspath(folder), {os.fspath(p) for p in programs}, DEEPEST)
    return sorted(Path(path) for path in found)


def _libraries_below(folder: str, programs: Collection[str], depth: int) -> Iterator[str]:
    for path in _folders_in(folder):
        if path in programs:
            continue
        if any(name.lower().endswith(".fun") for name in os.listdir(path)):  # noqa: PTH208  # likewise
            yield path
        elif depth > 1:
            yield from _libraries_below(path, programs, depth - 1)


def _folders_in(folder: str) -> list[str]:
    """Return the folders that may hold libraries; what may not be read holds none."""
    with contextlib.suppress(OSError), os.scandir(folder) as entries:  # a Path each takes longer
        return [
            entry.path
            for entry in entries
            if entry.name[0] not in "._"
            and entry.name not in _NOT_LOOKED_INTO
            and entry.is_dir()
            and os.access(entry.path, os.R_OK | os.X_OK)
        ]
    return []
