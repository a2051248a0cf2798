"""Finding and reading .typ, .var and .fun files, with progress on a terminal."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.progress import track

from plcsim.core.errors import PlcError
from st_types.errors import SourceError
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

    from st_types.syntax.tree import DeclarationFile

SUFFIXES = frozenset([".typ", ".var", ".fun"])

MANY_FILES = 50
"""From as many files on, progress is shown."""


def find_files(paths: Iterable[Path], suffixes: Collection[str] = SUFFIXES) -> list[Path]:
    """Return the files at and below ``paths`` with one of ``suffixes``, each once, in order.

    Raises:
        PlcError: a path does not exist, or is a file of another kind.
    """
    found: dict[Path, None] = {}
    for path in paths:
        if path.is_dir():
            found.update(dict.fromkeys(_files_below(path, suffixes)))
        elif not path.exists():
            raise PlcError(f"{path}: no such file or folder.")
        elif path.suffix.lower() not in suffixes:
            *others, last = sorted(suffixes)
            kinds = f"{', '.join(others)} or {last}" if others else last
            raise PlcError(f"{path}: not a {kinds} file.")
        else:
            found[path] = None
    return list(found)


def _files_below(folder: Path, suffixes: Collection[str]) -> Iterator[Path]:
    for place, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            if os.path.splitext(name)[1].lower() in suffixes:  # noqa: PTH122  # a Path each would take longer than the parser
                yield Path(place, name)


class Reading:
    """Files as they were read.

    Attributes:
        files: parsed files.
        failures: a line for each file that could not be read.
        notes: a line for what is not there or is left out, but is no error.
    """

    def __init__(self) -> None:
        self.files: list[DeclarationFile] = []
        self.failures: list[str] = []
        self.notes: list[str] = []

    def read(self, path: Path) -> None:
        """Parse one file."""
        try:
            source = Source.read(path)
        except OSError as err:
            self.failures.append(f"{path}: error: {err.strerror or err}")
        except SourceError as err:
            self.failures.append(str(err))
        else:
            self.files.append(parse_declarations(source))


def read_files(paths: Sequence[Path]) -> Reading:
    """Parse files, with a progress bar where stderr is a terminal and the files are many."""
    reading = Reading()
    for path in shown_progress(paths):
        reading.read(path)
    return reading


def shown_progress(paths: Sequence[Path]) -> Iterable[Path]:
    """Yield ``paths``, with a progress bar where stderr is a terminal and they are many."""
    if len(paths) < MANY_FILES or not sys.stderr.isatty():
        return paths
    return track(paths, "reading", console=Console(stderr=True), transient=True)
