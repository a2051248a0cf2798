"""Tokens of Automation Basic."""

import pytest

from plcsim.program.structured_text.languages import automation_basic_tokens
from plcsim.program.structured_text.languages.automation_basic_tokens import basic_tokens
from st_types.syntax.source import Source


def texts(text: str) -> list[str]:
    tokens = basic_tokens(Source("a.ab", text))
    return tokens.texts[: tokens.end]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a[1].X04=b.3", ["a", "[", "1", "]", ".", "X04", "=", "b", ".", "3"]),
        ("x = 1.5E-3;rest", ["x", "=", "1.5E-3"]),
        ("2..7", ["2", "..", "7"]),
        ("$1f %011 16#FF T#5s", ["16#1f", "2#011", "16#FF", "T#5s"]),
        ("\"say 'no' for $5\"", ["'say $'no$' for $$5'"]),
        ("a\r\nb\rc\nd", ["a", "\n", "b", "\n", "c", "\n", "d"]),
        ("a \\ ; more\r\n b \\\n c", ["a", "b", "c"]),
        ("a (* x *) b (* y\n *) c", ["a", "b", "\n", "c"]),
        ("; (* no block\na // ; b\n(* open", ["\n", "a", "\n"]),
        ("a<=b>=c<>d:=e=>f", ["a", "<=", "b", ">=", "c", "<>", "d", ":=", "e", "=>", "f"]),
    ],
)
def test_tokens(text: str, expected: list[str]) -> None:
    assert texts(text) == expected


def test_places() -> None:
    tokens = basic_tokens(Source("a.ab", 'a = $1F\n  b = "text"'))
    found = [str(tokens.location(number)) for number in (2, 4, 6)]
    assert found == ["a.ab:1:5", "a.ab:2:3", "a.ab:2:7"]


def test_no_file_takes_memory_without_bound(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(automation_basic_tokens, "MAX_TOKENS", 10)
    tokens = basic_tokens(Source("a.ab", "a " * 11))
    assert tokens.truncated
    assert tokens.end == 10
    assert not basic_tokens(Source("a.ab", "a " * 9)).truncated
