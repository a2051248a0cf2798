import struct

import pytest

from plcsim.core.errors import CycleTimeViolation
from plcsim.core.memory import FIRST
from plcsim.core.system_area import STALLED
from plcsim.machine import MachineFault, frames_of
from plcsim.program.structured_text import ir
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


def words(machine, *offsets):
    return [struct.unpack("<i", machine.read(FIRST + o, 4))[0] for o in offsets]


def ran(compiled, *body, start=b"", **more):
    machine = compiled(program(*body, **more))
    machine.write(FIRST + 64, start)
    machine.run()
    return machine


def add(offset, value):
    return store(offset, op("add", load(offset), value))


@pytest.mark.parametrize("last", [-1, 0, 9])
def test_for_runs_to_its_end(compiled, last):
    machine = ran(compiled, *for_(0, last, [add(4, load(0))]))
    assert words(machine, 0, 4) == [max(last + 1, 0), sum(range(last + 1))]


def test_the_limit_is_evaluated_in_every_pass(compiled):
    machine = ran(
        compiled, store(8, 3), *for_(0, load(8), [if_(is_(load(0), "eq", 1), [store(8, 5)])])
    )
    assert words(machine, 0) == [6]


def test_continue_goes_to_the_test(compiled):
    test = if_(is_(load(0), "ge_s", 5), [ir.Break(1, 1)])
    body = [test, add(0, 1), if_(is_(load(0), "eq", 3), [ir.Continue(1, 1)]), add(4, load(0))]
    assert words(ran(compiled, ir.Loop(1, 1, body)), 0, 4) == [5, 12]


def test_a_test_at_the_end(compiled):
    body = [
        add(0, 1),
        if_(is_(load(0), "eq", 3), [ir.Continue(1, 1)]),
        if_(is_(load(0), "ge_s", 6), [ir.Break(1, 1)]),
    ]
    assert words(ran(compiled, ir.Loop(1, 1, body)), 0) == [6]


def test_a_test_in_the_middle_and_a_body_that_ends_in_a_break(compiled):
    middle = [add(0, 1), if_(is_(load(0), "gt_s", 4), [ir.Break(1, 1)]), add(4, 1)]
    once = [add(8, 1), ir.Break(1, 2), add(8, 100)]
    machine = ran(compiled, ir.Loop(1, 1, middle), ir.Loop(1, 2, once))
    assert words(machine, 0, 4, 8) == [5, 4, 1]


def test_inner_loops_leave_outer_ones(compiled):
    inner = [
        if_(is_(load(4), "eq", 7), [ir.Break(1, 1)]),
        add(4, 1),
        if_(is_(op("and", load(4), 3), "eq", 0), [ir.Continue(1, 1)]),
    ]
    outer = ir.Loop(1, 1, [add(0, 1), ir.Loop(1, 2, inner)])
    assert words(ran(compiled, outer), 0, 4) == [2, 7]


def test_a_test_that_calls_is_written_once(compiled):
    count = function(
        "F",
        (),
        "i32",
        store(32, op("add", load(32, root=0), 1), root=0),
        ir.Return(1, load(32, root=0)),
    )
    test = if_(is_(call("F", result="i32"), "gt_s", 3), [ir.Break(1, 1)])
    machine = compiled(module(unit(ir.Loop(1, 1, [test, add(0, 1)])), count))
    machine.run()
    assert words(machine, 0, 32) == [3, 4]
    number = machine.wasm[machine.wasm.rindex(b"\x01F") - 1]  # of the section of names
    assert machine.wasm.count(bytes([0x10, number])) == 1


def test_a_loop_does_not_load_what_it_keeps(compiled):
    """A pass costs what its statements cost, and not a load of each variable."""
    costs = {}
    for copies in (True, False):
        options = CodegenOptions(copies=copies)
        per_pass = []
        for last in (10, 110):
            tested = program(*for_(0, last, [add(4, op("mul", load(8), load(12)))]))
            per_pass.append(compiled(tested, options=options, fuel=True).fuel_of())
        costs[copies] = (per_pass[1] - per_pass[0]) / 100
    loads = 5  # i in the test, i in the step, and three operands: a constant and a load for each
    assert costs[False] - costs[True] == loads - 2  # a copy costs one more at each store, too


@pytest.mark.parametrize("this", [False, True])
def test_what_a_call_in_the_loop_changes_is_loaded_again(compiled, this):
    member = ir.Place(ir.Local("i32", 0), 0, 40) if this else place(0)
    body = [
        if_(ir.Compare("i32", "ge_s", ir.Load("i32", "w32", member), number(5)), [ir.Break(1, 1)]),
        evaluate(ir.Call(None, "bump", [ir.AddressOf(member)])),
        add(4, 1),
    ]
    pointed = ir.Place(ir.Local("i32", 0), 0, 0)
    bump = function(
        "bump",
        ("i32",),
        None,
        ir.Store(1, "w32", pointed, op("add", ir.Load("i32", "w32", pointed), 1)),
    )
    loop = ir.Loop(1, 1, body)
    functions = [unit(loop), bump]
    if this:
        block = function("FB", ("i32",), None, loop, kind="block", exported=False)
        functions = [unit(evaluate(call("FB", address(0)))), block, bump]
    machine = compiled(module(*functions))
    machine.run()
    assert words(machine, 0, 4) == [5, 5]


def test_memory_is_current_inside_a_loop(compiled):
    """The index at which a loop has failed can be seen."""
    nil_at_7 = ir.Place(
        op("add", address(0, 0), op("mul", is_(load(0), "eq", 7), 0x1000_0000)), 16, 0
    )
    machine = compiled(program(*for_(0, 9, [ir.Store(4, "u8", nil_at_7, number(1))])))
    with pytest.raises(MachineFault):
        machine.run()
    assert words(machine, 0) == [7]


def endless(*body):
    return ir.Loop(5, 9, [add(0, 1), *body])


def test_the_watchdog_ends_an_endless_loop(compiled):
    machine = compiled(program(endless()))
    machine.memory.system.end_program(STALLED)
    with pytest.raises(CycleTimeViolation) as caught:
        machine.run()
    frame = frames_of(caught.value)[0]
    assert machine.code.lines.find(frame.offset) == ("CYCLIC", "unit", "Main.st", 5, "budget")
    assert words(machine, 0) == [0]


def test_the_watchdog_ends_it_in_the_middle(compiled):
    """What a function in Python does in the third pass is seen at the head of the fourth."""

    def stop(side):
        if words(side, 0) == [3]:
            side.memory.system.end_program(STALLED)

    foreign = {"stop": ir.Import("function", "stop", ir.Signature((), None))}
    machine = compiled(
        module(unit(endless(evaluate(call("stop")))), imports=foreign), {"stop": stop}
    )
    with pytest.raises(CycleTimeViolation):
        machine.run()
    assert words(machine, 0) == [3]


def test_recursion_meets_the_budget_before_the_stack(compiled):
    again = function("F", (), None, evaluate(call("F")), kind="action")
    machine = compiled(module(unit(evaluate(call("F"))), again))
    machine.memory.system.end_program(STALLED)
    with pytest.raises(CycleTimeViolation):
        machine.run()


def test_without_budget_nothing_polls(compiled):
    body = for_(0, 100, [add(4, 1)])
    with_, without = (
        compiled(program(*body), options=CodegenOptions(budget=budget), fuel=True).fuel_of()
        for budget in (True, False)
    )
    assert with_ - without == 51 * 5  # a loop as small as this one polls in every other pass


@pytest.mark.parametrize("passes", [0, 1, 2, 3, 7])
@pytest.mark.parametrize("size", [1, 30])
def test_a_loop_that_is_written_twice_ends_in_each_pass(compiled, passes, size):
    """Small bodies are; by the test, by EXIT in the middle, and with CONTINUE."""
    skip = if_(is_(load(0), "eq", 2), [ir.Continue(1, 1)])
    leave = if_(is_(load(0), "eq", load(64)), [ir.Break(1, 1)])
    test = if_(is_(load(0), "ge_s", passes), [ir.Break(1, 1)])
    body = [test, add(0, 1), *([add(4, load(0))] * size), skip, leave, add(8, 1)]
    for stop in (0, 1, 2, 3):
        machine = ran(compiled, ir.Loop(1, 1, body), start=bytes([stop]))
        count = min(passes, stop) if stop and stop != 2 else passes
        whole = sum(1 for one in range(1, count + 1) if one not in (2, stop))
        assert words(machine, 0, 4, 8) == [count, size * sum(range(count + 1)), whole]


def test_fuel_ends_an_endless_loop_at_the_same_place(compiled):
    counts = []
    for _ in range(2):
        machine = compiled(program(endless()), fuel=True)
        machine.machine.fuel = 1000
        with pytest.raises(CycleTimeViolation):
            machine.run()
        counts.append(words(machine, 0))
    assert counts[0] == counts[1] != [0]
