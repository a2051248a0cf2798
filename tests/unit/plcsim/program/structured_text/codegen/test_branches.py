import struct

import pytest

from plcsim.core.memory import FIRST
from plcsim.program.structured_text import ir

from .build import evaluate, if_, is_, load, op, program, store


def word(machine, offset):
    return struct.unpack("<I", machine.read(FIRST + offset, 4))[0]


def arms(count, line=1):
    return [
        ir.Arm(line + n, is_(load(64), "eq", n), [store(0, 100 + n, line=line + n)])
        for n in range(count)
    ]


@pytest.mark.parametrize("count", [1, 2, 5])
@pytest.mark.parametrize("other", [[], [store(0, 99)]])
def test_the_first_arm_that_is_true_runs(compiled, count, other):
    machine = compiled(program(store(0, 7), ir.If(1, arms(count), other)))
    for value in range(count + 1):
        machine.write(FIRST + 64, bytes([value]))
        machine.run()
        expected = 100 + value if value < count else 99 if other else 7
        assert word(machine, 0) == expected


def test_later_conditions_are_not_evaluated(compiled):
    nil = ir.Load("i32", "w32", ir.Place(load(68), 0, 0))
    machine = compiled(
        program(ir.If(1, [ir.Arm(1, load(64), [store(0, 1)]), ir.Arm(2, nil, [store(0, 2)])]))
    )
    machine.write(FIRST + 64, b"\1")
    machine.run()
    assert word(machine, 0) == 1


def test_thousands_of_arms(compiled):
    machine = compiled(program(ir.If(1, arms(5000))))
    machine.write(FIRST + 64, struct.pack("<I", 4999))
    machine.run()
    assert word(machine, 0) == 5099


def test_thousands_of_nested_blocks_are_no_recursion_of_arms(compiled):
    body = [store(0, 1)]
    for label in range(100):
        body = [ir.Block(1, label, [if_(load(64), [ir.Break(1, label)]), *body])]
    machine = compiled(program(*body))
    machine.run()
    assert word(machine, 0) == 1


def test_break_leaves_its_block_only(compiled):
    inner = ir.Block(1, 2, [if_(load(64), [ir.Break(1, 1)]), ir.Break(1, 2), store(0, 1)])
    machine = compiled(program(ir.Block(1, 1, [inner, store(4, 2)]), store(8, 3)))
    machine.run()
    assert [word(machine, o) for o in (0, 4, 8)] == [0, 2, 3]
    machine.write(FIRST, bytes(16))
    machine.write(FIRST + 64, b"\1")
    machine.run()
    assert [word(machine, o) for o in (0, 4, 8)] == [0, 0, 3]


@pytest.mark.parametrize("chosen", [0, 1, 2])
def test_what_one_arm_stores_is_loaded_after_it(compiled, chosen):
    """A copy is used after an If only where it is right on all paths."""
    body = (
        evaluate(load(0)),
        ir.If(
            1,
            [
                ir.Arm(1, is_(load(64), "eq", 0), [store(0, 5)]),
                ir.Arm(
                    1,
                    is_(load(64), "eq", 1),
                    [
                        ir.FillBytes(
                            1, ir.AddressOf(load(0).place), ir.Const("i32", 2), ir.Const("i32", 1)
                        )
                    ],
                ),
            ],
        ),
        store(4, op("add", load(0), 0)),
    )
    machine = compiled(program(*body))
    machine.write(FIRST, b"\x09")
    machine.write(FIRST + 64, bytes([chosen]))
    machine.run()
    assert word(machine, 4) == [5, 2, 9][chosen]


def test_what_a_left_block_stored_is_known_to_be_unknown(compiled):
    body = (
        store(0, 1),
        ir.Block(1, 1, [if_(load(64), [ir.Break(1, 1)]), store(0, 2), store(8, 1)]),
        store(4, load(0)),
    )
    machine = compiled(program(*body))
    machine.run()
    assert word(machine, 4) == 2
    machine.write(FIRST + 64, b"\1")
    machine.run()
    assert word(machine, 4) == 1
