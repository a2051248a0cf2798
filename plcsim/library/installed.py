"""The libraries that come with plcsim, and those of installed packages.

A package brings a library by an entry point of the group ``plcsim.libraries``: its value is the
Python package that is the library's folder.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Final, overload

from plcsim.core.errors import ConfigurationError
from plcsim.library.library import Library, declarations_of, files_in
from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from st_types.resolve.dialect import Dialect
    from st_types.resolve.scope import Scope

GROUP: Final = "plcsim.libraries"

_OWN: Final = Path(__file__).parent

_OF_THE_NORM: Final = (_OWN / "iec").resolve()
"""The library that is no controller's: it has types that Automation Studio does not know."""


class Scopes(Sequence["Scope"]):
    """The scopes of libraries, which are read when a name is looked up in them."""

    def __init__(self, libraries: Sequence[Library]) -> None:
        self._libraries = libraries

    @overload
    def __getitem__(self, index: int) -> Scope: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Scope]: ...
    def __getitem__(self, index: int | slice) -> Scope | Sequence[Scope]:
        if isinstance(index, slice):
            return [library.scope for library in self._libraries[index]]
        return self._libraries[index].scope

    def __len__(self) -> int:
        return len(self._libraries)

    def needed_by(self, library: Library) -> list[Scope]:
        """Return the scopes of the libraries that one says it needs, and of what those need.

        All others where it does not say: it was never built by Automation Studio.
        """
        if not library.dependencies:
            return [each.scope for each in self._libraries if each is not library]
        waiting, names = [library], {library.name.upper()}
        while waiting:
            named = {name.upper() for name in waiting.pop().dependencies} - names
            names |= named
            waiting += [each for each in self._libraries if each.name.upper() in named]
        meant = [each for each in self._libraries if each.name.upper() in names]
        return [each.scope for each in meant if each is not library]

    def by_dependency(self) -> list[Scope]:
        """Return the scopes, each behind those of the libraries that it says it needs.

        What comes with plcsim comes first, then what comes without source.
        """
        by_name: dict[str, list[Library]] = {}
        for library in self._libraries:
            by_name.setdefault(library.name.upper(), []).append(library)
        found: dict[Library, None] = {}

        def add(library: Library, around: tuple[Library, ...]) -> None:
            if library in found or library in around:
                return
            for name in library.dependencies:
                for needed in by_name.get(name.upper(), ()):
                    add(needed, (*around, library))
            found[library] = None

        for library in sorted(self._libraries, key=_rank):
            add(library, ())
        return [library.scope for library in found]


def _rank(library: Library) -> tuple[bool, bool]:
    return library.is_strict, library.beside is not None or bool(library.dependencies)


@cache
def installed() -> Mapping[str, Library]:
    """Return the installed libraries by their Python package; they see one another.

    Raises:
        ConfigurationError: a package names a folder that is not there.
    """
    libraries: list[Library] = []
    scopes = Scopes(libraries)
    libraries += (
        Library(folder, package, scopes) for package, folder in (*_own(), *_of_packages())
    )
    for library in libraries:
        library.dialect = dialect_of(library.folder)
    return {library.package: library for library in libraries}


def dialect_of(folder: Path) -> Dialect:
    """Return the dialect of the library in a folder."""
    return IEC if folder.resolve() == _OF_THE_NORM else AUTOMATION_STUDIO


def _own() -> Iterator[tuple[str, Path]]:
    for folder in sorted(_OWN.iterdir()):
        if folder.is_dir() and declarations_of(files_in(folder)):
            yield f"plcsim.library.{folder.name}", folder


def _of_packages() -> Iterator[tuple[str, Path]]:
    for entry in entry_points(group=GROUP):
        try:
            spec = find_spec(entry.value)
        except ImportError as err:
            raise ConfigurationError(f"entry point {GROUP}: {entry.name}: {err}") from None
        if spec is None or not spec.submodule_search_locations:
            raise ConfigurationError(
                f"entry point {GROUP}: {entry.name}: there is no package {entry.value}"
            )
        yield entry.value, Path(spec.submodule_search_locations[0])
