"""Libraries whose code becomes part of each program that uses it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

FOLDER: Final = Path(__file__).parent / "static"
"""Sources of those that come along."""


class StaticLibrary(NamedTuple):
    """Sources that are linked to who needs them, once for each program.

    Attributes:
        sources: in C and C++.
        headers: a program that reads one of them may use the library: folders without links, or
            names of headers wherever they lie.
    """

    sources: Sequence[Path]
    headers: Sequence[Path]

    def is_used(self, read: Iterable[str]) -> bool:
        """Return whether files that a compiler has read belong to the library."""
        files = {*map(Path, read)}
        folders = {Path(os.path.realpath(file.parent)) for file in files}
        known = {Path(file.name) for file in files} | folders
        known |= {above for folder in folders for above in folder.parents}
        return not known.isdisjoint(self.headers)


UNIT_TEST: Final = StaticLibrary((FOLDER / "UnitTest.c",), (Path("UnitTest.h"),))
"""The runner of the library UnitTest; its headers are the project's."""
