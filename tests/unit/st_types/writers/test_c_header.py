import subprocess
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import st_types
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations, parse_text
from st_types.syntax.source import Source
from st_types.types.derived import StructType
from st_types.types.elementary import ALL_ELEMENTARY
from st_types.writers.c_header import C_TYPES, LOCAL, Header, c_header

from ..checked import checked

INCLUDE = Path(st_types.__file__).parent / "writers" / "include"
LIBRARY = Path(__file__).parents[4] / "plcsim" / "library"


def compile_m32(folder: Path, text: str, *options: str) -> str:
    """Compile C as for the 32-bit target and return what gcc complains of."""
    (folder / "check.c").write_text(text)
    command = ["gcc", "-m32", "-Wall", "-Werror", "-fsyntax-only", "-I", str(INCLUDE)]
    done = subprocess.run(
        [*command, *options, "check.c"], cwd=folder, capture_output=True, text=True, check=False
    )
    return done.stderr


def has_m32(folder: Path) -> bool:
    return compile_m32(folder, "#include <stddef.h>\nint main(void) { return 0; }\n") == ""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("header")
    if not has_m32(path):
        pytest.skip("gcc -m32 is not here (package gcc-multilib)")
    return path


def assertions(table: Scope, names: dict[object, str]) -> str:
    """C that does not compile unless every size and every offset is ours."""
    lines = ["#include <stddef.h>"]
    for data_type, name in names.items():
        lines.append(f'_Static_assert(sizeof({name}) == {data_type.size}, "{name}");')
        if isinstance(data_type, StructType):
            for member, offset in zip(data_type.members, data_type.offsets, strict=True):
                place = f"offsetof({name}, {member.name})"
                lines.append(f'_Static_assert({place} == {offset}, "{name}.{member.name}");')
    return "\n".join(lines) + "\n"


def check(folder: Path, table: Scope, *options: str) -> None:
    header = Header(table)
    text = c_header(header, "Check") + assertions(table, header.names)
    assert compile_m32(folder, text, *options) == ""


EVERY_KIND = """
TYPE Both : UNION r : REAL; b : ARRAY[0..4] OF USINT; END_UNION;
Extended EXTENDS Simple0 : STRUCT more : BOOL; END_STRUCT
Simple0 : STRUCT n : INT; u : Both; END_STRUCT; END_TYPE
TYPE
    Mode : (off := -1, auto := 16#10, on);
    Deep : STRUCT p : Point; n : ARRAY[0..2, 1..3] OF Point; x : BOOL; END_STRUCT;
    Point : STRUCT x : LREAL; m : Mode; b : ARRAY[-1..3] OF BOOL; END_STRUCT;
    Text : STRING[33];
    Wide : ARRAY[0..2] OF WSTRING[7];
    Texts : ARRAY[0..1] OF Text;
    Low : USINT(2..9);
    Alias : Low;
    Empty : STRUCT END_STRUCT;
    Nested : STRUCT inner : STRUCT a : INT; b : (x, y); END_STRUCT; after : BYTE; END_STRUCT;
    Node : STRUCT next : REFERENCE TO Node; all : REFERENCE TO ARRAY[0..9] OF Node;
        name : REFERENCE TO STRING[9]; names : REFERENCE TO ARRAY[0..1] OF WSTRING[3];
        mode : REFERENCE TO Mode; each : ARRAY[0..3] OF REFERENCE TO INT; low : REFERENCE TO Low;
        points : REFERENCE TO ARRAY[0..1, 0..1] OF Point; END_STRUCT;
    Other : STRUCT r : REAL; l : LWORD; t : TIME; d : DT; o : TOD; a : DATE; END_STRUCT;
END_TYPE
VAR CONSTANT
    LIMIT : UINT := 5;
    LOWEST : DINT := -2147483648;
    BIG : ULINT := 16#FFFF_FFFF_FFFF_FFFF;
    SMALL : LINT := -9000000000;
    NAME : STRING[9] := 'a"\\$$?$00';
    RATE : REAL := 0.5;
    YES : BOOL := TRUE;
    LIST : ARRAY[0..1] OF INT := [1, 2];
    START : Mode := on;
END_VAR
VAR count : UINT; mode : Mode; low : USINT(1..3); block : Block; END_VAR
VAR RETAIN saved : ARRAY[0..3] OF Point; END_VAR
FUNCTION_BLOCK Block
    VAR_INPUT e : BOOL; p : Point; END_VAR
    VAR_OUTPUT q : BOOL; n : SINT; END_VAR
    VAR_IN_OUT io : Point; END_VAR
    VAR s : Inner; v : LREAL; f : BOOL; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Inner VAR x : UINT; END_VAR END_FUNCTION_BLOCK
FUNCTION Scale : REAL VAR_INPUT x : ANY_NUM; int : INT; s : STRING[5]; p : Point; END_VAR
    VAR_IN_OUT y : INT; END_VAR VAR z : INT; END_VAR END_FUNCTION
FUNCTION Make : Point END_FUNCTION
FUNCTION Plain END_FUNCTION
"""


def test_every_kind_of_type_compiles_and_lies_as_laid_out(folder: Path) -> None:
    file = parse_text(EVERY_KIND)
    table = checked([file], strict=True)
    assert file.diagnostics.records == []
    check(folder, table)
    text = c_header(Header(table), "Check")
    for options in (["-D_REPLACE_CONST"], ["-x", "c++"]):
        assert compile_m32(folder, text, *options) == ""


def test_the_library_compiles_and_lies_as_laid_out(folder: Path) -> None:
    paths = [p for p in sorted(LIBRARY.rglob("*")) if p.suffix in (".fun", ".typ", ".var")]
    assert len(paths) >= 4
    table = checked([parse_declarations(Source.read(path)) for path in paths], strict=True)
    check(folder, table, "-fno-builtin")  # atan2 of AsMath is one of REALs, unlike the built-in one


def test_a_function_that_gives_a_string_returns_its_address() -> None:
    text = "FUNCTION Name : STRING[5] END_FUNCTION FUNCTION Wide : WSTRING[5] END_FUNCTION"
    header = c_header(Header(checked([parse_text(text)])), "Check")
    assert "_BUR_PUBLIC plcstring* Name(void);" in header
    assert "_BUR_PUBLIC plcwstring* Wide(void);" in header


def test_constants_have_their_values(folder: Path) -> None:
    text = c_header(Header(checked([parse_text(EVERY_KIND)])), "Check")
    text += (
        '_Static_assert(LIMIT == 5 && LOWEST < 0 && YES == 1 && RATE == 0.5, "");\n'
        '_Static_assert(BIG == 18446744073709551615ULL && SMALL == -9000000000LL, "");\n'
        '_Static_assert(sizeof(NAME) == 7, "");\n'
    )
    assert compile_m32(folder, text, "-D_REPLACE_CONST") == ""


def test_the_shape_of_a_data_block() -> None:
    file = parse_text(
        "FUNCTION_BLOCK F VAR_INPUT enable : BOOL; n : UINT; END_VAR VAR_OUTPUT done : BOOL; "
        "END_VAR VAR text : STRING[3]; bits : ARRAY[0..7] OF BOOL; END_VAR "
        "VAR_IN_OUT count : INT; go : BOOL; END_VAR END_FUNCTION_BLOCK"
    )
    lines = list(Header(checked([file])).lines())
    assert lines == [
        "",
        "typedef struct F {",
        "\t/* VAR_INPUT (analog) */",
        "\tunsigned short n;",
        "\t/* VAR_IN_OUT (analog and digital) */",
        "\tsigned short* count;",
        "\tplcbit* go;",
        "\t/* VAR (analog) */",
        "\tplcstring text[4];",
        "\t/* VAR_INPUT (digital) */",
        "\tplcbit enable;",
        "\t/* VAR_OUTPUT (digital) */",
        "\tplcbit done;",
        "\t/* VAR (digital) */",
        "\tplcbit bits[8];",
        "} F_typ;",
        "",
        "/* Prototypes */",
        "_BUR_PUBLIC void F(struct F* inst);",
    ]


def test_names_that_c_does_not_allow() -> None:
    file = parse_text("TYPE int : STRUCT long : INT; END_STRUCT; E : (red, int); END_TYPE")
    text = c_header(Header(checked([file])), "my lib")
    assert "typedef struct int_ {\n\tsigned short long_;\n} int_;" in text
    assert "\tint__ = 1,\n} E;" in text
    assert "#ifndef _MY_LIB_H_" in text


def test_parameters_are_those_of_automation_studios_headers() -> None:
    """Each line stands so, but for its names, in headers that Automation Studio generated."""
    file = parse_text(
        "TYPE S : STRUCT x : INT; END_STRUCT; E : (a, b); Id : DINT; Guid : ARRAY[0..3] OF BYTE; "
        "END_TYPE FUNCTION F : E VAR_INPUT s : S; t : STRING[9]; e : E; i : Id; g : Guid; "
        "a : ARRAY[0..2, 1..4] OF LREAL; b : ARRAY[0..1] OF S; c : ARRAY[0..1] OF STRING[5]; "
        "END_VAR END_FUNCTION FUNCTION G : BOOL VAR_INPUT s : REFERENCE TO S; "
        "t : REFERENCE TO STRING[9]; n : REFERENCE TO UINT; e : REFERENCE TO E; "
        "a : REFERENCE TO ARRAY[0..2] OF S; c : REFERENCE TO ARRAY[0..1] OF STRING[5]; END_VAR "
        "END_FUNCTION "
        "FUNCTION H VAR_IN_OUT s : S; t : STRING[9]; n : UINT; a : ARRAY[0..2] OF BYTE; END_VAR "
        "END_FUNCTION FUNCTION K : Lib END_FUNCTION FUNCTION L : ANY_NUM END_FUNCTION"
    )
    first = "_BUR_PUBLIC enum E F(struct S* s, plcstring* t, enum E e, Id i, Guid g, "
    first += "double a[3][4], struct S b[2], plcstring* c[2]);"
    second = "_BUR_PUBLIC plcbit G(struct S** s, plcstring** t, unsigned short* n, enum E* e, "
    second += "struct S (*a)[3], plcstring* (*c)[2]);"
    lines = list(Header(checked([file])).lines())
    assert lines[lines.index("/* Prototypes */") + 1 :] == [
        *(first, second),
        "_BUR_PUBLIC void H(struct S* s, plcstring* t, unsigned short* n, plcbyte a[3]);",
        "/* L gives any type: C has no prototype for it */",
    ]


def test_a_reference_to_another_name_of_a_type_is_one_pointer(folder: Path) -> None:
    text = "TYPE S : STRUCT x : INT; END_STRUCT; Same : S; Name : STRING[9]; END_TYPE FUNCTION F : "
    text += "BOOL VAR_INPUT a : REFERENCE TO Same; b : REFERENCE TO Name; END_VAR END_FUNCTION"
    header = c_header(Header(checked([parse_text(text)])), "Check")
    body = "plcbit F(Same* a, Name* b) { return a->x == **b; }\n"
    assert compile_m32(folder, header + body) == ""


def test_words_that_only_cpp_does_not_allow(folder: Path) -> None:
    text = "FUNCTION F VAR_INPUT new : INT; END_VAR END_FUNCTION TYPE S : STRUCT xor : BOOL; "
    text += "class : ARRAY[0..2] OF INT; END_STRUCT; END_TYPE"
    header = c_header(Header(checked([parse_text(text)])), "Check")
    assert "\tplcbit xor;\n" in header
    use = "int f(S* s) { return s->xor%s + s->class%s[0]; }\n"
    assert compile_m32(folder, header + use.replace("%s", "")) == ""
    assert compile_m32(folder, header + use.replace("%s", "_"), "-x", "c++") == ""


@pytest.mark.parametrize(
    "declared", ["REFERENCE TO T{}", "STRUCT a : REFERENCE TO ARRAY[0..1] OF T{}; END_STRUCT"]
)
def test_references_that_go_on_and_on(folder: Path, declared: str) -> None:
    types = [f"T{i} : {declared.format((i + 1) % 900)};" for i in range(900)]
    scope = checked([parse_text(f"TYPE {' '.join(types)} END_TYPE")])
    assert compile_m32(folder, c_header(Header(scope), "Check")) == ""


def test_a_header_rests_on_those_it_includes() -> None:
    outer = checked([parse_text("TYPE S : STRUCT x : INT; END_STRUCT; E : (a, b); END_TYPE")])
    inner = checked(
        [
            parse_text(
                "TYPE S : INT; T : STRUCT e : E; s : S; END_STRUCT; END_TYPE VAR a : T; END_VAR"
            )
        ],
        [outer],
    )
    around = Header(outer)
    list(around.lines())
    assert list(Header(inner, [around], variables=LOCAL).lines()) == [
        *("", "typedef signed short S_;"),
        *("", "typedef struct T {", "\tenum E e;", "\tS_ s;", "} T;"),
        *("", "/* Variables */", "_BUR_LOCAL struct T a_;"),
    ]


def test_every_elementary_type_has_a_c_type() -> None:
    assert {t.name for t in ALL_ELEMENTARY.values()} == set(C_TYPES)


kinds = st.sampled_from(
    ["BOOL", "SINT", "UINT", "REAL", "LREAL", "LINT", "STRING[3]", "WSTRING[2]", "Mode", "TIME"]
)
arrays = st.tuples(st.integers(1, 3), kinds).map(lambda a: f"ARRAY[0..{a[0]}] OF {a[1]}")
members = st.lists(
    kinds | arrays | st.sampled_from(["S0", "REFERENCE TO S1"]), min_size=1, max_size=6
)


@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(lists=st.lists(members, min_size=3, max_size=3))
def test_random_structs_lie_as_gcc_lays_them_out(folder: Path, lists: list[list[str]]) -> None:
    text = ["TYPE Mode : (a, b);", "S0 : STRUCT x : BYTE; y : LREAL; END_STRUCT;"]
    for number, kinds_of in enumerate(lists, 1):
        declared = " ".join(f"m{i} : {kind};" for i, kind in enumerate(kinds_of))
        text.append(f"S{number} : STRUCT {declared} END_STRUCT;")
    check(folder, checked([parse_text(" ".join(text) + " END_TYPE")], strict=True))
