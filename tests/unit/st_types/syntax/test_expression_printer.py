import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.expression_printer import ExpressionPrinter, print_expression
from st_types.syntax.expressions import (
    MAX_OPERATORS,
    PRECEDENCE,
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
from st_types.syntax.source import Source


def parse(text: str) -> Expression:
    source = Source("a", text)
    return ExpressionParser(Tokens(source), DiagnosticLog(source)).expression()


@pytest.mark.parametrize(
    "text",
    [
        "1 + 2 * 3",
        "(1 + 2) * 3",
        "1 - (2 - 3)",
        "-(a + b)",
        "(-2) ** 2",
        "-2 ** 2",
        "2 ** (-1)",
        "a * -b",
        "NOT a AND NOT (b OR c)",
        "a.b[1, 2].3",
        "(v.3).x",
        "(5).3",
        "(a + b).c",
        "p^[i]",
        "f(a, b := 1, c =>, d => e)",
    ],
)
def test_printing_gives_the_text_back(text: str) -> None:
    assert print_expression(parse(text)) == text


def test_superfluous_parentheses_go_unless_the_file_is_at_hand() -> None:
    text = "((a)) + (b * c) + ((d + e)) * -(1) + (f).g"
    source = Source("a", text)
    tokens = Tokens(source)
    node = ExpressionParser(tokens, DiagnosticLog(source)).expression()
    assert print_expression(node) == "a + b * c + (d + e) * -1 + f.g"
    assert ExpressionPrinter(tokens).expression(node) == text.replace("(f)", "f")


def test_a_long_chain_prints() -> None:
    text = " + ".join(["1"] * (MAX_OPERATORS + 1))
    assert print_expression(parse(text)) == text


names = st.sampled_from(["a", "Speed", "_x", "OF", "Type"])
literals = st.sampled_from(["0", "1.5", "1.", "16#FF", "'it$'s'", '"w"', "T#-1s", "INT#-5", "TRUE"])
leaves = st.one_of(
    names.map(lambda name: Name(0, name)),
    literals.map(lambda text: Literal(0, text, parse_literal(text))),
    st.just(DirectAddress(0, "%IX0.1")),
)


def operations(inner: st.SearchStrategy[Expression]) -> st.SearchStrategy[Expression]:
    arguments = st.one_of(
        inner.map(lambda value: Argument(0, "", value)),
        st.builds(Argument, st.just(0), names, st.none() | inner, st.booleans()),
    )
    return st.one_of(
        st.builds(
            Binary, st.just(0), st.sampled_from(sorted(set(PRECEDENCE) - {"&"})), inner, inner
        ),
        st.builds(Unary, st.just(0), st.sampled_from(["-", "+", "NOT"]), inner),
        st.builds(MemberAccess, st.just(0), inner, names | st.just("7")),
        st.builds(Index, st.just(0), inner, st.lists(inner, min_size=1, max_size=3)),
        st.builds(Dereference, st.just(0), inner),
        st.builds(Call, st.just(0), inner, st.lists(arguments, max_size=3)),
    )


@given(st.recursive(leaves, operations, max_leaves=12))
def test_printing_then_parsing_is_the_identity(node: Expression) -> None:
    assert parse(print_expression(node)) == node
