"""The modules of a project: its folder is a package, and so are its libraries.

A project's package has a name of its own, so that two projects in one process do not mix, and
programs and libraries may share modules: ``from ..shared import X``, ``from ..my_lib import Ramp``.
"""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.library import face
from plcsim.library.catalogue import SETTINGS
from plcsim.program.fault import describe, location_of

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from plcsim.library.library import Library
    from st_types.resolve.scope import Scope

_NO_BODIES: Final = ("__init__", face.INTERFACE, SETTINGS)
"""Modules of a library that hold other things."""


def add_package(name: str, folder: Path, scope: Callable[[], Scope]) -> None:
    """Let a folder be found as a package, unless it is one already.

    Args:
        name: of the package.
        folder: of the project, or of a program.
        scope: gives what is declared there; types and constants are names of the package.
    """
    if name not in sys.modules:
        sys.modules[name] = ScopePackage(name, folder, scope)


class ScopePackage(ModuleType):
    """The package of a project or a program: its modules, and what is declared in its folder."""

    def __init__(self, name: str, folder: Path, scope: Callable[[], Scope]) -> None:
        super().__init__(name)
        self.__path__ = [str(folder)]
        self._scope = scope

    def __getattr__(self, name: str) -> object:
        if name.startswith("__") or f"{self.__name__}.{name}" in sys.modules:
            raise AttributeError(name)
        return face.face_of(self._scope(), name, self.__name__)


def add_library(library: Library) -> None:
    """Let the folder of a project's library be found as a package, with its face."""
    face.register(library)
    sys.modules[library.package] = LibraryPackage(library)
    _add_interface(library)


def _add_interface(library: Library) -> None:
    """Let the face of a library be found that has no file with it."""
    if not (library.folder / f"{face.INTERFACE}.py").is_file():
        name = f"{library.package}.{face.INTERFACE}"
        sys.modules.setdefault(name, face.InterfaceModule(library))


def unload(package: str) -> None:
    """Forget the modules of a project and its libraries."""
    face.forget(package)
    for name in [*sys.modules]:
        if name == package or name.startswith(f"{package}."):
            del sys.modules[name]


def load_module(name: str, folder: Path, project: str = "") -> ModuleType:
    """Import a module of a project.

    Args:
        name: of the module.
        folder: named in an error that has no line.
        project: package of the project, for errors to speak of its folder instead.

    Raises:
        ConfigurationError: it cannot be imported; file and line are named.
    """
    try:
        return importlib.import_module(name)
    except ConfigurationError:
        raise
    except (Exception, SystemExit) as error:
        location = location_of(error) or str(folder)
        text = describe(error)
        if isinstance(error, SyntaxError):  # the location is told already
            text = f"{type(error).__name__}: {error.msg}"
        if project:
            text = text.replace(project, sys.modules[project].__path__[0].rpartition("/")[2])
        raise ConfigurationError(f"{location}: {text}") from error


class LibraryPackage(ModuleType):
    """The package of a project's library: what its modules define, and its face for the rest.

    Nothing is imported before a name is asked for.
    """

    def __init__(self, library: Library) -> None:
        super().__init__(library.package)
        self.__path__ = [str(library.folder)]
        self._library = library
        self._is_loaded = False

    def __getattr__(self, name: str) -> object:
        library = self._library
        module = sys.modules.get(f"{library.package}.{name}")
        if module is not None:
            return module
        if name.startswith("__") or (library.folder / f"{name}.py").is_file():
            raise AttributeError(name)  # the import system looks for a module then
        if not self._is_loaded:
            self._is_loaded = True
            for module in body_modules(library):
                vars(self).update(own_names(module))
        if name not in vars(self):
            setattr(self, name, face.face_of(library.scope, name, library.package))
        return vars(self)[name]


def own_names(module: ModuleType) -> dict[str, object]:
    """Return what a module defines itself under names that are not private."""
    return {
        name: value
        for name, value in vars(module).items()
        if not name.startswith("_") and getattr(value, "__module__", "") == module.__name__
    }


def body_modules(library: Library) -> list[ModuleType]:
    """Return the modules in a library's folder that may hold bodies, imported.

    Raises:
        ConfigurationError: some cannot be imported; all findings are told, with file and line.
    """
    _add_interface(library)  # of an installed one
    files = sorted(library.folder.glob("*.py"))
    stems = [file.stem for file in files if file.stem not in _NO_BODIES]
    findings = Findings()
    modules = []
    for stem in stems:
        with findings.gathered():
            modules.append(load_module(f"{library.package}.{stem}", library.folder))
    findings.check()
    return modules
