"""Bodies of libraries in C: one module for each library and controller."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from plcsim.ansi_c.module import CModule
from plcsim.core.errors import ConfigurationError
from plcsim.program.c.code import locator
from plcsim.program.c.names import NAME
from plcsim.program.c.sources import compile_library
from plcsim.program.c.surroundings import ProgramSurroundings, heap_size_of
from plcsim.program.compiled import CompiledPrograms
from plcsim.program.compiled_body import CompiledBody
from plcsim.program.structured_text.calling import interface_of
from st_types.types.derived import StringType, WStringType

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.library.executable import Executable
    from plcsim.library.library import Library
    from plcsim.machine.shared_module import SharedModule
    from plcsim.program.site import Site
    from st_types.resolve.declared import DeclaredFunction


def bodies_in(library: Library, files: Sequence[Path]) -> dict[str, Executable]:
    """Compile the files of a library and return the bodies in them, by declared name.

    Raises:
        ConfigurationError: there are errors in them; all are told.
    """
    whole = CLibraryCode(library, compile_library(library, files).module, files)
    known = set(whole.module.functions)
    found: dict[str, Executable] = {
        block.name: CompiledBody(whole, block.name)
        for block in library.scope.function_blocks
        if block.name in known
    }
    for function in library.scope.functions:
        if function.name in known:
            found[function.name] = _function(whole, function)
    return found


def _function(whole: CLibraryCode, function: DeclaredFunction) -> CompiledBody:
    """Return the body of a FUNCTION; one that gives a STRING returns its address.

    Raises:
        ConfigurationError: its result is a STRUCT or an ARRAY.
    """
    interface, only_c = interface_of(function), ""
    large = interface.large
    if large is not None:
        place = function.file.location(function.node)
        gives = f"{function.name} gives {large.name}"
        if not isinstance(large, StringType | WStringType):
            raise ConfigurationError(f"{place}: error: {gives}, which a function in C cannot give")
        interface = replace(interface, results="I")
        if not large.length:
            only_c = f"{gives} ({place}), an address without a length: only C can call it"
    return CompiledBody(whole, function.name, interface, only_c)


class CLibraryCode:
    """The C of a library.

    Args:
        library: the library.
        module: its module.
        sources: its files.

    Attributes:
        module: as above.
    """

    def __init__(self, library: Library, module: SharedModule, sources: Sequence[Path]) -> None:
        self._library = library
        self._sources = sources
        self.module = module

    language: Final = NAME

    def on(self, site: Site) -> CModule | None:
        """Return the module on a controller; None while it is being placed."""
        modules = site.context.settings(_Modules)
        if modules is None:
            modules = _Modules()
            site.context.give_settings(modules)
        if self not in modules.placed:
            modules.placed[self] = None
            modules.placed[self] = self._placed(site)
        return modules.placed[self]

    def _placed(self, site: Site) -> CModule:
        name = f"library {self._library.name}"
        scope = self._library.scope
        size = heap_size_of(self.module, self._library.c_build.heap_size)
        folders = [file.parent for file in self._sources]
        surroundings = ProgramSurroundings(name, site, scope, (), size, folders=folders)
        module = CModule(
            name, self.module, site.machine, surroundings, sources=self._sources
        ).link()
        CompiledPrograms.of(site).locate_by(name, locator(module))

        def reset() -> None:
            surroundings.reset()
            module.reset()

        reset()
        site.memory.at_boot(reset)
        return module


class _Modules:
    """The libraries in C of one controller."""

    def __init__(self) -> None:
        self.placed: dict[CLibraryCode, CModule | None] = {}
