"""A controller library: a folder with declarations, and the bodies of what they declare.

The interface of a library stands in its ``.fun``, ``.typ`` and ``.var`` files and nowhere else;
views in Python, names in Structured Text and headers for C follow from them.
"""

from __future__ import annotations

import sys
from functools import cached_property
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError
from st_types.errors import Severity, SourceError
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path
    from types import ModuleType

    from st_types.syntax.tree import DeclarationFile

DECLARATIONS: Final = (".typ", ".var", ".fun")
"""Suffixes of files with declarations, in small letters."""


class Library:
    """One library.

    Args:
        folder: where it lies.
        package: name under which Python finds the folder, for bodies in Python.
        outer: the scopes of the libraries that it sees.

    Attributes:
        name: of its .fun file where it has one only, else of its folder.
        folder: as above.
        package: likewise.
    """

    def __init__(self, folder: Path, package: str, outer: Sequence[Scope] = ()) -> None:
        self.folder = folder
        self.package = package
        self._outer = outer
        interfaces = [file.stem for file in declaration_files(folder) if file.suffix == ".fun"]
        self.name = interfaces[0] if len(interfaces) == 1 else folder.name

    def __repr__(self) -> str:
        return f"Library({self.name})"

    @cached_property
    def scope(self) -> Scope:
        """What the library declares.

        Raises:
            ConfigurationError: a file cannot be read.
        """
        return Scope(self.name, read_declarations(declaration_files(self.folder)), self._outer)

    @property
    def module(self) -> ModuleType:
        """The Python package of the folder, imported."""
        return sys.modules[self.package]


def declaration_files(folder: Path) -> list[Path]:
    """Return the files with declarations that lie in a folder itself, in order of their names.

    Raises:
        ConfigurationError: the folder cannot be read.
    """
    try:
        return sorted(file for file in folder.iterdir() if file.suffix.lower() in DECLARATIONS)
    except OSError as err:
        raise ConfigurationError(f"{folder}: cannot be read: {err.strerror}") from None


def read_declarations(files: Iterable[Path]) -> list[DeclarationFile]:
    """Parse files; what is wrong in their text is in their ``diagnostics``.

    Raises:
        ConfigurationError: a file cannot be read.
    """
    try:
        return [parse_declarations(Source.read(file)) for file in files]
    except (OSError, SourceError) as err:
        raise ConfigurationError(str(err)) from None


def check_scope(scope: Scope) -> list[str]:
    """Resolve everything that a scope declares; return its warnings.

    Raises:
        ConfigurationError: there are errors; each is told with file, line, column and caret.
    """
    scope.check()
    records = [record for file in scope.files for record in file.diagnostics.records]
    errors = [record.render() for record in records if record.severity is Severity.ERROR]
    if errors:
        raise ConfigurationError(*errors)
    return [record.render() for record in records]
