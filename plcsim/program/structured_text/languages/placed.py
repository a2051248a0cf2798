"""Tokens of a text that is not Structured Text, each placed where it stands in its file.

Nodes of the tree name tokens by their numbers. Operands that stand in attributes of XML are cut
into tokens here, and parsed as expressions when all tokens of the file are known.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text.syntax.statements import StatementParser
from st_types.syntax.lexer import Tokens
from st_types.syntax.reader import UnexpectedTokenError
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from st_types.syntax.expressions import Expression

END = ";"
"""Stands behind each operand, so that an expression ends with it."""


class PlacedTokens:
    """Collects the tokens of a file.

    Args:
        source: the file.
    """

    def __init__(self, source: Source) -> None:
        self._source = source
        self._found: list[tuple[int, str]] = []

    def mark(self, offset: int, text: str = END) -> int:
        """Add a token and return its number."""
        self._found.append((offset, text))
        return len(self._found) - 1

    def operand(self, offset: int, text: str) -> int:
        """Add the tokens of an expression and return the number of the first.

        Args:
            offset: of the text in the file.
            text: as it is meant; where the file spells it otherwise (``&gt;``), all its tokens are
                placed at its start.
        """
        first = len(self._found)
        tokens = Tokens(Source("", text))
        is_spelled = self._source.text.startswith(text, offset)
        for number, token in enumerate(tokens.texts[: tokens.end]):
            self.mark(offset + tokens.offset(number) if is_spelled else offset, token)
        self.mark(offset + len(text) if is_spelled else offset)
        return first

    def finish(self) -> Tokens:
        """Return the tokens of the file."""
        return Tokens.placed(self._source, self._found)


class OperandParser(StatementParser):
    """Parses the operands of a file by the numbers of their first tokens."""

    def operand(self, at: int) -> Expression | None:
        """Return the expression that begins with a token, None where it is wrong, which is told."""
        self.index, self.depth = at, 0
        try:
            found = self.expression()
            if self.text != END:
                self.fail("expected an operator or the end of the operand")
        except UnexpectedTokenError as err:
            self.tell(err.offset, err.message, err.hint)
            return None
        return found
