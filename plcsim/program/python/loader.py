"""Loads programs written in Python from the folders of a project.

A program's folder holds either one file with a subclass of `plcsim.core.task.Program`, or that
class in one file (``main.py`` or ``variables.py``) and its units as functions ``init``, ``cyclic``,
``exit`` in files of those names. The project's folder is a package, so programs may share modules:
``from ..shared import X``.
"""

from __future__ import annotations

import importlib
import itertools
import os
import sys
from types import ModuleType
from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError
from plcsim.core.task import Program, Unit
from plcsim.program.python.check import check_program
from plcsim.program.python.place import describe, place_of

if TYPE_CHECKING:
    from pathlib import Path

_counter = itertools.count(1)

_CLASS_FILES = ("variables", "main")


class ProgramLoader:
    """Loads the programs of one project; two projects in one process do not mix.

    Args:
        folder: where plc.toml lies.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()
        self._package = f"plcsim_project_{next(_counter)}"
        self._classes: dict[str, type[Program]] = {}
        self._add_package(self._package, self._folder)

    def _add_package(self, name: str, folder: Path) -> None:
        package = ModuleType(name)
        package.__path__ = [str(folder)]
        sys.modules[name] = package

    def load(self, source: str) -> type[Program]:
        """Return the program class in folder ``source``, loaded once.

        Raises:
            ConfigurationError: there is no such folder, it cannot be loaded, or it does not hold
                exactly one program.
        """
        if source not in self._classes:
            try:
                self._classes[source] = self._load(source)
            except OSError as err:
                raise ConfigurationError(f"{err.filename}: {err.strerror}") from None
        return self._classes[source]

    def _load(self, source: str) -> type[Program]:
        folder = self._folder / source
        if not os.path.isdir(folder):  # noqa: PTH112  # no error for what can be no path
            raise ConfigurationError(f"{folder}: no such program folder{self._known()}")
        package = ".".join((self._package, *folder.relative_to(self._folder).parts))
        self._add_package(package, folder)
        stems = [name for name in _CLASS_FILES if (folder / f"{name}.py").is_file()]
        if not stems:
            raise self._nothing_in(folder)
        modules = [self._import(folder, f"{package}.{stem}") for stem in stems]
        program = self._program_in(folder, modules)
        units = self._units_in(folder, package)
        whole = type(program.__name__, (program,), units) if units else program
        check_program(whole, folder)
        return whole

    def _known(self) -> str:
        names = sorted(p.parent.name for s in _CLASS_FILES for p in self._folder.glob(f"*/{s}.py"))
        return f"; there are {', '.join(names)}" if names else ""

    def _nothing_in(self, folder: Path) -> ConfigurationError:
        if any(folder.glob("*.st")):
            return ConfigurationError(
                f"{folder}: this version of plcsim runs programs in Python; "
                "Structured Text is not there yet"
            )
        return ConfigurationError(f"{folder}: holds neither main.py nor variables.py")

    def _import(self, folder: Path, name: str) -> ModuleType:
        try:
            return importlib.import_module(name)
        except (Exception, SystemExit) as error:
            place = place_of(error) or str(folder)
            text = describe(error)
            if isinstance(error, SyntaxError):  # the place is told already
                text = f"{type(error).__name__}: {error.msg}"
            text = text.replace(self._package, self._folder.name)
            raise ConfigurationError(f"{place}: {text}") from error

    def _program_in(self, folder: Path, modules: list[ModuleType]) -> type[Program]:
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
                f"{folder}: one subclass of plcsim.Program is expected, found {names}"
            )
        return programs[0]

    def _units_in(self, folder: Path, package: str) -> dict[str, object]:
        units: dict[str, object] = {}
        for unit in Unit:
            stem = unit.value.lower()
            if (folder / f"{stem}.py").is_file():
                function = getattr(self._import(folder, f"{package}.{stem}"), stem, None)
                if not callable(function):
                    raise ConfigurationError(f"{folder / stem}.py: has no function {stem}")
                units[stem] = function
        return units
