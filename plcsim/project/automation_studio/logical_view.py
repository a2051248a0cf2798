r"""The logical view of an Automation Studio project: its packages, programs and libraries.

``Package.pkg``, ``IEC.prg``, ``ANSIC.lby`` and so on list what belongs to a package, a program, a
library; what is not listed does not exist for Automation Studio. The files come from Windows: names
are looked up without regard to case, ``\`` separates folders, and references count from the folder
of the package, of the project file, or, where they begin with ``\``, from that of the project.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import chain
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.library.document import DocumentError, read_document
from plcsim.project.automation_studio.dependencies import wrong_dependencies
from plcsim.project.automation_studio.finding import Finding
from plcsim.project.automation_studio.names import FileNames, names_in

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from plcsim.library.document import XmlElement

MAX_DEPTH: Final = 32
"""Packages one inside the other; real ones stay below 7."""

PACKAGE_LIST: Final = "Package.pkg"
PROGRAM_LISTS: Final = ("IEC.prg", "ANSIC.prg")
LIBRARY_LISTS: Final = ("IEC.lby", "ANSIC.lby", "Binary.lby")


class Dependency(NamedTuple):
    """A library that another one needs, and the line that says so."""

    name: str
    line: int


@dataclass(frozen=True, slots=True)
class SourceFolder:
    """A program or a library.

    Attributes:
        name: as the list of its package has it.
        path: names of the packages around it, from the outside in, and its own.
        folder: where it lies.
        files: what its list names, and the lists of the packages inside it, in order.
        list_file: its list; None where there is none.
        missing: what its lists name and is not there.
        dependencies: of a library: those that its list says it needs.
    """

    name: str
    path: tuple[str, ...]
    folder: Path
    files: tuple[Path, ...]
    list_file: Path | None = None
    missing: tuple[Finding, ...] = ()
    dependencies: tuple[Dependency, ...] = ()

    @property
    def is_binary(self) -> bool:
        """Whether it is a library that comes compiled, without its source."""
        return self.list_file is not None and self.list_file.name.lower() == "binary.lby"


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

    def walk(self) -> Iterator[Package]:
        """Yield this package and all below it, in the order in which they are listed."""
        yield self
        for inner in self.packages:
            yield from inner.walk()


class LogicalView(NamedTuple):
    """The root package, and what is wrong in the lists."""

    root: Package
    findings: list[Finding]

    @property
    def libraries(self) -> Iterator[SourceFolder]:
        """All libraries, in order."""
        return chain.from_iterable(package.libraries for package in self.root.walk())


def project_file(folder: Path) -> Path | None:
    """Return the project file (``*.apj``) in a folder, None if there is none.

    Some repositories hold the logical view only: then it is the folder ``Logical``.
    """
    names = names_in(folder)
    found = _named_as_project(folder, names)
    if found is not None:
        return found
    logical = folder / names.get("logical", "Logical")
    return logical if is_package(logical) else None


def _named_as_project(folder: Path, names: Mapping[str, str]) -> Path | None:
    """Return the first file called ``*.apj``; a folder may be called so, too."""
    found = (folder / name for name in sorted(names.values()) if name.lower().endswith(".apj"))
    return next((path for path in found if not path.is_dir()), None)


def logical_folder(project: Path) -> Path | None:
    """Return the folder of the logical view of the project in a folder, None if there is none.

    That is ``Logical`` beside a project file (``*.apj``).
    """
    names = names_in(project)
    if _named_as_project(project, names) is None or "logical" not in names:
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


def read_logical_view(folder: Path, names: FileNames | None = None) -> LogicalView:
    """Read the logical view whose root package lies in ``folder``.

    Args:
        folder: as above; the project file lies beside it.
        names: of the project's files, where others look them up too.
    """
    reader = _Reader(names or FileNames(folder.parent))
    view = LogicalView(reader.package(folder, ()), reader.findings)
    view.findings.extend(wrong_dependencies(view.libraries))
    return view


class _Object(NamedTuple):
    """A line of a list."""

    kind: str
    name: str
    line: int
    is_private: bool
    is_reference: bool


class _List(NamedTuple):
    """A list: what is in it, and where that lies."""

    file: Path | None
    items: tuple[tuple[_Object, Path], ...] = ()
    missing: tuple[Finding, ...] = ()
    dependencies: tuple[Dependency, ...] = ()


class _Reader:
    """Reads the lists of one project."""

    def __init__(self, names: FileNames) -> None:
        self._names = names
        self._seen: set[Path] = set()
        self.findings: list[Finding] = []

    def package(self, folder: Path, path: tuple[str, ...]) -> Package:
        made = Package(path, folder)
        for item, found in self._listed(folder, (PACKAGE_LIST,)).items:
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
        found = self._listed(folder, lists)
        files, missing = self._files(found, MAX_DEPTH)
        return SourceFolder(
            path[-1],
            path,
            folder,
            tuple(files),
            found.file,
            tuple(missing),
            found.dependencies,
        )

    def _files(self, listed: _List, depth: int) -> tuple[list[Path], list[Finding]]:
        """Return the files of a program or a library, those of packages inside it too."""
        files, missing = [], list(listed.missing)
        for item, found in listed.items:
            if item.kind == "File":
                files.append(found)
            elif item.kind == "Package" and depth:
                inside = self._files(self._listed(found, (PACKAGE_LIST,)), depth - 1)
                files += inside[0]
                missing += inside[1]
        return files, missing

    def _listed(self, folder: Path, lists: tuple[str, ...]) -> _List:
        """Return what the first of ``lists`` that is in a folder names, and where it lies."""
        names = self._names.in_folder(folder)
        name = next((names[each.lower()] for each in lists if each.lower() in names), None)
        if name is None:
            return self._broken(None, folder, 0, f"there is no {' or '.join(lists)}")
        file = folder / name
        if file.resolve() in self._seen:
            return self._broken(None, file, 0, "it is listed twice, or lists itself")
        self._seen.add(file.resolve())
        wrong: tuple[Finding, ...] = ()
        try:
            root = read_document(file)
        except DocumentError as err:
            broken = self._broken(file, file, err.line, str(err))
            if lists != (PACKAGE_LIST,) or err.root is None:
                return broken  # half of a program would be another one
            wrong, root = broken.missing, err.root
        found = [(item, self._path_of(folder, item)) for item in _objects(root)]
        missing = [_missing(file, item) for item, path in found if path is None]
        self.findings += missing
        return _List(
            file,
            tuple(_renamed(item, path) for item, path in found if path is not None),
            (*wrong, *missing),
            tuple(Dependency(e.get("ObjectName"), e.line) for e in root.all("Dependency")),
        )

    def _broken(self, file: Path | None, place: Path, line: int, message: str) -> _List:
        finding = Finding(place, line, message)
        self.findings.append(finding)
        return _List(file, missing=(finding,))

    def _path_of(self, folder: Path, item: _Object) -> Path | None:
        """Return where the object of a list in ``folder`` lies, None if it does not."""
        look = self._names.referenced if item.is_reference else self._names.below
        found = look(folder, item.name)
        is_wrong = found is not None and item.kind == "File" and found.is_dir()
        return None if is_wrong else found


def _missing(file: Path, item: _Object) -> Finding:
    message = f"{item.kind} {item.name} is listed and not there"
    return Finding(file, item.line, message, item.name)


def _renamed(item: _Object, found: Path) -> tuple[_Object, Path]:
    """Return an object and its folder; one by reference has the name of its folder."""
    if item.is_reference and item.kind != "File":
        found = found if found.is_dir() else found.parent
        item = item._replace(name=found.name)
    return item, found


def _objects(root: XmlElement) -> Iterator[_Object]:
    """Yield the lines of a list."""
    for element in root.all("Object", "File"):
        kind = "File" if element.tag == "File" else element.get("Type")
        private, reference = element.is_true("Private"), element.is_true("Reference")
        name = element.text.strip()
        if name:
            yield _Object(kind, name, element.line, private, reference)
