"""The declarations of a project: types, global variables, libraries, the variables of its programs.

A name means what is declared nearest: in the program, in the places between it and the project, in
the project, in the libraries. Among these the project's own come first, in the order of its layout,
then the installed ones, then those that come without source: where plcsim has a library itself, it
executes what it has, and the rest of the vendor's is at least declared. Local hides global.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.library.catalogue import Catalogue
from plcsim.library.installed import Scopes, installed
from plcsim.library.library import Library, check_scope, declarations_of, read_declarations
from plcsim.library.simulated import built_in_rules
from st_types.resolve.dialect import AUTOMATION_STUDIO
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from plcsim.library.executable import BodyLanguage
    from plcsim.program.layout import DeclarationPlace, LibraryPlace, MadeVariable, SourceLayout
    from st_types.resolve.declared import DeclaredVariable
    from st_types.resolve.dialect import Dialect
    from st_types.syntax.tree import DeclarationFile

MADE: Final = "configuration"
"""Stands for the file of variables that no file declares."""


class Declarations:
    """What a project declares.

    Args:
        layout: where its sources lie.
        package: name under which Python finds it.
        languages: that bodies of libraries may be written in.
        common: what units in the common files declare.
        dialect: of the common files.

    Attributes:
        layout: as above.
        folder: of the project.
        package: as above.
        own_libraries: those of the project with their sources, and those that plc.toml names.
        catalogue: all libraries that its programs see.

    Raises:
        ConfigurationError: two libraries have one name.
    """

    def __init__(
        self,
        layout: SourceLayout,
        package: str,
        languages: Sequence[BodyLanguage] = (),
        common: Sequence[DeclarationFile] = (),
        dialect: Dialect = AUTOMATION_STUDIO,
    ) -> None:
        self._common = common
        self._dialect = dialect
        self.layout = layout
        self.folder = layout.folder
        self.package = package
        self._scopes: dict[tuple[DeclarationPlace, ...], Scope] = {}
        around: list[Library] = []
        scopes = Scopes(around)
        own: list[Library] = []
        vendors: list[Library] = []
        ours = {each.name.upper(): each for each in installed().values()}
        for place in layout.libraries:
            beside = ours.get(place.name.upper()) if place.is_vendor else None
            library = self._library(place, scopes, beside)
            (vendors if place.is_vendor else own).append(library)
        _check_names(own)
        hidden = {library.name.upper() for library in own}
        around += own
        around += [each for name, each in ours.items() if name not in hidden]
        around += [each for each in vendors if each.name.upper() not in hidden]
        self.own_libraries = tuple(own)
        stubs = layout.stubs | ({v.name.lower() for v in vendors} if "*" in layout.stubs else set())
        self.catalogue = Catalogue(
            around, languages, stubs, built_in_rules().extended(layout.simulate)
        )

    def _library(self, place: LibraryPlace, around: Scopes, beside: Library | None) -> Library:
        library = Library(
            place.folder,
            f"{self.package}.{place.package}",
            around,
            name=place.name,
            files=place.files,
            dependencies=place.dependencies,
            beside=beside,
            strict=not place.is_vendor,
        )
        library.c_build = self.layout.c_build
        return library

    @cached_property
    def scope(self) -> Scope:
        """What all programs see.

        Raises:
            ConfigurationError: a file cannot be read.
        """
        common = self.layout.common
        files = read_declarations(declarations_of(common.files))
        made = self._made_file()
        files = [*files, *([made] if made else []), *self._common]
        outer = self.catalogue.scopes
        return Scope(common.name, files, outer, dialect=self._dialect, strict=True)

    def _made_file(self) -> DeclarationFile | None:
        """Return what declares the variables that no file declares, None where there are none."""
        variables = [each for each in self.layout.made_variables if self._is_known(each)]
        if not variables:
            return None
        lines = "".join(f"\t{each.name} : {each.data_type};\n" for each in variables)
        return parse_declarations(Source(MADE, f"VAR\n{lines}END_VAR\n"))

    def _is_known(self, variable: MadeVariable) -> bool:
        names = (scope.index.names("types") for scope in self.catalogue.scopes)
        return any(variable.data_type in each for each in names)

    def scope_of(
        self,
        source: str,
        more: Iterable[DeclarationFile] = (),
        dialect: Dialect = AUTOMATION_STUDIO,
    ) -> Scope:
        """Return what a program sees: its own declarations, and around them all others.

        Args:
            source: the program, as the layout names it.
            more: what the files with its units declare; told at the first call.
            dialect: of the program; likewise.

        Raises:
            ConfigurationError: a file cannot be read.
        """
        place = self.layout.programs[source]
        return self._scope_of((*place.around, place.own), more, dialect)

    def _scope_of(
        self,
        places: tuple[DeclarationPlace, ...],
        more: Iterable[DeclarationFile] = (),
        dialect: Dialect = AUTOMATION_STUDIO,
    ) -> Scope:
        if not places:
            return self.scope
        if places not in self._scopes:
            outer = self._scope_of(places[:-1])
            files = [*read_declarations(declarations_of(places[-1].files)), *more]
            name = places[-1].name
            self._scopes[places] = Scope(name, files, (outer,), dialect=dialect, strict=True)
        return self._scopes[places]

    def check(self) -> list[str]:
        """Resolve everything that the project, its packages and its own libraries declare.

        Returns:
            warnings, each with file, line, column and caret.

        Raises:
            ConfigurationError: there are errors; all of them are told.
        """
        findings = Findings()
        warnings: list[str] = []
        for scope in (*(each.scope for each in self.own_libraries), *self._common_scopes()):
            with findings.gathered():
                warnings += check_scope(scope)
        with findings.gathered():
            _check_unique(self._global_variables())
        findings.check()
        return warnings

    def check_program(self, source: str) -> list[str]:
        """Resolve everything that a program declares; see `check`."""
        return check_scope(self.scope_of(source))

    def _common_scopes(self) -> Iterator[Scope]:
        """Yield the scopes that several programs see."""
        yield self.scope
        programs = self.layout.programs.values()
        for places in dict.fromkeys(place.around for place in programs):
            for depth in range(1, len(places) + 1):
                yield self._scope_of(places[:depth])

    def global_variables(self) -> list[DeclaredVariable]:
        """Return the variables and constants that several programs see.

        They are those of the project, of the places between it and its programs, and of its own
        libraries; constants of libraries need no memory. Of two with one name, which `check`
        tells, it is the first.
        """
        found: dict[str, DeclaredVariable] = {}
        for variable in self._global_variables():
            found.setdefault(variable.name, variable)
        return [*found.values()]

    def _global_variables(self) -> list[DeclaredVariable]:
        scopes = dict.fromkeys(self._common_scopes())
        found = [variable for scope in scopes for variable in scope.variables]
        for library in self.own_libraries:
            found += [v for v in library.scope.variables if not v.is_constant]
        return found


def _check_unique(variables: Sequence[DeclaredVariable]) -> None:
    """Raise a ConfigurationError where two files declare one global variable."""
    findings = Findings()
    seen: dict[str, DeclaredVariable] = {}
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
