"""Instruction List: what each instruction does when it runs."""

import pytest

from plcsim.program.structured_text.languages.readers import parse_units
from st_types.syntax.source import Source

from ..running import Running, checked

DECLARED = (
    "VAR a, b, c, x, y : BOOL; i, j, k : INT; r : REAL; n : UDINT; t : TON;"
    " list : ARRAY[0..3] OF INT; END_VAR"
)


def ton(running, address):
    """Q is what IN is."""
    base = running.address("t")
    value = running.memory.read(address + running.address("t.IN") - base, 1)
    running.memory.write(address + running.address("t.Q") - base, value)


@pytest.fixture
def run():
    opened = []

    def start(*instructions, path="Main.il"):
        text = "\r\n".join(["PROGRAM _CYCLIC", *instructions, "END_PROGRAM"])
        running = Running(text, DECLARED, path=path, TON=ton)
        opened.append(running)
        return running

    yield start
    for each in opened:
        each.close()


def after(running, *names, **values):
    for name, value in values.items():
        running[name] = value
    running.run()
    found = tuple(running[name] for name in names)
    return found[0] if len(found) == 1 else found


@pytest.mark.parametrize(
    ("operator", "table"),
    [
        ("AND", [0, 0, 0, 1]),
        ("&", [0, 0, 0, 1]),
        ("ANDN", [0, 0, 1, 0]),
        ("OR", [0, 1, 1, 1]),
        ("ORN", [1, 0, 1, 1]),
        ("XOR", [0, 1, 1, 0]),
        ("XORN", [1, 0, 0, 1]),
    ],
)
def test_operators_of_bits(run, operator, table):
    running = run("LD a", f"{operator} b", "ST x", "STN y")
    found = [after(running, "x", "y", a=a, b=b) for a in (0, 1) for b in (0, 1)]
    assert found == [(bool(each), not each) for each in table]


@pytest.mark.parametrize(
    ("operator", "expected"),
    [("ADD", 20), ("SUB", 14), ("MUL", 51), ("DIV", 5), ("MOD", 2)],
)
def test_operators_of_numbers(run, operator, expected):
    assert after(run("LD i", f"{operator} 3", "ST k"), "k", i=17) == expected
    assert after(run("ld i", f"{operator.lower()} j", "st k"), "k", i=17, j=3) == expected


@pytest.mark.parametrize(
    ("operator", "table"),
    [
        *(("GT", [0, 0, 1]), ("GE", [0, 1, 1]), ("EQ", [0, 1, 0])),
        *(("NE", [1, 0, 1]), ("LE", [1, 1, 0]), ("LT", [1, 0, 0])),
    ],
)
def test_comparisons(run, operator, table):
    running = run("LD i", f"{operator} 5", "ST x")
    assert [after(running, "x", i=i) for i in (4, 5, 6)] == [bool(each) for each in table]


def test_negation_set_and_reset(run):
    running = run("LDN a", "NOT", "S x", "LD b", "R x")
    assert [after(running, "x", a=a, b=b) for a, b in ((0, 0), (1, 0), (0, 0), (1, 1))] == [
        *(False, True, True, False)
    ]


def test_the_result_of_a_store_is_taken_again(run):
    running = run("LD i", "ADD 1", "ST i", "ADD 1", "ST j", "GT 5", "ST x", "ANDN a", "ST y")
    assert after(running, "i", "j", "x", "y", i=3) == (4, 5, False, False)
    assert after(running, "i", "j", "x", "y") == (5, 6, True, True)


def test_a_variable_that_was_loaded_may_change_before_it_is_stored(run):
    assert after(run("LD i", "ST j", "ADD 1", "ST i", "ST k"), "i", "j", "k", i=3) == (4, 3, 4)
    assert after(run("LD a", "STN a", "ST x"), "a", "x", a=1) == (False, True)


def test_parentheses(run):
    running = run("LD a", "AND( b", "OR c", ")", "ST x")
    cases = {(1, 0, 0): 0, (1, 1, 0): 1, (1, 0, 1): 1, (0, 1, 1): 0}
    for (a, b, c), value in cases.items():
        assert after(running, "x", a=a, b=b, c=c) == value
    running = run("LD i", "MUL(", "LD j", "ADD(", "LD 2", "MUL 3", ")", ")", "SUB 1", "ST k")
    assert after(running, "k", i=2, j=4) == 2 * (4 + 6) - 1
    running = run("LD a", "ANDN( b", "OR c", ")", "ST x")
    assert [after(running, "x", a=1, b=b) for b in (0, 1)] == [True, False]


def test_several_operands_and_those_that_are_no_names(run):
    running = run("LD list[2]", "ADD i, -3, 16#10", "ST list[3]", "LD i.0", "ST x")
    running["list[2]"] = 7
    assert after(running, "list[3]", "x", i=1) == (7 + 1 - 3 + 16, True)


@pytest.mark.parametrize(
    ("jump", "taken"), [("JMP over", (1, 1)), ("JMPC over", (0, 1)), ("JMPCN over", (1, 0))]
)
def test_jumps(run, jump, taken):
    running = run("LD a", jump, "LD 1", "ST i", "over: LD 2", "ST j")
    found = tuple(after(running, "i", a=a, i=0) == 0 for a in (0, 1))
    assert found == tuple(map(bool, taken))
    assert running["j"] == 2


def test_a_loop(run):
    running = run("LD 0", "ST i", "again:", "LD i", "ADD 1", "ST i", "LT 5", "JMPC again")
    assert after(running, "i") == 5


@pytest.mark.parametrize(("leave", "taken"), [("RET", (1, 1)), ("RETC", (0, 1)), ("RETCN", (1, 0))])
def test_returns(run, leave, taken):
    running = run("LD a", leave, "LD 1", "ST i")
    assert tuple(after(running, "i", a=a, i=0) == 0 for a in (0, 1)) == tuple(map(bool, taken))


def test_the_result_lives_on_behind_a_jump_that_is_not_taken(run):
    running = run("LD a", "OR b", "JMPC over", "ST x", "over:")
    assert after(running, "x", x=1) is False


def test_function_blocks(run):
    running = run("LD a", "ANDN b", "ST t.IN", "CAL t", "LD t.Q", "ST x")
    assert [after(running, "x", a=1, b=b) for b in (0, 1)] == [True, False]
    running = run("CAL t(", "    IN := a,", "    PT := T#1s,", "    Q => y", ")", "LD t.PT", "ST n")
    assert after(running, "y", a=1) is True


@pytest.mark.parametrize(("call", "taken"), [("CALC", (0, 1)), ("CALCN", (1, 0))])
def test_calls_with_a_condition(run, call, taken):
    running = run("LD b", f"{call} t(IN := a)", "LD t.IN", "ST x")
    for b, expected in zip((0, 1), taken, strict=True):
        running["t.IN"] = False
        assert after(running, "x", a=1, b=b) == bool(expected)


def test_functions(run):
    assert after(run("LD i", "MOVE", "ST j"), "j", i=4) == 4
    assert after(run("LD i", "LIMIT 5, 9", "ST j"), "j", i=4) == 5
    assert after(run("LD i", "MAX 7", "INT_TO_REAL", "ST r"), "r", i=4) == 7.0
    assert after(run("SEL(G := a, IN0 := 3, IN1 := 4)", "ST j"), "j", a=1) == 4


def test_an_edge_of_an_edge(run):
    running = run("LD a", "EDGEPOS", "ANDN b", "EDGEPOS", "ST x")
    assert [after(running, "x", a=a) for a in (0, 1, 1, 0, 1)] == [0, 1, 0, 0, 1]


def test_edges_are_functions(run):
    running = run("LD a", "EDGEPOS", "ST x")
    assert [after(running, "x", a=a) for a in (0, 1, 1, 0, 1)] == [0, 1, 0, 0, 1]


@pytest.mark.parametrize("path", ["Main.fbd", "Main.CFC"])
def test_what_an_editor_draws_is_a_comment(run, path):
    running = run(
        *("(* GRAPHIC_INFORMATION", "OBJECT 3 4 'a' ADD ; := (", "GRAPHIC_INFORMATION_END *)"),
        *("LD i", "NE 3", "ST x"),
        path=path,
    )
    assert [after(running, "x", i=i) for i in (3, 4)] == [False, True]


def test_all_kinds_of_units():
    text = """
FUNCTION Twice : INT
VAR_INPUT value : INT; END_VAR
LD value
ADD value
ST Twice
END_FUNCTION
ACTION Count:
    LD i
    Twice
    ST j
END_ACTION
PROGRAM _CYCLIC
CAL Count
END_PROGRAM
"""
    running = Running(text, DECLARED, path="Main.il")
    assert after(running, "j", i=21) == 42
    running.close()


@pytest.mark.parametrize(
    ("instructions", "place", "told"),
    [
        (["ST x"], "2:1", "ST has no current result here: nothing is loaded before it"),
        (["LD a", "on: ST x"], "3:5", "ST has no current result here"),
        (["LD"], "2:3", "expected an operand to load, found 'END_PROGRAM'"),
        (["LD a b", "ST x"], "2:6", "expected the end of the line behind an instruction"),
        (["LD a", "AND( b", "ST x"], "3:1", "expected ')' behind the operands of this operator"),
        (["LD a", ")"], "3:1", "')' closes no parenthesis"),
        (["LD a", "+ b"], "3:1", "expected an instruction, found '+'"),
        (["LD a", "MAX(b, c)"], "3:1", "expected arguments with names in the brackets behind"),
        (["LD a", "JMPC 5"], "3:6", "expected a name of a label behind JMP"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(instructions, place, told):
    text = "\n".join(["PROGRAM _CYCLIC", *instructions, "END_PROGRAM"])
    records = parse_units(Source("Main.il", text)).diagnostics.records
    found = [f"{each.line}:{each.column} {each.message}" for each in records]
    assert any(each.startswith(f"{place} {told}") for each in found), found


def test_all_mistakes_are_told():
    text = "PROGRAM _CYCLIC\nLD a b\nST x\nLD\nST y\n+ 3\nEND_PROGRAM"
    records = parse_units(Source("Main.il", text)).diagnostics.records
    assert [each.line for each in records] == [2, 4, 6]


def test_findings_of_the_checker_stand_at_the_operand():
    _, _, found = checked("PROGRAM _CYCLIC\nLD gone\nST x\nEND_PROGRAM", DECLARED, path="Main.il")
    assert [each.split(" |")[0] for each in found] == ["2:4 ST2001 no variable is called gone"]


def test_a_list_of_any_length_runs(run):
    assert after(run("LD 1", *["ADD 1"] * 3000, "ST i"), "i") == 3001
    nested = ["OR(", *["LD b", "AND c"] * 3] * 20
    assert after(run("LD a", *nested, *[")"] * 20, "ST x"), "x", b=1, c=1) is True


def test_a_list_that_is_nested_too_deep():
    text = "\n".join(["PROGRAM _CYCLIC", "LD a", *["AND( b"] * 200, "END_PROGRAM"])
    records = parse_units(Source("Main.il", text)).diagnostics.records
    assert any("expected at most 100 levels of nesting" in each.message for each in records)
