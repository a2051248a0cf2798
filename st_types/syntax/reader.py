"""Reading tokens one after another: what every parser of this package shares."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NoReturn

from st_types.syntax.lexer import TokenKind, is_open_string, kind_of
from st_types.syntax.trivia import open_comment

if TYPE_CHECKING:
    from st_types.syntax.diagnostics import DiagnosticLog
    from st_types.syntax.lexer import Tokens

MAX_DEPTH = 100
"""Deepest nesting of operands, types and initial values; real files stay below 20."""

NAMED_TOKEN_LENGTH = 40
"""Longest token that a message repeats."""


class UnexpectedTokenError(Exception):
    """Leaves the rule that cannot go on; the parser catches it where it can go on.

    Attributes:
        offset: place in the text.
        message: what was expected.
        hint: may be empty.
    """

    def __init__(self, offset: int, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.offset = offset
        self.message = message
        self.hint = hint


FOREIGN_SIGNS: Final = {
    "=": "'=' compares, ':=' assigns",
    "!": "'<>' compares for unequal, NOT negates",
    "&": "'&' and AND are one",
    "|": "OR is written OR",
    "%": "the rest of a division is written MOD",
}
"""What to write for the signs of other languages."""


class TokenReader:
    """A place in a list of tokens.

    Attributes:
        tokens: all tokens of the file.
        texts: their texts, for speed.
        index: number of the next token.
        diagnostics: takes the findings.
        depth: levels of nesting that are open.
    """

    def __init__(self, tokens: Tokens, diagnostics: DiagnosticLog) -> None:
        self.tokens = tokens
        self.texts = tokens.texts
        self.index = 0
        self.diagnostics = diagnostics
        self.depth = 0
        self._told = -1

    @property
    def text(self) -> str:
        """The next token, empty at the end of the text."""
        return self.texts[self.index]

    @property
    def keyword(self) -> str:
        """The next token in capitals."""
        return self.texts[self.index].upper()

    def accept(self, text: str) -> bool:
        """Step over the next token if it is ``text`` (an operator or a keyword in capitals)."""
        found = self.texts[self.index]
        if found != text and found.upper() != text:
            return False
        self.index += 1
        return True

    def expect(self, text: str, context: str) -> int:
        """Step over ``text`` and return its number.

        Args:
            text: an operator or a keyword in capitals.
            context: completes "expected 'x' ...", such as "after the name".

        Raises:
            UnexpectedTokenError: the next token is another one.
        """
        found = self.texts[self.index]
        if found != text and found.upper() != text:
            if text.isidentifier():
                self.fail(f"expected '{text}' {context}")
            self.fail_before(f"expected '{text}' {context}")
        self.index += 1
        return self.index - 1

    def expect_name(self, context: str) -> str:
        """Step over an identifier and return it.

        Raises:
            UnexpectedTokenError: the next token is none.
        """
        text = self.texts[self.index]
        if kind_of(text) is not TokenKind.IDENTIFIER:
            self.fail(f"expected a name {context}")
        self.index += 1
        return text

    def tell(self, offset: int, message: str, hint: str = "") -> None:
        """Record an error, unless it only follows from another one.

        That is one at the same place, and what is missing behind a comment that is never closed:
        the parser of a file tells of the comment.
        """
        is_lost = not self.text and open_comment(self.tokens.trivia[self.index]) is not None
        if offset != self._told and not is_lost:
            self._told = offset
            self.diagnostics.error(offset, message, hint)

    def fail(self, expected: str, hint: str = "") -> NoReturn:
        """Give up at the next token: ``expected`` says what should stand in its place.

        Raises:
            UnexpectedTokenError: always.
        """
        hint = hint or FOREIGN_SIGNS.get(self.text, "")
        raise UnexpectedTokenError(self.here(), f"{expected}, found {self.found()}", hint)

    def fail_before(self, expected: str) -> NoReturn:
        """Give up as `fail` does, where ``expected`` should stand before the next token.

        Something forgotten at the end of a line is shown there, not at the start of the next one.

        Raises:
            UnexpectedTokenError: always.
        """
        trivia = self.tokens.trivia[self.index]
        if self.index and ("\n" in trivia or "\r" in trivia):
            offset = self.tokens.end_offset(self.index - 1)
            raise UnexpectedTokenError(offset, f"{expected}, found {self.found()}")
        self.fail(expected)

    def found(self) -> str:
        """Return the next token as a message names it."""
        text = self.texts[self.index]
        if not text:
            return "the end of the file"
        if kind_of(text) is TokenKind.UNKNOWN and is_open_string(text):
            return "a string that is not closed on its line"
        shown = text if len(text) <= NAMED_TOKEN_LENGTH else text[:NAMED_TOKEN_LENGTH] + "..."
        return f"'{shown}'" if shown.isprintable() else f"the character U+{ord(shown[0]):04X}"

    def here(self) -> int:
        """Return the offset of the next token, at the end of the text that of its end."""
        if self.index and not self.texts[self.index]:
            return self.tokens.end_offset(self.index - 1)
        return self.tokens.offset(self.index)

    def enter(self) -> None:
        """Count one level of nesting; `leave` ends it, and so does setting ``depth`` back.

        Raises:
            UnexpectedTokenError: there are more than `MAX_DEPTH` levels.
        """
        self.depth += 1
        if self.depth > MAX_DEPTH:
            self.fail(f"expected at most {MAX_DEPTH} levels of nesting")

    def leave(self) -> None:
        """End one level of nesting."""
        self.depth -= 1
