import pytest

from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.lexer import Tokens
from st_types.syntax.reader import MAX_DEPTH, TokenReader, UnexpectedTokenError
from st_types.syntax.source import Source


def reader(text: str) -> TokenReader:
    source = Source("a.typ", text)
    return TokenReader(Tokens(source), DiagnosticLog(source))


def test_stepping() -> None:
    found = reader("End_Var ; name")
    assert (found.text, found.keyword) == ("End_Var", "END_VAR")
    assert not found.accept("VAR")
    assert found.accept("END_VAR")
    assert found.expect(";", "here") == 1
    assert found.expect_name("here") == "name"
    assert found.text == ""


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected ':' after x, found the end of the file"),
        ("y", "expected ':' after x, found 'y'"),
        ("'open", "expected ':' after x, found a string that is not closed on its line"),
        ("\x07", r"expected ':' after x, found the character U\+0007"),
        ("a" * 50, "found '" + "a" * 40 + "...'"),
    ],
)
def test_what_was_found(text: str, message: str) -> None:
    with pytest.raises(UnexpectedTokenError, match=message):
        reader(text).expect(":", "after x")


@pytest.mark.parametrize(
    ("text", "place"),
    [("a b", 2), ("a\n b", 1), ("a (* x\n *) b", 1), ("a (* x *)", 1), ("a\rb", 1)],
)
def test_what_is_missing_is_missing_on_its_own_line(text: str, place: int) -> None:
    found = reader(text)
    found.index = 1
    with pytest.raises(UnexpectedTokenError) as caught:
        found.expect(";", "after a")
    assert caught.value.offset == place


def test_a_wrong_word_is_shown_where_it_stands() -> None:
    found = reader("a\n b")
    found.index = 1
    with pytest.raises(UnexpectedTokenError) as caught:
        found.expect("OF", "after a")
    assert caught.value.offset == found.here() == 3


def test_no_name() -> None:
    with pytest.raises(UnexpectedTokenError, match="expected a name of x, found '5'"):
        reader("5").expect_name("of x")


def test_nesting_is_counted() -> None:
    found = reader("x")
    for _ in range(MAX_DEPTH):
        found.enter()
    with pytest.raises(UnexpectedTokenError, match=f"at most {MAX_DEPTH} levels"):
        found.enter()
    found.leave()
    found.leave()
    found.enter()
