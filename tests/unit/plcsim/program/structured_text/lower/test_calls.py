"""Functions, function blocks, actions, and what goes into them."""

import pytest

from ..running import Running

COUNTER = """
FUNCTION_BLOCK Counter
VAR_INPUT up : BOOL; start : INT := 5; END_VAR
VAR_OUTPUT n : INT; END_VAR
VAR_IN_OUT total : DINT; END_VAR
VAR old : BOOL; first : BOOL := TRUE; END_VAR
VAR_TEMP step : INT := 1; END_VAR
IF first THEN n := start; first := FALSE; END_IF
IF up AND NOT old THEN n := n + step; step := 100; total := total + n; report; END_IF
old := up;
END_FUNCTION_BLOCK
ACTION report: total := total + 1000; END_ACTION
"""


def run(text: str, cycles: int = 1, **imports: object) -> Running:
    return Running(text, **imports).run(cycles)


def test_a_function_block_keeps_its_data_and_works_on_what_it_is_given() -> None:
    running = run(
        COUNTER
        + """
PROGRAM _CYCLIC
VAR a : Counter; b : Counter := (start := 50); c : ARRAY[1..2] OF Counter; END_VAR
VAR d, e : DINT; q : INT; f : BOOL; i : INT := 2; END_VAR
f := NOT f;
a(up := f, total := d, n => q);
b(up := TRUE, total := d);
c[i](up := f, total := e);
END_PROGRAM""",
        3,
    )
    assert [running[name] for name in ("a.n", "q", "b.n", "c[2].n", "c[1].n", "d", "e")] == [
        *(7, 7, 51, 7, 0),
        6 + 7 + 51 + 3000,
        6 + 7 + 2000,
    ]


def test_a_bare_instance_is_a_call_and_members_can_be_set_before() -> None:
    running = run(
        COUNTER.replace("VAR_IN_OUT", "VAR")
        + """
PROGRAM _CYCLIC
VAR a : Counter; r : REFERENCE TO Counter; n : INT; END_VAR
a.up := TRUE;
a;
r ACCESS ADR(a);
r(up := FALSE);
r.up := TRUE;
r;
n := r.n;
END_PROGRAM"""
    )
    assert (running["n"], running["a.n"], running["a.total"]) == (7, 7, 2013)


def test_0_goes_into_a_reference_to_a_structure_itself() -> None:
    running = run(
        COUNTER
        + """
PROGRAM _CYCLIC
VAR a : Counter; r : REFERENCE TO Counter; before, after : UDINT; END_VAR
r ACCESS ADR(a);
before := ADR(r);
r := 0;
after := ADR(r);
END_PROGRAM"""
    )
    assert running["before"] != 0
    assert running["after"] == 0


def test_a_reference_to_a_link_of_mapp_takes_what_another_has() -> None:
    running = run(
        """
TYPE MpComIdentType : STRUCT Internal : ARRAY[0..1] OF UDINT; END_STRUCT; END_TYPE
FUNCTION_BLOCK Component
VAR_INPUT MpLink : REFERENCE TO MpComIdentType; END_VAR
END_FUNCTION_BLOCK
PROGRAM _CYCLIC
VAR gLink : MpComIdentType; a, b : Component; same : BOOL; END_VAR
a.MpLink := ADR(gLink);
b.MpLink := a.MpLink;
same := ADR(b.MpLink) = ADR(gLink);
END_PROGRAM"""
    )
    assert running["same"] == 1


FUNCTIONS = """
FUNCTION sum : DINT
VAR_INPUT list : ARRAY[1..3] OF INT; factor : INT := 10; END_VAR
VAR i : INT; END_VAR
FOR i := 1 TO 3 DO sum := sum + list[i]; END_FOR
sum := sum * factor;
IF factor = 0 THEN sum := -1; RETURN; END_IF
factor := 99;
END_FUNCTION
FUNCTION shout : STRING[10]
VAR_INPUT text : STRING[10]; END_VAR
VAR copy : STRING[4] := 'xyz'; END_VAR
copy := text;
shout := copy;
text := 'gone';
END_FUNCTION
FUNCTION mirrored : Point
VAR_INPUT p : Point; END_VAR
mirrored.x := p.y; mirrored.y := p.x;
END_FUNCTION
FUNCTION swap
VAR_IN_OUT a, b : INT; END_VAR
VAR_OUTPUT larger : INT; END_VAR
VAR t : INT; END_VAR
t := a; a := b; b := t;
larger := MAX(a, b);
END_FUNCTION
FUNCTION set
VAR_INPUT r : REFERENCE TO DINT; small : SINT; END_VAR
r := small;
END_FUNCTION
FUNCTION where_is : UDINT
VAR_INPUT x : INT; END_VAR
where_is := ADR(x);
x := x + 1;
where_is := where_is + x - x;
END_FUNCTION
FUNCTION faculty : DINT
VAR_INPUT n : DINT; END_VAR
IF n <= 1 THEN faculty := 1; ELSE faculty := n * faculty(n - 1); END_IF
END_FUNCTION
"""
POINT = "TYPE Point : STRUCT x : INT; y : INT; END_STRUCT; END_TYPE"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "d := sum(l); e := sum(l, 2); l[1] := 5; d := d + sum(factor := 0, list := l);",
            {"d": 59, "e": 12},
        ),
        (
            "s := 'hello'; s2 := shout(s); s3 := shout(shout('abcdefgh'));",
            {"s": "gone", "s2": "hell", "s3": "abcd"},
        ),
        ("p.x := 1; p.y := 2; q := mirrored(p); i := mirrored(q).x;", {"q.x": 2, "q.y": 1, "i": 1}),
        ("i := 1; j := 2; swap(i, j, larger := k);", {"i": 2, "j": 1, "k": 2}),
        ("i := 1; j := 2; swap(a := i, b := j, larger => k);", {"i": 2, "j": 1, "k": 2}),
        ("i := 300; set(ADR(d), i); rd ACCESS ADR(e); set(rd, -1);", {"d": 44, "e": -1}),
        ("i := 7; d := where_is(i) - where_is(i);", {"i": 7, "d": 0}),
        ("d := faculty(10);", {"d": 3628800}),
    ],
)
def test_functions(text: str, expected: dict[str, object]) -> None:
    variables = """VAR l : ARRAY[1..3] OF INT := [1, 2, 3]; d, e : DINT; i, j, k : INT;
    s, s2, s3 : STRING[10]; p, q : Point; rd : REFERENCE TO DINT; END_VAR"""
    running = run(f"{POINT}{FUNCTIONS}PROGRAM _CYCLIC {variables} {text} END_PROGRAM")
    assert {name: running[name] for name in expected} == expected


def test_units_share_variables_and_actions() -> None:
    running = Running(
        """
PROGRAM _INIT n := 5; both; END_PROGRAM
PROGRAM _CYCLIC n := n + 1; both(); END_PROGRAM
PROGRAM _EXIT n := -1; END_PROGRAM
ACTION both: m := m + n; IF n > 6 THEN RETURN; END_IF deeper; END_ACTION
ACTION deeper: m := m + 1000; END_ACTION""",
        "VAR n, m : INT; END_VAR",
    )
    running.run(1, "init").run(2)
    assert (running["n"], running["m"]) == (7, 5 + 6 + 7 + 2000)
    running.run(1, "exit")
    assert running["n"] == -1


def test_blocks_and_functions_of_others_get_addresses_and_values() -> None:
    calls = []

    def block(running: Running, address: int) -> None:
        calls.append(address)
        running.memory.write(address + 4, b"\x07")

    def name_of(running: Running, result: int, number: int, text: int) -> None:
        running.write(result, f"{running.string(text)}{number}".encode() + b"\0")

    running = run(
        """
PROGRAM _CYCLIC
VAR t : Foreign; s : STRING[20]; i : SINT := -3; o : USINT; END_VAR
t(x := 5, y => o);
s := name_of(i, 'n');
s := name_of(2, s);
END_PROGRAM""",
        declarations="""
FUNCTION_BLOCK Foreign VAR_INPUT x : DINT; END_VAR VAR_OUTPUT y : USINT; END_VAR END_FUNCTION_BLOCK
FUNCTION name_of : STRING[20] VAR_INPUT number : INT; text : STRING[10]; END_VAR END_FUNCTION""",
        Foreign=block,
        name_of=name_of,
    )
    assert calls == [running.address("t")]
    assert (running["t.x"], running["o"], running["s"]) == (5, 7, "n-32")


def test_conversions_to_text_are_functions_of_others() -> None:
    def text_of(running: Running, result: int, value: float) -> None:
        running.write(result, f"<{value}>".encode() + b"\0")

    def number_of(running: Running, text: int) -> int:
        return len(running.string(text))

    running = run(
        """
PROGRAM _CYCLIC
VAR s, t, u : STRING[20]; i : INT; r : REAL := 1.5; END_VAR
s := REAL_TO_STRING(r); t := USINT_TO_STRING(300); i := STRING_TO_INT(s); u := TO_STRING(r);
END_PROGRAM""",
        REAL_TO_STRING=text_of,
        USINT_TO_STRING=text_of,
        STRING_TO_INT=number_of,
    )
    assert [running[name] for name in "stui"] == ["<1.5>", "<44>", "<1.5>", 5]


def test_the_edges_of_a_block_are_members_of_its_own() -> None:
    running = run(
        """
FUNCTION_BLOCK Pulse
VAR_INPUT x : BOOL; END_VAR
VAR n : INT; zzEdge00000 : BOOL; zzEdge00001 : BOOL; END_VAR
IF EDGEPOS(x) THEN n := n + 1; END_IF
IF EDGENEG(x) THEN n := n + 10; END_IF
END_FUNCTION_BLOCK
PROGRAM _CYCLIC
VAR a, b : Pulse; f : BOOL; END_VAR
f := NOT f; a(x := f); b(x := TRUE);
END_PROGRAM""",
        4,
    )
    assert (running["a.n"], running["b.n"]) == (22, 1)
