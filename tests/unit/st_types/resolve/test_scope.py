from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types import DeclarationError
from st_types.resolve.dialect import AUTOMATION_STUDIO, IEC, Dialect
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations, parse_text
from st_types.syntax.literals import Constant
from st_types.syntax.source import Source
from st_types.types.derived import (
    AliasType,
    DataBlockType,
    EnumerationType,
    ReferenceType,
    StructType,
    resolve_alias,
)
from st_types.types.elementary import DINT, INT
from st_types.types.values import decode, encode, initial_image

from ..checked import checked


def scope_of(*texts: str, dialect: Dialect = AUTOMATION_STUDIO) -> Scope:
    files = [parse_text(text, f"{number}.typ") for number, text in enumerate(texts)]
    scope = checked(files, strict=True, dialect=dialect)
    for file in files:
        file.diagnostics.raise_errors()
    return scope


def findings(*texts: str, strict: bool = False) -> list[str]:
    files = [parse_text(text, f"{number}.typ") for number, text in enumerate(texts)]
    checked(files, strict=strict)
    return [str(record) for file in files for record in file.diagnostics.records]


def layout_of(scope: Scope, name: str) -> list[tuple[int, str]]:
    data_type = scope.find_type(name)
    assert isinstance(data_type, StructType)
    names = [member.name for member in data_type.members]
    return sorted(zip(data_type.offsets, names, strict=True))


LIBRARY = Path(__file__).parents[4] / "plcsim" / "library"
INTERNALS = ["i_state", "i_result", "i_tmp", "enable"]
TRANSFER = ["ident", "pData", "datalen"]
"""Sizes and offsets as measured with gcc -m32 on B&R's AsTCP.h."""
AS_TCP = {
    "TcpOpen": (
        32,
        [0, 4, 8, 12, 16, 20, 22, 24, 28],
        ["pIfAddr", "port", "options", "status", "ident", *INTERNALS],
    ),
    "TcpOpenSsl": (
        36,
        [0, 4, 8, 12, 16, 20, 24, 26, 28, 32],
        ["pIfAddr", "port", "sslCfgIdent", "options", "status", "ident", *INTERNALS],
    ),
    "TcpServer": (
        36,
        [0, 4, 8, 12, 16, 20, 22, 24, 28, 32],
        ["ident", "backlog", "pIpAddr", "status", "identclnt", "portclnt", *INTERNALS],
    ),
    "TcpClient": (
        24,
        [0, 4, 8, 10, 12, 14, 16, 20],
        ["ident", "pServer", "portserv", "status", *INTERNALS],
    ),
    "TcpClose": (24, [0, 4, 8, 10, 12, 16, 20], ["ident", "how", "status", *INTERNALS]),
    "TcpSend": (
        36,
        [0, 4, 8, 12, 16, 20, 24, 26, 28, 32],
        [*TRANSFER, "flags", "status", "sentlen", *INTERNALS],
    ),
    "TcpRecv": (
        36,
        [0, 4, 8, 12, 16, 20, 24, 26, 28, 32],
        ["ident", "pData", "datamax", "flags", "status", "recvlen", *INTERNALS],
    ),
    "TcpIoctl": (
        36,
        [0, 4, 8, 12, 16, 20, 24, 26, 28, 32],
        ["ident", "ioctl", "pData", "datalen", "status", "outlen", *INTERNALS],
    ),
    "tcpLINGER_typ": (8, [0, 4], ["lOnOff", "lLinger"]),
    "tcpSO_ADDRESS_typ": (8, [0, 4], ["pPort", "pIpAddr"]),
    "TON": (
        20,
        [0, 4, 8, 12, 16, 17, 18],
        ["PT", "ET", "StartTime", "Restart", "IN", "Q", "M"],
    ),
}


@pytest.mark.parametrize("name", AS_TCP)
def test_library_blocks_lie_as_in_the_vendors_header(name: str) -> None:
    paths = [p for p in sorted(LIBRARY.rglob("*")) if p.suffix in (".fun", ".typ", ".var")]
    scope = checked([parse_declarations(Source.read(path)) for path in paths], strict=True)
    size, offsets, names = AS_TCP[name]
    data_type = scope.find_type(name)
    assert data_type is not None
    assert data_type.size == size
    assert layout_of(scope, name) == list(zip(offsets, names, strict=True))


def test_forward_references_between_types_and_files() -> None:
    scope = scope_of(
        "TYPE A : STRUCT b : b; n : ARRAY[0..MAX] OF Colour; END_STRUCT; END_TYPE",
        "TYPE B : STRUCT x : LREAL; y : BOOL; END_STRUCT; Colour : (red, green := MAX); END_TYPE",
        "VAR CONSTANT Max : UINT := HALF * 2; half : UINT := 2; END_VAR",
    )
    assert layout_of(scope, "A") == [(0, "b"), (12, "n")]
    found = scope.find_type("a")
    assert found is not None
    assert found.size == 32
    colour = scope.find_type("COLOUR")
    assert isinstance(colour, EnumerationType)
    assert colour.values == {"red": 0, "green": 4}


def test_types_that_refer_to_themselves() -> None:
    scope = scope_of(
        "TYPE Node : STRUCT next : REFERENCE TO Node; all : REFERENCE TO ARRAY[0..3] OF Node; "
        "END_STRUCT; END_TYPE"
    )
    node = scope.find_type("Node")
    assert isinstance(node, StructType)
    assert node.size == 8
    reference = node.members[0].data_type
    assert isinstance(reference, ReferenceType)
    assert reference.target is node
    assert reference.name == "REFERENCE TO Node"


def test_a_long_chain_of_references_is_no_nesting() -> None:
    types = "".join(f"T{i} : STRUCT r : REFERENCE TO T{i + 1}; END_STRUCT; " for i in range(3000))
    assert findings(f"TYPE {types} T3000 : INT; END_TYPE") == []


def test_data_blocks() -> None:
    scope = scope_of(
        "FUNCTION_BLOCK F VAR s : INT; END_VAR VAR_OUTPUT q : BOOL; o : UDINT; END_VAR "
        "VAR_IN_OUT io : BOOL; END_VAR VAR_INPUT e : BOOL; i : LREAL; END_VAR "
        "VAR CONSTANT N : INT := 3; END_VAR VAR a : ARRAY[1..N] OF INT; END_VAR "
        "VAR_TEMP t : INT; END_VAR END_FUNCTION_BLOCK"
    )
    block = scope.find_type("F")
    assert isinstance(block, DataBlockType)
    assert layout_of(scope, "F") == [
        *[(0, "i"), (8, "o"), (12, "io"), (16, "s"), (18, "a")],
        *[(24, "e"), (25, "q")],
    ]


def test_a_block_inside_a_block_with_initial_values() -> None:
    scope = scope_of(
        "FUNCTION_BLOCK Inner VAR_INPUT PT : TIME := T#1s; IN : BOOL; END_VAR END_FUNCTION_BLOCK "
        "FUNCTION_BLOCK Outer VAR t : Inner := (PT := T#5s, IN := TRUE); END_VAR "
        "END_FUNCTION_BLOCK"
    )
    outer = scope.find_type("Outer")
    assert outer is not None
    assert decode(outer, initial_image(outer)) == {"t": {"PT": 5000, "IN": True}}


def test_kinds_of_named_types() -> None:
    scope = scope_of(
        "TYPE Alias : INT := 5; Text : STRING[MAX]; Low : USINT(2..9) := 3; Names : ARRAY[-1..1] "
        "OF Text := [2('a')]; Mode : (off, on) := on; S : STRUCT x : Low; END_STRUCT := (x := 4); "
        "Empty : STRUCT END_STRUCT; Plain : STRING; END_TYPE VAR CONSTANT MAX : INT := 3; END_VAR"
    )
    alias = scope.find_type("Alias")
    assert isinstance(alias, AliasType)
    assert (alias.target, alias.initial) == (INT, 5)
    images = {t.name: decode(t, initial_image(t)) for t in scope.data_types()}
    assert images == {
        "Alias": 5,
        "Text": "",
        "Low": 3,
        "Names": ["a", "a", ""],
        "Mode": 1,
        "S": {"x": 4},
        "Empty": {},
        "Plain": "",
    }
    plain = scope.find_type("Plain")
    assert plain is not None
    assert plain.size == 81


def test_variables() -> None:
    scope = scope_of(
        "VAR RETAIN x : INT := N; END_VAR VAR CONSTANT N : INT := 7; END_VAR "
        "VAR a, b : ARRAY[0..1] OF BOOL := [1, TRUE]; END_VAR"
    )
    assert [(v.name, str(v.data_type), v.initial) for v in scope.variables] == [
        ("x", "INT", 7),
        ("N", "INT", 7),
        ("a", "ARRAY[0..1] OF BOOL", [True, True]),
        ("b", "ARRAY[0..1] OF BOOL", [True, True]),
    ]
    assert scope.variables[0].block.qualifiers == ("RETAIN",)
    assert str(scope.variables[2].file.location(scope.variables[2].node)).endswith(":1:73")


def test_functions() -> None:
    scope = scope_of(
        "FUNCTION Scale : REAL VAR_INPUT x : ANY_NUM; a : ARRAY[0..N] OF INT; END_VAR "
        "VAR_IN_OUT s : INT; END_VAR VAR CONSTANT N : INT := 1; END_VAR END_FUNCTION "
        "FUNCTION Nothing END_FUNCTION"
    )
    scale, nothing = scope.functions
    assert str(scale.result) == "REAL"
    assert [(v.name, v.data_type and v.data_type.size) for v in scale.variables] == [
        *[("x", None), ("a", 4), ("s", 2), ("N", 2)],
    ]
    assert (nothing.name, nothing.result, nothing.variables) == ("Nothing", None, ())
    assert scale.scope.constant("N") == Constant("INT", 1)


def test_outer_scopes_are_resolved_as_far_as_they_are_needed() -> None:
    library = parse_text("TYPE T : INT; Bad : ARRAY[1..0] OF INT; END_TYPE", "lib.typ")
    file = parse_text("TYPE U : T; END_TYPE", "own.typ")
    scope = checked([file], [Scope("lib", [library])], strict=True)
    assert [data_type.name for data_type in scope.data_types()] == ["U"]
    assert resolve_alias(scope.find_type("U")) is INT
    assert file.diagnostics.records == library.diagnostics.records == []


PROJECT = """
TYPE Parameters : STRUCT g : LREAL; END_STRUCT; Shared : STRUCT p : Parameters; END_STRUCT; END_TYPE
VAR CONSTANT MAX : INT := 9; END_VAR VAR gCount : UDINT; x : BOOL; END_VAR
"""


def programs() -> tuple[Scope, Scope, Scope]:
    """Two programs, each with types and constants of its own, and the project around them."""
    library = Scope("lib", [parse_text("FUNCTION Lib : INT END_FUNCTION", "lib.fun")])
    project = Scope("project", [parse_text(PROJECT, "Global.typ")], [library], strict=True)
    belt = (
        "TYPE Parameters : INT; END_TYPE VAR x : Parameters; n : ARRAY[0..MAX] OF Shared; END_VAR"
    )
    pump = "VAR CONSTANT MAX : INT := 1; END_VAR VAR n : ARRAY[0..MAX] OF Parameters; END_VAR"
    scopes = [
        Scope(name, [parse_text(text, f"{name}.var")], [project], strict=True)
        for name, text in (("belt", belt), ("pump", pump))
    ]
    return scopes[0], scopes[1], project


def test_what_is_local_hides_what_is_global() -> None:
    belt, pump, project = programs()
    sizes = {v.name: v.data_type.size for v in belt.variables if v.data_type is not None}
    assert sizes == {"x": 2, "n": 80}
    assert [str(v.data_type) for v in pump.variables] == ["INT", "ARRAY[0..1] OF Parameters"]
    assert pump.find_type("Parameters") is project.find_type("Parameters")
    assert resolve_alias(belt.find_type("Parameters")) is INT
    assert (belt.constant("MAX"), pump.constant("MAX")) == (
        Constant("INT", 9),
        Constant("INT", 1),
    )
    names = ("x", "gCount", "Lib", "Parameters", "Shared", "pump", "INT")
    owners = [belt.owner_of(name) for name in names]
    assert [o and o.name for o in owners] == [
        *["belt", "project", "lib", "belt", "project", None, None]
    ]
    for scope in (belt, pump, project):
        scope.check()
        assert scope.files[0].diagnostics.records == []


def test_a_program_does_not_see_its_sibling() -> None:
    _, pump, project = programs()
    assert pump.find_variable("x") is project.variables[2]
    assert [scope.name for scope in pump.chain] == ["pump", "project", "lib"]
    assert project.find_variable("n") is None


def test_scopes_may_see_one_another() -> None:
    libraries: list[Scope] = []
    for name, text in (
        ("a", "TYPE A : STRUCT b : B; END_STRUCT; END_TYPE"),
        ("b", "TYPE B : INT; C : A; END_TYPE"),
    ):
        libraries.append(Scope(name, [parse_text(text, name)], libraries, strict=True))
    assert [scope.name for scope in libraries[1].chain] == ["b", "a"]
    found = libraries[1].find_type("C")
    assert resolve_alias(found) is libraries[0].find_type("A")


def test_finding_what_is_declared() -> None:
    scope = scope_of(
        "VAR v : INT := 3; END_VAR VAR CONSTANT c : INT := 4; END_VAR "
        "FUNCTION f : REAL VAR_INPUT x : LREAL; END_VAR END_FUNCTION "
        "FUNCTION_BLOCK B VAR_INPUT i : INT; END_VAR VAR CONSTANT N : INT := 2; END_VAR "
        "VAR_IN_OUT io : ARRAY[0..N] OF INT; END_VAR VAR_TEMP t : DINT; END_VAR END_FUNCTION_BLOCK "
        "TYPE T : INT; END_TYPE"
    )
    assert [variable.name for variable in scope.variables] == ["v", "c"]
    assert [variable.is_constant for variable in scope.variables] == [False, True]
    assert [each.name for each in scope.types] == ["T"]
    variable = scope.find_variable("v")
    assert variable is not None
    assert (variable.data_type, variable.initial) == (INT, 3)
    function = scope.find_function("f")
    assert function is not None
    assert (str(function.result), len(function.variables)) == ("REAL", 1)
    block = scope.find_function_block("B")
    assert block is not None
    assert block == scope.function_blocks[0]
    assert block.data_type is scope.find_type("B")
    assert [(v.name, str(v.data_type)) for v in block.variables] == [
        *[("i", "INT"), ("N", "INT"), ("io", "ARRAY[0..2] OF INT"), ("t", "DINT")]
    ]
    assert block.data_type is not None
    assert [member.name for member in block.data_type.members] == ["i", "io"]
    assert block.scope.find_variable("v") == variable
    nothing = (scope.find_variable("T"), scope.find_function("T"), scope.find_function_block("T"))
    assert nothing == (None, None, None)


def test_values_of_constant_expressions() -> None:
    scope = scope_of("VAR CONSTANT c : INT := 4; END_VAR TYPE E : (a, b); END_TYPE")
    assert scope.constant("E#b") == scope.constant("E.b") == scope.constant("b")
    (block,) = parse_text("VAR x : INT := c * 2 + b; END_VAR").items
    expression = block.declarations[0].initial  # type: ignore[union-attr]  # it is a VAR block
    assert scope.evaluate(expression) == Constant("INT", 9)  # type: ignore[arg-type]  # no list


CASES = "TYPE Mode : (On); END_TYPE VAR Speed : Mode; END_VAR FUNCTION Run END_FUNCTION"


def test_another_case_is_found_and_told_in_automation_studio() -> None:
    scope = scope_of(CASES)
    assert scope.find_type("MODE") is scope.find_type("Mode")
    assert scope.find_function("RUN") == scope.find_function("Run")
    assert scope.find_variable("SPEED") == scope.find_variable("Speed")
    assert [scope.spelling(name) for name in ("mode", "speed", "Run", "nothing")] == [
        *["Mode", "Speed", "Run", None]
    ]
    text = "VAR CONSTANT Max : INT := 1; END_VAR TYPE A : ARRAY[0..MAX] OF ton; TON : INT; END_TYPE"
    assert findings(text) == [
        "0.typ:1:56: warning: MAX is declared as Max; names differ in case",
        "0.typ:1:64: warning: ton is declared as TON; names differ in case",
    ]


def test_names_that_differ_in_case_only_are_two_in_automation_studio() -> None:
    scope = scope_of("TYPE R_TRIG : INT; r_trig : DINT; x : r_trig; END_TYPE")
    assert resolve_alias(scope.find_type("x")) is DINT
    assert findings("TYPE R_TRIG : INT; r_trig : DINT; x : R_trig; END_TYPE") == [
        "0.typ:1:39: warning: no type is called R_trig"
    ]
    file = parse_text("TYPE R_TRIG : INT; r_trig : DINT; x : R_trig; END_TYPE")
    checked([file])
    assert file.diagnostics.records[0].hint == "declared are R_TRIG and r_trig"


def test_case_does_not_matter_in_iec() -> None:
    text = (
        "TYPE Mode : (On, OFF := on + 5); A : ARRAY[0..MAX] OF mode := [2(off)]; "
        "S : STRUCT Speed : Mode := ON; END_STRUCT := (speed := Off); END_TYPE "
        "VAR CONSTANT Max : INT := 1; END_VAR"
    )
    scope = scope_of(text, dialect=IEC)
    for name, value in (("a", [5, 5]), ("s", {"Speed": 5})):
        found = scope.find_type(name)
        assert found is not None
        assert decode(found, initial_image(found)) == value
    assert scope.files[0].diagnostics.records == []


def test_characters_of_the_standard() -> None:
    declared = "a : CHAR := 'x'; b : WChar := \"\u20ac\"; c : CHAR := 'xy'; d : CHAR := \"\u20ac\";"
    text = f"VAR {declared} END_VAR"
    file = parse_text(text, "a")
    scope = checked([file], dialect=IEC)
    assert [each.initial for each in scope.variables] == [120, 0x20AC, None, None]
    assert [str(record) for record in file.diagnostics.records] == [
        "a:1:52: error: 'xy' is not a value of CHAR",
        "a:1:70: error: 8364 is outside 0..255 of CHAR",
    ]


def test_automation_studio_has_no_characters() -> None:
    file = parse_text("VAR a : CHAR; END_VAR", "a")
    checked([file])
    assert [str(record) for record in file.diagnostics.records] == [
        "a:1:9: warning: no type is called CHAR"
    ]


def test_types_are_resolved_once() -> None:
    scope = Scope("test", [parse_text("TYPE A : STRUCT b : Lib; END_STRUCT; END_TYPE", "a.typ")])
    assert scope.find_type("A") is None
    scope.check()
    assert (scope.types[0].data_type, len(scope.files[0].diagnostics.records)) == (None, 1)


def test_an_unknown_name_is_a_warning_and_strictly_an_error() -> None:
    text = "TYPE A : STRUCT x : Lib; y : Lib; END_STRUCT; B : ARRAY[0..MAX] OF A; END_TYPE"
    expected = [
        "0.typ:1:21: {}: no type is called Lib",
        "0.typ:1:60: {}: no constant is called MAX",
    ]
    assert findings(text) == [line.format("warning") for line in expected]
    assert findings(text, strict=True) == [line.format("error") for line in expected]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("TYPE A : A; END_TYPE", ["1:10: error: A contains itself: A -> A"]),
        (
            "TYPE A : STRUCT b : B; END_STRUCT; B : ARRAY[0..1] OF A; END_TYPE",
            ["1:55: error: A contains itself: A -> B -> A"],
        ),
        ("TYPE A : INT; A : BOOL; END_TYPE", ["1:15: error: A is declared twice; first at 0.typ"]),
        ("FUNCTION F END_FUNCTION FUNCTION F END_FUNCTION", ["1:34: error: F is declared twice"]),
        (
            "TYPE A : STRUCT x : INT; x : INT; END_STRUCT; END_TYPE",
            ["1:26: error: A declares x tw"],
        ),
        ("TYPE A : (x, y, x); END_TYPE", ["1:17: error: A declares x twice"]),
        ("VAR x : INT; END_VAR VAR x : INT; END_VAR", ["1:26: error: x is declared twice"]),
        (
            "FUNCTION_BLOCK F VAR_INPUT x : INT; END_VAR VAR x : INT; END_VAR END_FUNCTION_BLOCK",
            ["1:49: error: x is declared twice; first at 0.typ:1:28"],
        ),
        ("FUNCTION F VAR x, x : INT; END_VAR END_FUNCTION", ["1:19: error: x is declared twice"]),
        (
            "TYPE A : ARRAY[5..1] OF INT; END_TYPE",
            ["1:19: error: the upper bound 1 is below the lo"],
        ),
        (
            "TYPE A : ARRAY[0..1.5] OF INT; END_TYPE",
            ["1:19: error: expected a whole number, found"],
        ),
        (
            "TYPE A : ARRAY[0..2147483647] OF LREAL; END_TYPE",
            ["1:10: error: ARRAY[0..2147483647] OF"],
        ),
        ("TYPE A : STRING[-1]; END_TYPE", ["1:17: error: STRING[-1]: the length must be 0 or"]),
        ("TYPE A : STRUCT s : STRING[0]; w : WSTRING[0]; END_STRUCT; END_TYPE", []),
        ("TYPE A : WSTRING[-1]; END_TYPE", ["1:18: error: WSTRING[-1]: the length must be"]),
        ("TYPE A : INT(3..1); END_TYPE", ["1:17: error: the upper bound 1 is below"]),
        ("TYPE A : INT(0..40000); END_TYPE", ["1:10: error: A: 0..40000 is not a range of INT"]),
        ("TYPE B : (x, y); A : B(0..1); END_TYPE", ["1:22: error: B cannot have a subrange"]),
        ("TYPE A : ARRAY[0..1/0] OF INT; END_TYPE", ["1:20: error: division by zero"]),
        ("TYPE A : (); END_TYPE", ["1:10: warning: the enumeration has no values"]),
        (
            "VAR a : A(x := 1); END_VAR TYPE A : STRUCT x : INT; END_STRUCT END_TYPE",
            ["1:9: error: A is no function block, so it has no FB_init to be given"],
        ),
        (
            "TYPE A : REAL (x, y); B : (x) DINT; END_TYPE",
            ["1:10: error: an enumeration is an integer, REAL is none"],
        ),
        (
            "TYPE A : (x := 255, y) USINT; B : (z := 256) USINT; END_TYPE",
            ["1:41: error: 256 is outside 0..255 of USINT"],
        ),
        ("VAR CONSTANT A : INT := B; B : INT := A; END_VAR", ["1:25: error: B depends on itself"]),
        ("VAR CONSTANT A : INT := SIZEOF(x); END_VAR", ["1:31: warning: the value is not known"]),
    ],
)
def test_findings(text: str, expected: list[str]) -> None:
    file = parse_declarations(Source("0.typ", text))
    checked([file])
    found = [str(record) for record in file.diagnostics.records]
    assert len(found) == len(expected), found
    for message, start in zip(found, expected, strict=True):
        assert message.startswith(f"0.typ:{start}")


def test_values_of_an_enumeration_go_on_from_the_last_one_and_wrap() -> None:
    scope = scope_of(
        "TYPE E : (a := 16#7FFFFFFF, b, c := a - 1, d := E2.x, e); E2 : (x := -5); END_TYPE"
    )
    found = scope.find_type("E")
    assert isinstance(found, EnumerationType)
    assert found.values == {"a": 2**31 - 1, "b": -(2**31), "c": 2**31 - 2, "d": -5, "e": -4}


def test_an_enumeration_without_values_is_a_dint() -> None:
    file = parse_text("TYPE A : (); B : STRUCT a : A; END_STRUCT; END_TYPE")
    assert resolve_alias(checked([file]).find_type("A")) is DINT


@pytest.mark.parametrize("order", [1, -1])
def test_too_many_types_one_inside_the_other(order: int) -> None:
    types = [f"T{i} : STRUCT x : T{i + 1}; END_STRUCT;" for i in range(60)][::order]
    found = findings(f"TYPE T60 : INT; {' '.join(types)} END_TYPE")
    assert found
    assert all("more than 50" in text or "too many declarations" in text for text in found)


def test_arrays_of_arrays_are_counted_as_nesting() -> None:
    array = "ARRAY[0..0] OF " * 30
    found = findings(
        f"TYPE A : {array} INT; B : {array} A; C : STRUCT x : {array} INT; y : {array} "
        "INT; END_STRUCT; END_TYPE"
    )
    assert found == ["0.typ:1:466: error: B: more than 50 types lie one inside the other"]


def test_a_long_chain_of_constants_in_order_is_fine() -> None:
    constants = "".join(f"C{i} : DINT := C{i - 1} + 1; " for i in range(1, 500))
    scope = scope_of(f"VAR CONSTANT C0 : DINT := 0; {constants} END_VAR")
    assert scope.variables[-1].initial == 499


WORDS = [
    "A",
    "B",
    "C",
    "MAX",
    "INT",
    "REAL",
    "STRING[3]",
    "5",
    "-1",
    "'abcd'",
    "(x := 1)",
    "[1, 2]",
]
SPECIFICATIONS = ["A", "B", "INT", "BOOL", "STRING[MAX]", "ARRAY[0..MAX] OF B", "REFERENCE TO A"]
SPECIFICATIONS += [
    "STRUCT x : B; END_STRUCT",
    "(red, green := MAX)",
    "USINT(1..MAX)",
    "ARRAY[1..0] OF C",
]
INITIALS = [
    "",
    ":= 1",
    ":= -1",
    ":= 'abcd'",
    ":= [2(1)]",
    ":= (x := 1)",
    ":= MAX",
    ":= red",
    ":= (0)",
]
INITIALS += [":= T#1s", ":= 1.5", ":= [2000000000(1)]", ":= [1, [2, 3]]", ":= TRUE", ":= B"]


@given(
    st.lists(
        st.tuples(
            st.sampled_from("ABC"), st.sampled_from(SPECIFICATIONS), st.sampled_from(INITIALS)
        ),
        max_size=5,
    ),
    st.sampled_from(["3", "A", "MAX", "-1", "2 ** 40"]),
)
def test_any_declarations_resolve_or_are_reported(
    types: list[tuple[str, str, str]], maximum: str
) -> None:
    declarations = " ".join(f"{name} : {spec} {initial};" for name, spec, initial in types)
    text = f"TYPE {declarations} END_TYPE VAR CONSTANT MAX : INT := {maximum}; END_VAR"
    file = parse_declarations(Source("a.typ", text))
    scope = checked([file])
    for data_type in scope.data_types():
        if data_type.size < 10_000:
            image = initial_image(data_type)
            assert encode(data_type, decode(data_type, image)) == image
    with suppress(DeclarationError):
        file.diagnostics.raise_errors()
