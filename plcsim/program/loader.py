"""Loads the programs of a project, each by the language it is written in."""

from __future__ import annotations

import itertools
import os
import time
from contextlib import suppress
from functools import cache, cached_property
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.host.helper_process import share
from plcsim.library.catalogue import Catalogue
from plcsim.library.installed import installed
from plcsim.library.library import files_in
from plcsim.program.c.exports import ExportedBodies
from plcsim.program.c.language import C_LANGUAGE, CBodies
from plcsim.program.declarations import Declarations
from plcsim.program.language import ProgramSource
from plcsim.program.python.blocks import give_views
from plcsim.program.python.bodies import PythonBodies
from plcsim.program.python.kept_objects import kept_objects
from plcsim.program.python.language import PYTHON
from plcsim.program.python.modules import add_library, add_package, unload
from plcsim.program.python.program import globals_in
from plcsim.program.structured_text.language import STRUCTURED_TEXT, StructuredTextBodies
from plcsim.program.variables import DeclaredVariables, variables_of
from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from plcsim.library.executable import BodyLanguage
    from plcsim.library.library import Library
    from plcsim.program.language import Language, ProgramCode
    from plcsim.program.layout import SourceLayout
    from st_types.resolve.declared import DeclaredFunction, DeclaredFunctionBlock
    from st_types.resolve.dialect import Dialect
    from st_types.syntax.tree import DeclarationFile

LANGUAGES: Final[tuple[Language, ...]] = (PYTHON, STRUCTURED_TEXT, C_LANGUAGE)
"""A program is written in one of them."""

BODIES: Final[tuple[BodyLanguage, ...]] = (
    PythonBodies(),
    StructuredTextBodies(),
    CBodies(),
    ExportedBodies(),
)
"""Bodies of libraries are written in one of them."""

DIALECTS: Final = {"automation-studio": AUTOMATION_STUDIO, "iec": IEC}
"""Dialects of Structured Text by their names in plc.toml."""

LONGEST_KNOWN_S: Final = 0.05
"""What takes longer to load was not in the cache: more of it is worth a second process."""

_counter = itertools.count(1)


@cache
def installed_catalogue() -> Catalogue:
    """Return the libraries that are installed, for programs of no project."""
    return Catalogue([*installed().values()], BODIES)


class Loaded(NamedTuple):
    """What came of loading programs.

    Attributes:
        codes: the programs that can run, by name.
        common: what is wrong in what several programs see.
        failures: what is wrong in the others, by name.
    """

    codes: Mapping[str, ProgramCode]
    common: tuple[str, ...]
    failures: Mapping[str, tuple[str, ...]]

    def check(self) -> None:
        """Raise a ConfigurationError where anything is wrong; all of it is told."""
        findings = (*self.common, *itertools.chain.from_iterable(self.failures.values()))
        if findings:
            raise ConfigurationError(*dict.fromkeys(findings))


class ProgramLoader:
    """Loads the programs of one project; two projects in one process do not mix.

    Args:
        layout: where the sources of the project lie.
        languages: that programs may be written in.
        progress: told how many programs are loaded, and of how many, after each.

    Attributes:
        declarations: of the project.
        package: name under which Python finds the project's folder.
        warnings: of the declarations, after `load`.

    Raises:
        ConfigurationError: two libraries have one name.
    """

    def __init__(
        self,
        layout: SourceLayout,
        languages: Sequence[Language] = LANGUAGES,
        progress: Callable[[int, int], None] = lambda _done, _all: None,
    ) -> None:
        self._layout = layout
        self._progress = progress
        self._languages = languages
        self.warnings: list[str] = []
        self.package = f"plcsim_project_{next(_counter)}"
        common, dialect = self._common_units()
        self.declarations = Declarations(layout, self.package, BODIES, common, dialect)
        add_package(self.package, layout.folder, lambda: self.declarations.scope)
        for library in self.declarations.own_libraries:
            add_library(library)

    def _common_units(self) -> tuple[Sequence[DeclarationFile], Dialect]:
        """Return what units in the common files declare, where there are some, and the dialect.

        Raises:
            ConfigurationError: a file cannot be read.
        """
        if not any(place.only for place in self._layout.programs.values()):
            return (), AUTOMATION_STUDIO
        return self._declared_in(self._layout.common.files)

    def load(self) -> Mapping[str, ProgramCode]:
        """Return all programs by name.

        Raises:
            ConfigurationError: a program is not there, or something is wrong in it or in what is
                declared; everything is told, with file and line.
        """
        declared = self._declare()
        declared.check()  # or what follows from a wrong declaration would be told too
        loaded = self._load_declared(declared)
        loaded.check()
        return loaded.codes

    def load_each(self) -> Loaded:
        """Load each program that can be loaded, whatever is wrong in the rest."""
        return self._load_declared(self._declare())

    def _declare(self) -> Loaded:
        """Check all declarations; no program is loaded yet."""
        common = Findings()
        failures = {}
        with common.gathered():
            self.warnings += self.declarations.check()
        for name in self._layout.programs:
            wrong = Findings()
            with wrong.gathered():
                self.declarations.scope_of(name, *self._declared_by(name))
                self.warnings += self.declarations.check_program(name)
            if wrong:
                failures[name] = wrong.texts
        return Loaded({}, common.texts, failures)

    def _declared_by(self, name: str) -> tuple[Sequence[DeclarationFile], Dialect]:
        """Return what the files with units of a program declare, and in which dialect."""
        place = self._layout.programs[name]
        if place.only:
            return (), self.declarations.scope.dialect
        return self._declared_in(place.own.files)

    def _declared_in(self, files: Sequence[Path]) -> tuple[Sequence[DeclarationFile], Dialect]:
        given = DIALECTS.get(self._layout.dialect)
        try:
            for language in self._languages:
                declared = language.declarations(language.units(files))
                if declared:
                    return declared, given or language.dialect(declared)
        except OSError as err:
            raise ConfigurationError(f"{err.filename}: {err.strerror}") from None
        return (), given or AUTOMATION_STUDIO

    def _load_declared(self, declared: Loaded) -> Loaded:
        """Load the programs whose declarations are right."""
        names = [name for name in self._layout.programs if name not in declared.failures]
        found = self._load_all(names)
        common = Findings()
        for library in self.declarations.own_libraries:
            with common.gathered():
                self._check_bodies(library)
        codes: dict[str, ProgramCode] = {}
        failures = dict(declared.failures)
        for name in names:
            code = found[name]
            if isinstance(code, tuple):
                failures[name] = code
            else:
                codes[name] = code
                self.warnings += code.warnings
        self.warnings += kept_objects(self.package)
        return Loaded(codes, (*declared.common, *common.texts), failures)

    def _load_all(self, names: Sequence[str]) -> Mapping[str, ProgramCode | tuple[str, ...]]:
        """Return programs, or what is wrong in them, by name.

        A helper process compiles about half of them, and of the libraries; they are in the cache
        when they are loaded here.
        """
        compiled = self._compiled(names)
        known = set(compiled)
        others = [name for name in names if name not in known]
        found: dict[str, ProgramCode | tuple[str, ...]] = {}
        for count, name in enumerate(others, 1):
            found[name] = self._tried(name)
            self._progress(count, len(names))
        libraries = self.declarations.own_libraries
        jobs: list[Library | str] = [*libraries, *compiled]

        def tell(taken: int) -> None:  # libraries come first
            self._progress(len(others) + max(0, taken - len(libraries)), len(names))

        share(len(jobs), lambda number: self._do(jobs[number], found), tell)
        return {**found, **{name: self._tried(name) for name in compiled if name not in found}}

    def _do(self, job: Library | str, found: dict[str, ProgramCode | tuple[str, ...]]) -> bool:
        """Load a program by its name, or the bodies of a library; return whether it took long."""
        start = time.perf_counter()
        if isinstance(job, str):
            found[job] = self._tried(job)
        else:
            with suppress(ConfigurationError):  # `_check_bodies` tells it
                self.declarations.catalogue.bodies(job)
        return time.perf_counter() - start > LONGEST_KNOWN_S

    def _compiled(self, names: Sequence[str]) -> list[str]:
        """Return the programs whose code a cache keeps, the longest first."""
        costs = {}
        for name in names:
            files = self._layout.programs[name].own.files
            found = [each for each in self._languages if each.load_cost and each.units(files)]
            if found:
                costs[name] = found[0].load_cost * sum(_size(file) for file in files)
        return sorted(costs, key=lambda name: (-costs[name], name))

    def _tried(self, name: str) -> ProgramCode | tuple[str, ...]:
        """Return a program, or what is wrong in it."""
        try:
            return self._load(name)
        except ConfigurationError as err:
            return err.findings

    def _check_bodies(self, library: Library) -> None:
        """Load the bodies of a library of the project, and note what has none.

        Raises:
            ConfigurationError: some cannot be loaded.
        """
        bodies = self.declarations.catalogue.bodies(library)
        declared: list[DeclaredFunctionBlock | DeclaredFunction] = [*library.scope.function_blocks]
        declared += library.scope.functions
        for each in declared:
            if each.name not in bodies:
                location = each.file.location(each.node)
                self.warnings.append(f"{location}: warning: {each.name} has no body")

    def unload(self) -> None:
        """Forget the modules of the project."""
        unload(self.package)

    @cached_property
    def shared(self) -> DeclaredVariables:
        """The global variables: of the declarations, or of the class in ``globals.py``.

        Raises:
            ConfigurationError: there are both, or what is there is wrong.
        """
        declared = self.declarations.global_variables()
        shared = variables_of("globals", declared)
        view = globals_in(self._layout.folder, self.package)
        if view is not None:
            if declared:
                raise ConfigurationError(
                    f"{declared[0].file.location(declared[0].node)}: global variables are declared "
                    f"here and in {self._layout.folder / 'globals.py'}; let one of them do it"
                )
            shared = DeclaredVariables(view, shared.constants)
        with suppress(ConfigurationError):  # of a library, which `_check_bodies` tells
            give_views(shared.variables, self.declarations.catalogue)
        return shared

    def _load(self, name: str) -> ProgramCode:
        folder, own, _, only, instance = self._layout.programs[name]
        if only:
            own = self._layout.common
        if not os.path.isdir(folder):  # noqa: PTH112  # no error for what can be no path
            raise ConfigurationError(f"{folder}: no such program folder{self._known()}")
        try:
            found = [(each, files) for each in self._languages if (files := each.units(own.files))]
            if len(found) > 1:
                names = " and ".join(language.name for language, _ in found)
                raise ConfigurationError(
                    f"{folder}: holds units in {names}; a program has one language"
                )
            if not found:
                raise ConfigurationError(
                    f"{folder}: holds no program: neither main.py nor variables.py, no .st file, "
                    "no .c file"
                )
            language, files = found[0]
            scope = self.declarations.scope_of(name)
            return language.load(
                ProgramSource(
                    name, folder, files, self.declarations, scope, self.shared, only, instance
                )
            )
        except OSError as err:
            raise ConfigurationError(f"{err.filename}: {err.strerror}") from None

    def _known(self) -> str:
        folders = sorted(f for f in self._layout.folder.glob("*/") if self._is_program(f))
        return f"; there are {', '.join(f.name for f in folders)}" if folders else ""

    def _is_program(self, folder: Path) -> bool:
        return any(language.units(files_in(folder)) for language in self._languages)


def _size(file: Path) -> int:
    try:
        return file.stat().st_size
    except OSError:
        return 0
