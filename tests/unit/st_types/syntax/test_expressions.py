from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.expressions import (
    MAX_OPERATORS,
    Argument,
    Binary,
    Call,
    Dereference,
    DirectAddress,
    Expression,
    ExpressionParser,
    Index,
    Literal,
    MemberAccess,
    Name,
    Unary,
)
from st_types.syntax.lexer import Tokens
from st_types.syntax.literals import parse_literal
from st_types.syntax.reader import MAX_DEPTH, UnexpectedTokenError
from st_types.syntax.source import Source


def parse(text: str) -> Expression:
    source = Source("a", text)
    parser = ExpressionParser(Tokens(source), DiagnosticLog(source))
    found = parser.expression()
    assert not parser.text, f"{parser.text} is left over"
    return found


def shape(node: Expression) -> str:
    """The tree with every operation in parentheses."""
    match node:
        case Binary():
            return f"({shape(node.left)} {node.operator} {shape(node.right)})"
        case Unary():
            return f"({node.operator} {shape(node.operand)})"
        case Literal():
            return node.text
        case Name():
            return node.name
    raise AssertionError(node)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 + 2 * 3", "(1 + (2 * 3))"),
        ("1 - 2 - 3", "((1 - 2) - 3)"),
        ("(1 + 2) * 3", "((1 + 2) * 3)"),
        ("a OR b XOR c AND d", "(a OR (b XOR (c AND d)))"),
        ("a & b and c", "((a AND b) AND c)"),
        ("a = b < c", "(a = (b < c))"),
        ("a <> b AND c >= d", "((a <> b) AND (c >= d))"),
        ("not a or b", "((NOT a) OR b)"),
        ("NOT a = b", "((NOT a) = b)"),
        ("-2 ** 2", "(- (2 ** 2))"),
        ("2 ** -1", "(2 ** (- 1))"),
        ("2 ** 3 ** 4", "((2 ** 3) ** 4)"),
        ("a MOD b / c", "((a MOD b) / c)"),
        ("-a * b", "((- a) * b)"),
        ("a - -1", "(a - (- 1))"),
        ("T#1s + t", "(T#1s + t)"),
        ("TRUE AND x", "(TRUE AND x)"),
        (".5 + -.25E3", "(.5 + (- .25E3))"),
        ("a OR_ELSE b AND_THEN c and_then d", "(a OR_ELSE ((b AND_THEN c) AND_THEN d))"),
        ("a AND b + 1 * 2 ** 3 > 4 OR c", "((a AND ((b + (1 * (2 ** 3))) > 4)) OR c)"),
    ],
)
def test_precedence(text: str, expected: str) -> None:
    assert shape(parse(text)) == expected


def literal(text: str) -> Literal:
    return Literal(0, text, parse_literal(text))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a.b.3", MemberAccess(0, MemberAccess(0, Name(0, "a"), "b"), "3")),
        ("a.%X3", MemberAccess(0, Name(0, "a"), "%X3")),
        ("exit.TYPE", MemberAccess(0, Name(0, "exit"), "TYPE")),
        ("a[1, i].x", MemberAccess(0, Index(0, Name(0, "a"), [literal("1"), Name(0, "i")]), "x")),
        ("p^.x", MemberAccess(0, Dereference(0, Name(0, "p")), "x")),
        ("%IX0.1", DirectAddress(0, "%IX0.1")),
        ("Colour#red", MemberAccess(0, Name(0, "Colour"), "red")),
        ("f()", Call(0, Name(0, "f"), [])),
        ("And(a)", Call(0, Name(0, "And"), [Argument(0, "", Name(0, "a"))])),
        ("ADR('x')", Call(0, Name(0, "ADR"), [Argument(0, "", literal("'x'"))])),
        (
            "fb(IN := a, PT := , Q => b, NOT M => c)",
            Call(
                0,
                Name(0, "fb"),
                [
                    Argument(0, "IN", Name(0, "a")),
                    Argument(0, "PT", None),
                    Argument(0, "Q", Name(0, "b"), is_output=True),
                    Argument(0, "M", Name(0, "c"), is_output=True, is_negated=True),
                ],
            ),
        ),
    ],
)
def test_operands(text: str, expected: Expression) -> None:
    assert parse(text) == expected


@pytest.mark.parametrize(
    ("text", "message", "place"),
    [
        ("", "expected a value, found the end of the file", 0),
        ("1 +", "expected a value, found the end of the file", 3),
        ("(1", r"expected '\)' to close the parenthesis, found the end", 2),
        ("a[1", "expected ']' to close the index", 3),
        ("f(1 2)", r"expected ',' or '\)' after an argument, found '2'", 4),
        ("a.", "expected the name of a member or the number of a bit", 2),
        ("a.'x'", "expected the name of a member", 2),
        (". 5", "expected a value, found '.'", 0),
        ("'x", "expected a value, found a string that is not closed", 0),
        ("§", "expected a value, found '§'", 0),
        ("\x01", r"expected a value, found the character U\+0001", 0),
        ("2#3", "3 is not a number of base 2", 0),
        ("a + T#5y", "T#5y is no duration", 4),
    ],
)
def test_errors_say_what_was_expected(text: str, message: str, place: int) -> None:
    with pytest.raises(UnexpectedTokenError, match=message) as caught:
        parse(text)
    assert caught.value.offset == place


def test_a_long_chain_is_parsed_and_a_longer_one_refused() -> None:
    assert isinstance(parse("+".join(["1"] * (MAX_OPERATORS + 1))), Binary)
    with pytest.raises(UnexpectedTokenError, match=f"at most {MAX_OPERATORS} operators"):
        parse("+".join(["1"] * (MAX_OPERATORS + 2)))


@pytest.mark.parametrize(
    "opening", ["(", "a[", "f(", "-", "NOT ", "1+(", "a OR b AND c = d < e + f * ("]
)
def test_deep_nesting_is_an_error_not_a_recursion(opening: str) -> None:
    with pytest.raises(UnexpectedTokenError, match=f"{MAX_DEPTH} levels of nesting|operators"):
        parse(opening * 10_000)


WORDS = [
    "a",
    "1",
    "1.5",
    "'x'",
    "T#1s",
    "+",
    "-",
    "*",
    "/",
    "**",
    "(",
    ")",
    "[",
    "]",
    ".",
    ",",
    ":=",
]
WORDS += ["=>", "^", "NOT", "AND", "=", "<", "3", "%IX0", ";", "OF", "'"]


@given(st.lists(st.sampled_from(WORDS), max_size=30))
def test_any_tokens_parse_or_are_refused(words: list[str]) -> None:
    source = Source("a", " ".join(words))
    parser = ExpressionParser(Tokens(source), DiagnosticLog(source))
    with suppress(UnexpectedTokenError):
        parser.expression()
    assert parser.index <= parser.tokens.end
