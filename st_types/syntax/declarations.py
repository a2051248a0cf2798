"""Parser of .typ, .var and .fun files.

It accepts what Automation Studio accepts, and some forms beyond that which change nothing: runs of
semicolons, a forgotten one before an END keyword, ``a, b : INT``, any keyword as a name where a
colon follows. After an error it goes on at the next declaration, so that one run finds them all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.syntax.collector import collector_paused
from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.lexer import MAX_TOKENS, TokenKind, Tokens, kind_of, unnest_comments
from st_types.syntax.reader import UnexpectedTokenError
from st_types.syntax.source import Source
from st_types.syntax.specifications import ITEM_KEYWORDS, VARIABLE_SECTIONS, SpecificationParser
from st_types.syntax.tree import (
    DeclarationFile,
    FunctionBlockDeclaration,
    FunctionDeclaration,
    Item,
    TypeBlock,
    VariableBlock,
)
from st_types.syntax.trivia import open_comment, pragmas_in

if TYPE_CHECKING:
    from collections.abc import Callable

    from st_types.syntax.tree import Declaration

UNSUPPORTED = frozenset(["CLASS", "INTERFACE", "NAMESPACE", "METHOD", "PROPERTY"])
"""What IEC 61131-3 edition 3 and its followers have besides, up to ``END_CLASS`` and so on."""

QUALIFIERS = frozenset(
    [
        *("CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT", "PERMANENT"),
        *("PUBLIC", "PRIVATE", "PROTECTED", "INTERNAL"),
    ]
)
"""Words that may follow VAR, VAR_INPUT and so on."""


def parse_declarations(source: Source) -> DeclarationFile:
    """Parse the text of a .typ, .var or .fun file.

    Errors are in the ``diagnostics`` of the result, whose ``raise_errors`` makes an exception of
    them.
    """
    with collector_paused():
        first = _parse(source)
    if not first.diagnostics.error_count or (text := unnest_comments(source.text)) is None:
        return first
    second = _parse(Source(source.path, text, source.encoding, source.mark))
    return second if second.diagnostics.error_count < first.diagnostics.error_count else first


def parse_text(text: str, path: str = "<text>") -> DeclarationFile:
    """Parse declarations from a string.

    Raises:
        SourceError: there are errors; it has them all.
    """
    file = parse_declarations(Source(path, text))
    file.diagnostics.raise_errors()
    return file


def _parse(source: Source) -> DeclarationFile:
    return DeclarationParser(Tokens(source), DiagnosticLog(source)).file()


class DeclarationParser(SpecificationParser):
    """Parses the blocks of a declaration file."""

    def file(self) -> DeclarationFile:
        """Parse the whole file; errors go to ``diagnostics``."""
        items: list[Item] = []
        while self.text:
            start = self.index
            try:
                items += self._items()
            except UnexpectedTokenError as err:
                self.tell(err.offset, err.message, err.hint)
                self._skip_to_item(start)
        self._check_end()
        return DeclarationFile(items, self.trivia[self.index], self.tokens, self.diagnostics)

    def _skip_to_item(self, start: int) -> None:
        self.depth = 0
        self.index = max(self.index, start + 1)
        while self.text and (
            self.keyword not in ITEM_KEYWORDS or self.texts[self.index + 1] == ":"
        ):
            self.index += 1

    def _check_end(self) -> None:
        trivia = self.trivia[self.index]
        if (opened := open_comment(trivia)) is not None:
            start = self.tokens.offset(self.index) - len(trivia) + opened
            self.diagnostics.error(start, "the comment that starts here is never closed")
        if self.tokens.truncated:
            message = f"the file has more than {MAX_TOKENS} tokens; the rest is not read"
            self.diagnostics.error(self.tokens.offset(self.index), message)

    def _items(self) -> list[Item]:
        keyword = self.keyword
        if keyword == ";":
            self.index += 1
            return []
        if kind_of(keyword) is TokenKind.DIRECTIVE:
            self.diagnostics.warning(
                self.tokens.offset(self.index), "the preprocessor line is ignored"
            )
            self.index += 1
            return []
        rule = _ITEM_RULES.get(keyword)
        if rule is None and keyword in UNSUPPORTED:
            self._refuse(keyword)
            return []
        if rule is None:
            hint = "a pragma ends with '}'" if keyword == "{" else ""
            self.fail("expected TYPE, VAR, FUNCTION or FUNCTION_BLOCK", hint)
        return [rule(self)]

    def _refuse(self, keyword: str) -> None:
        """Log an error at a construct that is not supported, and step over its end."""
        self.diagnostics.error(self.here(), f"{keyword} is not supported here")
        self.skip_behind(f"END_{keyword}")

    def _type_block(self) -> TypeBlock:
        at = self.index
        self.index += 1
        declarations = self.declarations("END_TYPE")
        return TypeBlock(at, declarations, self.trivia[at], self._closing(at))

    def _closing(self, at: int) -> str:
        """Return the comments before the END keyword that was just stepped over."""
        return self.trivia[max(at + 1, self.index - 1)]

    def _variable_block(self) -> VariableBlock:
        at = self.index
        self.index += 1
        qualifiers = self._qualifiers()
        is_used = self.texts[at].upper() != "VAR_CONFIG"
        declarations = self.declarations("END_VAR") if is_used else self._unused()
        section, before = self.texts[at].upper(), self.trivia[at]
        pragmas = pragmas_in(before)
        closing = self._closing(at)
        return VariableBlock(at, section, qualifiers, declarations, pragmas, before, closing)

    def _unused(self) -> list[Declaration]:
        """Step over a VAR_CONFIG, whose names have parts: it says where variables lie."""
        message = "VAR_CONFIG is not used: a variable AT an address is one like any other"
        self.diagnostics.warning(self.tokens.offset(self.index - 1), message)
        self.index -= 1
        self.skip_behind("END_VAR")
        return []

    def _qualifiers(self) -> tuple[str, ...]:
        start = self.index
        while self.keyword in QUALIFIERS and not self.is_name():
            self.index += 1
        return tuple(text.upper() for text in self.texts[start : self.index])

    def _function_block(self) -> FunctionBlockDeclaration:
        at = self.index
        self.index += 1
        name = self.expect_name("after FUNCTION_BLOCK")
        behind = self.trivia[self.index]
        blocks = self._blocks(name, "END_FUNCTION_BLOCK")
        pragmas, closing = pragmas_in(self.trivia[at]), self._closing(at)
        return FunctionBlockDeclaration(
            at + 1, name, blocks, pragmas, self.trivia[at], behind, closing
        )

    def _function(self) -> FunctionDeclaration:
        at = self.index
        self.index += 1
        name = self.expect_name("after FUNCTION")
        result = self.specification() if self.accept(":") else None
        behind = self.trivia[self.index]
        blocks = self._blocks(name, "END_FUNCTION")
        pragmas, closing = pragmas_in(self.trivia[at]), self._closing(at)
        return FunctionDeclaration(
            at + 1, name, result, blocks, pragmas, self.trivia[at], behind, closing
        )

    def _blocks(self, name: str, end: str) -> list[VariableBlock]:
        """Parse the VAR blocks of ``name`` in any order, and step over the keyword ``end``."""
        blocks: list[VariableBlock] = []
        while not self.accept(end):
            if self.keyword in VARIABLE_SECTIONS:
                blocks.append(self._variable_block())
            elif self.keyword in UNSUPPORTED:
                self._refuse(self.keyword)
            elif not self.accept(";"):
                self.fail(f"expected VAR or {end} in {name}")
        return blocks


_ITEM_RULES: dict[str, Callable[[DeclarationParser], Item]] = {
    "TYPE": DeclarationParser._type_block,
    "FUNCTION_BLOCK": DeclarationParser._function_block,
    "FUNCTION": DeclarationParser._function,
    **dict.fromkeys(VARIABLE_SECTIONS, DeclarationParser._variable_block),
}
