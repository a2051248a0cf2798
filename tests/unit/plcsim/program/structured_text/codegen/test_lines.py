from hypothesis import given
from hypothesis import strategies as st

from plcsim.machine import frames_of
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.lines import FunctionLines, ModuleLines, pack

from .build import call, evaluate, function, if_, load, module, number, store, unit

CHANGES = st.lists(st.tuples(st.integers(0, 10_000), st.integers(1, 100_000)), max_size=30)


@given(CHANGES, st.integers(1, 100_000))
def test_what_was_packed_comes_out_again(changes, first):
    changes.sort()
    lines = FunctionLines("F", "unit", "Main.st", first, 50, 20_000, pack(changes, first))
    assert list(lines.changes()) == [(50 + position, line) for position, line in changes]


@given(CHANGES, st.integers(0, 10_050))
def test_an_instruction_belongs_to_the_last_change_before_it(changes, offset):
    changes.sort()
    lines = FunctionLines("F", "unit", "Main.st", 7, 50, 20_000, pack(changes, 7))
    before = [line for position, line in changes if 50 + position <= offset]
    assert lines.line_at(offset) == (before[-1] if before else 7)


def test_each_function_has_its_part():
    table = ModuleLines(
        [
            FunctionLines("A", "action", "A.st", 3, 10, 20, pack([(0, 3), (4, 5)], 3)),
            FunctionLines("B", "unit", "B.st", 9, 25, 30, pack([(0, 9)], 9)),
        ],
        {26: "index"},
    )
    assert table.find(15) == ("A", "action", "A.st", 5, "")
    assert table.find(26) == ("B", "unit", "B.st", 9, "index")
    assert [table.find(offset) for offset in (9, 20, 24, 30, 1000)] == [None] * 5
    assert ModuleLines([], {}).find(0) is None


def test_the_call_chain_of_a_fault_has_the_lines_of_the_calls(compiled):
    nil = ir.Load("i32", "w32", ir.Place(number(0), 4, 0))
    inner = function("INNER", (), None, store(0, 1, line=20), store(4, nil, line=22), kind="action")
    outer = unit(
        store(0, 1, line=2),
        if_(ir.Compare("i32", "eq", load(0), number(1)), [evaluate(call("INNER"), line=4)], line=3),
        store(0, 2, line=6),
    )
    machine = compiled(module(outer, inner))
    try:
        machine.run()
    except Exception as error:  # its frames are what is tested
        found = [machine.code.lines.find(frame.offset) for frame in frames_of(error)]
    assert [(one.function, one.line) for one in found] == [("INNER", 22), ("CYCLIC", 4)]
