"""Parser of Structured Text files: text in, syntax tree and findings out."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.syntax.preprocessor import preprocess
from plcsim.program.structured_text.syntax.tree import StructuredTextFile
from plcsim.program.structured_text.syntax.twincat import is_twincat, text_of
from plcsim.program.structured_text.syntax.units import UnitParser
from st_types.syntax.collector import collector_paused
from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.lexer import Tokens, unnest_comments
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from collections.abc import Mapping

NO_DEFINES: Final[Mapping[str, str]] = {}
"""No macros."""


def parse_structured_text(
    source: Source,
    defines: Mapping[str, str] = NO_DEFINES,
    parser_class: type[UnitParser] = UnitParser,
) -> StructuredTextFile:
    """Parse the text of a file of Structured Text.

    Errors are in the ``diagnostics`` of the result, whose ``raise_errors`` makes an exception of
    them.

    Args:
        source: the text.
        defines: macros that are defined before the first line, each with its replacement.
        parser_class: parses the units; one of another language has bodies of its own.
    """
    if not is_text(source.text):
        diagnostics = DiagnosticLog(source, FindingCode.SYNTAX)
        diagnostics.error(
            0, "the file is no text", "it is encrypted, binary, or UTF-16 without BOM"
        )
        return StructuredTextFile([], Tokens(Source(source.path, "")), diagnostics)
    if is_twincat(source.text):
        source = Source(source.path, text_of(source.text), source.encoding, source.mark)
    elif _XML.match(source.text):
        diagnostics = DiagnosticLog(source, FindingCode.SYNTAX)
        hint = "TwinCAT's .TcPOU, .TcGVL, .TcDUT and .TcIO are read; export others as text"
        diagnostics.error(0, "the file is XML", hint)
        return StructuredTextFile([], Tokens(Source(source.path, "")), diagnostics)
    with collector_paused():
        first = _parse(source, defines, parser_class)
        if not first.diagnostics.error_count or (text := unnest_comments(source.text)) is None:
            return first
        unnested = Source(source.path, text, source.encoding, source.mark)
        second = _parse(unnested, defines, parser_class)
    return second if second.diagnostics.error_count < first.diagnostics.error_count else first


SAMPLE = 4096
"""Characters at the start of a file that tell whether it is text."""

_XML = re.compile(r"\s*<\?xml\b")
_CONTROLS = re.compile(r"[\0-\x08\x0e-\x19\x1b-\x1f]")


def is_text(text: str) -> bool:
    """Return False for what is encrypted, compiled or UTF-16 without a byte order mark.

    Those are full of control characters; a text may hold some by mistake.
    """
    sample = text[:SAMPLE]
    return len(_CONTROLS.findall(sample)) * 20 <= len(sample)


def _parse(
    source: Source, defines: Mapping[str, str], parser_class: type[UnitParser]
) -> StructuredTextFile:
    diagnostics = DiagnosticLog(source, FindingCode.SYNTAX)
    tokens = Tokens(source)
    parser = parser_class(tokens, diagnostics)
    if defines or ("#" in source.text and "directive" in parser.keys):
        preprocess(tokens, defines, diagnostics)
        parser = parser_class(tokens, diagnostics)
    file = parser.structured_text_file()
    diagnostics.code = FindingCode.DECLARATION
    return file
