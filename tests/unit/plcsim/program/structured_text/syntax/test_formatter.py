"""Formatting: blocks are indented, blanks put in order, tokens and comments left alone."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.program.structured_text.syntax.formatter import (
    content_of,
    format_text,
    has_directives,
)
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from st_types.syntax.source import Source

CORPUS = Path(__file__).parents[5] / "corpus" / "structured_text"


def formatted(text, step="\t"):
    file = parse_structured_text(Source("a.st", text))
    file.diagnostics.raise_errors()
    return format_text(file, step)


def body(text):
    """Format statements of a program, without the program around them."""
    lines = formatted(f"PROGRAM p\n{text}\nEND_PROGRAM").splitlines()
    return [line.removeprefix("\t") for line in lines[1:-1]]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a:=b+-c*( d ) ;", ["a := b + -c * (d);"]),
        ("a:=NOT(b)AND(c);", ["a := NOT (b) AND (c);"]),
        ("x[ 1 ,2 ].y^.z.3:=f( a:=1,b=>c );", ["x[1, 2].y^.z.3 := f(a := 1, b => c);"]),
        ("longer   := 1;\nb        := 2;", ["longer   := 1;", "b        := 2;"]),
        ("a := 1;(* c *)\nb := 2;   // d", ["a := 1; (* c *)", "b := 2;   // d"]),
        ("IF a THEN\nb;\nELSIF c THEN\nd;\nELSE\ne;\nEND_IF", [
            "IF a THEN", "\tb;", "ELSIF c THEN", "\td;", "ELSE", "\te;", "END_IF",
        ]),
        ("CASE a OF\n1,2..4:\nb;\nRED : c;\nELSE\nd;\nEND_CASE", [
            "CASE a OF", "\t1, 2..4:", "\t\tb;", "\tRED : c;", "\tELSE", "\t\td;", "END_CASE",
        ]),
        ("CASE a OF -1:\nCASE b OF\n2:\nc;\nEND_CASE\nEND_CASE", [
            "CASE a OF -1:", "\t\tCASE b OF", "\t\t\t2:", "\t\t\t\tc;", "\t\tEND_CASE", "END_CASE",
        ]),
        ("FOR i:=1 TO 3 BY -1 DO\nx;\nEND_FOR", ["FOR i := 1 TO 3 BY -1 DO", "\tx;", "END_FOR"]),
        ("REPEAT\nx;\nUNTIL a\nEND_REPEAT", ["REPEAT", "\tx;", "UNTIL a", "END_REPEAT"]),
        ("f(\na:=1,\nb:=2\n);", ["f(", "\ta := 1,", "\tb := 2", ");"]),
        ("a := b\n+ c;\nd;", ["a := b", "\t+ c;", "d;"]),
        ("a;\n\n\n\n\nb;", ["a;", "", "", "b;"]),
        ("(* one\n   two *)\nIF a THEN\n// c\nEND_IF", [
            "(* one", "   two *)", "IF a THEN", "\t// c", "END_IF",
        ]),
        ("if.x := type + 1;", ["if.x := type + 1;"]),
    ],
)  # fmt: skip
def test_statements(text, expected):
    assert body(text) == expected


def test_units_and_declarations():
    text = """
{pragma}
TYPE
S:STRUCT
a:INT:=1;  (* first *)
b:ARRAY[0..3]OF INT;
END_STRUCT;
E:(
one,
two
);
END_TYPE
FUNCTION_BLOCK Fb
VAR_INPUT
x : INT(0..5);
END_VAR
y:=x;
END_FUNCTION_BLOCK
ACTION go:
z:=1;
END_ACTION
"""
    assert formatted(text, "  ").splitlines() == [
        "{pragma}",
        "TYPE",
        "  S: STRUCT",
        "    a: INT := 1;  (* first *)",
        "    b: ARRAY[0..3] OF INT;",
        "  END_STRUCT;",
        "  E: (",
        "    one,",
        "    two",
        "  );",
        "END_TYPE",
        "FUNCTION_BLOCK Fb",
        "  VAR_INPUT",
        "    x : INT(0..5);",
        "  END_VAR",
        "  y := x;",
        "END_FUNCTION_BLOCK",
        "ACTION go:",
        "  z := 1;",
        "END_ACTION",
    ]


@pytest.mark.parametrize("file", sorted((CORPUS / "standard").iterdir()), ids=lambda f: f.name)
def test_whole_files_keep_their_content_and_stay_as_they_are_the_second_time(file):
    source = Source.read(file)
    parsed = parse_structured_text(source)
    if parsed.tokens.source.text != source.text:
        pytest.skip("has comments in comments")
    once = format_text(parsed)
    assert content_of(Source("a", once)) == content_of(source)
    assert formatted(once) == once


def test_steps_and_transitions():
    text = """INITIAL_STEP A:
n:=1;
act( N );
END_STEP
ENTRY_ACTION
n:=2;
END_ACTION
TRANSITION FROM A TO (B,C):=n>1;
END_TRANSITION
STEP B: END_STEP"""
    assert body(text) == [
        "INITIAL_STEP A:",
        "\tn := 1;",
        "\tact(N);",
        "END_STEP",
        "ENTRY_ACTION",
        "\tn := 2;",
        "END_ACTION",
        "TRANSITION FROM A TO (B, C) := n > 1;",
        "END_TRANSITION",
        "STEP B: END_STEP",
    ]


BLANKS = st.sampled_from(["", " ", "\n", "\n\n\n\n", "\t", " (* c *) ", " // d\n", "\r\n"])
TOKENS = re.split(
    " ",
    "PROGRAM p IF a = - 1 THEN b [ 2 ] := f ( c := 3 ) ; ELSE CASE d OF 1 , 2 : e ; ELSE g ; "
    "END_CASE END_IF WHILE NOT h DO i . j ^ := 4 + ( 5 ) ; END_WHILE END_PROGRAM",
)


@given(st.lists(BLANKS, min_size=len(TOKENS), max_size=len(TOKENS)))
def test_any_blanks_between_tokens_lead_to_one_text(blanks):
    text = "".join(f"{token}{blank or ' '}" for token, blank in zip(TOKENS, blanks, strict=True))
    once = formatted(text)
    assert content_of(Source("a", once)) == content_of(Source("a", text))
    assert formatted(once) == once


def test_deep_nesting_and_long_expressions_take_their_time():
    deep = "IF a THEN\n" * 90 + "END_IF\n" * 90
    assert formatted(f"PROGRAM p\n{deep}END_PROGRAM").count("\n") == 182
    long = "a := " + " + ".join(["b"] * 300) + ";"
    assert body(long) == [long]


def test_an_empty_file_stays_empty():
    assert formatted(" \n\n") == ""


def test_directives_are_seen():
    assert has_directives(Source("a", "#ifdef X\n#endif\n"))
    assert not has_directives(Source("a", "a := 16#FF; // #if\n"))
