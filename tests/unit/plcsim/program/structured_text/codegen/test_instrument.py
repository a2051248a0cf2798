"""Counters: what a program costs by line, which lines have run, and which ways were gone."""

import random
import struct

import pytest

from plcsim.ansi_c.c_library import STACK_SIZE
from plcsim.core.memory import FIRST
from plcsim.machine import MachineFault
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.generate import COUNTER
from plcsim.program.structured_text.codegen.options import CodegenOptions

from .build import (
    address,
    call,
    evaluate,
    for_,
    function,
    if_,
    is_,
    load,
    module,
    number,
    op,
    place,
    program,
    store,
    unit,
)
from .random_ir import SIZE, Maker
from .test_random_programs import IMPORTS, initial, outcome

COUNTED = CodegenOptions(counters=True)


@pytest.fixture
def ran(compiled):
    """``ran(module, 1, 2)``: run once for each value at offset 64; what the counters tell."""

    def ran(tested, *values):
        machine = compiled(tested, options=COUNTED)
        for value in values:
            machine.write(FIRST + 64, struct.pack("<i", value))
            machine.run()
        return machine.code.profile, machine.counts()

    return ran


def test_the_sum_of_all_lines_is_what_the_machine_counts_without_counters(compiled):
    """And what counting costs itself is known, so that the rest can be told at any time."""
    for seed in range(25):
        choose = random.Random(seed)
        tested, start = Maker(choose).module(), initial(choose)
        costs, memories, ends = [], [], []
        for options in (CodegenOptions(), COUNTED):
            machine = compiled(tested, IMPORTS, options, fuel=True)
            machine.write(FIRST, start)
            before = machine.machine.fuel
            ends.append(outcome(machine.run))
            costs.append(before - machine.machine.fuel)
            memories.append(machine.read(FIRST, SIZE))
        overhead = machine.instance.value(COUNTER.format(0))
        by_line = machine.code.profile.cost_of_lines(machine.counts())
        assert memories[0] == memories[1]
        assert ends[0] == ends[1]
        if ends[0] == "end":
            assert costs[0] == costs[1] - overhead == sum(by_line.values())


def test_counters_beside_a_stack_pointer(compiled):
    """Which is a global variable of WebAssembly as they are, and stands before them."""
    local = ir.Place(ir.Local("i32", 1), 0)
    body = [
        ir.Store(12, "w32", local, ir.Local("i32", 0)),
        ir.If(13, [ir.Arm(13, ir.Local("i32", 0), [ir.Evaluate(14, down(ir.Local("i32", 0)))])]),
        ir.Store(15, "w32", place(0), op("add", load(0), ir.Load("i32", "w32", local))),
    ]
    deep = ir.Function("DEEP", "function", ("i32",), None, ("i32",), body, frame=FRAME)
    costs = []
    for options in (CodegenOptions(), COUNTED):
        machine = compiled(module(unit(evaluate(down(number(6)))), deep), None, options, fuel=True)
        machine.memory.open_stack(STACK_SIZE)
        before = machine.machine.fuel
        machine.run()
        machine.run()
        costs.append(before - machine.machine.fuel)
        assert struct.unpack("<i", machine.read(FIRST, 4)) == (2 * (5 + 4 + 3 + 2 + 1),)
    overhead = machine.instance.value(COUNTER.format(0))
    by_line = machine.code.profile.cost_of_lines(machine.counts())
    assert costs[0] == costs[1] - overhead == sum(by_line.values())


FRAME = ir.StackFrame(16, 1)


def down(value):
    return call("DEEP", op("sub", value, 1))


def test_costs_are_those_of_the_statements_of_a_line(ran):
    body = (store(0, 1, line=3), store(4, op("add", load(8), 2), line=5), store(8, 7, line=5))
    profile, counts = ran(program(*body), 0, 0)
    # a store of a constant: address, value, copy, store; a load: address, load, copy
    assert profile.cost_of_lines(counts) == {
        ("Main.st", 1): 2 * 1,
        ("Main.st", 3): 2 * 4,
        ("Main.st", 5): 2 * (1 + 3 + 2 + 2 + 4),
    }


def test_helpers_stand_under_their_own_names(ran):
    assign = call("rt.string_assign", address(100), address(200), number(80))
    profile, counts = ran(program(evaluate(assign, line=4)), 0)
    assert {file for file, _ in profile.cost_of_lines(counts)} == {"Main.st", "rt.string_assign"}
    assert profile.lines(0) == {4}


def lines_of(found, file=0):
    profile, counts = found
    return profile.lines(file), profile.lines_run(file, counts)


def ways_of(found):
    """All ways, and those that were gone."""
    profile, counts = found
    return profile.ways(0), profile.ways_gone(0, counts)


IF = program(if_(load(64), [store(0, 1, line=3)], line=2), store(4, 1, line=5))


@pytest.mark.parametrize(
    ("values", "run", "gone"),
    [
        ((0,), {2, 5}, {(2, 5)}),
        ((1,), {2, 3, 5}, {(2, 3)}),
        ((0, 1), {2, 3, 5}, {(2, 3), (2, 5)}),
        ((), set(), set()),
    ],
)
def test_if(ran, values, run, gone):
    found = ran(IF, *values)
    assert lines_of(found) == ({2, 3, 5}, run)
    assert ways_of(found) == ({(2, 3), (2, 5)}, gone)


def test_if_with_else(ran):
    tested = program(if_(load(64), [store(0, 1, line=3)], [store(0, 2, line=5)], line=2))
    found = ran(tested, 0)
    assert lines_of(found) == ({2, 3, 5}, {2, 5})
    assert ways_of(found) == ({(2, 3), (2, 5)}, {(2, 5)})


def test_an_if_at_the_end_leaves_the_function(ran):
    tested = program(if_(load(64), [store(0, 1, line=3)], line=2), line=1)
    assert ways_of(ran(tested, 0)) == ({(2, 3), (2, -1)}, {(2, -1)})


def test_elsif(ran):
    arms = [
        ir.Arm(line, is_(load(64), "eq", line), [store(0, 1, line=line + 1)]) for line in (2, 4, 6)
    ]
    tested = program(ir.If(2, arms, [store(0, 9, line=9)]), store(4, 1, line=11))
    every = {(2, 3), (2, 4), (4, 5), (4, 6), (6, 7), (6, 9)}
    found = ran(tested, 4, 9)
    assert ways_of(found) == (every, {(2, 4), (4, 5), (4, 6), (6, 9)})
    assert lines_of(found)[1] == {2, 4, 5, 6, 9, 11}


def test_nested_ifs_lead_over_the_ends_of_both(ran):
    inner = if_(load(64), [store(0, 1, line=4)], line=3)
    tested = program(if_(load(64), [inner], line=2), store(4, 1, line=7))
    assert ways_of(ran(tested, 1)) == ({(2, 3), (2, 7), (3, 4), (3, 7)}, {(2, 3), (3, 4)})


@pytest.mark.parametrize(
    ("last", "gone"), [(-1, {(2, 6)}), (0, {(2, 3), (2, 6)}), (5, {(2, 3), (2, 6)})]
)
def test_for(ran, last, gone):
    body = for_(0, load(64), [store(4, 1, line=3)], line=2)
    found = ran(program(*body, store(8, 1, line=6)), last)
    assert ways_of(found) == ({(2, 3), (2, 6)}, gone)
    assert lines_of(found) == ({2, 3, 6}, {2, 3, 6} if last >= 0 else {2, 6})


def test_a_condition_that_only_leaves_the_loop(ran):
    """``IF condition THEN`` in line 3, ``EXIT;`` in line 4."""
    leave = if_(is_(load(0), "eq", load(64)), [ir.Break(4, 1)], line=3)
    tested = program(*for_(0, 3, [leave, store(4, 1, line=6)], line=2), store(8, 1, line=8))
    every = {(2, 3), (2, 8), (3, 4), (3, 6)}
    found = ran(tested, 9)
    assert ways_of(found) == (every, {(2, 3), (2, 8), (3, 6)})
    assert lines_of(found) == ({2, 3, 4, 6, 8}, {2, 3, 6, 8})
    found = ran(tested, 0)
    assert ways_of(found) == (every, {(2, 3), (3, 4)})
    assert lines_of(found)[1] == {2, 3, 4, 8}


def test_an_exit_after_a_statement_has_its_line(ran):
    leave = if_(load(64), [store(0, 1, line=4), ir.Break(5, 1)], line=3)
    tested = program(*for_(0, 1, [leave], line=2), store(8, 1, line=8))
    assert lines_of(ran(tested, 1))[1] == {2, 3, 4, 5, 8}
    assert lines_of(ran(tested, 0))[1] == {2, 3, 8}


def test_repeat(ran):
    end = if_(is_(load(0), "ge_s", load(64)), [ir.Break(4, 1)], line=4)
    loop = ir.Loop(2, 1, [store(0, op("add", load(0), 1), line=3), end])
    assert ways_of(ran(program(loop, store(8, 1, line=6)), 1)) == ({(4, 3), (4, 6)}, {(4, 6)})


@pytest.mark.parametrize("values", [(1, 2, 3), (1000, 2000, 3000, 4000, 5000)])
def test_case(ran, values):
    """By a jump table and by a search."""
    cases = [
        ir.Case(10 + n, [(value, value)], [store(0, n, line=10 + n)])
        for n, value in enumerate(values)
    ]
    tested = program(ir.Switch(5, load(64), cases, [store(0, 9, line=30)]), store(4, 1, line=40))
    every = {(5, 10 + n) for n in range(len(values))} | {(5, 30)}
    found = ran(tested, values[1], 7)
    assert ways_of(found) == (every, {(5, 11), (5, 30)})
    assert lines_of(found)[1] == {5, 11, 30, 40}


def test_a_case_without_else_goes_on(ran):
    cases = [ir.Case(3, [(n, n) for n in range(9)], [store(0, 1, line=3)])]
    tested = program(ir.Switch(2, load(64), cases), store(4, 1, line=6))
    assert ways_of(ran(tested, 100)) == ({(2, 3), (2, 6)}, {(2, 6)})


def test_a_return_has_its_line(ran):
    tested = program(if_(load(64), [ir.Return(3)], line=2), store(0, 1, line=5))
    found = ran(tested, 1)
    assert lines_of(found) == ({2, 3, 5}, {2, 3})
    assert ways_of(found) == ({(2, 3), (2, 5)}, {(2, 3)})


def test_what_no_source_decides_is_no_way(ran):
    guarded = ir.IfExpression("i32", load(64), number(1), number(2))
    trunc = ir.Convert("i32", "trunc_f32_s", load(8, "f32"))
    checked = ir.Checked(load(64), 10)
    body = (store(0, guarded, line=2), store(4, trunc, line=3), store(12, checked, line=4))
    assert ways_of(ran(program(*body), 1)) == (set(), set())


def test_the_entry_of_a_function_is_no_statement(ran):
    action = function("ACTION", (), None, evaluate(call("INNER"), line=21), kind="action")
    inner = function("INNER", (), None, store(0, 1, line=31), kind="action")
    tested = module(unit(if_(load(64), [evaluate(call("ACTION"), line=3)], line=2)), action, inner)
    assert lines_of(ran(tested, 0)) == ({2, 3, 21, 31}, {2})
    assert lines_of(ran(tested, 1))[1] == {2, 3, 21, 31}


def test_lines_after_a_failed_check_have_not_run(compiled):
    body = (store(0, ir.Checked(load(64), 10), line=2), store(4, 1, line=3))
    machine = compiled(program(*body), options=COUNTED)
    machine.write(FIRST + 64, b"\x0a")
    with pytest.raises(MachineFault) as caught:
        machine.run()
    assert machine.code.profile.lines_run(0, machine.counts()) == {2}
    found = machine.code.lines.find(caught.value.frames[0].offset)
    assert (found.line, found.trap) == (2, "index")


def test_an_endless_loop_of_nothing_has_no_way_out(ran):
    tested = program(if_(load(64), [ir.Loop(3, 1, [])], line=2), store(0, 1, line=5))
    assert ways_of(ran(tested, 0)) == ({(2, -1), (2, 5)}, {(2, 5)})
