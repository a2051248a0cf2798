"""Which language reads a file with units, by the suffix of its name.

A reader makes of a text what the parser of Structured Text makes of its own: the tree of the units
in it, with places in the file as it lies there. All that follows is the same for all languages.
"""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.languages.automation_basic import parse_automation_basic
from plcsim.program.structured_text.languages.chart_file import parse_chart_file
from plcsim.program.structured_text.languages.charts import with_charts
from plcsim.program.structured_text.languages.instruction_list import read_instruction_list
from plcsim.program.structured_text.languages.ladder import read_ladder
from plcsim.program.structured_text.syntax.parser import NO_DEFINES, parse_structured_text

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.program.structured_text.syntax.tree import StructuredTextFile
    from st_types.syntax.source import Source

READERS: Final[Mapping[str, Callable[[Source], StructuredTextFile]]] = {
    ".ab": parse_automation_basic,
    **dict.fromkeys([".cfc", ".fbd", ".il"], read_instruction_list),
    ".ld": read_ladder,
    ".sfc": parse_chart_file,
}
"""Readers by suffix in small letters; all other files are parsed as Structured Text."""


def parse_units(source: Source, defines: Mapping[str, str] = NO_DEFINES) -> StructuredTextFile:
    """Parse a file with units in the language that its name tells.

    Args:
        source: its text.
        defines: macros for the preprocessor of Structured Text.
    """
    reader = READERS.get(PurePath(source.path).suffix.lower())
    return with_charts(parse_structured_text(source, defines) if reader is None else reader(source))
