"""Expressions of Structured Text: syntax tree and parser.

The parser climbs precedences, tightest first: ``**``, then ``-`` and NOT, ``* / MOD``, ``+ -``,
``< > <= >=``, ``= <>``, AND, XOR, OR (IEC 61131-3 edition 2, table 55; B&R's TM246 has the same
order). Operators of one precedence associate to the left.

Nodes compare equal without regard to their place in the text. ``at`` is the number of a token;
the `Tokens` of the file know its place.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from st_types.syntax.lexer import TokenKind, kind_of
from st_types.syntax.literals import (
    MAX_DIGITS,
    TYPED_PREFIXES,
    Constant,
    LiteralError,
    parse_literal,
)
from st_types.syntax.reader import TokenReader, UnexpectedTokenError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

MAX_OPERATORS = 400
"""Most operators, brackets and parts of a path in one expression; bounds the depth of its tree."""


@dataclass(slots=True)
class Node:
    """A node of a syntax tree; ``at`` is the number of its first or its naming token."""

    at: int = field(compare=False)


@dataclass(slots=True)
class Literal(Node):
    """A literal as it is written, and its value."""

    text: str
    constant: Constant = field(compare=False)


@dataclass(slots=True)
class Name(Node):
    """A variable, a constant, an enumeration value, a function."""

    name: str


@dataclass(slots=True)
class DirectAddress(Node):
    """An address such as ``%IX0.1``."""

    text: str


@dataclass(slots=True)
class Unary(Node):
    """``-``, ``+`` or ``NOT`` before an operand."""

    operator: str
    operand: Expression


@dataclass(slots=True)
class Binary(Node):
    """Two operands; the operator is in capitals, ``&`` is AND."""

    operator: str
    left: Expression
    right: Expression


@dataclass(slots=True)
class MemberAccess(Node):
    """``base.name``; a name of digits is the access to one bit."""

    base: Expression
    name: str


@dataclass(slots=True)
class Index(Node):
    """``base[index, ...]``."""

    base: Expression
    indices: Sequence[Expression]


@dataclass(slots=True)
class Dereference(Node):
    """``base^``."""

    base: Expression


@dataclass(slots=True)
class Argument(Node):
    """An argument of a call: a value, ``name := value`` or ``name => variable``."""

    name: str
    value: Expression | None
    is_output: bool = False


@dataclass(slots=True)
class Call(Node):
    """``function(argument, ...)``."""

    function: Expression
    arguments: Sequence[Argument]


Expression = (
    Literal | Name | DirectAddress | Unary | Binary | MemberAccess | Index | Dereference | Call
)

PRECEDENCE = {
    **dict.fromkeys(["OR"], 1),
    **dict.fromkeys(["XOR"], 2),
    **dict.fromkeys(["AND", "&"], 3),
    **dict.fromkeys(["=", "<>"], 4),
    **dict.fromkeys(["<", ">", "<=", ">="], 5),
    **dict.fromkeys(["+", "-"], 6),
    **dict.fromkeys(["*", "/", "MOD"], 7),
    "**": 9,
}
"""Binary operators; the unary ones have `UNARY_PRECEDENCE`."""

UNARY_PRECEDENCE = 8


_ENDS = frozenset([";", ",", "]", ")", ".."])
_TRUTH_VALUES = frozenset(["TRUE", "FALSE"])
_PREFIX_OPERATORS = frozenset(["-", "+", "NOT"])


class ExpressionParser(TokenReader):
    """Parses expressions; statement and declaration parsers build on it."""

    _operators = 0

    def expression(self) -> Expression:
        """Parse one expression.

        Raises:
            UnexpectedTokenError: there is none here, or it is nested too deep or too long.
        """
        index = self.index
        if self.texts[index + 1] in _ENDS:
            text = self.texts[index]
            if text.isdecimal() and text.isascii() and len(text) <= MAX_DIGITS:
                self.index = index + 1
                return Literal(index, text, parse_literal(text))
            if text.isidentifier() and text.isascii() and text.upper() not in _TRUTH_VALUES:
                self.index = index + 1
                return Name(index, text)
        self._operators = 0
        return self._binary(0)

    def _binary(self, minimum: int) -> Expression:
        self.enter()
        left = self._unary()
        while (precedence := PRECEDENCE.get(self.keyword, 0)) > minimum:
            operator = self.keyword
            at = self._step()
            left = Binary(
                at, "AND" if operator == "&" else operator, left, self._binary(precedence)
            )
        self.leave()
        return left

    def _step(self) -> int:
        self._operators += 1
        if self._operators > MAX_OPERATORS:
            self.fail(f"expected at most {MAX_OPERATORS} operators in an expression")
        self.index += 1
        return self.index - 1

    def _unary(self) -> Expression:
        operator = self.keyword
        if operator in _PREFIX_OPERATORS:
            return Unary(self._step(), operator, self._binary(UNARY_PRECEDENCE))
        takes_postfix = kind_of(self.text) in (TokenKind.IDENTIFIER, TokenKind.OPERATOR)
        operand = self._primary()
        return self._postfix(operand) if takes_postfix else operand

    def _primary(self) -> Expression:
        at, text = self.index, self.text
        if text == "(":
            return self._parenthesised()
        kind = kind_of(text)
        if kind is TokenKind.LITERAL or text.upper() in _TRUTH_VALUES:
            return self.literal(text)
        if text == "." and self.texts[at + 1][:1].isdecimal() and not self.tokens.trivia[at + 1]:
            self.index += 1
            return self.literal(f".{self.text}")
        if kind not in (TokenKind.IDENTIFIER, TokenKind.ADDRESS):
            self.fail("expected a value")
        self.index += 1
        return Name(at, text) if kind is TokenKind.IDENTIFIER else DirectAddress(at, text)

    def _parenthesised(self) -> Expression:
        self._step()
        inner = self._binary(0)
        self.expect(")", "to close the parenthesis")
        return inner

    def literal(self, text: str) -> Expression:
        """Step over the last token of the literal ``text``.

        ``Type#Name`` is a value of an enumeration.

        Raises:
            UnexpectedTokenError: it is malformed.
        """
        prefix, _, name = text.partition("#")
        if name.isidentifier() and prefix.upper() not in TYPED_PREFIXES and prefix.isidentifier():
            self.index += 1
            return MemberAccess(self.index - 1, Name(self.index - 1, prefix), name)
        try:
            constant = parse_literal(text)
        except LiteralError as err:
            offset = self.tokens.offset(self.index)
            raise UnexpectedTokenError(offset, str(err)) from None
        self.index += 1
        return Literal(self.index - 1, text, constant)

    def _postfix(self, base: Expression) -> Expression:
        while self.text in _POSTFIX_RULES:
            base = _POSTFIX_RULES[self.text](self, base)
        return base

    def _member(self, base: Expression) -> Expression:
        self._step()
        text = self.text
        if not (text.isdecimal() and text.isascii()) and kind_of(text) is not TokenKind.IDENTIFIER:
            self.fail("expected the name of a member or the number of a bit after '.'")
        self.index += 1
        return MemberAccess(self.index - 1, base, text)

    def _index(self, base: Expression) -> Expression:
        at = self._step()
        indices = [self._binary(0)]
        while self.accept(","):
            indices.append(self._binary(0))
        self.expect("]", "to close the index")
        return Index(at, base, indices)

    def _dereference(self, base: Expression) -> Expression:
        return Dereference(self._step(), base)

    def _call(self, base: Expression) -> Expression:
        return Call(self._step(), base, self._arguments())

    def _arguments(self) -> list[Argument]:
        arguments: list[Argument] = []
        while not self.accept(")"):
            if arguments:
                self.expect(",", "or ')' after an argument")
            arguments.append(self._argument())
        return arguments

    def _argument(self) -> Argument:
        at, name = self.index, self.text
        sign = self.texts[at + 1]
        if sign not in (":=", "=>") or kind_of(name) is not TokenKind.IDENTIFIER:
            return Argument(at, "", self._binary(0))
        self.index += 2
        is_empty = self.text in (",", ")")
        return Argument(at, name, None if is_empty else self._binary(0), sign == "=>")


_POSTFIX_RULES: dict[str, Callable[[ExpressionParser, Expression], Expression]] = {
    ".": ExpressionParser._member,
    "[": ExpressionParser._index,
    "^": ExpressionParser._dereference,
    "(": ExpressionParser._call,
}
