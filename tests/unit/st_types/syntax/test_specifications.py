import pytest

from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.lexer import Tokens
from st_types.syntax.printer import print_specification
from st_types.syntax.reader import MAX_DEPTH, UnexpectedTokenError
from st_types.syntax.source import Source
from st_types.syntax.specifications import SpecificationParser
from st_types.syntax.tree import (
    ArraySpecification,
    Declaration,
    EnumerationSpecification,
    NamedType,
    ReferenceSpecification,
    StringSpecification,
    StructSpecification,
    SubrangeSpecification,
    TypeSpecification,
)


def parser_of(text: str) -> SpecificationParser:
    source = Source("a.typ", text)
    return SpecificationParser(Tokens(source), DiagnosticLog(source))


def specification(text: str) -> TypeSpecification:
    parser = parser_of(text)
    found = parser.specification()
    assert not parser.text, f"{parser.text} is left over"
    return found


def declarations(text: str, end: str = "END_VAR") -> tuple[list[Declaration], list[str]]:
    parser = parser_of(text)
    found = parser.declarations(end)
    return found, [str(record) for record in parser.diagnostics.records]


@pytest.mark.parametrize(
    ("text", "kind", "printed"),
    [
        ("INT", NamedType, "INT"),
        ("String", NamedType, "String"),
        ("STRING[80]", StringSpecification, "STRING[80]"),
        ("string(MAX+1)", StringSpecification, "STRING[MAX + 1]"),
        ("WSTRING[5]", StringSpecification, "WSTRING[5]"),
        ("ARRAY[0..9]OF REAL", ArraySpecification, "ARRAY[0..9] OF REAL"),
        ("Array [-5..MAX-1, LOW..2] of X", ArraySpecification, "ARRAY[-5..MAX - 1, LOW..2] OF X"),
        ("ARRAY[0..1] OF ARRAY[0..2] OF INT", ArraySpecification, None),
        ("ARRAY[0..1] OF STRING[8]", ArraySpecification, None),
        ("ARRAY[1. ..%IX0 ..2]OF X", None, None),
        ("REFERENCE TO X", ReferenceSpecification, None),
        ("REFERENCE TO ARRAY[0..3] OF TON", ReferenceSpecification, None),
        ("POINTER TO REAL", ReferenceSpecification, None),
        (
            "Ref_To ARRAY[0..3] OF REF_TO X",
            ReferenceSpecification,
            "REF_TO ARRAY[0..3] OF REF_TO X",
        ),
        ("USINT(4..6)", SubrangeSpecification, None),
        ("SINT (-3..+6)", SubrangeSpecification, "SINT(-3..+6)"),
        ("(A, B := 5)", EnumerationSpecification, None),
        ("()", EnumerationSpecification, None),
        ("(A, B,)", EnumerationSpecification, None),
        ("(A, B) UINT", EnumerationSpecification, None),
        ("UINT (A, B := 16#10)", EnumerationSpecification, None),
        ("STRUCT END_STRUCT", StructSpecification, None),
        ("STRUCT a : INT; END_STRUCT", StructSpecification, None),
    ],
)
def test_specifications(text: str, kind: type | None, printed: str | None) -> None:
    if kind is None:
        with pytest.raises(UnexpectedTokenError):
            specification(text)
        return
    node = specification(text)
    assert isinstance(node, kind)
    assert specification(print_specification(node)) == node
    assert printed in (None, print_specification(node))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected a type, found the end of the file"),
        ("5", "expected a type, found '5'"),
        ("ARRAY OF INT", r"expected '\[' after ARRAY, found 'OF'"),
        ("ARRAY[3] OF INT", r"expected '..' between the bounds of an array, found '\]'"),
        ("ARRAY[0..3 OF INT", r"expected '\]' or ',' after the bounds of an array"),
        ("ARRAY[0..3] INT", "expected 'OF' after the bounds of an array, found 'INT'"),
        ("STRING[", "expected a value"),
        ("STRING[8", "expected ']' after the length of a string"),
        ("REFERENCE X", "expected 'TO' after REFERENCE, found 'X'"),
        ("Buffer<10>", r"Buffer<...> \(VAR_GENERIC\) is not supported"),
        ("Block(a := )", "expected a value"),
        ("Block(1, 2", r"expected ',' or '\)' after what FB_init is given"),
        ("Block[(1), 2]", r"expected '\(' before what FB_init is given"),
        ("INT(1)", "expected '..' between the bounds of INT|expected a name"),
        ("INT(1..2", r"expected '\)' after the bounds of INT"),
        ("(A B)", r"expected ',' or '\)' after the enumeration value A, found 'B'"),
        ("(5)", "expected a name of an enumeration value, found '5'"),
        ("(A := )", r"expected a value, found '\)'"),
    ],
)
def test_errors_in_specifications(text: str, message: str) -> None:
    with pytest.raises(UnexpectedTokenError, match=message):
        specification(text)


@pytest.mark.parametrize(
    "opening", ["ARRAY[0..1] OF ", "REFERENCE TO ", "STRUCT a : ", "STRING[(("]
)
def test_deep_nesting_is_an_error(opening: str) -> None:
    found, errors = declarations(f"a : {opening * 3000}")
    assert any(f"at most {MAX_DEPTH} levels of nesting" in error for error in errors)
    assert found == []


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("END_VAR", []),
        (";;; END_VAR", []),
        ("a : INT; b : BOOL; END_VAR", ["a", "b"]),
        ("a : INT;; ; b : INT END_VAR", ["a", "b"]),
        ("a, b, c : INT; END_VAR", ["a", "b", "c"]),
        ("a AT %IX0.0 : BOOL; END_VAR", ["a"]),
        ("type : INT; END_TYPE : INT; VAR : INT; struct : X; array : Y; END_VAR", None),
        ("s : STRUCT x : INT; END_STRUCT t : INT; END_VAR", ["s", "t"]),
        ("s : STRUCT x : INT END_STRUCT; END_VAR", ["s"]),
        ("a : (* b : *) INT (* ; *) ; // c : INT;\r\nEND_VAR", ["a"]),
        ("a : {P} INT; {Q} b : INT; END_VAR", ["a", "b"]),
        ("at AT %M : INT; END_VAR", ["at"]),
        ("a : STRUCT; x : INT; END_STRUCT; b : struct; x : INT; END_STRUCT; END_VAR", ["a", "b"]),
        ("a : string; b : Array[0..1] of INT; END_VAR", ["a", "b"]),
        ("a : BOOL R_EDGE; b : BOOL f_edge := TRUE; END_VAR", ["a", "b"]),
    ],
)
def test_lists_of_declarations(text: str, names: list[str] | None) -> None:
    found, errors = declarations(text)
    assert errors == []
    if names is not None:
        assert [d.name for d in found] == names


def test_details_of_a_declaration() -> None:
    found, _ = declarations(" a AT %MW0 : {P} BOOL R_EDGE := TRUE; (*why*)\n{Q} b : INT; END_VAR")
    assert (found[0].address, found[0].edge, found[0].pragmas) == ("%MW0", "R_EDGE", ("{P}",))
    assert (found[0].before, found[0].behind) == (" ", " (*why*)\n{Q} ")
    assert found[1].pragmas == ("{Q}",)


@pytest.mark.parametrize(
    ("text", "names", "errors"),
    [
        ("a INT;\nb : INT;\nEND_VAR", ["b"], ["1:3: error: expected ':' after the name a"]),
        ("a : INT\nb : INT;\nEND_VAR", ["b"], ["1:8: error: expected ';' after the declaration"]),
        ("5 : INT; b : INT; END_VAR", ["b"], ["1:1: error: expected the name of a declaration"]),
        ("a : ARRAY[0..] OF INT; b : INT; END_VAR", ["b"], ["1:14: error: expected a value"]),
        ("a : INT := ; b : INT; END_VAR", ["b"], ["1:12: error: expected a value, found ';'"]),
        ("a : INT;", ["a"], ["1:9: error: expected END_VAR, found the end of the file"]),
        ("a : INT; END_TYPE", ["a"], ["1:10: error: expected END_VAR, found 'END_TYPE'"]),
        ("a AT x : INT; END_VAR", [], ["1:6: error: expected an address such as %IX0.0"]),
        ("a, 5 : INT; END_VAR", [], ["1:4: error: expected a name after ','"]),
        (
            "s : STRUCT\n x INT;\n y : INT;\nEND_STRUCT; z : 3; END_VAR",
            ["s"],
            [
                "2:4: error: expected ':' after the name x",
                "4:17: error: expected a type, found '3'",
            ],
        ),
        ("a : INT := 'open;\nb : INT;\nEND_VAR", ["b"], ["1:12: error: expected a value, found a"]),
    ],
)
def test_the_parser_goes_on_after_an_error(text: str, names: list[str], errors: list[str]) -> None:
    found, messages = declarations(text)
    assert [d.name for d in found] == names
    assert len(messages) == len(errors)
    for message, expected in zip(messages, errors, strict=True):
        assert message.startswith(f"a.typ:{expected}")
