"""The declarations of a project: types, global variables, libraries, the variables of its programs.

::

    my_plc/
      plc.toml
      Global.typ Global.var       any .typ and .var file here: what all programs see
      conveyor/                   a program
        Variables.var Types.typ   any .typ, .var and .fun file here: its own
      my_lib/                     a folder with a .fun file that is no program: a library

A name means what is declared nearest: in the program, in the folders between it and the project, in
the project, in the libraries. Among these the project's own come first, then those that plc.toml
names, then the installed ones. Local hides global.
"""

from __future__ import annotations

import contextlib
import os
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.library.catalogue import Catalogue
from plcsim.library.installed import Scopes, installed
from plcsim.library.library import Library, check_scope, declaration_files, read_declarations
from st_types.resolve.scope import Scope

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

    from plcsim.library.executable import BodyLanguage
    from st_types.resolve.declared import Variable
    from st_types.syntax.tree import DeclarationFile

DEEPEST: Final = 4
"""Folders below the project's in which libraries are looked for."""

_NOT_LOOKED_INTO: Final = frozenset(["tests", "Temp", "Binaries"])
"""Folders of a project that hold no libraries; neither do those that begin with "." or "_"."""


class Declarations:
    """What a project declares.

    Args:
        folder: of the project.
        package: name under which Python finds it.
        programs: folders of its programs.
        libraries: folders of libraries outside it.
        languages: that bodies of libraries may be written in.

    Attributes:
        folder: of the project.
        package: name under which Python finds it.
        own_libraries: those of the project, and those that plc.toml names.
        catalogue: all libraries that its programs see.

    Raises:
        ConfigurationError: two libraries have one name.
    """

    def __init__(
        self,
        folder: Path,
        package: str,
        programs: Collection[Path] = (),
        libraries: Sequence[Path] = (),
        languages: Sequence[BodyLanguage] = (),
    ) -> None:
        self.folder = folder
        self.package = package
        self._scopes: dict[Path, Scope] = {}
        around: list[Library] = []
        scopes = Scopes(around)
        inside = library_folders(folder, programs)
        outside = [
            path for path in dict.fromkeys(p.resolve() for p in libraries) if path not in inside
        ]
        own = [
            Library(path, ".".join((package, *path.relative_to(folder).parts)), scopes)
            for path in inside
        ]
        own += [Library(path, f"{package}.{path.name}", scopes) for path in outside]
        _check_names(own)
        hidden = {library.name.upper() for library in own}
        others = [each for each in installed().values() if each.name.upper() not in hidden]
        around += [*own, *others]
        self.own_libraries = tuple(own)
        self.catalogue = Catalogue(around, languages)

    @cached_property
    def scope(self) -> Scope:
        """What the files in the project's own folder declare.

        Raises:
            ConfigurationError: a file cannot be read.
        """
        files = read_declarations(declaration_files(self.folder))
        return Scope(self.folder.name, files, self.catalogue.scopes, strict=True)

    def scope_of(self, folder: Path, more: Iterable[DeclarationFile] = ()) -> Scope:
        """Return what a program sees: its own declarations, and around them all others.

        Args:
            folder: of the program, or one between it and the project.
            more: what the files with its units declare; told at the first call.

        Raises:
            ConfigurationError: a file cannot be read.
        """
        if folder == self.folder:
            return self.scope
        if folder not in self._scopes:
            outer = self.scope_of(folder.parent)
            files = [*read_declarations(declaration_files(folder)), *more]
            self._scopes[folder] = Scope(folder.name, files, (outer,), strict=True)
        return self._scopes[folder]

    def check(self) -> list[str]:
        """Resolve everything that the project, its programs and its own libraries declare.

        Returns:
            warnings, each with file, line, column and caret.

        Raises:
            ConfigurationError: there are errors; all of them are told.
        """
        findings = Findings()
        warnings: list[str] = []
        own = [library.scope for library in self.own_libraries]
        for scope in (*own, self.scope, *self._scopes.values()):
            with findings.gathered():
                warnings += check_scope(scope)
        findings.check()
        return warnings

    def global_variables(self, programs: Collection[Path] = ()) -> list[Variable]:
        """Return the variables and constants that several programs see.

        They are those of the project, of the folders between it and its programs, and of its own
        libraries; constants of libraries need no memory.

        Args:
            programs: folders whose scopes are programs.

        Raises:
            ConfigurationError: two have one name.
        """
        between = [scope for folder, scope in self._scopes.items() if folder not in programs]
        found = [v for scope in (self.scope, *between) for v in scope.variables]
        for library in self.own_libraries:
            found += [v for v in library.scope.variables if not v.is_constant]
        _check_unique(found)
        return found


def _check_unique(variables: Sequence[Variable]) -> None:
    findings = Findings()
    seen: dict[str, Variable] = {}
    for variable in variables:
        other = seen.setdefault(variable.name, variable)
        if other is not variable and other.file is not variable.file:
            here, there = variable.file.location(variable.node), other.file.location(other.node)
            findings.add(
                ConfigurationError(
                    f"{here}: error: the global variable {variable.name} is declared in "
                    f"{there} already"
                )
            )
    findings.check()


def _check_names(libraries: Sequence[Library]) -> None:
    """Raise a ConfigurationError where two libraries of a project have one name."""
    seen: dict[str, Library] = {}
    for library in libraries:
        other = seen.setdefault(library.name.upper(), library)
        if other is not library:
            raise ConfigurationError(
                f"{library.folder}: library {library.name} is in {other.folder} already"
            )


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
