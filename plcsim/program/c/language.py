"""ANSI C and C++ as languages of programs, and of the bodies of libraries.

All C files of a program are one. Its units are the
functions marked ``_INIT``, ``_CYCLIC`` and ``_EXIT``. Variables that a .var file declares are those
of the controller; what C defines itself lies in PLC memory as well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.program.c.names import NAME, c_files
from st_types.resolve.dialect import AUTOMATION_STUDIO

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.library.executable import Executable
    from plcsim.library.library import Library
    from plcsim.program.language import ProgramCode, ProgramSource
    from st_types.resolve.dialect import Dialect
    from st_types.syntax.tree import DeclarationFile


class C:
    """The language; see `plcsim.program.language.Language`."""

    name: Final = NAME
    load_cost: Final = 10

    def units(self, files: Sequence[Path]) -> list[Path]:
        """Return the C files of a program: which of them hold units, the compiler finds out."""
        return c_files(files)

    def declarations(self, _files: Sequence[Path]) -> Sequence[DeclarationFile]:
        """Return nothing: what C declares is its own."""
        return ()

    def dialect(self, _declared: Sequence[DeclarationFile]) -> Dialect:
        """Return the rules of .var, .typ and .fun files."""
        return AUTOMATION_STUDIO

    def load(self, source: ProgramSource) -> ProgramCode:
        """Compile and link the files of a program."""
        from plcsim.program.c.code import load  # noqa: PLC0415  # 50 ms that few projects need

        return load(source)


class CBodies:
    """See `plcsim.library.executable.BodyLanguage`."""

    name: Final = NAME

    def bodies(self, library: Library) -> dict[str, Executable]:
        """Compile the C files of a library; return the bodies in them."""
        files = c_files(library.files)
        if not files or not (library.scope.functions or library.scope.function_blocks):
            return {}  # static: programs are linked with what they need of it
        from plcsim.program.c.library import bodies_in  # noqa: PLC0415  # as in `load` above

        return bodies_in(library, files)


C_LANGUAGE: Final = C()
