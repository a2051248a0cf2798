"""Libraries whose code becomes part of each program that uses it."""

from __future__ import annotations

import os
from functools import lru_cache
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
        options: further ones of the compiler, for its sources.
    """

    sources: Sequence[Path]
    headers: Sequence[Path]
    options: Sequence[str] = ()

    def is_used(self, read: Iterable[str]) -> bool:
        """Return whether files that a compiler has read belong to the library."""
        parts = [os.path.split(file) for file in read]
        known = {name for _, name in parts}.union(*(_places(folder) for folder in dict(parts)))
        return not known.isdisjoint(map(str, self.headers))


@lru_cache(maxsize=4096)
def _places(folder: str) -> frozenset[str]:
    """Return a folder, without links, and all above it; many files lie in the same one."""
    real = Path(os.path.realpath(folder))
    return frozenset(map(str, (real, *real.parents)))


UNIT_TEST: Final = StaticLibrary((FOLDER / "UnitTest.c",), (Path("UnitTest.h"),))
"""The runner of the library UnitTest; its headers are the project's."""
