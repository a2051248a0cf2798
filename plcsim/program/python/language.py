"""Programs written in Python.

A program's folder holds either one file with a subclass of `plcsim.Program`, or that class in one
file (``main.py`` or ``variables.py``) and its units as functions ``init``, ``cyclic``, ``exit`` in
files of those names. The project's folder is a package, so programs may share modules:
``from ..shared import X``.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final, NoReturn

from plcsim.core.errors import ConfigurationError, CycleTimeViolation, Findings
from plcsim.core.suggestion import did_you_mean
from plcsim.core.task import Task, Unit
from plcsim.program.fault import fault_of
from plcsim.program.language import PlacedProgram
from plcsim.program.python.blocks import give_views
from plcsim.program.python.check import check_program
from plcsim.program.python.modules import add_package, load_module, own_names
from plcsim.program.python.program import Program
from plcsim.program.python.shared import ConstantAttribute, GlobalVariable
from plcsim.program.variables import DeclaredVariables, variables_of
from st_types.resolve.dialect import AUTOMATION_STUDIO
from st_types.types.derived import StructType, resolve_alias

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path
    from types import ModuleType

    from plcsim.program.language import ProgramSource
    from plcsim.program.site import Site
    from st_types.resolve.dialect import Dialect
    from st_types.syntax.tree import DeclarationFile
    from st_types.types.elementary import DataType

_CLASS_FILES = ("variables", "main")
_UNIT_FILES = {unit: unit.value.lower() for unit in Unit}


class PythonCode:
    """A program class; see `plcsim.program.language.ProgramCode`.

    Python itself warns of what it finds.

    Args:
        program: the class; its variables are declared in its body, or it has their type.
        constants: type of its constants.
    """

    warnings: Sequence[str] = ()

    def __init__(self, program: type[Program], constants: StructType[Any] | None = None) -> None:
        self.program = program
        self._variables = DeclaredVariables(
            program._plc_type, constants or StructType("CONSTANT", ())
        )

    def place(self, name: str, site: Site) -> PlacedProgram:
        """Make a task that runs the methods of a new view of the class."""
        variables, constants = self._variables.allocate(site.memory, name)
        site.prepare(variables.data_type)
        view = site.memory.access(self.program, variables.address, site.context)
        units = {Unit.INIT: view.init, Unit.CYCLIC: view.cyclic, Unit.EXIT: view.exit}
        task = Task(
            name, variables, units, constants=constants, fault_of=fault_of, interrupt=_interrupt
        )
        return PlacedProgram(lambda: False, lambda: task)


def _interrupt(reason: str) -> NoReturn:
    """End the program from a signal handler, which Python runs between two of its bytecodes."""
    raise CycleTimeViolation(reason)


class Python:
    """The language; see `plcsim.program.language.Language`."""

    name: Final = "Python"
    load_cost: Final = 0

    def units(self, files: Sequence[Path]) -> list[Path]:
        """Return the files with the program's class, or those with a unit each."""
        names = [f"{stem}.py" for stem in (*_CLASS_FILES, *_UNIT_FILES.values())]
        by_name = {file.name: file for file in files}
        return [by_name[name] for name in names if name in by_name]

    def declarations(self, _files: Sequence[Path]) -> Sequence[DeclarationFile]:
        """Return nothing: what a class declares is checked where it is loaded."""
        return ()

    def dialect(self, _declared: Sequence[DeclarationFile]) -> Dialect:
        """Return the rules of .var, .typ and .fun files."""
        return AUTOMATION_STUDIO

    def load(self, source: ProgramSource) -> PythonCode:
        """Import the files of a program."""
        return _Loader(source).load()


PYTHON: Final = Python()


class _Loader:
    """Loads one program."""

    def __init__(self, source: ProgramSource) -> None:
        self._source = source
        self._folder = source.folder
        self._declared = variables_of(source.name, source.scope.variables)
        self._project = source.declarations.package
        parts = source.folder.relative_to(source.declarations.folder).parts
        self._package = ".".join((self._project, *parts))
        add_package(self._package, source.folder, lambda: source.scope)

    def load(self) -> PythonCode:
        """Return the program with everything that stands outside its class: units, variables."""
        stems = [file.stem for file in self._source.files if file.stem in _CLASS_FILES]
        modules = [load_module(f"{self._package}.{s}", self._folder, self._project) for s in stems]
        program = self._program_in(modules)
        body = self._units() | self._names(program) | self._variables(program)
        give_views(body.get("_plc_type", program._plc_type), self._source.declarations.catalogue)
        whole = type(program.__name__, (program,), body) if body else program
        check_program(whole, self._folder)
        return PythonCode(whole, self._declared.constants)

    def _program_in(self, modules: list[ModuleType]) -> type[Program]:
        found = {
            value
            for module in modules
            for value in own_names(module).values()
            if isinstance(value, type) and issubclass(value, Program)
        }
        bases = {base for value in found for base in value.__mro__[1:]}
        programs = [value for value in found if value not in bases]
        if not programs and not modules:
            return Program  # its units are functions in files of their own
        if len(programs) != 1:
            names = ", ".join(sorted(p.__name__ for p in programs)) or "none"
            raise ConfigurationError(
                f"{self._folder}: one subclass of plcsim.Program is expected, found {names}"
            )
        return programs[0]

    def _units(self) -> dict[str, Any]:
        """Return the units that are functions in files of their own."""
        units: dict[str, Any] = {}
        for stem in _UNIT_FILES.values():
            file = self._folder / f"{stem}.py"
            if file in self._source.files:
                module = load_module(f"{self._package}.{stem}", self._folder, self._project)
                function = getattr(module, stem, None)
                if not callable(function):
                    raise ConfigurationError(f"{file}: has no function {stem}")
                units[stem] = function
        return units

    def _variables(self, program: type[Program]) -> dict[str, Any]:
        """Return what gives the class the variables of the program's .var files."""
        findings = Findings()
        for variable in self._source.scope.variables:
            if hasattr(program, variable.name):
                at = f"{variable.file.location(variable.node)}: error: "
                findings.add(ConfigurationError(f"{at}{_taken(program, variable.name)}"))
        findings.check()
        constants = {m.name: ConstantAttribute(*m[:3]) for m in self._declared.constants.members}
        if not self._declared.variables.members:
            return constants
        if program._plc_type.members:
            first = self._source.scope.variables[0]
            raise ConfigurationError(
                f"{first.file.location(first.node)}: error: variables are declared here and in "
                f"class {program.__name__}; let one of them do it"
            )
        return {"_plc_type": self._declared.variables} | constants

    def _names(self, program: type[Program]) -> dict[str, Any]:
        """Return the global variables and constants by name, but for those that are hidden."""
        shared = self._source.shared
        self._check_external(program)
        local = {variable.name for variable in self._source.scope.variables}
        local |= {name for name in dir(program) if not _is_external(program, name)}
        names: dict[str, Any] = {
            m.name: GlobalVariable(m.name, m.data_type) for m in shared.variables.members
        }
        names |= {m.name: ConstantAttribute(*m[:3]) for m in shared.constants.members}
        return {name: value for name, value in names.items() if name not in local}

    def _check_external(self, program: type[Program]) -> None:
        """Compare what ``var_external`` says with the declarations."""
        findings = Findings()
        members = [m for kind in self._source.shared for m in kind.members]
        declared = {m.name: m.data_type for m in members}
        for name in filter(partial(_is_external, program), dir(program)):
            used: GlobalVariable = getattr(program, name)
            if name not in declared:
                text = f"there is no global variable {name}{did_you_mean(name, declared)}"
            elif not _is_same(used.data_type, declared[name]):
                text = f"the global variable {name} is {declared[name]}, not {used.data_type}"
            else:
                continue
            findings.add(ConfigurationError(f"{self._folder}: {program.__name__}: {text}"))
        findings.check()


def _is_external(program: type[Program], name: str) -> bool:
    return isinstance(getattr(program, name), GlobalVariable)


def _taken(program: type[Program], name: str) -> str:
    inherited = hasattr(Program, name)
    return f"{name}: " + (
        "a method of plcsim.Program has this name"
        if inherited
        else f"class {program.__name__} has an attribute of this name"
    )


def _is_same(used: DataType[Any] | None, declared: DataType[Any]) -> bool:
    """Whether two types have one layout and one name."""
    used, declared = resolve_alias(used or declared), resolve_alias(declared)
    return used is declared or (used.name == declared.name and used.size == declared.size)
