"""Automation Basic: what a text does, and what is wrong in one."""

from pathlib import Path

import pytest

from plcsim.program.structured_text.languages.automation_basic import parse_automation_basic
from plcsim.program.structured_text.languages.readers import parse_units
from st_types.syntax.source import Source

from ..running import Running, checked

STANDARD = Path(__file__).parents[6] / "plcsim" / "library" / "standard"


def basic(text, declarations, **imports):
    """Run one cycle of some lines."""
    return Running(f"PROGRAM _CYCLIC\n{text}\nEND_PROGRAM\n", declarations, path="a.ab", **imports)


def values(text, declarations, *names):
    running = basic(text, declarations).run()
    found = [running[name] for name in names]
    running.close()
    return found


NUMBERS = "VAR a, b, c, n : INT; x, y : BOOL; w : UDINT; s : USINT; r : REAL; END_VAR"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a = 1 ; b = 2", {"a": 1, "b": 0}),
        ("a = 1 // b = 2\nb = 3", {"a": 1, "b": 3}),
        ("a = 1 (* b = 2\n b = 2 *)\nb := 4;", {"a": 1, "b": 4}),
        ("x = a = 0", {"x": True}),
        ("x = (a = 1) OR NOT(b <> 0)", {"x": True}),
        ("w = $1F + %101", {"w": 36}),
        ("a = 2 + \\ ; goes on\n 3 * 4", {"a": 14}),
        ("INC a\nINC a\nDEC b", {"a": 2, "b": -1}),
        ("w = 3\nw = BIT_SET(w, 4)\nx = w.0\ny = BIT_TST(w, 3)", {"w": 19, "x": True, "y": False}),
        ("a = 300\ns = USINT(a)\nr = REAL(a) / 2.0", {"s": 44, "r": 150.0}),
        ("w = 5\nx = BIT(w AND %100)\ny = BIT(w AND %10)", {"x": True, "y": False}),
        ("w = LSL(5, 4)\nw = LSR(w, 2)", {"w": 20}),
        ("n = 7 MOD 4", {"n": 3}),
    ],
)
def test_assignments(text: str, expected: dict[str, object]) -> None:
    assert values(text, NUMBERS, *expected) == [*expected.values()]


CHOICE = """
IF n = 1 THEN
  a = 10
ELSE IF n = 2 THEN
  a = 20
ELSE IF (n = 3) then
  IF x THEN
    a = 30
  ELSE
    a = 31
  ENDIF
ELSE
  a = 99
ENDIF
b = 5
"""


@pytest.mark.parametrize(("n", "a"), [(1, 10), (2, 20), (3, 31), (4, 99)])
def test_else_if_needs_no_end_of_its_own(n: int, a: int) -> None:
    assert values(f"n = {n}\n{CHOICE}", NUMBERS, "a", "b") == [a, 5]


CASES = """
CASE n OF
  ACTION 1:
    a = 10
  ENDACTION

  ACTION 2:
  ACTION 5..7: ; three more
  ACTION 9, 11:
    a = 20
  ENDACTION
  ACTION 3:
  ENDACTION
  ELSEACTION:
    a = 99
  ENDACTION
ENDCASE
"""


@pytest.mark.parametrize(
    ("n", "a"), [(1, 10), (2, 20), (6, 20), (9, 20), (11, 20), (3, 0), (4, 99), (8, 99)]
)
def test_actions_of_a_case(n: int, a: int) -> None:
    assert values(f"n = {n}\n{CASES}", NUMBERS, "a") == [a]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("LOOP n = 1 TO 4 DO\n a = a + n\nENDLOOP", 10),
        ("LOOP n = 4 DOWNTO 2 DO\n a = a * 10 + n\nENDLOOP", 432),
        ("LOOP s = 3 DOWNTO 0 DO\n a = a + 1\nENDLOOP", 4),
        ("LOOP n = 1 TO 9 DO\n EXITIF n > 3\n a = a + 1\nENDLOOP", 3),
        ("LOOP\n a = a + 1\n EXITIF a = 7\nENDLOOP", 7),
        ("LOOP DO\n a = a + 1\n EXITIF a = 7\nENDLOOP", 7),
        ("n = 1\nagain:\na = a + n\nINC n\nIF n < 4 THEN\n GOTO again\nENDIF", 6),
    ],
)
def test_loops_and_jumps(text: str, expected: int) -> None:
    assert values(text, NUMBERS, "a") == [expected]


COUNTER = """
FUNCTION_BLOCK Counter
VAR_INPUT up : BOOL; by : INT; END_VAR
VAR_OUTPUT done : BOOL; count : INT; END_VAR
VAR zzCounter00000 : Counter2; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Counter2
VAR_INPUT up : BOOL; END_VAR
VAR_OUTPUT count : INT; END_VAR
END_FUNCTION_BLOCK
"""
BODY = """
FUNCTION_BLOCK Counter
IF up THEN
  count = count + by
ENDIF
done = count >= 6
END_FUNCTION_BLOCK
"""


def test_each_call_of_a_block_without_an_instance_has_its_own() -> None:
    text = f"""PROGRAM _CYCLIC
Counter(x, 2, y, a)
Counter((x AND y), 1, z, b)
c1.up = TRUE
c1.by = 5
c1 FUB Counter()
END_PROGRAM
{BODY}"""
    declared = f"VAR a, b : INT; x, y, z : BOOL; c1 : Counter; END_VAR{COUNTER}"
    run = Running(text, declared.replace("VAR zzCounter00000 : Counter2; END_VAR", ""), path="a.ab")
    run["x"] = True
    assert [run.run()["a"], run["b"], run["y"], run["c1.count"]] == [2, 0, False, 5]
    assert [run.run()["a"], run["b"], run["y"], run["c1.count"]] == [4, 0, False, 10]
    assert [run.run()["a"], run["b"], run["y"], run["c1.count"]] == [6, 1, True, 15]
    run.close()


def test_in_a_block_the_instance_is_the_member_that_automation_studio_makes() -> None:
    text = """PROGRAM _CYCLIC
o1 FUB Outer()
o2.up = TRUE
o2 FUB Outer()
END_PROGRAM
FUNCTION_BLOCK Outer
Inner(up, count)
END_FUNCTION_BLOCK
FUNCTION_BLOCK Inner
IF up THEN
  INC count
ENDIF
END_FUNCTION_BLOCK
"""
    declared = """VAR o1, o2 : Outer; END_VAR
FUNCTION_BLOCK Inner
VAR_INPUT up : BOOL; END_VAR
VAR_OUTPUT count : INT; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Outer
VAR_INPUT up : BOOL; END_VAR
VAR_OUTPUT count : INT; END_VAR
VAR zzInner00007 : Inner; END_VAR
END_FUNCTION_BLOCK
"""
    run = Running(text, declared, path="a.ab").run(3)
    assert [run["o1.count"], run["o2.count"], run["o2.zzInner00007.count"]] == [0, 3, 3]
    run.close()
    _, _, found = checked(text, declared.replace("zzInner00007", "other"), path="a.ab")
    assert found == [
        (
            "7:1 ST2002 the function block has no member zzInner00000 for this call | "
            "declare it as VAR : Inner, as Automation Studio does when it builds"
        )
    ]


def test_functions_actions_and_texts() -> None:
    text = """PROGRAM _CYCLIC
note(ADR(s), "it's $1")
p = "abc"
n = Twice(4)
Beside
END_PROGRAM
FUNCTION Twice
Twice = 2 * a
END_FUNCTION
"""
    declared = """VAR n : INT; s : STRING[20]; p : UDINT; END_VAR
FUNCTION note : BOOL
VAR_INPUT to : UDINT; what : UDINT; END_VAR
END_FUNCTION
FUNCTION Twice : INT
VAR_INPUT a : INT; END_VAR
END_FUNCTION
"""
    told = []
    with pytest.raises(AssertionError, match="no variable is called Beside"):
        Running(text, declared, path="a.ab", note=lambda *_: 0)
    run = Running(
        text.replace("Beside\n", ""),
        declared,
        path="a.ab",
        note=lambda run, _to, what: told.append(run.string(what)) or 0,
    ).run()
    assert told == ["it's $1"]
    assert run.string(run["p"]) == "abc"
    assert run["n"] == 8
    run.close()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "IF x\na = 1\nENDIF",
            "2:5 expected 'THEN' after the condition, found the end of the line",
        ),
        ("IF x THEN\na = 1", "4:1 expected ENDIF of the IF in line 2, found 'END_PROGRAM'"),
        ("a = 1 b = 2", "2:7 expected the end of the line, found 'b'"),
        ("ENDIF", "2:1 expected a statement, found 'ENDIF'"),
        ("a =", "2:4 expected a value, found the end of the line"),
        ("CASE n OF\nACTION 1:\na = 1\nACTION 2:\nENDACTION\nENDCASE", "5:1 expected ENDACTION"),
        ("CASE n OF\na = 1\nENDCASE", "3:1 expected ENDCASE of the CASE in line 2"),
        ("LOOP n = 1 TO 3\nENDLOOP", "2:16 expected 'DO' after the values of LOOP"),
        ("SELECT n", "2:8 expected the end of the line, found 'n'"),
        ("GOTO", "2:5 expected a name of a label after GOTO"),
    ],
)
def test_what_is_wrong(text: str, expected: str) -> None:
    file = parse_units(Source("a.ab", f"PROGRAM _CYCLIC\n{text}\nEND_PROGRAM\n"))
    records = file.diagnostics.records
    assert f"{records[0].line}:{records[0].column} {records[0].message}".startswith(expected)


def test_one_error_a_line_is_told_and_the_rest_is_read() -> None:
    text = "PROGRAM _CYCLIC\na = \nb = 1\nc = )\nEND_PROGRAM\nstray\nPROGRAM _EXIT\nEND_PROGRAM"
    file = parse_automation_basic(Source("a.ab", text))
    assert [each.line for each in file.diagnostics.records] == [2, 4, 6]
    assert [len(unit.body) for unit in file.units] == [1, 0]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("f(1)", "2:1 ST2001 no function is called f"),
        ("c1 FUB Nothing()", "2:8 ST2003 no function block is called Nothing"),
        ("n FUB Counter2()", "2:1 ST2004 this is INT, no Counter2"),
        ("Counter2(x)", "2:1 ST3003 Counter2 takes its 2 inputs and outputs in order, or nothing"),
    ],
)
def test_calls_that_are_wrong(text: str, expected: str) -> None:
    declared = f"VAR n : INT; x : BOOL; c1 : Counter2; END_VAR{COUNTER}"
    _, _, found = checked(f"PROGRAM _CYCLIC\n{text}\nEND_PROGRAM", declared, path="a.ab")
    assert any(each.startswith(expected) for each in found), found


def test_a_file_that_is_no_text() -> None:
    file = parse_automation_basic(Source("a.ab", "\0\1\2\3" * 50))
    assert [each.message for each in file.diagnostics.records] == ["the file is no text"]


def test_deep_nesting_is_an_error() -> None:
    text = "PROGRAM _CYCLIC\n" + "IF x THEN\n" * 5000 + "END_PROGRAM"
    file = parse_automation_basic(Source("a.ab", text))
    assert "levels of nesting" in file.diagnostics.records[0].message
