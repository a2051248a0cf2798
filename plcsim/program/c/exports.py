"""Bodies of FUNCTIONs that are functions of the C library.

A library that comes with plcsim may name them in a module ``exports.py`` of its folder, as
``EXPORTS``: exports of the C library by the names of declared functions. Compiled programs call
them directly.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.library.installed import installed
from plcsim.program.site import Site
from plcsim.program.structured_text.calling import Interface, callable_of, interface_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.ansi_c.c_library import CLibrary
    from plcsim.core.context import Context
    from plcsim.library.executable import Executable
    from plcsim.library.library import Library
    from plcsim.machine import Extern

MODULE: Final = "exports"
"""The module of a library's package that names its bodies."""


class ExportedBody(NamedTuple):
    """The body of a FUNCTION; see `plcsim.library.executable.CompiledExecutable`.

    Attributes:
        name: of the function of the C library.
        interface: of the FUNCTION.
    """

    name: str
    interface: Interface

    @property
    def language(self) -> str:
        """ANSI C."""
        return "ANSI C"

    def bind(self, context: Context) -> Callable[..., Any]:
        """Return it for Python."""
        site = Site.of(context)
        call = callable_of(site.memory, _library(site), self.name, self.interface)
        return site.machine.unit(call)

    def extern(self, context: Context) -> Extern:
        """Return it for other modules to import."""
        found = _library(Site.of(context)).extern(self.name)
        assert found is not None, self.name  # a test looks for all of them
        return found


def _library(site: Site) -> CLibrary:
    from plcsim.ansi_c.c_library import CLibrary  # noqa: PLC0415  # not every project needs it

    return site.machine.shared(CLibrary)


class ExportedBodies:
    """See `plcsim.library.executable.BodyLanguage`."""

    name: Final = "ANSI C"

    def bodies(self, library: Library) -> dict[str, Executable]:
        """Return the bodies that a library names, where it comes with plcsim."""
        if installed().get(library.package) is not library:
            return {}
        if not (library.folder / f"{MODULE}.py").is_file():
            return {}
        exports: Mapping[str, str] = import_module(f"{library.package}.{MODULE}").EXPORTS
        return {
            function.name: ExportedBody(exports[function.name], interface_of(function))
            for function in library.scope.functions
            if function.name in exports
        }
