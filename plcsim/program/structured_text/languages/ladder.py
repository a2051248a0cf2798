"""Files of Automation Studio's Ladder Diagram: units around networks in XML."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from plcsim.library.document import DocumentError, parse
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.languages.ladder_networks import NetworkReader
from plcsim.program.structured_text.languages.ladder_rungs import NetworkStatements
from plcsim.program.structured_text.languages.placed import OperandParser, PlacedTokens
from plcsim.program.structured_text.syntax.tree import (
    ActionUnit,
    FunctionBlockUnit,
    FunctionUnit,
    ProgramUnit,
    StructuredTextFile,
)
from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.tree import FunctionBlockDeclaration, FunctionDeclaration

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.program.structured_text.languages.ladder_networks import LadderNetwork
    from plcsim.program.structured_text.syntax.tree import Statement, Unit
    from st_types.syntax.source import Source

_KEYWORDS: Final = "PROGRAM|FUNCTION_BLOCK|FUNCTION|ACTION"
_HEADER: Final = re.compile(
    rf"^[ \t\ufeff]*({_KEYWORDS})[ \t]+(\w+)[ \t]*:?", re.IGNORECASE | re.MULTILINE
)
_END: Final = re.compile(rf">\s*(END_(?:{_KEYWORDS}))\b", re.IGNORECASE)
_COMMENT: Final = re.compile(r"\(\*.*?\*\)|//[^\r\n]*|\s+|\ufeff", re.DOTALL)


def read_ladder(source: Source) -> StructuredTextFile:
    """Read a file of a Ladder Diagram; what is wrong is in its ``diagnostics``."""
    reader = _LadderReader(source)
    units = reader.units()
    return StructuredTextFile(units, reader.parser.tokens, reader.diagnostics)


class _LadderReader:
    """Reads one file: the networks of all units first, then what they do."""

    def __init__(self, source: Source) -> None:
        self._text = source.text
        self.diagnostics = DiagnosticLog(source, FindingCode.SYNTAX)
        self._tokens = PlacedTokens(source)
        self._read = [*self._headers()]
        self.parser = OperandParser(self._tokens.finish(), self.diagnostics)

    def units(self) -> list[Unit]:
        """Return the units of the file."""
        found = []
        for keyword, name, at, networks in self._read:
            body: list[Statement] = []
            for network in networks:
                body += NetworkStatements(network, self.parser).statements()
            found.append(_unit(keyword, name, at, body))
        return found

    def _headers(self) -> Iterator[tuple[str, str, int, list[LadderNetwork]]]:
        """Yield keyword, name, token of the name, and networks of each unit."""
        text, offset = self._text, 0
        while (header := _HEADER.search(text, offset)) is not None:
            self._check_blank(offset, header.start())
            end = _END.search(text, header.end())
            if end is None:
                message = f"expected END_{header[1].upper()} behind the networks"
                self.diagnostics.error(header.start(1), message)
                return
            at = self._tokens.mark(header.start(2), header[2])
            networks = self._networks(header.end(), end.start() + 1)
            yield header[1].upper(), header[2], at, networks
            if end[1].upper() != f"END_{header[1].upper()}":
                self.diagnostics.error(end.start(1), f"expected END_{header[1].upper()}")
            offset = end.end()
        self._check_blank(offset, len(text))

    def _check_blank(self, start: int, end: int) -> None:
        """Tell where something else than comments stands between units."""
        offset = start
        while offset < end and (match := _COMMENT.match(self._text, offset, end)) is not None:
            offset = match.end()
        if offset < end:
            hint = "a file of Ladder Diagram holds PROGRAM, FUNCTION_BLOCK, FUNCTION or ACTION"
            self.diagnostics.error(offset, "expected a unit", hint)

    def _networks(self, start: int, end: int) -> list[LadderNetwork]:
        """Read the XML of a unit; comments may stand before it."""
        text = self._text
        while (match := _COMMENT.match(text, start, end)) is not None:
            start = match.end()
        try:
            root = parse(text[start:end].encode("utf-8", "replace"), "UTF-8")
        except DocumentError as err:
            place = self.diagnostics.source.location(start).line - 1 + max(err.line, 1)
            starts = self.diagnostics.source.line_starts
            offset = max(start, starts[min(place, len(starts)) - 1])
            self.diagnostics.error(offset, str(err))
            return []
        return [*NetworkReader(text, start, self._tokens, self.diagnostics).networks(root)]


def _unit(keyword: str, name: str, at: int, body: Sequence[Statement]) -> Unit:
    """Return a unit as the parser of Structured Text makes it."""
    if keyword == "PROGRAM":
        return ProgramUnit(at, name, [], body)
    if keyword == "ACTION":
        return ActionUnit(at, name, body)
    if keyword == "FUNCTION":
        return FunctionUnit(at, FunctionDeclaration(at, name, None, []), body)
    return FunctionBlockUnit(at, FunctionBlockDeclaration(at, name, []), body)
