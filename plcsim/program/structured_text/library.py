"""Bodies of libraries in Structured Text: one module for each library, linked where it is used."""

from __future__ import annotations

import marshal
from functools import cached_property
from typing import TYPE_CHECKING, Final

from plcsim.program.compiled_body import CompiledBody
from plcsim.program.structured_text.calling import interface_of
from plcsim.program.structured_text.code import checked
from plcsim.program.structured_text.code_cache import Stored, code_cache, find, keep, key_of
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.coverage import MEASURING, keep_possible
from plcsim.program.structured_text.layout import NOTHING, VariableLayout, types_of
from plcsim.program.structured_text.linkage import Linkage
from plcsim.program.structured_text.lower.module import lower
from plcsim.program.structured_text.lower.semantics import semantics_of
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
    from plcsim.program.structured_text.sources import UnitFile
    from plcsim.program.variables import DeclaredVariables


def bodies_in(library: Library, files: Sequence[Path]) -> dict[str, Executable]:
    """Check the files of a library and return the bodies in them, by declared name.

    Raises:
        ConfigurationError: there are errors in them; all are told, with file, line and column.
    """
    whole = CompiledLibrary(library, read_files(files))
    found: dict[str, Executable] = {}
    for kind, name in whole.bodies():
        if kind == "block":
            found[name] = CompiledBody(whole, f"block {name}")
        elif kind == "function":
            function = library.scope.find_function(name)
            assert function is not None
            interface = interface_of(function)
            found[name] = CompiledBody(whole, f"function {name}", interface)
    return found


class CompiledLibrary:
    """The Structured Text of a library.

    What is in the cache of compiled programs is neither parsed nor checked again.

    Args:
        library: as above.
        files: with its bodies.
    """

    def __init__(self, library: Library, files: Sequence[UnitFile]) -> None:
        self._name = library.name
        self._files = files
        self._scope = library.scope
        self._codes: dict[object, ObjectCode] = {}

    @cached_property
    def _program(self) -> CheckedProgram:
        """Its bodies, checked.

        Raises:
            ConfigurationError: there are errors in them.
        """
        check_syntax(self._files)
        files = [file.parsed for file in self._files]
        return checked(self._name, files, self._scope, "global")[0]

    def bodies(self) -> list[tuple[str, str]]:
        """Return kind and name of each body.

        Raises:
            ConfigurationError: there are errors in them.
        """
        cache = code_cache()
        key = key_of(("bodies of a library", self._name), self._files, self._scope, NOTHING)
        known = cache.load(key)
        if known is not None:
            return [(kind, name) for kind, name in marshal.loads(known)]  # noqa: S302  # from the user's own cache, hashed
        found: list[tuple[str, str]] = [(body.kind, body.name) for body in self._program.bodies]
        cache.store(key, marshal.dumps(found))
        return found

    language: Final = NAME

    def on(self, site: Site) -> Instance | None:
        """Return the module on a controller; None while it is being linked."""
        linkage = Linkage.of(site)
        return linkage.library(
            self, lambda: linkage.place(self._code(site), self._scope, {}).link()
        )

    def _code(self, site: Site) -> ObjectCode:
        """Return the code for the global variables of a controller."""
        shared = types_of(site.shared)
        if shared not in self._codes:
            self._codes[shared] = code = self._stored(shared)
            texts = {file.path: file.source.text for file in self._files}
            keep_possible(code.profile, texts)
        return self._codes[shared]

    def _stored(self, shared: DeclaredVariables) -> ObjectCode:
        names = ("library", self._name, self._scope.dialect.name, repr(MEASURING.options))
        cache, key = code_cache(), key_of(names, self._files, self._scope, shared)
        stored = find(cache, key)
        if stored is None:
            layout = VariableLayout(self._name, (), self._scope.chain, shared)
            module = lower(self._program, layout.areas, semantics_of(self._scope))
            code = generate(module, MEASURING.options)
            stored = Stored(code, ())
            keep(cache, key, stored)
        return stored.code
