import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types.errors import SourceError
from st_types.syntax import lexer
from st_types.syntax.declarations import parse_declarations, parse_text
from st_types.syntax.diagnostics import MAX_DIAGNOSTICS
from st_types.syntax.source import Source
from st_types.syntax.tree import (
    DeclarationFile,
    FunctionBlockDeclaration,
    FunctionDeclaration,
    NamedType,
    TypeBlock,
    VariableBlock,
)


def errors_in(text: str) -> list[str]:
    return [str(d) for d in parse_declarations(Source("a.typ", text)).diagnostics.records]


@pytest.mark.parametrize(
    "text",
    [
        "",
        " \r\n\t\xa0\x1a",
        "(* only a comment *)",
        ";;",
        "TYPE END_TYPE",
        "TYPE\nEND_TYPE;\nTYPE\nEND_TYPE",
        "VAR END_VAR",
        "VAR CONSTANT END_VAR VAR RETAIN END_VAR",
        "VAR_GLOBAL RETAIN PERSISTENT x : INT; END_VAR",
        "VAR constant : INT; retain AT %M : INT; END_VAR",
        "type x : int; end_type var y : x; end_var",
        "FUNCTION_BLOCK f END_FUNCTION_BLOCK",
        "FUNCTION f : INT END_FUNCTION;",
        "FUNCTION f END_FUNCTION",
        "FUNCTION f : STRING[80] VAR_INPUT x : ANY_NUM; END_VAR END_FUNCTION",
        "FUNCTION f : STRUCT x : INT; END_STRUCT VAR END_VAR END_FUNCTION",
        "FUNCTION_BLOCK f VAR_OUTPUT END_VAR VAR_INPUT END_VAR; END_FUNCTION_BLOCK",
        "FUNCTION_BLOCK f VAR RETAIN END_VAR VAR_IN_OUT END_VAR END_FUNCTION_BLOCK",
        "{P} {Q} FUNCTION_BLOCK f {R} (* x *) {S} VAR {T} END_VAR {U} END_FUNCTION_BLOCK {V}",
        "(* a (* b *) c *) TYPE END_TYPE",
        "(* see (* below *) TYPE END_TYPE (* x *)",
        "(* it's *) TYPE (* don't (* nest *) *) END_TYPE",
        "TYPE x : INT END_TYPE",
    ],
)
def test_no_false_error(text: str) -> None:
    assert errors_in(text) == []


def test_the_tree() -> None:
    file = parse_text(
        "(* head *)\nTYPE A : INT; END_TYPE\nVAR CONSTANT RETAIN n : INT; END_VAR\n"
        "{P}\nFUNCTION_BLOCK F (*what*)\n\tVAR_INPUT\n\t\ta : INT;\n\tEND_VAR\nEND_FUNCTION_BLOCK\n"
        "FUNCTION G : REAL (*g*)\nEND_FUNCTION\n(* tail *)\n"
    )
    types, variables, block, function = file.items
    assert isinstance(types, TypeBlock)
    assert types.before == "(* head *)\n"
    assert isinstance(variables, VariableBlock)
    assert (variables.section, variables.qualifiers) == ("VAR", ("CONSTANT", "RETAIN"))
    assert isinstance(block, FunctionBlockDeclaration)
    assert (block.name, block.pragmas, block.behind) == ("F", ("{P}",), " (*what*)\n\t")
    assert [b.section for b in block.blocks] == ["VAR_INPUT"]
    assert isinstance(function, FunctionDeclaration)
    assert function.result == NamedType(0, "REAL")
    assert function.behind == " (*g*)\n"
    assert file.closing == "\n(* tail *)\n"


def test_places() -> None:
    file = parse_text("TYPE\r\n\tA : STRUCT\r\n\t\tb : INT;\r\n\tEND_STRUCT;\r\nEND_TYPE", "T.typ")
    declaration = file.items[0].declarations[0]
    assert str(file.location(declaration)) == "T.typ:2:2"
    member = declaration.specification.members[0]
    assert str(file.location(member)) == "T.typ:3:3"
    assert str(file.location(member.specification)) == "T.typ:3:7"
    file.error(member, "odd", "hint")
    file.warning(member.specification, "dubious")
    assert [str(record) for record in file.diagnostics.records] == [
        "T.typ:3:3: error: odd",
        "T.typ:3:7: warning: dubious",
    ]


@pytest.mark.parametrize(
    ("text", "errors"),
    [
        ("x", ["1:1: error: expected TYPE, VAR, FUNCTION or FUNCTION_BLOCK, found 'x'"]),
        ("END_VAR", ["1:1: error: expected TYPE, VAR"]),
        ("{ open\nTYPE END_TYPE", ["1:1: error: expected TYPE, VAR"]),
        ("TYPE", ["1:5: error: expected END_TYPE, found the end of the file"]),
        ("TYPE x : INT; VAR y : INT; END_VAR", ["1:15: error: expected END_TYPE, found 'VAR'"]),
        ("VAR a : INT; END_TYPE VAR END_VAR", ["1:14: error: expected END_VAR, found 'END_TYPE'"]),
        (
            "TYPE a : STRUCT END_TYPE VAR END_VAR",
            ["1:17: error: expected END_STRUCT, found 'END_T"],
        ),
        ("FUNCTION_BLOCK 5 END_FUNCTION_BLOCK", ["1:16: error: expected a name after FUNC"]),
        ("FUNCTION_BLOCK F x := 1; END_FUNCTION_BLOCK", ["1:18: error: expected VAR or END_FUN"]),
        (
            "FUNCTION_BLOCK F VAR a : INT; END_VAR FUNCTION_BLOCK G END_FUNCTION_BLOCK",
            ["1:39: error: expected VAR or END_FUNCTION_BLOCK in F, found 'FUNCTION_BLOCK'"],
        ),
        ("FUNCTION f : END_FUNCTION", ["1:14: error: expected a type, found 'END_FUNCTION'"]),
        ("TYPE END_TYPE (* open", ["1:15: error: the comment that starts here is never closed"]),
        ("TYPE (*)", ["1:6: error: the comment that starts"]),
        ("#ifdef X\nTYPE END_TYPE", ["1:1: warning: the preprocessor line is ignored"]),
        ("TYPE \u00fc : INT; END_TYPE", ["1:6: error: expected the name of a declaration"]),
        (
            "TYPE A : \u00fc; B : (x) \u00fc; END_TYPE",
            ["1:10: error: expected a type", "1:21: error:"],
        ),
        ("TYPE A : INT := \u00fc; B : INT := \u0663; END_TYPE", ["1:17: error", "1:31: error"]),
        ("TYPE A : (x, (* y *); END_TYPE", ["1:21: error: expected a name of an enumeration"]),
        *(
            (text.replace("?", "9" * 500), [f"1:{text.index('?') + 1}: error: a number of 500"])
            for text in (
                "TYPE A : ARRAY[0..?] OF INT; END_TYPE",
                "TYPE A : STRING[?]; END_TYPE",
                "VAR a : INT := ?; b : INT := 1; END_VAR",
            )
        ),
    ],
)
def test_errors(text: str, errors: list[str]) -> None:
    found = errors_in(text)
    assert len(found) == len(errors), found
    for message, expected in zip(found, errors, strict=True):
        assert message.startswith(f"a.typ:{expected}")


def test_many_errors_are_counted_not_kept() -> None:
    text = "TYPE\n" + "x INT;\n" * 1000 + "END_TYPE"
    with pytest.raises(SourceError, match="980 more that are not shown") as caught:
        parse_text(text)
    assert len(caught.value.diagnostics) == MAX_DIAGNOSTICS


def test_a_comment_around_nested_comments_hides_its_text() -> None:
    file = parse_text("(* TYPE A : INT; (* b *) END_TYPE *) VAR x : INT; END_VAR")
    assert [type(item) for item in file.items] == [VariableBlock]


WORDS = [
    "TYPE",
    "END_TYPE",
    "VAR",
    "VAR_INPUT",
    "END_VAR",
    "CONSTANT",
    "FUNCTION",
    "FUNCTION_BLOCK",
]
WORDS += ["END_FUNCTION", "END_FUNCTION_BLOCK", "STRUCT", "END_STRUCT", "ARRAY", "OF", "STRING"]
WORDS += ["REFERENCE", "TO", "AT", "%IX0", "a", "b", "INT", "5", "'x'", "'", "T#1s", "(", ")", "["]
WORDS += ["]", ",", ";", ":", ":=", "..", "-", "(*", "*)", "//", "\n", "{", "}", "#if", "16#", "é"]


def parse_anything(file: DeclarationFile) -> None:
    try:
        file.diagnostics.raise_errors()
    except SourceError as err:
        for record in err.diagnostics:
            source = file.tokens.source
            assert 1 <= record.line <= source.line_count + 1
            assert record.render()


@given(st.lists(st.sampled_from(WORDS), max_size=60))
def test_any_words_parse_or_give_a_source_error(words: list[str]) -> None:
    parse_anything(parse_declarations(Source("a.typ", " ".join(words))))


@given(st.text(max_size=80))
def test_any_text_parses_or_gives_a_source_error(text: str) -> None:
    parse_anything(parse_declarations(Source("a.typ", text)))


@given(st.binary(max_size=80))
def test_any_bytes_parse_or_give_a_source_error(data: bytes) -> None:
    parse_anything(parse_declarations(Source.decode("a.typ", b"TYPE " + data)))


HOSTILE = ["VAR ", "TYPE x:(", "x INT;", "a:", "a:INT;", "FUNCTION f ", "(", "(*", "'", "a:STRUCT "]
HOSTILE += [",", "\0", "a:INT:=[", "x:ARRAY[0..1]OF ", "END_VAR ", "a,", "{", "FUNCTION_BLOCK "]


@pytest.mark.parametrize("unit", HOSTILE)
def test_hostile_text_takes_linear_time(unit: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lexer, "MAX_TOKENS", 50_000)
    start = time.process_time()
    file = parse_declarations(Source("a.typ", "VAR " + unit * (500_000 // len(unit))))
    assert file.diagnostics.error_count
    assert time.process_time() - start < 5


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("CLASS A METHOD B END_METHOD END_CLASS", "1:1: error: CLASS"),
        ("interface I end_interface", "1:1: error: INTERFACE"),
        ("NAMESPACE N TYPE T : INT; END_TYPE END_NAMESPACE", "1:1: error: NAMESPACE"),
        (
            "FUNCTION_BLOCK F METHOD M VAR x : INT; END_VAR END_METHOD END_FUNCTION_BLOCK",
            "1:18: error: METHOD",
        ),
        ("CLASS without an end", "1:1: error: CLASS"),
    ],
)
def test_what_is_not_supported_is_refused_by_name_and_stepped_over(text: str, place: str) -> None:
    file = parse_declarations(Source("a", f"{text} TYPE Behind : INT; END_TYPE"))
    (record,) = file.diagnostics.records
    assert str(record).startswith(f"a:{place} is not supported")
    names = [
        d.name for item in file.items if isinstance(item, TypeBlock) for d in item.declarations
    ]
    assert names[-1:] == ([] if "without" in text else ["Behind"])


def test_a_type_may_be_called_union() -> None:
    assert parse_text("VAR a : Union; b : UNION := (x := 1); END_VAR").diagnostics.records == []
