import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types.syntax import lexer
from st_types.syntax.lexer import OPERATORS, KeyTable, TokenKind, Tokens, kind_of, unnest_comments
from st_types.syntax.source import Source


def texts(text: str) -> list[str]:
    tokens = Tokens(Source("a", text))
    return tokens.texts[: tokens.end]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a:=b=>c..d**e<>f<=g>=h", "a := b => c .. d ** e <> f <= g >= h"),
        ("a<b>c=d+e-f*g/h&i^j", "a < b > c = d + e - f * g / h & i ^ j"),
        ("x[1,2](y).3;", "x [ 1 , 2 ] ( y ) . 3 ;"),
        ("0..5 -3..MAX", "0 .. 5 - 3 .. MAX"),
        ("1.5 1. 1E5 1.5e-3 2e+4 1_000", "1.5 1. 1E5 1.5e-3 2e+4 1_000"),
        ("16#FF 2#1010_1100 8#17 16#FFe-3", "16#FF 2#1010_1100 8#17 16#FFe - 3"),
        ("T#1d2h3m4s5ms t#-1.5s TIME#10s", "T#1d2h3m4s5ms t#-1.5s TIME#10s"),
        ("T#1s..T#5s", "T#1s .. T#5s"),
        ("D#2024-02-29 DT#2024-02-29-12:30:00.5", "D#2024-02-29 DT#2024-02-29-12:30:00.5"),
        ("TOD#23:59:59.9 Date_And_Time#2000-01-01", "TOD#23:59:59.9 Date_And_Time#2000-01-01"),
        ("INT#-5 INT#5-3 BYTE#16#FF REAL#1.5e-3", "INT#-5 INT#5 - 3 BYTE#16#FF REAL#1.5e-3"),
        ("BOOL#TRUE Colour#red", "BOOL#TRUE Colour#red"),
        ("x AT%IX0.1:BOOL", "x AT %IX0.1 : BOOL"),
        ('%IX."IF3.ST2".Input01;', '%IX."IF3.ST2".Input01 ;'),
        ("END_IF;x:=1", "END_IF ; x := 1"),
    ],
)
def test_tokens(text: str, expected: str) -> None:
    assert texts(text) == expected.split(" ")


@pytest.mark.parametrize(
    "text",
    ["'it$'s'", "'$$'", '"say $"x$""', "'(* text *)'", "'// {}'", "STRING#'x y'", "''", "'$'$''"],
)
def test_a_string_is_one_token(text: str) -> None:
    assert texts(f"a {text};") == ["a", text, ";"]


def test_an_open_string_ends_with_its_line() -> None:
    assert texts("a 'open ; x\r\nb") == ["a", "'open ; x", "b"]
    assert kind_of("'open ; x") is TokenKind.UNKNOWN
    assert kind_of("'$'") is TokenKind.UNKNOWN


@pytest.mark.parametrize(
    "trivia",
    [
        "(**)",
        "(***)",
        "(*[*)",
        "(* a * b ) *)",
        "(*\r\n*)",
        "/* ( */",
        "/***/",
        "// (* x\r",
        "//\n",
        "{REDUND_UNREPLICABLE}",
        "{}",
        "\xa0\ufeff\x1a\t\f ",
        "(*$GROUP=User,$CAT=User*)",
        "(*'*)",
        "{ '(*' }",
    ],
)
def test_comments_pragmas_and_blanks_are_no_tokens(trivia: str) -> None:
    tokens = Tokens(Source("a", f"x{trivia}y"))
    assert tokens.texts[:2] == ["x", "y"]
    assert tokens.trivia[1] == trivia


def test_a_directive_is_one_token() -> None:
    assert texts("#ifdef DEBUG\nx;\n#endif") == ["#ifdef DEBUG", "x", ";", "#endif"]


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("", TokenKind.END),
        ("END_VAR", TokenKind.IDENTIFIER),
        ("_x1", TokenKind.IDENTIFIER),
        ("T#1s", TokenKind.LITERAL),
        ("7", TokenKind.LITERAL),
        ("16#FF", TokenKind.LITERAL),
        ("''", TokenKind.LITERAL),
        ("%IX0", TokenKind.ADDRESS),
        ("%", TokenKind.UNKNOWN),
        ("#if", TokenKind.DIRECTIVE),
        ("#", TokenKind.UNKNOWN),
        ("ü", TokenKind.UNKNOWN),
        ("{", TokenKind.UNKNOWN),
        *((operator, TokenKind.OPERATOR) for operator in sorted(OPERATORS)),
    ],
)
def test_kinds(text: str, kind: TokenKind) -> None:
    assert kind_of(text) is kind


@given(st.text(alphabet="ab1 \t\r\n.:=#'\"$(*)/{}%;<>-é", max_size=60))
def test_no_character_is_lost(text: str) -> None:
    tokens = Tokens(Source("a", text))
    assert "".join(t + x for t, x in zip(tokens.trivia, tokens.texts, strict=True)) == text
    for index in range(tokens.end):
        assert text.startswith(tokens.texts[index], tokens.offset(index))
        assert tokens.end_offset(index) == tokens.offset(index) + len(tokens.texts[index])


def test_locations_count_from_one() -> None:
    tokens = Tokens(Source("a.typ", "TYPE\r\n\tx : INT;"))
    assert tokens.location(1) == ("a.typ", 2, 2)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a (* b *) c", None),
        ("a (* b (* c *) d *) e", "a (* b    c    d *) e"),
        ("(* (* (* *) *) *)", "(*             *)"),
        ("(* see (* below *) x", None),
        ("'(* (*' \"(*\" // (* (*", None),
        ("(* x *) y *)", None),
        ("a /* b /* c */ d */ e", "a /* b    c    d */ e"),
        ("(* /* *) /* (* */", None),
    ],
)
def test_unnesting(text: str, expected: str | None) -> None:
    assert unnest_comments(text) == expected


HOSTILE = [
    *("(*", "/*", "(* (*", "(*)", "'", "'$", '"', "{", "{a", "%", '%"', "//", "*", ")", "1.", "1_"),
    *("16#", "T#1", "D#1-", "A#'$'", "a#", "a", "1", ";", "\0", "\x80", "#a", "'a'#", "1e", "(*'"),
]


@pytest.mark.parametrize("unit", HOSTILE)
def test_hostile_text_takes_linear_time(unit: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lexer, "MAX_TOKENS", 50_000)
    text = unit * (1_000_000 // len(unit))
    start = time.process_time()
    tokens = Tokens(Source("a", text))
    unnest_comments(text)
    assert time.process_time() - start < 5  # a quadratic scan of a megabyte takes minutes
    assert len(tokens.texts) <= 50_000 + lexer.LOOKAHEAD + 1


def test_a_text_with_too_many_tokens_is_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lexer, "MAX_TOKENS", 3)
    tokens = Tokens(Source("a", "a b c d e"))
    assert tokens.truncated
    assert tokens.texts[: tokens.end] == ["a", "b", "c"]
    assert not Tokens(Source("a", "a b")).truncated


def test_a_key_says_what_a_parser_decides_by() -> None:
    table = KeyTable(["IF", "END_IF"])
    found = ["if", "If", "iF", "END_If", "x", "TrUe", "1.5", "INT#5", "%IX0", "#if a", "'a", ":="]
    keys = ["IF", "IF", "IF", "END_IF", "name", "literal", "literal", "literal", "address"]
    assert table.keys_of([*found, "é", ""]) == [*keys, "directive", "unknown", ":=", "unknown", ""]
    assert "x" not in table  # names of one file are not kept for the next


def test_tokens_that_were_cut_elsewise_stand_where_they_are_placed():
    source = Source("a.xml", '<a name="x"/>\n<b name="y"/>')
    tokens = Tokens.placed(source, [(9, "x"), (9, "+"), (23, "y")])
    assert tokens.texts[: tokens.end] == ["x", "+", "y"]
    assert [tokens.location(index)[1:] for index in range(4)] == [
        (1, 10),
        (1, 10),
        (2, 10),
        (2, 14),
    ]
    assert tokens.source is source
