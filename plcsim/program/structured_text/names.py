"""What the language is called."""

from typing import Final

NAME: Final = "Structured Text"

SUFFIXES = frozenset([".st", ".tcpou", ".tcgvl", ".tcdut", ".tcio"])
"""Of files with Structured Text, in small letters; all but the first are TwinCAT's."""

TWINCAT_MARK = "<TcPlcObject"
"""What stands near the start of a file of TwinCAT."""
