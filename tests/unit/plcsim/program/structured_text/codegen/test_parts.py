import re

import pytest

from plcsim.machine import MachineFault, frames_of
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.codegen.parts import CALLS_OF_PART, MOST_CALLS, parts_of

from ..running import Running

COUNT = MOST_CALLS + 100
VARIABLES = "VAR n, m, k : DINT; s : STRING[20] := 'x'; f : BOOL; END_VAR"
LINE = "IF s = 'x' THEN n := n + 1; END_IF\n"


def run(body, more="", cycles=1):
    """Run a program; return its variables and the names of its functions."""
    text = f"PROGRAM _CYCLIC\n{body}\nEND_PROGRAM\n{more}\n{VARIABLES}"
    running = Running(text)
    try:
        running.run(cycles)
        names = [one.name for one in generate(running.module).lines.functions]
        return {name: running[name] for name in ("n", "m", "k")}, names
    finally:
        running.close()


def parts_in(names):
    return [name for name in names if re.search(r"\(part \d+\)$", name)]


def test_a_body_of_few_calls_stays_whole():
    values, names = run(LINE * 10)
    assert (values["n"], parts_in(names)) == (10, [])


def test_a_body_of_many_calls_is_cut():
    values, names = run(LINE * COUNT)
    assert values["n"] == COUNT
    assert len(parts_in(names)) == COUNT // CALLS_OF_PART


@pytest.mark.parametrize(("k", "wanted"), [(0, 1), (7, 8), (COUNT - 1, COUNT), (COUNT, -1)])
def test_a_choice_of_many_small_arms_is_cut(k, wanted):
    arms = "".join(f"{i}: IF s = 'x' THEN n := {i + 1}; END_IF\n" for i in range(COUNT))
    values, names = run(f"k := {k};\nCASE k OF\n{arms}ELSE n := -1; END_CASE")
    assert values["n"] == wanted
    assert parts_in(names)


def test_large_arms_are_cut_inside():
    arms = "".join(f"{i}: k := {i};\n{LINE * 50}" for i in range(20))
    values, names = run(f"CASE m OF\n{arms}END_CASE\nm := m + 1;", cycles=3)
    assert (values["n"], values["k"], values["m"]) == (150, 2, 3)
    assert parts_in(names)


def test_what_leaves_the_body_stays_in_it():
    leave = "IF n = 450 THEN RETURN; END_IF\n"
    values, _ = run((LINE + leave) * COUNT + "m := 1;")
    assert (values["n"], values["m"]) == (450, 0)


def test_a_loop_is_not_cut():
    body = f"FOR k := 1 TO 3 DO\n{LINE * COUNT}IF n > {COUNT} THEN EXIT; END_IF\nEND_FOR"
    values, names = run(body)
    assert (values["n"], values["k"], parts_in(names)) == (2 * COUNT, 2, ["cyclic (part 1)"])


def test_actions_are_cut_as_well():
    values, names = run("act;", f"ACTION act:\n{LINE * COUNT}END_ACTION")
    assert values["n"] == COUNT
    assert parts_in(names)


def test_a_fault_in_a_part_has_its_line():
    before, after = LINE * (COUNT // 2), LINE * (COUNT - COUNT // 2)
    text = f"PROGRAM _CYCLIC\n{before}n := n / m;\n{after}END_PROGRAM\n{VARIABLES}"
    running = Running(text)
    try:
        with pytest.raises(MachineFault) as caught:
            running.run()
        lines = generate(running.module).lines
        found = [lines.find(frame.offset) for frame in frames_of(caught.value)]
        assert [(each.function, each.line) for each in found] == [
            (f"cyclic (part {COUNT // 2 // CALLS_OF_PART + 1})", 2 + COUNT // 2),
            ("cyclic", 2 + COUNT // 2 // CALLS_OF_PART * CALLS_OF_PART),
        ]
    finally:
        running.close()


def test_locals_that_cross_statements_hold_them_together():
    call = ir.Call("i32", "function f", ())
    statements = [
        each
        for index in range(MOST_CALLS)
        for each in (ir.SetLocal(1, index % 2, call), ir.Evaluate(2, ir.Local("i32", index % 2)))
    ]
    function = ir.Function("cyclic", "unit", (), None, ("i32", "i32"), [*statements, *statements])
    assert [one.name for one in parts_of(function)] == ["cyclic"]
