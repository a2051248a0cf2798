import pytest

from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.initials import InitialParser
from st_types.syntax.lexer import Tokens
from st_types.syntax.printer import print_initial
from st_types.syntax.reader import MAX_DEPTH, UnexpectedTokenError
from st_types.syntax.source import Source
from st_types.syntax.tree import ArrayInitial, Initial, RepeatedInitial, StructInitial


def parse(text: str) -> Initial:
    source = Source("a", text)
    parser = InitialParser(Tokens(source), DiagnosticLog(source))
    found = parser.initial()
    assert not parser.text, f"{parser.text} is left over"
    return found


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("5", "5"),
        ("-1.5E-3", "-1.5E-3"),
        ("(1+2)*3", "(1 + 2) * 3"),
        ("MAX - 1", "MAX - 1"),
        ("'a$n'", "'a$n'"),
        ("ADR(x)", "ADR(x)"),
        ("[]", "[]"),
        ("[1,2]", "[1, 2]"),
        ("[1,2,]", "[1, 2]"),
        ("[13(0)]", "[13(0)]"),
        ("[COUNT(0), 2(-1)]", "[COUNT(0), 2(-1)]"),
        ("[2(1,2)]", "[2(1, 2)]"),
        ("[2()]", "[2()]"),
        ("[N+1(0), 2*N(1), (N)(2)]", "[N + 1(0), 2 * N(1), N(2)]"),
        ("[MAX - MIN(a:=1)]", "[MAX - MIN((a := 1))]"),
        ("[2(N+1(0))]", "[2(N + 1(0))]"),
        ("[(a:=F(1))]", "[(a := F(1))]"),
        ("[[1,2],[3,4]]", "[[1, 2], [3, 4]]"),
        ("[2([1,2])]", "[2([1, 2])]"),
        ("[-(3), NOT (TRUE)]", "[-3, NOT TRUE]"),
        ("1, 2, 3(0)", "[1, 2, 3(0)]"),
        ("3(0)", "[3(0)]"),
        ("()", "()"),
        ("(a:=1)", "(a := 1)"),
        ("(a:=1,b:=(c:='x'),)", "(a := 1, b := (c := 'x'))"),
        ("(PT:=T#1s, IN:=TRUE)", "(PT := T#1s, IN := TRUE)"),
        ("(a:=[1,2(0)])", "(a := [1, 2(0)])"),
        ("[(a:=1),(a:=2)]", "[(a := 1), (a := 2)]"),
        ("[2((a:=1))]", "[2((a := 1))]"),
        ("[2(a:=1,b:=2)]", "[2((a := 1, b := 2))]"),
    ],
)
def test_forms(text: str, printed: str) -> None:
    node = parse(text)
    assert print_initial(node) == printed
    assert parse(printed) == node


def test_kinds() -> None:
    assert isinstance(parse("[1]"), ArrayInitial)
    assert isinstance(parse("()"), StructInitial)
    repeated = parse("[2(a:=1)]").items[0]
    assert isinstance(repeated, RepeatedInitial)
    assert isinstance(repeated.items[0], StructInitial)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected a value, found the end of the file"),
        ("[1 2]", "expected ',' or ']' after an initial value, found '2'"),
        ("[1", "expected ',' or ']' after an initial value"),
        ("(a:=1 b:=2)", r"expected ',' or '\)' after the value of a member, found 'b'"),
        ("(a:=1, 5)", "expected a name of a member, found '5'"),
        ("(a:=1, b)", "expected ':=' after the name of the member b"),
        ("[,]", "expected a value, found ','"),
    ],
)
def test_errors(text: str, message: str) -> None:
    with pytest.raises(UnexpectedTokenError, match=message):
        parse(text)


@pytest.mark.parametrize("opening", ["[", "(a:=", "[2(", "[2(a:="])
def test_deep_nesting_is_an_error(opening: str) -> None:
    with pytest.raises(UnexpectedTokenError, match=f"at most {MAX_DEPTH} levels"):
        parse(opening * 5000)
