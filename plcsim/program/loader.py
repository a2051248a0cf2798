"""Loads the programs of a project, each by the language it is written in."""

from __future__ import annotations

import itertools
import os
from functools import cache, cached_property
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.library.catalogue import Catalogue
from plcsim.library.installed import installed
from plcsim.program.c.language import C_LANGUAGE, CBodies
from plcsim.program.declarations import Declarations
from plcsim.program.language import ProgramSource
from plcsim.program.python.blocks import give_views
from plcsim.program.python.bodies import PythonBodies
from plcsim.program.python.language import PYTHON
from plcsim.program.python.modules import add_library, add_package, unload
from plcsim.program.python.program import globals_in
from plcsim.program.structured_text.language import STRUCTURED_TEXT, StructuredTextBodies
from plcsim.program.variables import Variables, variables_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from plcsim.library.executable import BodyLanguage
    from plcsim.library.library import Library
    from plcsim.program.language import Language, ProgramCode
    from st_types.resolve.declared import Function, FunctionBlock
    from st_types.syntax.tree import DeclarationFile

LANGUAGES: Final[tuple[Language, ...]] = (PYTHON, STRUCTURED_TEXT, C_LANGUAGE)
"""A program is written in one of them."""

BODIES: Final[tuple[BodyLanguage, ...]] = (PythonBodies(), StructuredTextBodies(), CBodies())
"""Bodies of libraries are written in one of them."""

_counter = itertools.count(1)


@cache
def installed_catalogue() -> Catalogue:
    """Return the libraries that are installed, for programs of no project."""
    return Catalogue([*installed().values()], BODIES)


class ProgramLoader:
    """Loads the programs of one project; two projects in one process do not mix.

    Args:
        folder: where plc.toml lies.
        sources: folders of the programs, as plc.toml names them.
        libraries: folders of libraries outside the project.
        languages: that programs may be written in.

    Attributes:
        declarations: of the project.
        package: name under which Python finds the project's folder.
        warnings: of the declarations, after `load`.

    Raises:
        ConfigurationError: two libraries have one name.
    """

    def __init__(
        self,
        folder: Path,
        sources: Sequence[str] = (),
        libraries: Sequence[Path] = (),
        languages: Sequence[Language] = LANGUAGES,
    ) -> None:
        folder = folder.resolve()
        self._folder = folder
        self._languages = languages
        self.warnings: list[str] = []
        self._programs = {source: folder / source for source in sources}
        self.package = f"plcsim_project_{next(_counter)}"
        self.declarations = Declarations(
            folder, self.package, [*self._programs.values()], libraries, BODIES
        )
        add_package(self.package, folder, lambda: self.declarations.scope)
        for library in self.declarations.own_libraries:
            add_library(library)

    def load(self) -> Mapping[str, ProgramCode]:
        """Return all programs by their source.

        Raises:
            ConfigurationError: a program is not there, or something is wrong in it or in what is
                declared; everything is told, with file and line.
        """
        declared, loaded = Findings(), Findings()
        for folder in self._programs.values():
            with declared.gathered():
                self._declare(folder)
        with declared.gathered():
            self.warnings = self.declarations.check()
        declared.check()  # or what follows from a wrong declaration would be told too
        for library in self.declarations.own_libraries:
            with loaded.gathered():
                self._check_bodies(library)
        codes = {}
        for source, folder in self._programs.items():
            with loaded.gathered():
                codes[source] = self._load(source, folder)
                self.warnings += codes[source].warnings
        loaded.check()
        return codes

    def _check_bodies(self, library: Library) -> None:
        """Load the bodies of a library of the project, and note what has none.

        Raises:
            ConfigurationError: some cannot be loaded.
        """
        bodies = self.declarations.catalogue.bodies(library)
        declared: list[FunctionBlock | Function] = [*library.scope.function_blocks]
        declared += library.scope.functions
        for each in declared:
            if each.name not in bodies:
                location = each.file.location(each.node)
                self.warnings.append(f"{location}: warning: {each.name} has no body")

    def unload(self) -> None:
        """Forget the modules of the project."""
        unload(self.package)

    def _declare(self, folder: Path) -> None:
        """Read what a program declares, where its folder is there."""
        if _is_folder(folder):
            self.declarations.scope_of(folder, self._declared_in(folder))

    def _declared_in(self, folder: Path) -> Iterator[DeclarationFile]:
        """Iterate over what the files with units of a program declare."""
        try:
            for language in self._languages:
                yield from language.declarations(language.units(folder))
        except OSError as err:
            raise ConfigurationError(f"{err.filename}: {err.strerror}") from None

    @cached_property
    def shared(self) -> Variables:
        """The global variables: of the declarations, or of the class in ``globals.py``.

        Raises:
            ConfigurationError: there are both, or what is there is wrong.
        """
        declared = self.declarations.global_variables(self._programs.values())
        shared = variables_of("globals", declared)
        view = globals_in(self._folder, self.package)
        if view is not None:
            if declared:
                raise ConfigurationError(
                    f"{declared[0].file.location(declared[0].node)}: global variables are declared "
                    f"here and in {self._folder / 'globals.py'}; let one of them do it"
                )
            shared = Variables(view, shared.constants)
        give_views(shared.variables, self.declarations.catalogue)
        return shared

    def _load(self, source: str, folder: Path) -> ProgramCode:
        if not _is_folder(folder):
            raise ConfigurationError(f"{folder}: no such program folder{self._known()}")
        try:
            found = [(each, files) for each in self._languages if (files := each.units(folder))]
            if len(found) > 1:
                names = " and ".join(language.name for language, _ in found)
                raise ConfigurationError(
                    f"{folder}: holds units in {names}; a program has one language"
                )
            if not found:
                raise self._nothing_in(folder)
            language, files = found[0]
            scope = self.declarations.scope_of(folder)
            return language.load(
                ProgramSource(source, folder, files, self.declarations, scope, self.shared)
            )
        except OSError as err:
            raise ConfigurationError(f"{err.filename}: {err.strerror}") from None

    def _known(self) -> str:
        folders = sorted(f for f in self._folder.glob("*/") if self._is_program(f))
        return f"; there are {', '.join(f.name for f in folders)}" if folders else ""

    def _is_program(self, folder: Path) -> bool:
        return any(language.units(folder) for language in self._languages)

    def _nothing_in(self, folder: Path) -> ConfigurationError:
        return ConfigurationError(
            f"{folder}: holds no program: neither main.py nor variables.py, no .st file, no .c file"
        )


def _is_folder(path: Path) -> bool:
    return os.path.isdir(path)  # noqa: PTH112  # no error for what can be no path
