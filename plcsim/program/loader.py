"""Loads the programs of a project, each by the language it is written in."""

from __future__ import annotations

import itertools
import os
import sys
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import ConfigurationError
from plcsim.program.c.language import C_LANGUAGE
from plcsim.program.language import ProgramSource
from plcsim.program.python.language import PYTHON

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.program.language import Language, ProgramCode

LANGUAGES: Final[tuple[Language, ...]] = (PYTHON, C_LANGUAGE)
"""A program is written in one of them."""

_counter = itertools.count(1)


def unload(package: str) -> None:
    """Forget the modules of a project."""
    for name in [*sys.modules]:
        if name == package or name.startswith(f"{package}."):
            del sys.modules[name]


class ProgramLoader:
    """Loads the programs of one project; two projects in one process do not mix.

    Args:
        folder: where plc.toml lies.
        languages: that programs may be written in.

    Attributes:
        package: name under which Python finds the project's folder.
    """

    def __init__(self, folder: Path, languages: Sequence[Language] = LANGUAGES) -> None:
        self._folder = folder.resolve()
        self._languages = languages
        self.package = f"plcsim_project_{next(_counter)}"
        self._codes: dict[str, ProgramCode] = {}

    def load(self, source: str) -> ProgramCode:
        """Return the program in folder ``source``, loaded once.

        Raises:
            ConfigurationError: there is no such folder, it holds no program, or what it holds is
                wrong.
        """
        if source not in self._codes:
            try:
                self._codes[source] = self._load(source)
            except OSError as err:
                raise ConfigurationError(f"{err.filename}: {err.strerror}") from None
        return self._codes[source]

    def _load(self, source: str) -> ProgramCode:
        folder = self._folder / source
        if not os.path.isdir(folder):  # noqa: PTH112  # no error for what can be no path
            raise ConfigurationError(f"{folder}: no such program folder{self._known()}")
        found = [
            (language, files) for language in self._languages if (files := language.units(folder))
        ]
        if len(found) > 1:
            names = " and ".join(language.name for language, _ in found)
            raise ConfigurationError(
                f"{folder}: holds units in {names}; a program has one language"
            )
        if not found:
            raise self._nothing_in(folder)
        language, files = found[0]
        return language.load(ProgramSource(source, folder, files, self._folder, self.package))

    def _known(self) -> str:
        folders = sorted(f for f in self._folder.glob("*/") if self._is_program(f))
        return f"; there are {', '.join(f.name for f in folders)}" if folders else ""

    def _is_program(self, folder: Path) -> bool:
        return any(language.units(folder) for language in self._languages)

    def _nothing_in(self, folder: Path) -> ConfigurationError:
        if any(folder.glob("*.st")):
            return ConfigurationError(
                f"{folder}: this version of plcsim runs programs in Python; "
                "Structured Text is not there yet"
            )
        return ConfigurationError(f"{folder}: holds neither main.py nor variables.py")
