import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from st_types.syntax.declarations import parse_declarations, parse_text
from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.expressions import Binary, Expression, Literal, MemberAccess, Name, Unary
from st_types.syntax.lexer import Tokens
from st_types.syntax.literals import parse_literal
from st_types.syntax.printer import print_bytes, print_declaration, print_file, print_item
from st_types.syntax.source import Source
from st_types.syntax.tree import (
    ArrayInitial,
    ArraySpecification,
    Declaration,
    DeclarationFile,
    EnumerationSpecification,
    EnumerationValue,
    FunctionBlockDeclaration,
    FunctionDeclaration,
    MemberInitial,
    NamedType,
    ReferenceSpecification,
    RepeatedInitial,
    StringSpecification,
    StructInitial,
    StructSpecification,
    SubrangeSpecification,
    TypeBlock,
    VariableBlock,
)

AUTOMATION_STUDIO_STYLE = """\
(* Types of the cell *)
TYPE
	(* Modes *)
	Mode :
		( (*mode of operation*)
		AUTO := 16#10, (*by itself*)
		// by hand
		MANUAL (*last*)
		);
	Axis : STRUCT (*one axis*) (*#CYC#*)
		Position : LREAL := -1.5E3; (*mm*) (*#OPT#*)
		Names : ARRAY[0..MAX_IDX, -1..1] OF STRING[SIZE + 1] := [2('it$'s'), ''];
		Timer : TON := (PT := T#1s500ms);
		Next : REFERENCE TO Axis; // none
		(* to be removed *)
	END_STRUCT;
	Low : USINT(4..6) := 5;
END_TYPE
VAR CONSTANT
	MAX_IDX : USINT := 9;
END_VAR
{REDUND_OK} {REDUND_UNREPLICABLE} FUNCTION_BLOCK Drive (*drives it*) (*$GROUP=User*)
	VAR_INPUT
		Enable : {REDUND_UNREPLICABLE} BOOL; (*on*)
	END_VAR
	(* outputs *)
	VAR_OUTPUT
		Done : BOOL;
	END_VAR
END_FUNCTION_BLOCK
FUNCTION Scale : REAL (*linear*)
	VAR_INPUT
		Value : ANY_NUM;
	END_VAR
END_FUNCTION
VAR
	Input AT %IX0.1 : BOOL R_EDGE;
END_VAR
(* end *)
"""


def test_text_in_the_usual_shape_comes_back_unchanged() -> None:
    assert print_file(parse_text(AUTOMATION_STUDIO_STYLE)) == AUTOMATION_STUDIO_STYLE


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("TYPE END_TYPE", "TYPE\nEND_TYPE\n"),
        ("TYPE (*a*) x : INT; END_TYPE (*b*) ", "TYPE\n\t(*a*)\n\tx : INT;\nEND_TYPE\n(*b*)\n"),
        ("VAR (*a*) END_VAR", "VAR\n\t(*a*)\nEND_VAR\n"),
        ("VAR (*a*)\n(*b*) END_VAR", "VAR\n\t(*a*)\n\t(*b*)\nEND_VAR\n"),
        ("VAR a,b:INT;END_VAR", "VAR\n\ta : INT;\n\tb : INT;\nEND_VAR\n"),
        ("TYPE e : (); END_TYPE", "TYPE\n\te :\n\t\t(\n\t\t);\nEND_TYPE\n"),
        ("VAR END_VAR (*x*) VAR END_VAR", "VAR\nEND_VAR\n(*x*)\nVAR\nEND_VAR\n"),
        ("{P} VAR END_VAR", "{P} VAR\nEND_VAR\n"),
        (
            "VAR a:F(x:=1,y:=A.b);b:F(1);c:ARRAY[0..1] OF F[(x:=1),(2)];END_VAR",
            (
                "VAR\n\ta : F(x := 1, y := A.b);\n\tb : F(1);\n"
                "\tc : ARRAY[0..1] OF F[(x := 1), (2)];\nEND_VAR\n"
            ),
        ),
        ("VAR a : A := (0); END_VAR", "VAR\n\ta : A := (0);\nEND_VAR\n"),
        (
            "VAR a : ARRAY[(0)..(N)] OF INT := [((N)+1)((2))]; END_VAR",
            "VAR\n\ta : ARRAY[(0)..(N)] OF INT := [((N) + 1)((2))];\nEND_VAR\n",
        ),
        (
            "{A} TYPE E : ({B}\nx {C},\n{D} y); END_TYPE {E}",
            "{A}\nTYPE\n\tE :\n\t\t( {B}\n\t\tx,\n\t\t{D}\n\t\ty\n\t\t);\nEND_TYPE\n{E}\n",
        ),
        (
            "TYPE S : STRUCT a : INT; {P}\nEND_STRUCT; {Q} END_TYPE",
            "TYPE\n\tS : STRUCT\n\t\ta : INT;\n\t\t{P}\n\tEND_STRUCT;\n\t{Q}\nEND_TYPE\n",
        ),
        ("FUNCTION f (*a*)\n(*b*) END_FUNCTION", "FUNCTION f (*a*)\n(*b*)\nEND_FUNCTION\n"),
        (
            "FUNCTION f : STRUCT a : INT; END_STRUCT END_FUNCTION",
            "FUNCTION f : STRUCT\n\ta : INT;\nEND_STRUCT\nEND_FUNCTION\n",
        ),
    ],
)
def test_shapes(text: str, printed: str) -> None:
    assert print_file(parse_text(text)) == printed


@pytest.mark.parametrize(
    "data",
    [
        "TYPE\r\n\tA : INT; (*für*)\r\nEND_TYPE\r\n".encode("latin-1"),
        "\ufeffTYPE\n\tA : INT; (*€\n2*)\nEND_TYPE\n".encode(),
        "\ufeffTYPE\r\tA : INT;\rEND_TYPE\r".encode("utf-16-le"),
        "\ufeffTYPE\r\n\tA : INT;\r\nEND_TYPE\r\n".encode("utf-16-be"),
    ],
)
def test_encoding_mark_and_line_ends_are_those_that_were_read(data: bytes) -> None:
    assert print_bytes(parse_declarations(Source.decode("a.typ", data))) == data


def test_parts_print_alone() -> None:
    item = parse_text("VAR x : INT := 5; (*why*) END_VAR").items[0]
    assert print_item(item) == "VAR\n\tx : INT := 5; (*why*)\nEND_VAR\n"
    assert print_declaration(item.declarations[0]) == "x : INT := 5; (*why*)\n"


names = st.sampled_from(["a", "Speed", "_x1", "TYPE", "Var", "END_STRUCT", "ARRAY", "OF", "string"])
free_names = st.sampled_from(["a", "Speed", "MAX_IDX", "_x1"])
comments = st.sampled_from(["", " (*why*)", "\n(* own line *)\n", " // to the end\n", "\n"])
texts = st.sampled_from(["0", "7", "1.", "1.5E3", "16#FF", "'a$'b'", '"w"', "T#-1s", "D#2024-1-1"])
expressions: st.SearchStrategy[Expression] = st.recursive(
    st.one_of(
        texts.map(lambda text: Literal(0, text, parse_literal(text))),
        free_names.map(lambda name: Name(0, name)),
    ),
    lambda inner: st.one_of(
        st.builds(Binary, st.just(0), st.sampled_from(["+", "*", "OR", "**"]), inner, inner),
        st.builds(Unary, st.just(0), st.sampled_from(["-", "NOT"]), inner),
        st.builds(MemberAccess, st.just(0), free_names.map(lambda n: Name(0, n)), free_names),
    ),
    max_leaves=3,
)
counts = st.one_of(
    st.just(Literal(0, "3", parse_literal("3"))), free_names.map(lambda name: Name(0, name))
)


def few(strategy: st.SearchStrategy, smallest: int = 0) -> st.SearchStrategy[list]:
    return st.lists(strategy, min_size=smallest, max_size=3)


initials = st.recursive(
    expressions,
    lambda inner: st.one_of(
        st.builds(
            ArrayInitial,
            st.just(0),
            few(inner | st.builds(RepeatedInitial, st.just(0), counts, few(inner))),
        ),
        st.builds(
            StructInitial, st.just(0), few(st.builds(MemberInitial, st.just(0), free_names, inner))
        ),
    ),
    max_leaves=4,
)


def declarations_of(specifications: st.SearchStrategy) -> st.SearchStrategy[Declaration]:
    return st.builds(
        Declaration,
        st.just(0),
        names,
        specifications,
        st.none() | initials,
        st.sampled_from(["", "%IX0.1", "%M*"]),
        st.sampled_from([(), ("{P}",), ("{P}", "{ Q }")]),
        st.sampled_from(["", "R_EDGE"]),
    )


enumerations = st.builds(
    EnumerationSpecification,
    st.just(0),
    few(st.builds(EnumerationValue, st.just(0), names, st.none() | expressions)),
    st.sampled_from(["", "UINT"]),
)
specifications = st.recursive(
    st.one_of(
        free_names.map(lambda name: NamedType(0, name)),
        st.just(NamedType(0, "STRING")),
        st.builds(
            StringSpecification, st.just(0), st.sampled_from(["STRING", "WSTRING"]), expressions
        ),
        st.builds(SubrangeSpecification, st.just(0), free_names, expressions, expressions),
        enumerations,
    ),
    lambda inner: st.one_of(
        st.builds(
            ArraySpecification, st.just(0), few(st.tuples(expressions, expressions), 1), inner
        ),
        st.builds(
            ReferenceSpecification,
            st.just(0),
            inner,
            st.sampled_from(["REFERENCE", "POINTER", "REF_TO"]),
        ),
        st.builds(StructSpecification, st.just(0), few(declarations_of(inner))),
    ),
    max_leaves=4,
)
declarations = few(declarations_of(specifications))
pragmas = st.sampled_from([(), ("{P}",), ("{P}", "{Q}")])
variable_blocks = st.builds(
    VariableBlock,
    st.just(0),
    st.sampled_from(["VAR", "VAR_INPUT", "VAR_IN_OUT", "VAR_GLOBAL"]),
    st.sampled_from([(), ("CONSTANT",), ("RETAIN", "PERSISTENT")]),
    declarations,
    pragmas,
)
items = st.one_of(
    st.builds(TypeBlock, st.just(0), declarations),
    variable_blocks,
    st.builds(FunctionBlockDeclaration, st.just(0), free_names, few(variable_blocks), pragmas),
    st.builds(
        FunctionDeclaration,
        st.just(0),
        free_names,
        st.none() | specifications,
        few(variable_blocks),
        pragmas,
    ),
)
EMPTY = Source("a.typ", "")
files = st.builds(
    DeclarationFile, few(items), st.just(""), st.just(Tokens(EMPTY)), st.just(DiagnosticLog(EMPTY))
)


@given(files)
@settings(max_examples=60)
def test_printing_then_parsing_is_the_identity(file: DeclarationFile) -> None:
    assert parse_text(print_file(file)) == file


PIECES = [
    "TYPE",
    "END_TYPE",
    "VAR",
    "END_VAR",
    "A : INT;",
    "B : (x, y := 5);",
    "(*c*)",
    "// c\n",
    "\n",
]
PIECES += [
    "S : STRUCT",
    "END_STRUCT;",
    "{P}",
    "a, b : BOOL := TRUE;",
    "FUNCTION_BLOCK F",
    "(* d\n *)",
]
PIECES += [
    "END_FUNCTION_BLOCK",
    "FUNCTION G : INT",
    "END_FUNCTION",
    "VAR_INPUT",
    ";",
    "(",
    ")",
    ",",
]


@given(st.lists(st.sampled_from(PIECES), max_size=25))
def test_whatever_parses_prints_and_parses_again(pieces: list[str]) -> None:
    file = parse_declarations(Source("a.typ", " ".join(pieces)))
    if file.diagnostics.error_count:
        return
    printed = print_file(file)
    again = parse_text(printed)
    assert again == file
    assert print_file(again) == printed  # comments are not lost on the second way
