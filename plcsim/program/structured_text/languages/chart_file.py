"""Files with sequential function charts as Automation Studio writes them: .sfc.

They are text. A transition may have a name of any characters before FROM, which is for people, even
``//``. Comments ``(* @NAME := 'value' *)`` say what the editor keeps: LANGUAGE of a body,
SFCCOMMENT, SFCMINTIME and SFCMAXTIME of a step, SFCISJUMP and SFCNOJUMP, how an arrow is drawn.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from plcsim.program.structured_text.syntax.tree import StructuredTextFile
    from st_types.syntax.diagnostics import DiagnosticLog

_STEPS: Final = r"[ \t]*(?:\w+|\([^()\r\n]*\))[ \t]*"
_NAMED: Final = re.compile(
    rf"^([ \t]*TRANSITION\b)([^\r\n]*?)([ \t]FROM\b{_STEPS}\bTO\b{_STEPS}:=)", re.MULTILINE
)
_NOTE: Final = re.compile(r"\(\*[ \t]*@(\w+)[ \t]*:=[ \t]*'([^'\r\n]*)'[ \t]*\*\)")
_OF_THE_EDITOR: Final = frozenset(["SFCCOMMENT", "SFCISJUMP", "SFCNOJUMP"])
_LANGUAGES: Final = frozenset(["", "ST", "SFC"])


def parse_chart_file(source: Source) -> StructuredTextFile:
    """Parse a .sfc file; errors are in the ``diagnostics`` of the result."""
    text = _NAMED.sub(lambda match: f"{match[1]}{' ' * len(match[2])}{match[3]}", source.text)
    file = parse_structured_text(Source(source.path, text, source.encoding, source.mark))
    for note in _NOTE.finditer(source.text):
        _check_note(note, file.diagnostics)
    return file


def _check_note(note: re.Match[str], diagnostics: DiagnosticLog) -> None:
    """Tell of what a note asks for and is not there."""
    name, value, place = note[1].upper(), note[2].strip(), note.start()
    if name == "LANGUAGE":
        if value.upper() not in _LANGUAGES:
            message = f"a body in the language {value} is not supported in a chart"
            diagnostics.error(place, message, "write it in ST", FindingCode.NOT_SUPPORTED)
    elif name == "SFCMINTIME" and value:
        message = f"the least time of a step, {value}, is not supported"
        hint = "compare the time of the step in its transition: Step.T >= T#5s"
        diagnostics.error(place, message, hint, FindingCode.NOT_SUPPORTED)
    elif name == "SFCMAXTIME" and value:
        message = f"the most time of a step, {value}, is not supervised"
        diagnostics.warning(place, message, "", FindingCode.NOT_SUPPORTED)
    elif name.startswith("SFC") and name not in _OF_THE_EDITOR and value:
        message = f"@{note[1]} is not known"
        diagnostics.error(place, message, "", FindingCode.NOT_SUPPORTED)
