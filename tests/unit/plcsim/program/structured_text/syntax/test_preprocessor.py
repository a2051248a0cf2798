import pytest

from plcsim.program.structured_text.syntax.tree import ActionUnit

from .shapes import findings, parse, shapes


def run(text: str, **defines: str) -> str:
    file = parse(f"ACTION a:\n{text}\nEND_ACTION", **defines)
    file.diagnostics.raise_errors()
    (unit,) = file.units
    assert isinstance(unit, ActionUnit)
    return shapes(unit.body)


IFDEF = "#ifdef FAST\na;\n#else // otherwise\nb;\n#endif\nc;"
CHAIN = "#if N == 1\na;\n#elif N > 1 (* many *)\nb;\n#elif N > 2\nx;\n#else\nc;\n#endif"
NESTED = "#ifdef A\n#ifdef B\na;\n#else\nb;\n#endif\n#else\n#ifdef B\nc;\n#endif\n#endif"


@pytest.mark.parametrize(
    ("text", "defines", "expected"),
    [
        (IFDEF, {}, "b; c;"),
        (IFDEF, {"FAST": ""}, "a; c;"),
        ("#ifndef FAST\na;\n#endif", {}, "a;"),
        ("#ifndef FAST\na;\n#endif", {"FAST": "1"}, ""),
        (CHAIN, {"N": "1"}, "a;"),
        (CHAIN, {"N": "3"}, "b;"),
        (CHAIN, {}, "c;"),
        (NESTED, {"A": "", "B": ""}, "a;"),
        (NESTED, {"A": ""}, "b;"),
        (NESTED, {"B": ""}, "c;"),
        (NESTED, {}, ""),
        ("#define ON\n#ifdef ON\na;\n#endif\n#undef ON\n#ifdef ON\nb;\n#endif", {}, "a;"),
        ("#define N 3 + x\na := N * N;", {}, "a := 3 + x * 3 + x;"),
        ("#define A B\n#define B A\nA := B;", {}, "A := B;"),
        ("#define A B + C\n#define C 1\nx := A;", {}, "x := B + 1;"),
        ("#if 0\n#define N 1\n#error no\n#unknown\n'\n#endif\na := N;", {}, "a := N;"),
        ("#pragma warning (disable : 1)\na;", {}, "a;"),
        ("  #  ifdef A\n x; \n\t#\tendif\n", {"A": ""}, "x;"),
        ("#if defined(A) && !defined B\na;\n#endif", {"A": ""}, "a;"),
    ],
)
def test_what_is_kept(text: str, defines: dict[str, str], expected: str) -> None:
    assert run(text, **defines) == expected


def test_what_is_kept_stays_at_its_place() -> None:
    file = parse("ACTION a:\n#ifdef A\nx;\n#else\n  y := N;\n#endif\nEND_ACTION", N="1 + 2")
    (unit,) = file.units
    assert isinstance(unit, ActionUnit)
    (statement,) = unit.body
    assert file.location(statement)[1:] == (5, 5)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("#if 1\nACTION a: x; END_ACTION", ["1:1 this #if has no #endif"]),
        ("#endif", ["1:1 #endif without #if"]),
        ("#else", ["1:1 #else without #if"]),
        ("#if 1\n#else\n#else\n#endif", ["3:1 #else without #if"]),
        ("#if 1\n#else\n#elif 1\n#endif", ["3:1 #elif without #if"]),
        ("#error too many axes", ["1:1 #error too many axes"]),
        ("#defin A", ["1:1 #defin is no preprocessor line"]),
        ("#define", ["1:1 expected a name after #define"]),
        ("#define MAX(a, b) a", ["1:1 MAX: a macro with parameters is not supported"]),
        ("#if 1 +\n#endif", ["1:1 expected a value in the condition, found ''"]),
    ],
)
def test_errors(text: str, expected: list[str]) -> None:
    assert findings(text) == expected


def test_macros_that_double_one_another_take_bounded_memory() -> None:
    lines = [f"#define A{i} A{i + 1} + A{i + 1}" for i in range(60)]
    assert findings("\n".join([*lines, "ACTION a: x := A0; END_ACTION"]))


def test_macros_inside_one_another_are_no_recursion() -> None:
    lines = [f"#define A{i} A{i + 1}" for i in range(5000)]
    assert findings("\n".join([*lines, "ACTION a: x := A0; END_ACTION"]))
