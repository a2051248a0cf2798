"""Structured Text as a language of programs, and of the bodies of libraries.

All .st files of a program are one: its units
``PROGRAM _INIT``, ``_CYCLIC`` and ``_EXIT``, its actions, its functions and function blocks. What
.var, .typ and .fun files beside them declare is its own, and so is what stands in VAR and TYPE
blocks of the files themselves, as IEC 61131-3 has it; any other name of a PROGRAM means the cyclic
unit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.names import NAME, SUFFIXES

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.library.executable import Executable
    from plcsim.library.library import Library
    from plcsim.program.language import ProgramCode, ProgramSource
    from st_types.resolve.dialect import Dialect
    from st_types.syntax.tree import DeclarationFile


class StructuredText:
    """The language; see `plcsim.program.language.Language`."""

    name: Final = NAME
    load_cost: Final = 1

    def units(self, files: Sequence[Path]) -> list[Path]:
        """Return the .st files of a program."""
        return _sources(files)

    def declarations(self, files: Sequence[Path]) -> Sequence[DeclarationFile]:
        """Parse the files; return what they declare in VAR and TYPE blocks of their own."""
        if not files:
            return ()
        from plcsim.program.structured_text.sources import declared_in  # noqa: PLC0415  # as in `load`

        return declared_in(files)

    def dialect(self, declared: Sequence[DeclarationFile]) -> Dialect:
        """Return IEC 61131-3 where a file has VAR blocks, which Automation Studio's have not."""
        from plcsim.program.structured_text.sources import dialect_of  # noqa: PLC0415  # likewise

        return dialect_of(declared)

    def load(self, source: ProgramSource) -> ProgramCode:
        """Check and compile the files of a program."""
        from plcsim.program.structured_text.code import load  # noqa: PLC0415  # 60 ms that not every project needs

        return load(source)


class StructuredTextBodies:
    """See `plcsim.library.executable.BodyLanguage`."""

    name: Final = NAME

    def bodies(self, library: Library) -> dict[str, Executable]:
        """Check the .st files of a library; return the bodies in them."""
        files = _sources(library.files)
        if not files:
            return {}
        from plcsim.program.structured_text.library import bodies_in  # noqa: PLC0415  # as in `load` above

        return bodies_in(library, files)


STRUCTURED_TEXT: Final = StructuredText()


def _sources(files: Sequence[Path]) -> list[Path]:
    return [file for file in files if file.suffix.lower() in SUFFIXES]
