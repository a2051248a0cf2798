"""The scopes of declaration files: an Automation Studio project, a project of ours, any folder.

The logical view of an Automation Studio project has the scopes that its compiler gives it: a
program sees its own files, the private files of the packages around it, the files of all packages,
and the libraries. In any other tree a folder sees its own files and those of the folders around it;
a folder with the list of a library (``*.lby``), or with a ``.fun`` file and no program, is a
library there, and every folder of the tree sees it, as do the logical views that lie in the tree.
The controller libraries that plcsim has come last.
"""

from __future__ import annotations

import os
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from plcsim.cli.declaration_files import SUFFIXES, find_files, read_files
from plcsim.library.installed import dialect_of
from plcsim.project.automation_studio.logical_view import (
    LIBRARY_LISTS,
    PROGRAM_LISTS,
    is_listed,
    is_package,
    logical_folder,
    read_logical_view,
)
from plcsim.project.automation_studio.names import names_in
from st_types.resolve.scope import Scope

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from plcsim.cli.declaration_files import Reading
    from plcsim.project.automation_studio.logical_view import Package, SourceFolder
    from st_types.syntax.tree import DeclarationFile

LIBRARY = Path(__file__).parents[1] / "library"
"""Declarations of the controller libraries that plcsim has."""

NAMED_FILES = 5
"""Most files without a package that are named one by one."""


class NamedScope(NamedTuple):
    """A scope and what it is the scope of.

    Attributes:
        kind: ``library``, ``project``, ``package``, ``program``; ``folder`` below a project that
            has no such things.
        path: its name, after those of the packages or folders around it.
        scope: its declarations.
        folder: where it lies; None where it has none of its own.
        listed: what belongs to a program or a library; None where all in the folder does.
    """

    kind: str
    path: tuple[str, ...]
    scope: Scope
    folder: Path | None = None
    listed: tuple[Path, ...] | None = None


class FoundDeclarations(NamedTuple):
    """All that was read.

    Attributes:
        reading: the files, those too that are there for their names only.
        scopes: of the files that the user named, outer ones first.
        others: what those see besides: the rest of their project, and the libraries of plcsim.
        files: the files that the user named.
    """

    reading: Reading
    scopes: list[NamedScope]
    others: list[NamedScope]
    files: list[DeclarationFile]


def read_declarations(paths: Sequence[Path], *, strict: bool = False) -> FoundDeclarations:
    """Read the declarations at and below ``paths``, and what they see around them.

    Raises:
        PlcError: a path does not exist, or is a file of another kind.
    """
    trees = _trees(paths)
    reading = read_files([file for tree in trees for file in tree.files])
    for tree in trees:
        tree.tell(reading)
    libraries = library_scopes()
    scopes = list(_scopes_of(trees, reading.files, libraries, strict=strict))
    asked = [path.resolve() for path in paths]
    files = [f for f in reading.files if _is_below(Path(f.path).resolve(), asked)]
    wanted = set(map(id, files))
    named = [each for each in scopes if any(id(file) in wanted for file in each.scope.files)]
    others = [each for each in scopes if each not in named]
    others += [NamedScope("library", (scope.name,), scope) for scope in libraries]
    return FoundDeclarations(reading, named, others, files)


def _scopes_of(
    trees: Iterable[_LogicalTree | _FolderTree],
    files: Sequence[DeclarationFile],
    builtin: Sequence[Scope],
    *,
    strict: bool,
) -> Iterator[NamedScope]:
    """Yield the scopes of all trees; the libraries in plain folders are seen by the others."""
    libraries: list[Scope] = []
    for tree in sorted(trees, key=lambda tree: isinstance(tree, _LogicalTree)):
        around = [*libraries, *_without(builtin, libraries)]
        made = list(tree.scopes(files, around, strict=strict))
        if isinstance(tree, _FolderTree):
            libraries += [each.scope for each in made if each.kind == "library"]
        yield from made


def report(found: FoundDeclarations, show: Callable[[str], object]) -> int:
    """Show all findings in the files that the user named, and return the number of errors."""
    for line in (*found.reading.failures, *found.reading.notes):
        show(line)
    for file in found.files:
        for record in sorted(file.diagnostics.records, key=lambda r: (r.line, r.column)):
            show(record.render())
        if file.diagnostics.omitted:
            show(f"{file.path}: {file.diagnostics.omitted} more findings are not shown")
    errors = sum(file.diagnostics.error_count for file in found.files)
    return len(found.reading.failures) + errors


def _is_below(path: Path, folders: Iterable[Path]) -> bool:
    return any(folder == path or folder in path.parents for folder in folders)


def library_scopes() -> list[Scope]:
    """Return the controller libraries that plcsim has; each sees the others."""
    libraries: list[Scope] = []
    for folder, files in _by_folder(read_files(find_files([LIBRARY])).files).items():
        libraries.append(Scope(folder.name, files, libraries, dialect=dialect_of(folder)))
    return libraries


def _by_folder(files: Iterable[DeclarationFile]) -> dict[Path, list[DeclarationFile]]:
    folders: dict[Path, list[DeclarationFile]] = {}
    for file in files:
        folders.setdefault(Path(file.path).resolve().parent, []).append(file)
    return folders


# Which trees the paths belong to


def _trees(paths: Sequence[Path]) -> list[_LogicalTree | _FolderTree]:
    """Return the trees that hold ``paths``, each once."""
    find_files(path for path in paths if not path.is_dir())  # refuses what is no such file
    trees: dict[Path, _LogicalTree | _FolderTree] = {}
    for path in paths:
        for tree in _trees_of(path):
            trees.setdefault(tree.folder.resolve(), tree)
    found = list(trees.values())
    listed = {f.resolve() for t in found if isinstance(t, _LogicalTree) for f in t.files}
    for tree in found:
        if isinstance(tree, _FolderTree):
            tree.files = [file for file in tree.files if file.resolve() not in listed]
    return found


def _trees_of(path: Path) -> Iterator[_LogicalTree | _FolderTree]:
    start = path if path.is_dir() else path.parent
    around = _logical_around(start)
    if around is not None:
        yield _LogicalTree(around, path)
        return
    root = _project_around(start) or path
    files = [] if root.is_dir() else [root]
    for place, folders, names in os.walk(root):
        here = Path(place)
        logical = _logical_at(here, names)
        if logical is not None:
            folders.clear()
            yield _LogicalTree(logical.resolve(), path)
        else:
            folders[:] = sorted(name for name in folders if not name.startswith("."))
            files += [here / name for name in sorted(names) if _is_declaration(name)]
    if files:
        yield _FolderTree(root, [_as_named(file, path) for file in files])


def _is_declaration(name: str | Path) -> bool:
    return Path(name).suffix.lower() in SUFFIXES


def _logical_at(folder: Path, names: Iterable[str]) -> Path | None:
    """Return the root package if a logical view begins in ``folder``, which holds ``names``."""
    kinds = {Path(name).suffix.lower() for name in names}
    if ".apj" in kinds and (logical := logical_folder(folder)) is not None:
        return logical
    return folder if ".pkg" in kinds and is_package(folder) else None


def _logical_around(folder: Path) -> Path | None:
    """Return the root package of the logical view that ``folder`` is or lies in, else None."""
    start = folder.resolve()
    for project in (start, *start.parents):
        logical = logical_folder(project)
        if logical is not None and (project == start or _is_below(start, [logical])):
            return logical
    if not is_listed(start):
        return None
    while is_listed(start.parent):
        start = start.parent
    return start if is_package(start) else None


def is_in_a_project(folder: Path) -> bool:
    """Return whether a folder is or lies in a project of ours, or in a logical view."""
    return _project_around(folder) is not None or _logical_around(folder) is not None


def _project_around(folder: Path) -> Path | None:
    """Return the folder with a ``plc.toml`` that ``folder`` is or lies in, else None."""
    start = folder.resolve()
    return next((p for p in (start, *start.parents) if (p / "plc.toml").is_file()), None)


def _as_named(file: Path, named: Path) -> Path:
    """Return a path as the user would have named it who named ``named``."""
    return file if named.is_absolute() else Path(os.path.relpath(file))


class _LogicalTree:
    """The logical view of an Automation Studio project.

    Args:
        folder: of its root package, absolute.
        named: what the user named; paths are shown likewise.
    """

    def __init__(self, folder: Path, named: Path) -> None:
        self.folder = folder
        self._named = named
        self._view = read_logical_view(folder)
        listed = chain.from_iterable(_files_of(self._view.root))
        self.files = [self._shown(file) for file in listed if _is_declaration(file)]

    def _shown(self, file: Path) -> Path:
        return _as_named(file, self._named)

    def tell(self, reading: Reading) -> None:
        """Add what is wrong in the lists, and what no list names."""
        for finding in self._view.findings:
            kind = "warning" if finding.missing else "error"
            line = f"{self._shown(finding.file)}: {kind}: {finding.message}"
            if not finding.missing:
                reading.failures.append(line)
            elif _is_declaration(finding.missing) or not Path(finding.missing).suffix:
                reading.notes.append(line)
        known = {file.resolve() for file in self.files}
        found = [file for file in find_files([self.folder]) if file.resolve() not in known]
        others = [self._shown(file) for file in found]
        for file in others[:NAMED_FILES]:
            reading.notes.append(f"{file}: warning: no package lists it, so it is not read")
        if len(others) > NAMED_FILES:
            text = f"{len(others) - NAMED_FILES} more files that are not listed"
            reading.notes.append(f"{self._shown(self.folder)}: warning: {text}")

    def scopes(
        self, files: Iterable[DeclarationFile], builtin: Sequence[Scope], *, strict: bool
    ) -> Iterator[NamedScope]:
        """Yield libraries, the project, then packages with private files and programs."""
        by_path = {Path(file.path).resolve(): file for file in files}

        def parsed(paths: Iterable[Path]) -> list[DeclarationFile]:
            found = (by_path.get(path.resolve()) for path in paths)
            return [file for file in found if file is not None]

        around: list[Scope] = []
        libraries = [
            NamedScope(
                "library",
                each.path,
                Scope(each.name, parsed(each.files), around, strict=strict),
                each.folder,
                each.files,
            )
            for each in _libraries_of(self._view.root)
        ]
        around += [each.scope for each in libraries]
        around += _without(builtin, around)
        public = chain.from_iterable(p.files for p in _packages_of(self._view.root))
        name = self.folder.parent.name
        project = Scope(name, parsed(public), tuple(around), strict=strict)
        around.append(project)
        yield from libraries
        yield NamedScope("project", (name,), project)
        yield from _inner_scopes(self._view.root, project, parsed)


def _without(builtin: Iterable[Scope], others: Iterable[Scope]) -> list[Scope]:
    """Return the libraries of plcsim that a project does not bring along."""
    names = {scope.name.lower() for scope in others}
    return [scope for scope in builtin if scope.name.lower() not in names]


def _inner_scopes(
    package: Package, outer: Scope, parsed: Callable[[Iterable[Path]], list[DeclarationFile]]
) -> Iterator[NamedScope]:
    if package.private_files:
        name = package.path[-1] if package.path else package.folder.name
        outer = Scope(name, parsed(package.private_files), [outer], strict=outer.strict)
        yield NamedScope("package", package.path, outer)
    for program in package.programs:
        scope = Scope(program.name, parsed(program.files), [outer], strict=outer.strict)
        yield NamedScope("program", program.path, scope, program.folder, program.files)
    for inner in package.packages:
        yield from _inner_scopes(inner, outer, parsed)


def _packages_of(package: Package) -> Iterator[Package]:
    yield package
    for inner in package.packages:
        yield from _packages_of(inner)


def _libraries_of(root: Package) -> Iterator[SourceFolder]:
    return chain.from_iterable(package.libraries for package in _packages_of(root))


def _files_of(root: Package) -> Iterator[Iterable[Path]]:
    """Yield the files of all packages, programs and libraries, in the order they are listed."""
    for package in _packages_of(root):
        yield package.files
        yield package.private_files
        for each in (*package.programs, *package.libraries):
            yield each.files


class _FolderTree:
    """Any other folder, or a file."""

    def __init__(self, root: Path, files: list[Path]) -> None:
        self.folder = root
        self.files = files
        self._top = (root if root.is_dir() else root.parent).resolve()

    def tell(self, reading: Reading) -> None:
        """Add nothing: what lies there is read."""

    def scopes(
        self, files: Iterable[DeclarationFile], builtin: Sequence[Scope], *, strict: bool
    ) -> Iterator[NamedScope]:
        """Yield a scope for each folder with declarations, libraries first, outer ones first."""
        known = set(map(str, self.files))
        folders = sorted(_by_folder(file for file in files if file.path in known).items())
        scopes: dict[Path, NamedScope] = {}
        around: list[list[Scope]] = []
        for folder, inside in folders:
            kind = "project" if folder == self._top else "folder"
            kind = "library" if is_library(folder) else kind
            around.append([scopes[parent].scope for parent in folder.parents if parent in scopes])
            path = folder.relative_to(self._top).parts or (self._top.name,)
            scope = Scope(path[-1], inside, around[-1], strict=strict)
            scopes[folder] = NamedScope(kind, path, scope, folder)
        libraries = [each.scope for each in scopes.values() if each.kind == "library"]
        last = [*libraries, *_without(builtin, libraries)]
        for outer in around:
            outer.extend(last)
        yield from sorted(scopes.values(), key=lambda each: each.kind != "library")


def is_library(folder: Path) -> bool:
    """Return whether a folder of no logical view is a library."""
    names = names_in(folder)
    if any(name.lower() in names for name in LIBRARY_LISTS):
        return True
    is_program = any(name.lower() in names for name in PROGRAM_LISTS)
    return not is_program and any(name.endswith(".fun") for name in names)
