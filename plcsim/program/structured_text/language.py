"""Structured Text as a language of programs, and of the bodies of libraries.

All .st files of a program's folder and of the folders in it are one program: its units
``PROGRAM _INIT``, ``_CYCLIC`` and ``_EXIT``, its actions, its functions and function blocks. What
.var, .typ and .fun files beside them declare is its own, and so is what stands in VAR and TYPE
blocks of the files themselves, as IEC 61131-3 has it; any other name of a PROGRAM means the cyclic
unit.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.names import NAME

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.library.executable import Executable
    from plcsim.library.library import Library
    from plcsim.program.language import ProgramCode, ProgramSource
    from st_types.syntax.tree import DeclarationFile

SUFFIX: Final = ".st"

DEEPEST: Final = 8
"""Folders one in another that hold one program, as packages of actions in Automation Studio do."""


class StructuredText:
    """The language; see `plcsim.program.language.Language`."""

    name: Final = NAME

    def units(self, folder: Path) -> list[Path]:
        """Return the .st files of a folder and of those in it."""
        return files_below(folder)

    def declarations(self, files: Sequence[Path]) -> Sequence[DeclarationFile]:
        """Parse the files; return what they declare in VAR and TYPE blocks of their own."""
        from plcsim.program.structured_text.check.program import declarations_of  # noqa: PLC0415  # as in `load`
        from plcsim.program.structured_text.sources import read_files  # noqa: PLC0415  # likewise

        return [declarations_of(file) for file in read_files(files)]

    def load(self, source: ProgramSource) -> ProgramCode:
        """Check and compile the files of a program."""
        from plcsim.program.structured_text.code import load  # noqa: PLC0415  # 60 ms that not every project needs

        return load(source)


class StructuredTextBodies:
    """See `plcsim.library.executable.BodyLanguage`."""

    name: Final = NAME

    def bodies(self, library: Library) -> dict[str, Executable]:
        """Check the .st files of a library; return the bodies in them."""
        files = files_below(library.folder)
        if not files:
            return {}
        from plcsim.program.structured_text.library import bodies_in  # noqa: PLC0415  # as in `load` above

        return bodies_in(library, files)


STRUCTURED_TEXT: Final = StructuredText()


def files_below(folder: Path) -> list[Path]:
    """Return the .st files of a folder, then those of the folders in it."""
    return [Path(file) for file in _files(os.fspath(folder), DEEPEST)]


def _files(folder: str, depth: int) -> Iterator[str]:
    with os.scandir(folder) as found:
        entries = sorted(found, key=lambda entry: entry.name)
    for entry in entries:
        if entry.name.lower().endswith(SUFFIX) and entry.is_file():
            yield entry.path
    for entry in entries:
        if depth and entry.name[0] not in "._" and entry.is_dir(follow_symlinks=False):
            yield from _files(entry.path, depth - 1)
