"""Programs written in Python.

A program's folder holds either one file with a subclass of `plcsim.Program`, or that class in one
file (``main.py`` or ``variables.py``) and its units as functions ``init``, ``cyclic``, ``exit`` in
files of those names. The project's folder is a package, so programs may share modules:
``from ..shared import X``.
"""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import TYPE_CHECKING, Final, NoReturn

from plcsim.core.errors import ConfigurationError, CycleTimeViolation
from plcsim.core.tag import Tag
from plcsim.core.task import Task, Unit
from plcsim.program.fault import describe, fault_of, location_of
from plcsim.program.python.check import check_program
from plcsim.program.python.program import Program
from st_types.types.views import address_of, type_of

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.program.language import ProgramSource, Site

_CLASS_FILES = ("variables", "main")


class PythonCode:
    """A program class; see `plcsim.program.language.ProgramCode`."""

    def __init__(self, program: type[Program]) -> None:
        self.program = program

    def task(self, name: str, site: Site) -> Task:
        """Return a task that runs the methods of a new view of the class."""
        view = site.memory.new(self.program, site.context)
        units = {Unit.INIT: view.init, Unit.CYCLIC: view.cyclic, Unit.EXIT: view.exit}
        variables = Tag(name, type_of(view), address_of(view))
        return Task(name, variables, units, fault_of=fault_of, interrupt=_interrupt)


def _interrupt(reason: str) -> NoReturn:
    """End the program from a signal handler, which Python runs between two of its bytecodes."""
    raise CycleTimeViolation(reason)


class Python:
    """The language; see `plcsim.program.language.Language`."""

    name: Final = "Python"

    def units(self, folder: Path) -> list[Path]:
        """Return the files with the program's class."""
        files = [folder / f"{name}.py" for name in _CLASS_FILES]
        return [file for file in files if file.is_file()]

    def load(self, source: ProgramSource) -> PythonCode:
        """Import the files of a program."""
        return PythonCode(_Loader(source).load())


PYTHON: Final = Python()


class _Loader:
    """Loads one program."""

    def __init__(self, source: ProgramSource) -> None:
        self._source = source
        self._folder = source.folder
        parts = source.folder.relative_to(source.project).parts
        self._package = ".".join((source.package, *parts))
        _add_package(source.package, source.project)
        _add_package(self._package, source.folder)

    def load(self) -> type[Program]:
        modules = [self._import(file.stem) for file in self._source.files]
        program = self._program_in(modules)
        units = self._units()
        whole = type(program.__name__, (program,), units) if units else program
        check_program(whole, self._folder)
        return whole

    def _import(self, stem: str) -> ModuleType:
        try:
            return importlib.import_module(f"{self._package}.{stem}")
        except (Exception, SystemExit) as error:
            location = location_of(error) or str(self._folder)
            text = describe(error)
            if isinstance(error, SyntaxError):  # the location is told already
                text = f"{type(error).__name__}: {error.msg}"
            text = text.replace(self._source.package, self._source.project.name)
            raise ConfigurationError(f"{location}: {text}") from error

    def _program_in(self, modules: list[ModuleType]) -> type[Program]:
        found = {
            value
            for module in modules
            for value in vars(module).values()
            if isinstance(value, type)
            and issubclass(value, Program)
            and value.__module__ in {m.__name__ for m in modules}
        }
        bases = {base for value in found for base in value.__mro__[1:]}
        programs = [value for value in found if value not in bases]
        if len(programs) != 1:
            names = ", ".join(sorted(p.__name__ for p in programs)) or "none"
            raise ConfigurationError(
                f"{self._folder}: one subclass of plcsim.Program is expected, found {names}"
            )
        return programs[0]

    def _units(self) -> dict[str, object]:
        units: dict[str, object] = {}
        for unit in Unit:
            stem = unit.value.lower()
            if (self._folder / f"{stem}.py").is_file():
                function = getattr(self._import(stem), stem, None)
                if not callable(function):
                    raise ConfigurationError(f"{self._folder / stem}.py: has no function {stem}")
                units[stem] = function
        return units


def _add_package(name: str, folder: Path) -> None:
    if name not in sys.modules:
        package = ModuleType(name)
        package.__path__ = [str(folder)]
        sys.modules[name] = package
