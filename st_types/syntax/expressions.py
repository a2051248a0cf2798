"""Expressions of Structured Text: syntax tree and parser.

Precedences, tightest first: ``**``, then ``-`` and NOT, ``* / MOD``, ``+ -``, ``< > <= >=``,
``= <>``, AND, XOR, OR (IEC 61131-3 edition 2, table 55; B&R's TM246 has the same order). Operators
of one precedence associate to the left. AND_THEN and OR_ELSE are AND and OR of CODESYS that leave
out what need not be evaluated. A stack holds the operands that wait for a looser operator, so only
what stands in brackets nests.

Nodes compare equal without regard to their place in the text. ``at`` is the number of a token;
the `Tokens` of the file know its place.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar, NoReturn

from st_types.syntax.lexer import NAME, KeyTable
from st_types.syntax.literals import TYPED_PREFIXES, Constant, LiteralError, parse_literal
from st_types.syntax.reader import TokenReader, UnexpectedTokenError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from st_types.syntax.diagnostics import DiagnosticLog
    from st_types.syntax.lexer import Keys, Tokens

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
    """An argument of a call: a value, ``name := value``, ``name => variable``, ``NOT name => ...``.

    ``value`` is None where nothing follows the sign.
    """

    name: str
    value: Expression | None
    is_output: bool = False
    is_negated: bool = False


@dataclass(slots=True)
class Call(Node):
    """``function(argument, ...)``."""

    function: Expression
    arguments: Sequence[Argument]


Expression = (
    Literal | Name | DirectAddress | Unary | Binary | MemberAccess | Index | Dereference | Call
)

PRECEDENCE = {
    **dict.fromkeys(["OR", "OR_ELSE"], 1),
    **dict.fromkeys(["XOR"], 2),
    **dict.fromkeys(["AND", "&", "AND_THEN"], 3),
    **dict.fromkeys(["=", "<>"], 4),
    **dict.fromkeys(["<", ">", "<=", ">="], 5),
    **dict.fromkeys(["+", "-"], 6),
    **dict.fromkeys(["*", "/", "MOD"], 7),
    "**": 9,
}
"""Binary operators; the unary ones have `UNARY_PRECEDENCE`."""

UNARY_PRECEDENCE = 8

POSTFIXES = frozenset([".", "[", "^", "("])
"""What may follow an operand: a member, an index, a dereference, arguments."""

_ENDS = frozenset([";", ",", ")", "]", "THEN", "DO", "OF", "TO", ".."])
_PREFIXES = frozenset(["-", "+", "NOT"])
_ARGUMENT_SIGNS = (":=", "=>")
FUNCTION_WORDS = frozenset(["AND", "OR", "XOR", "MOD"])
"""Operators that are functions, too: ``AND(a, b)``."""

_OPERATOR_WORDS = frozenset(["OR", "OR_ELSE", "XOR", "AND", "AND_THEN", "MOD", "NOT"])


class ExpressionParser(TokenReader):
    """Parses expressions; statement and declaration parsers build on it.

    Attributes:
        reserved: keywords that are no names of variables, whatever stands beside them.
        key_table: the keys of tokens; with the keywords of statements in the parser of those.
        keys: the keys of all tokens.
        postfixes: what may follow an operand here: arguments may not where ``(`` means another
            thing.
    """

    reserved: ClassVar[frozenset[str]] = _OPERATOR_WORDS
    key_table: ClassVar[KeyTable] = KeyTable(_OPERATOR_WORDS)

    def __init__(self, tokens: Tokens, diagnostics: DiagnosticLog) -> None:
        super().__init__(tokens, diagnostics)
        self.keys = self._keys()
        self.postfixes = POSTFIXES
        self._operators = 0

    def _keys(self) -> Keys:
        """Return the keys of all tokens; declarations ask for few of them."""
        return self.key_table.keys_when_asked(self.texts)

    def close(self, end: str, at: int) -> None:
        """Step over the keyword ``end`` of what begins at token ``at``, or tell that it misses."""
        if self.keys[self.index] == end:
            self.index += 1
            return
        line = self.tokens.location(at).line
        opened = self.texts[at].upper()
        self.tell(
            self.here(), f"expected {end} of the {opened} in line {line}, found {self.found()}"
        )

    def expression(self) -> Expression:
        """Parse one expression.

        Raises:
            UnexpectedTokenError: there is none here, or it is nested too deep or too long.
        """
        index = self.index
        keys = self.keys
        if keys[index + 1] in _ENDS:
            key = keys[index]
            if key == NAME:
                self.index = index + 1
                return Name(index, self.texts[index])
            if key == "literal":
                return self.literal(self.texts[index])
        self._operators = 0
        return self._operation()

    def _operation(self) -> Expression:
        """Parse operands and the operators between them.

        Operands of one token are taken here, as most are; a call for each would cost as much
        as the rest.
        """
        keys, texts, postfixes = self.keys, self.texts, self.postfixes
        precedences = PRECEDENCE
        waiting: list[tuple[int, int, Expression]] = []  # precedence, operator, left operand
        index = self.index
        while True:
            key = keys[index]
            if key == NAME and keys[index + 1] not in postfixes:
                left: Expression = Name(index, texts[index])
                index += 1
            else:
                self.index = index
                left = self.literal(texts[index]) if key == "literal" else self._operand()
                index = self.index
            precedence = precedences.get(keys[index], 0)
            while waiting and waiting[-1][0] >= precedence:
                _, at, first = waiting.pop()
                operator = keys[at]
                left = Binary(at, "AND" if operator == "&" else operator, first, left)
            self.index = index
            if not precedence:
                return left
            self._operators += 1
            if self._operators > MAX_OPERATORS:
                self._fail_operators()
            waiting.append((precedence, index, left))
            index += 1

    def _fail_operators(self) -> NoReturn:
        self.fail(f"expected at most {MAX_OPERATORS} operators in an expression")

    def _step(self) -> int:
        self._operators += 1
        if self._operators > MAX_OPERATORS:
            self._fail_operators()
        self.index += 1
        return self.index - 1

    def _operand(self) -> Expression:
        at = self.index
        keys = self.keys
        key = keys[at]
        if key == NAME:
            self.index = at + 1
            name = Name(at, self.texts[at])
            return self.postfix(name) if keys[at + 1] in self.postfixes else name
        if key == "literal":
            return self.literal(self.texts[at])
        if key in _PREFIXES:
            return self._prefix(key)
        if key == "(":
            return self.postfix(self._parenthesised())
        return self._rare_operand(key)

    def _prefix(self, operator: str) -> Expression:
        at = self._step()
        self.enter()
        operand = self._operand()
        while self.keys[self.index] == "**":
            operand = Binary(self._step(), "**", operand, self._operand())
        self.leave()
        return Unary(at, operator, operand)

    def _rare_operand(self, key: str) -> Expression:
        at = self.index
        text = self.texts[at]
        if key == "address":
            self.index += 1
            return DirectAddress(at, text)
        if key == "." and self.texts[at + 1][:1].isdecimal() and not self.tokens.trivia[at + 1]:
            self.index += 1
            return self.literal(f".{self.text}")
        is_call = key in FUNCTION_WORDS and self.keys[at + 1] == "("
        is_name = key == text.upper() and text.isidentifier() and key not in self.reserved
        if not is_name and not is_call:
            self.fail("expected a value")
        self.index += 1
        return self.postfix(Name(at, text))  # a keyword as a name

    def _parenthesised(self) -> Expression:
        at = self._step()
        self.enter()
        inner = self._operation()
        self.leave()
        self.expect(")", "to close the parenthesis")
        self.tokens.parentheses[at] = inner.at
        return inner

    def literal(self, text: str) -> Expression:
        """Step over the last token of the literal ``text``.

        ``Type#Name`` is a value of an enumeration.

        Raises:
            UnexpectedTokenError: it is malformed.
        """
        index = self.index
        try:
            constant = parse_literal(text)
        except LiteralError as err:
            return self._typed_value(text, err)
        self.index = index + 1
        return Literal(index, text, constant)

    def _typed_value(self, text: str, error: LiteralError) -> Expression:
        prefix, _, name = text.partition("#")
        is_value = name.isidentifier() and prefix.isidentifier()
        if not is_value or prefix.upper() in TYPED_PREFIXES:
            raise UnexpectedTokenError(self.tokens.offset(self.index), str(error)) from None
        self.index += 1
        return MemberAccess(self.index - 1, Name(self.index - 1, prefix), name)

    def postfix(self, base: Expression) -> Expression:
        """Parse the members, indices, ``^`` and arguments that follow ``base``."""
        keys = self.keys
        index = start = self.index
        postfixes = self.postfixes
        while (key := keys[index]) in postfixes:
            if key == "." and keys[index + 1] == NAME:
                base = MemberAccess(index + 1, base, self.texts[index + 1])
                index += 2
            else:
                self.index = index
                base = self._rare_postfix(key, base)
                index = self.index
            if index - start > MAX_OPERATORS:
                self.fail(f"expected at most {MAX_OPERATORS} tokens in a path")
        self.index = index
        return base

    def _rare_postfix(self, key: str, base: Expression) -> Expression:
        if key == ".":
            return self._member(base)
        if key == "[":
            return self._index(base)
        if key == "(":
            return self._call(base)
        return Dereference(self._step(), base)

    def _member(self, base: Expression) -> Expression:
        at = self._step() + 1
        text = self.texts[at]
        if not is_member(text):
            self.fail("expected the name of a member or the number of a bit after '.'")
        self.index = at + 1
        return MemberAccess(at, base, text)

    def _index(self, base: Expression) -> Expression:
        at = self._step()
        self.enter()
        indices = [self._operation()]
        while self.accept(","):
            indices.append(self._operation())
        self.leave()
        self.expect("]", "to close the index")
        return Index(at, base, indices)

    def _call(self, base: Expression) -> Expression:
        at = self._step()
        return Call(at, base, self._arguments())

    def _arguments(self) -> list[Argument]:
        """Parse arguments and the bracket behind them."""
        self.enter()
        arguments: list[Argument] = []
        while not self.accept(")"):
            if arguments:
                self.expect(",", "or ')' after an argument")
                if self.accept(")"):
                    break
            arguments.append(self._argument())
        self.leave()
        return arguments

    def _argument(self) -> Argument:
        at = self.index
        keys = self.keys
        is_negated = keys[at] == "NOT" and keys[at + 2] == "=>"
        if is_negated:
            at += 1
        sign = keys[at + 1]
        if sign not in _ARGUMENT_SIGNS or not self.texts[at].isidentifier():
            return Argument(at, "", self._operation())
        self.index = at + 2
        value = None if keys[self.index] in (",", ")") else self._operation()
        return Argument(at, self.texts[at], value, sign == "=>", is_negated)


def is_member(text: str) -> bool:
    """Return True for what may follow a dot: a name, the number of a bit, ``%X3``."""
    return text.isascii() and (text.isidentifier() or text.isdecimal() or text[:1] == "%")
