"""A controller library: a folder with declarations, and the bodies of what they declare.

The interface of a library stands in its ``.fun``, ``.typ`` and ``.var`` files and nowhere else;
views in Python, names in Structured Text and headers for C follow from them.
"""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.errors import ConfigurationError
from st_types.errors import DiagnosticSeverity, SourceError
from st_types.resolve.dialect import AUTOMATION_STUDIO
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source
from st_types.syntax.tree import TypeBlock, VariableBlock

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence
    from types import ModuleType

    from st_types.resolve.dialect import Dialect
    from st_types.resolve.index import NameSpace
    from st_types.syntax.tree import DeclarationFile, Item

SUFFIXES_OF_C: Final = (".c", ".cpp", ".cc", ".cxx")
"""Of files in C and C++ that are compiled."""

NESTED: Final = (".st", *SUFFIXES_OF_C)
"""Suffixes of the files that belong to a program or a library from folders inside its own."""

DEEPEST: Final = 8
"""Folders one in another that hold one program."""

DECLARATIONS: Final = (".typ", ".var", ".fun")
"""Suffixes of files with declarations, in small letters."""


_SPACES: Final[tuple[NameSpace, ...]] = ("types", "functions", "variables")


class CBuild(NamedTuple):
    """How C is compiled, beyond what holds for all of it.

    Attributes:
        gcc_version: that the sources shall find, such as "6.3.0"; "" for that of the compiler.
        include_folders: that they find headers in.
        options: for the compiler, such as "-D SIMULATION".
        heap_size: in bytes, of programs and libraries that do not say how many they need.
    """

    gcc_version: str = ""
    include_folders: tuple[Path, ...] = ()
    options: str = ""
    heap_size: int = 1 << 20


PLAIN: Final = CBuild()


class Library:
    """One library.

    Args:
        folder: where it lies.
        package: name under which Python finds the folder, for bodies in Python.
        outer: the scopes of the libraries that it sees.
        name: of the library; by default that of its .fun file where it has one only, else that of
            its folder.
        files: that belong to it; by default those in its folder.
        dependencies: names of libraries that it needs.
        beside: the library of plcsim with the same name; what that one declares is left out here.
        strict: a type that nobody declares is an error; otherwise what has one is left out, for
            libraries whose own libraries are not there.

    Attributes:
        name: as above.
        folder: likewise.
        package: likewise.
        files: likewise: declarations, sources, and whatever else there is.
        dependencies: likewise.
        beside: likewise.
        c_build: how its sources in C are compiled.
        dialect: of its declarations and of its bodies in Structured Text.
        is_strict: as above.

    Raises:
        ConfigurationError: the folder cannot be read.
    """

    def __init__(
        self,
        folder: Path,
        package: str,
        outer: Sequence[Scope] = (),
        *,
        name: str = "",
        files: Sequence[Path] | None = None,
        dependencies: Sequence[str] = (),
        beside: Library | None = None,
        strict: bool = False,
    ) -> None:
        self.dialect: Dialect = AUTOMATION_STUDIO
        self.folder = folder
        self.is_strict = strict
        self.package = package
        self.files = tuple(sources_in(folder) if files is None else files)
        self.dependencies = tuple(dependencies)
        self.c_build = PLAIN
        self.beside = beside
        self._outer = outer
        interfaces = [file.stem for file in self.files if file.suffix.lower() == ".fun"]
        self.name = name or (interfaces[0] if len(interfaces) == 1 else folder.name)

    def __repr__(self) -> str:
        return f"Library({self.name})"

    @cached_property
    def scope(self) -> Scope:
        """What the library declares.

        Raises:
            ConfigurationError: a file cannot be read.
        """
        files, name = read_declarations(declarations_of(self.files)), self.name
        if self.beside is not None:
            declared = self.beside.scope.index
            known = {each for space in _SPACES for each in declared.names(space)}
            files, name = [_without(file, known) for file in files], f"{name}_more"
        return Scope(name, files, self._outer, dialect=self.dialect, strict=self.is_strict)

    @property
    def module(self) -> ModuleType:
        """The Python package of the folder, imported."""
        return sys.modules[self.package]


def files_in(folder: Path) -> list[Path]:
    """Return the files that lie in a folder itself, in order of their names.

    Raises:
        ConfigurationError: the folder cannot be read.
    """
    try:
        return sorted(file for file in folder.iterdir() if file.is_file())
    except OSError as err:
        raise ConfigurationError(f"{folder}: cannot be read: {err.strerror}") from None


def sources_in(folder: Path) -> list[Path]:
    """Return the files of a library's or a program's folder, and the sources in folders inside.

    Such folders hold actions, as packages in a program of Automation Studio do.

    Raises:
        ConfigurationError: the folder cannot be read.
    """
    return [*files_in(folder), *_nested(os.fspath(folder), DEEPEST)]


def _nested(folder: str, depth: int) -> Iterator[Path]:
    """Iterate over the sources in the folders inside a folder."""
    with os.scandir(folder) as found:
        names = sorted(e.name for e in found if e.name[0] not in "._" and _is_folder(e))
    for name in names if depth else ():
        inside = Path(folder, name)
        yield from (file for file in files_in(inside) if file.suffix.lower() in NESTED)
        yield from _nested(os.fspath(inside), depth - 1)


def _is_folder(entry: os.DirEntry[str]) -> bool:
    return entry.is_dir(follow_symlinks=False) and os.access(entry.path, os.R_OK | os.X_OK)


def declarations_of(files: Iterable[Path]) -> list[Path]:
    """Return those of some files that hold declarations."""
    return [file for file in files if file.suffix.lower() in DECLARATIONS]


def read_declarations(files: Iterable[Path]) -> list[DeclarationFile]:
    """Parse files; what is wrong in their text is in their ``diagnostics``.

    Raises:
        ConfigurationError: a file cannot be read.
    """
    try:
        return [parse_declarations(Source.read(file)) for file in files]
    except (OSError, SourceError) as err:
        raise ConfigurationError(str(err)) from None


def _without(file: DeclarationFile, names: Collection[str]) -> DeclarationFile:
    """Return a file without the declarations of some names."""
    items: list[Item] = []
    for item in file.items:
        if isinstance(item, TypeBlock | VariableBlock):
            kept = [each for each in item.declarations if each.name not in names]
            items.append(replace(item, declarations=kept))
        elif item.name not in names:
            items.append(item)
    return replace(file, items=items)


def check_scope(scope: Scope) -> list[str]:
    """Resolve everything that a scope declares; return its warnings.

    Raises:
        ConfigurationError: there are errors; each is told with file, line, column and caret.
    """
    scope.check()
    records = [record for file in scope.files for record in file.diagnostics.records]
    errors = [record.render() for record in records if record.severity is DiagnosticSeverity.ERROR]
    if errors:
        raise ConfigurationError(*errors)
    return [record.render() for record in records]
