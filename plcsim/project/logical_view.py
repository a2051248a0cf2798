r"""The logical view of an Automation Studio project: its packages, programs and libraries.

``Package.pkg``, ``IEC.prg``, ``ANSIC.lby`` and so on list what belongs to a package, a program, a
library; what is not listed does not exist for Automation Studio. The files come from Windows: names
are looked up without regard to case, ``\`` separates folders, and references count from the folder
of the package, of the project file, or, where they begin with ``\``, from that of the project.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, Final, NamedTuple
from xml.etree import ElementTree as ET

if TYPE_CHECKING:
    from pathlib import Path

MAX_BYTES: Final = 4 << 20
"""Bytes of a list that are read; real ones stay below 100 KiB."""

MAX_DEPTH: Final = 32
"""Packages one inside the other; real ones stay below 7."""

PACKAGE_LIST: Final = "Package.pkg"
PROGRAM_LISTS: Final = ("IEC.prg", "ANSIC.prg")
LIBRARY_LISTS: Final = ("IEC.lby", "ANSIC.lby", "Binary.lby")


@dataclass(frozen=True, slots=True)
class SourceFolder:
    """A program or a library.

    Attributes:
        name: as the list of its package has it.
        path: names of the packages around it, from the outside in, and its own.
        folder: where it lies.
        files: what its list names, and the lists of the packages inside it, in order.
    """

    name: str
    path: tuple[str, ...]
    folder: Path
    files: tuple[Path, ...]


@dataclass(slots=True)
class Package:
    """A package.

    Attributes:
        path: names of the packages around it, from the outside in, and its own; () for the root.
        folder: where it lies.
        files: what every program sees, in order.
        private_files: what only the programs in this package and below see.
        packages: inside it, in order.
        programs: likewise.
        libraries: likewise.
    """

    path: tuple[str, ...]
    folder: Path
    files: list[Path] = field(default_factory=list)
    private_files: list[Path] = field(default_factory=list)
    packages: list[Package] = field(default_factory=list)
    programs: list[SourceFolder] = field(default_factory=list)
    libraries: list[SourceFolder] = field(default_factory=list)


class Finding(NamedTuple):
    """What is wrong in a list.

    Attributes:
        file: the list.
        message: what is wrong.
        missing: the object that is listed and not there, empty where the list itself is wrong.
    """

    file: Path
    message: str
    missing: str = ""


class LogicalView(NamedTuple):
    """The root package, and what is wrong in the lists."""

    root: Package
    findings: list[Finding]


def logical_folder(project: Path) -> Path | None:
    """Return the folder of the logical view of the project in a folder, None if there is none.

    That is ``Logical`` beside a project file (``*.apj``).
    """
    names = names_in(project)
    if not any(name.endswith(".apj") for name in names) or "logical" not in names:
        return None
    folder = project / names["logical"]
    return folder if is_package(folder) else None


def is_package(folder: Path) -> bool:
    """Whether a folder holds the list of a package."""
    return PACKAGE_LIST.lower() in names_in(folder)


def is_listed(folder: Path) -> bool:
    """Whether a folder holds the list of a package, a program or a library."""
    names = names_in(folder)
    return any(name.lower() in names for name in (PACKAGE_LIST, *PROGRAM_LISTS, *LIBRARY_LISTS))


def read_logical_view(folder: Path) -> LogicalView:
    """Read the logical view whose root package lies in ``folder``."""
    reader = _Reader(folder)
    return LogicalView(reader.package(folder, ()), reader.findings)


class _Object(NamedTuple):
    """A line of a list."""

    kind: str
    name: str
    is_private: bool
    is_reference: bool


class _ListError(Exception):
    """A list cannot be read; the message says why."""


class _Reader:
    """Reads the lists of one project.

    Args:
        root: folder of the root package; the project file lies beside it.
    """

    def __init__(self, root: Path) -> None:
        self._project = root.parent
        self._seen: set[Path] = set()
        self._names = cache(names_in)
        self.findings: list[Finding] = []

    def package(self, folder: Path, path: tuple[str, ...]) -> Package:
        made = Package(path, folder)
        for item, found in self._listed(folder, (PACKAGE_LIST,)):
            inner = (*path, item.name)
            match item.kind:
                case "File":
                    (made.private_files if item.is_private else made.files).append(found)
                case "Package" if len(path) < MAX_DEPTH:
                    made.packages.append(self.package(found, inner))
                case "Program":
                    made.programs.append(self._source_folder(found, inner, PROGRAM_LISTS))
                case "Library":
                    made.libraries.append(self._source_folder(found, inner, LIBRARY_LISTS))
        return made

    def _source_folder(
        self, folder: Path, path: tuple[str, ...], lists: tuple[str, ...]
    ) -> SourceFolder:
        return SourceFolder(path[-1], path, folder, tuple(self._files(folder, lists, MAX_DEPTH)))

    def _files(self, folder: Path, lists: tuple[str, ...], depth: int) -> list[Path]:
        """Return the files of a program or a library, those of packages inside it too."""
        files = []
        for item, found in self._listed(folder, lists):
            if item.kind == "File":
                files.append(found)
            elif item.kind == "Package" and depth:
                files += self._files(found, (PACKAGE_LIST,), depth - 1)
        return files

    def _listed(self, folder: Path, lists: tuple[str, ...]) -> list[tuple[_Object, Path]]:
        """Return what the first of ``lists`` that is in a folder names, and where it lies."""
        names = self._names(folder)
        name = next((names[each.lower()] for each in lists if each.lower() in names), None)
        if name is None:
            self._report(folder, f"there is no {' or '.join(lists)}")
            return []
        file = folder / name
        if file.resolve() in self._seen:
            self._report(file, "it is listed twice, or lists itself")
            return []
        self._seen.add(file.resolve())
        try:
            objects = _objects(file)
        except _ListError as err:
            self._report(file, str(err))
            return []
        return [pair for item in objects if (pair := self._found(file, item)) is not None]

    def _found(self, file: Path, item: _Object) -> tuple[_Object, Path] | None:
        found = self._path_of(file.parent, item)
        if found is None:
            self._report(file, f"{item.kind} {item.name} is listed and not there", item.name)
            return None
        if item.is_reference and item.kind != "File":
            found = found if found.is_dir() else found.parent
            item = item._replace(name=found.name)
        return item, found

    def _report(self, file: Path, message: str, missing: str = "") -> None:
        self.findings.append(Finding(file, message, missing))

    def _path_of(self, folder: Path, item: _Object) -> Path | None:
        """Return where the object of a list in ``folder`` lies, None if it does not."""
        if not item.is_reference:
            return self._below(folder, item.name)
        if item.name.startswith("\\"):
            return self._below(self._project, item.name)
        return self._below(self._project, item.name) or self._below(folder, item.name)

    def _below(self, folder: Path, name: str) -> Path | None:
        r"""Return the file ``name``, ``\`` between its parts, counted from ``folder``."""
        for part in name.replace("\\", "/").split("/"):
            if part == "..":
                folder = folder.parent
            elif part not in ("", "."):
                found = self._names(folder).get(part.lower())
                if found is None:
                    return None
                folder = folder / found
        return folder


def names_in(folder: Path) -> dict[str, str]:
    """Return the names in a folder by themselves in small letters; {} if it cannot be read."""
    try:
        return {path.name.lower(): path.name for path in folder.iterdir()}
    except OSError:
        return {}


class _NoDoctype(ET.TreeBuilder):
    """Refuses document types, whose entities can make much of little."""

    def doctype(self, name: str, pubid: str | None, system: str | None) -> None:
        """Refuse a document type.

        Raises:
            _ListError: always.
        """
        raise _ListError(f"a document type ({name}) has no place here")


def _objects(file: Path) -> list[_Object]:
    """Return the lines of a list.

    Raises:
        _ListError: it cannot be read.
    """
    try:
        with file.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
        if len(data) > MAX_BYTES:
            raise _ListError(f"it is larger than {MAX_BYTES >> 20} MiB")
        root = ET.fromstring(data, ET.XMLParser(target=_NoDoctype()))  # noqa: S314  # no document types, no entities
    except OSError as err:
        raise _ListError(err.strerror or str(err)) from None
    except (ET.ParseError, LookupError, ValueError) as err:
        raise _ListError(f"it is no XML: {err}") from None
    return [_object(element) for element in root.iter() if _tag(element) in ("Object", "File")]


def _tag(element: ET.Element) -> str:
    return element.tag.rpartition("}")[2]


def _object(element: ET.Element) -> _Object:
    kind = "File" if _tag(element) == "File" else element.get("Type", "")
    name = (element.text or "").strip()
    return _Object(kind, name, _is_true(element, "Private"), _is_true(element, "Reference"))


def _is_true(element: ET.Element, key: str) -> bool:
    return element.get(key, "").lower() == "true"
