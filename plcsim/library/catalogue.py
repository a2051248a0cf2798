"""The catalogue: the libraries that a project sees, and what executes what they declare."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.suggestion import did_you_mean
from plcsim.library.installed import Scopes
from plcsim.library.models import modelled_block, modelled_function
from plcsim.library.simulated import Rules, built_in_rules, result_body, table_body
from plcsim.library.stub import Stub
from plcsim.settings import is_settings
from st_types.types.derived import DataBlockType, StringType, StructType, resolve_alias

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from plcsim.library.executable import BodyLanguage, Executable
    from plcsim.library.library import Library
    from plcsim.library.models import ModelledBlock, ModelledFunction
    from plcsim.library.simulated import ResultBody, TableBody
    from plcsim.settings import Table
    from st_types.resolve.declared import DeclaredFunction
    from st_types.resolve.index import NameSpace

SETTINGS: Final = "settings"
"""The module of a library's package that holds the class of its settings, where it has some."""


class Catalogue:
    """Libraries, in the order in which names are looked up in them.

    Args:
        libraries: as above.
        languages: that bodies may be written in.
        stubs: names of libraries, in small letters, in which what has no body is idle, or follows
            rules; "*" for whatever comes compiled.
        rules: for blocks of such libraries.

    Attributes:
        libraries: as above.
        scopes: of the libraries; read when a name is looked up.
        stubbed: names that somebody looked up and that nothing executes, by library, and what they
            do instead: "" for nothing.
    """

    def __init__(
        self,
        libraries: Sequence[Library],
        languages: Sequence[BodyLanguage],
        stubs: Collection[str] = (),
        rules: Rules | None = None,
    ) -> None:
        self.libraries = tuple(libraries)
        self._stubs = frozenset(stubs)
        self._rules = rules or built_in_rules()
        self.stubbed: dict[str, dict[str, str]] = {}
        self.scopes = Scopes(self.libraries)
        self._languages = languages
        self._bodies: dict[Library, dict[str, Executable]] = {}
        self._broken: dict[Library, tuple[str, ...]] = {}

    def bodies(self, library: Library) -> Mapping[str, Executable]:
        """Return the bodies of a library by declared name; what has none is missing.

        Raises:
            ConfigurationError: some cannot be loaded, or one is there twice.
        """
        if library in self._broken:
            raise ConfigurationError(*self._broken[library])
        if library not in self._bodies:
            try:
                self._bodies[library] = self._load(library)
            except ConfigurationError as err:
                self._broken[library] = err.findings  # compiling it again would find the same
                raise
        return self._bodies[library]

    def _load(self, library: Library) -> dict[str, Executable]:
        found: dict[str, Executable] = {}
        for language in self._languages:
            for name, body in language.bodies(library).items():
                if name in found:
                    raise ConfigurationError(
                        f"{library.folder}: {name} has a body in {found[name].language} and one "
                        f"in {language.name}"
                    )
                found[name] = body
        return found

    def has_stubs(self, library: Library) -> bool:
        """Whether what has no body in a library is idle."""
        return library.name.lower() in self._stubs

    @property
    def has_idle_objects(self) -> bool:
        """Whether functions of compiled code are idle that belongs to a program, no library."""
        return "*" in self._stubs

    def note_idle(self, owner: str, name: str) -> None:
        """Take down a function of C that only compiled code of a library or a program holds."""
        self.stubbed.setdefault(owner, {})[name] = ""

    def _body(self, library: Library, name: str) -> Executable | None:
        body = self.bodies(library).get(name)
        if body is None and self.has_stubs(library):
            return self._stub(library, name)
        return body

    def _stub(self, library: Library, name: str) -> Executable:
        """Return what stands for a body that is not here."""
        data_type = library.scope.find_type(name)
        body: ModelledBlock | ModelledFunction | TableBody | ResultBody | None
        body = modelled_function(name)
        if isinstance(data_type, DataBlockType):
            body = self._simulated(library, data_type)
        function = library.scope.find_function(name)
        if body is None and function is not None:
            body = result_body(name, self._rules.of(name))
        self.stubbed.setdefault(library.name, {})[name] = "" if body is None else body.text
        return body or Stub(_zero(function))

    def _simulated(
        self, library: Library, data_type: DataBlockType[Any]
    ) -> ModelledBlock | TableBody | None:
        """Return what stands for the body of a block; rules of a project count first."""
        name = data_type.name
        if name not in self._rules.own:
            body = modelled_block(data_type, library.scope.find_type)
            if body is not None:
                return body
        return table_body(data_type, self._rules.of(name))

    def find_block(self, name: str) -> tuple[Library, Executable | None] | None:
        """Return the library that declares a FUNCTION_BLOCK, and its body; None for no such block.

        The body is None where the library has none.
        """
        return self._find("types", name)

    def find_function(self, name: str) -> tuple[Library, Executable | None] | None:
        """Return the library that declares a FUNCTION, and its body, likewise."""
        return self._find("functions", name)

    def _find(self, space: NameSpace, name: str) -> tuple[Library, Executable | None] | None:
        for library in self.libraries:
            if name in library.scope.index.names(space):
                return library, self._body(library, name)
        return None

    def executable(self, data_type: StructType[Any]) -> Executable | None:
        """Return what executes the block that a data block belongs to, None if nothing does."""
        name = data_type.name
        for library in self.libraries:
            declared = name in library.scope.index.names("types")
            if declared and library.scope.find_type(name) is data_type:
                return self._body(library, name)
        return None

    def read_settings(self, tables: Mapping[str, Table]) -> list[object]:
        """Return the settings of libraries, for their blocks to find in the context.

        Args:
            tables: [library.NAME] by NAME.

        Raises:
            ConfigurationError: there is no such library, it has no settings, or they are wrong.
        """
        by_name = {library.name: library for library in reversed(self.libraries)}
        findings = Findings()
        result: list[object] = []
        for name, table in tables.items():
            with findings.gathered():
                if name not in by_name:
                    hint = did_you_mean(name, by_name) or f"; there are {', '.join(by_name)}"
                    raise table.error("", f"there is no such library{hint}")
                kind = _settings_of(by_name[name])
                if kind is None:
                    raise table.error("", "this library has no settings")
                result.append(table.read(kind))
        findings.check()
        return result


def _zero(function: DeclaredFunction | None) -> object:
    """Return what a function returns that does nothing; None for a block, or for a STRUCT."""
    if function is None or function.result is None:
        return None
    result = resolve_alias(function.result)
    if isinstance(result, StructType):
        return None
    return "" if isinstance(result, StringType) else 0


def _settings_of(library: Library) -> type | None:
    if not (library.folder / f"{SETTINGS}.py").is_file():
        return None
    module = import_module(f"{library.package}.{SETTINGS}")
    found = [each for each in vars(module).values() if is_settings(each)]
    own = [each for each in found if each.__module__ == module.__name__]
    return own[0] if own else None
