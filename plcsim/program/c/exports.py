"""Bodies of FUNCTIONs and FUNCTION_BLOCKs that are functions of the C library.

A library that comes with plcsim may name them in a module ``exports.py`` of its folder, as
``EXPORTS``: exports of the C library by the names of what is declared. Compiled programs call
them directly.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Final

from plcsim.library.installed import installed
from plcsim.program.compiled_body import CompiledBody
from plcsim.program.structured_text.calling import interface_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.ansi_c.c_library import CLibrary
    from plcsim.library.executable import Executable
    from plcsim.library.library import Library
    from plcsim.program.site import Site

MODULE: Final = "exports"
"""The module of a library's package that names its bodies."""


class _CLibraryCode:
    """The C library as what bodies come from."""

    language: Final = "ANSI C"

    def on(self, site: Site) -> CLibrary:
        """Return the one of a controller."""
        return site.c_library()


_C_LIBRARY: Final = _CLibraryCode()


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
        found: dict[str, Executable] = {
            block.name: CompiledBody(_C_LIBRARY, exports[block.name])
            for block in library.scope.function_blocks
            if block.name in exports
        }
        for function in library.scope.functions:
            if function.name in exports:
                interface = interface_of(function)
                found[function.name] = CompiledBody(_C_LIBRARY, exports[function.name], interface)
        return found
