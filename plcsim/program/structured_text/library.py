"""Bodies of libraries in Structured Text: one module for each library, linked where it is used."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.program.compiled_body import CompiledBody
from plcsim.program.structured_text.calling import interface_of
from plcsim.program.structured_text.code import checked
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.coverage import MEASURING, keep_possible
from plcsim.program.structured_text.layout import VariableLayout, types_of
from plcsim.program.structured_text.linkage import Linkage
from plcsim.program.structured_text.lower.module import lower
from plcsim.program.structured_text.names import NAME
from plcsim.program.structured_text.sources import check_syntax, read_files

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.library.executable import Executable
    from plcsim.library.library import Library
    from plcsim.machine import Instance
    from plcsim.program.site import Site
    from plcsim.program.structured_text.check.typed import CheckedProgram
    from plcsim.program.structured_text.codegen.object_code import ObjectCode
    from st_types.resolve.scope import Scope


def bodies_in(library: Library, files: Sequence[Path]) -> dict[str, Executable]:
    """Check the files of a library and return the bodies in them, by declared name.

    Raises:
        ConfigurationError: there are errors in them; all are told, with file, line and column.
    """
    read = read_files(files)
    check_syntax(read)
    program, _ = checked(library.name, [file.parsed for file in read], library.scope, "global")
    whole = CompiledLibrary(program, library.scope, {file.path: file.source.text for file in read})
    found: dict[str, Executable] = {}
    for body in program.bodies:
        if body.kind == "block":
            found[body.name] = CompiledBody(whole, f"block {body.name}")
        elif body.kind == "function":
            function = library.scope.find_function(body.name)
            assert function is not None
            interface = interface_of(function)
            found[body.name] = CompiledBody(whole, f"function {body.name}", interface)
    return found


class CompiledLibrary:
    """The Structured Text of a library.

    Args:
        program: its bodies, checked.
        scope: of the library.
        texts: of its files, by path.
    """

    def __init__(self, program: CheckedProgram, scope: Scope, texts: dict[str, str]) -> None:
        self._program = program
        self._texts = texts
        self._scope = scope
        self._codes: dict[object, ObjectCode] = {}

    language: Final = NAME

    def on(self, site: Site) -> Instance | None:
        """Return the module on a controller; None while it is being linked."""
        linkage = Linkage.of(site)
        return linkage.library(self, lambda: linkage.link(self._code(site), self._scope, {}))

    def _code(self, site: Site) -> ObjectCode:
        """Return the code for the global variables of a controller."""
        shared = types_of(site.shared)
        if shared not in self._codes:
            layout = VariableLayout(self._scope.name, (), self._scope.chain, shared)
            self._codes[shared] = generate(lower(self._program, layout.areas), MEASURING.options)
            keep_possible(self._codes[shared].profile, self._texts)
        return self._codes[shared]
