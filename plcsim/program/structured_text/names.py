"""What the language is called, and those that become Structured Text's syntax tree."""

from pathlib import PurePath
from typing import Final

NAME: Final = "Structured Text"

LANGUAGES: Final = {
    ".ab": "Automation Basic",
    ".cfc": "CFC",
    ".fbd": "Function Block Diagram",
    ".il": "Instruction List",
    ".ld": "Ladder Diagram",
    ".sfc": "Sequential Function Chart",
    ".st": NAME,
    **dict.fromkeys([".tcpou", ".tcgvl", ".tcdut", ".tcio"], NAME),  # TwinCAT's
}
"""The language of a file by its suffix in small letters: each has a reader in ``languages``."""

SUFFIXES: Final = frozenset(LANGUAGES)
"""Of files with units, in small letters."""

WITH_ENABLE: Final = frozenset(
    ["CFC", "Function Block Diagram", "Instruction List", "Ladder Diagram"]
)
"""Languages in which each call may have EN and ENO, whatever is declared."""

TWINCAT_MARK: Final = "<TcPlcObject"
"""What stands near the start of a file of TwinCAT."""


def language_of(path: str) -> str:
    """Return the language of a file, Structured Text for any that is not known."""
    return LANGUAGES.get(PurePath(path).suffix.lower(), NAME)
