import random
import struct

import pytest

from plcsim.core.memory import FIRST
from plcsim.machine.opcodes import RETURN
from plcsim.program.structured_text import ir

from .build import if_, load, number, program, store

LOWEST, HIGHEST = -(2**31), 2**31 - 1


def machine_of(compiled, cases, other=True):
    """Stores 10 + the number of the case, 1 for none."""
    made = [
        ir.Case(2 + n, ranges, [store(0, 10 + n, line=2 + n)]) for n, ranges in enumerate(cases)
    ]
    body = ir.Switch(1, load(64), made, [store(0, 1)] if other else ())
    return compiled(program(store(0, 1), body, store(4, 5)))


def choice(machine, value):
    machine.write(FIRST + 64, struct.pack("<i", value))
    machine.run()
    assert machine.read(FIRST + 4, 1) == b"\5"
    return machine.read(FIRST, 1)[0]


def expected(cases, value):
    found = [
        10 + n for n, ranges in enumerate(cases) if any(lo <= value <= hi for lo, hi in ranges)
    ]
    return found[0] if found else 1


SHAPES = {
    "none": [],
    "one": [[(5, 5)]],
    "few": [[(5, 7)], [(-3, -3), (9, 9)]],
    "dense": [[(n, n)] for n in range(3, 40)],
    "dense with ranges and gaps": [[(0, 4), (9, 9)], [(5, 6)], [(12, 20)], [(-2, -1)]],
    "sparse": [[(n * 1000, n * 1000)] for n in range(-9, 9)],
    "one case of many": [[(n * 7000, n * 7000 + 100) for n in range(30)]],
    "whole": [[(LOWEST, -1)], [(0, 0)], [(1, HIGHEST)]],
    "halves": [
        [(LOWEST, LOWEST)],
        [(LOWEST + 5, -7), (3, 3)],
        [(4, HIGHEST - 1)],
        [(-5, -5)],
        [(-1, 0)],
    ],
    "wide": [[(-1000, 2000)], [(2001, 2002)], [(2003, 2003)], [(2004, 3300)]],
}


@pytest.mark.parametrize("other", [True, False])
@pytest.mark.parametrize("shape", SHAPES)
def test_the_case_that_holds_the_value_runs(compiled, shape, other):
    cases = SHAPES[shape]
    machine = machine_of(compiled, cases, other)
    edges = {v + d for ranges in cases for r in ranges for v in r for d in (-1, 0, 1)}
    edges |= {0, LOWEST, HIGHEST}
    for value in edges:
        if LOWEST <= value <= HIGHEST:
            assert choice(machine, value) == expected(cases, value), value


@pytest.mark.parametrize("seed", range(20))
def test_random_ranges(compiled, seed):
    choose = random.Random(seed)
    span = choose.choice([20, 300, 100_000, 2**31])
    ends = sorted(choose.sample(range(-span, span), 2 * choose.randint(1, 9)))
    ranges = list(zip(ends[::2], ends[1::2], strict=True))
    choose.shuffle(ranges)
    cases = [ranges[n::3] for n in range(3) if ranges[n::3]]
    machine = machine_of(compiled, cases)
    for value in [*ends, *(v + 1 for v in ends), *(v - 1 for v in ends)]:
        if LOWEST <= value <= HIGHEST:
            assert choice(machine, value) == expected(cases, value)


def test_cases_may_leave_the_loop_around_them(compiled):
    switch = ir.Switch(
        1,
        load(0),
        [
            ir.Case(2, [(3, 3)], [ir.Break(2, 1)]),
            ir.Case(3, [(1, 1)], [store(0, 3), ir.Continue(3, 1)]),
        ],
        [store(0, 1)],
    )
    machine = compiled(program(ir.Loop(1, 1, [switch]), store(4, load(0))))
    machine.run()
    assert machine.read(FIRST + 4, 1) == b"\3"


def test_a_switch_of_which_every_case_returns(compiled):
    cases = [ir.Case(2, [(n, n)], [store(0, n), ir.Return(2)]) for n in range(6)]
    machine = compiled(program(ir.Switch(1, load(64), cases, [ir.Return(9)]), store(8, 1)))
    machine.write(FIRST + 64, b"\4")
    machine.run()
    assert machine.read(FIRST, 1) == b"\4"
    assert machine.read(FIRST + 8, 1) == b"\0"


def test_what_ends_a_function_returns(compiled):
    """A jump to its end would be one more for the processor to predict."""
    cases = [ir.Case(n, [(n, n)], [store(0, n)]) for n in range(8)]
    switch = ir.Switch(1, load(64), cases, [store(0, 99)])
    last = compiled(program(switch))
    before = compiled(program(if_(number(1), [switch]), store(4, 1)))
    assert last.code.wasm.count(RETURN + b"\x0b") >= len(cases)
    assert before.code.wasm.count(RETURN + b"\x0b") < len(cases)
    for machine in (last, before):
        machine.write(FIRST + 64, b"\5")
        machine.run()
        assert machine.read(FIRST, 1) == b"\5"
