"""Programs in ANSI C and C++: all C files of a folder are one program.

Its units are the functions marked ``_INIT``, ``_CYCLIC`` and ``_EXIT``. Variables that a .var file
of the program declares are those of the controller; what C defines itself lies in PLC memory as
well.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.program.language import ProgramCode, ProgramSource
    from st_types.syntax.tree import DeclarationFile

SUFFIXES: Final = (".c", ".cpp", ".cc", ".cxx")
"""Of files that are compiled."""


class C:
    """The language; see `plcsim.program.language.Language`."""

    name: Final = "ANSI C"

    def units(self, folder: Path) -> list[Path]:
        """Return the C files of a folder: which of them hold units, the compiler finds out."""
        return sorted(f for f in folder.iterdir() if f.suffix.lower() in SUFFIXES and f.is_file())

    def declarations(self, _files: Sequence[Path]) -> Sequence[DeclarationFile]:
        """Return nothing: what C defines is seen by C."""
        return ()

    def load(self, source: ProgramSource) -> ProgramCode:
        """Compile and link the files of a program."""
        from plcsim.program.c.code import load  # noqa: PLC0415  # 50 ms that few projects need

        return load(source)


C_LANGUAGE: Final = C()
