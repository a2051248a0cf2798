import pytest

from plcsim.core.memory import FIRST
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.bulk import MOST_INLINE

from .build import address, evaluate, load, number, op, place, program, store

PATTERN = bytes(range(1, 201))
START = FIRST + 100


def moved(target, source, count):
    memory = bytearray(PATTERN)
    memory[target : target + count] = memory[source : source + count]
    return bytes(memory)


@pytest.mark.parametrize("distance", [-9, -8, -3, -1, 0, 1, 2, 7, 8, 15, 70])
def test_copies_of_all_sizes_may_overlap(compiled, distance):
    """Constant counts, moved by single accesses up to a limit, and computed ones by the helper."""
    source = 20
    target = source + distance
    for count in (*range(18), 31, MOST_INLINE - 1, MOST_INLINE, MOST_INLINE + 1, 100):
        bodies = [
            ir.CopyBytes(1, address(100 + target, 0), address(100 + source, 0), size)
            for size in (number(count), op("add", load(64), count))
        ]
        for body in bodies:
            machine = compiled(program(body))
            machine.write(START, PATTERN)
            machine.run()
            assert machine.read(START, len(PATTERN)) == moved(target, source, count), count
            machine.close()


@pytest.mark.parametrize("count", [0, 1, 2, 3, 7, 8, 15, 63, 64, 65, 100])
@pytest.mark.parametrize("value", [0, 0xFF, 0x180])
def test_fills_of_all_sizes(compiled, count, value):
    constant = ir.FillBytes(1, address(110, 0), number(value), number(count))
    computed = ir.FillBytes(1, address(110, 0), op("add", load(64), value), number(count))
    expected = PATTERN[:10] + bytes([value & 0xFF]) * count + PATTERN[10 + count :]
    for body in (constant, computed):
        machine = compiled(program(body))
        machine.write(START, PATTERN)
        machine.run()
        assert machine.read(START, len(PATTERN)) == expected


@pytest.mark.parametrize("computed", [False, True])
def test_copies_of_what_was_written_are_forgotten(compiled, computed):
    count = op("add", load(64), 4) if computed else number(4)
    body = (
        store(0, 1),
        store(4, 2),
        ir.CopyBytes(1, address(0), address(4), count),
        store(8, load(0)),
        ir.FillBytes(1, address(4), number(0), count),
        store(12, load(4)),
    )
    machine = compiled(program(*body))
    machine.run()
    assert machine.read(FIRST + 8, 8) == bytes([2, 0, 0, 0, 0, 0, 0, 0])


def test_a_copy_s_operands_are_evaluated_once_and_in_order(compiled):
    def step(result):
        """An expression that notes when it was evaluated."""
        noted = store(0, op("add", op("mul", load(0), 10), result))
        return ir.StatementExpression("i32", [noted], address(100 + result * 8, 0))

    count = ir.StatementExpression("i32", [store(0, op("mul", load(0), 10))], number(8))
    machine = compiled(program(ir.CopyBytes(1, step(1), step(2), count), evaluate(load(0))))
    machine.write(START + 16, b"abcdefgh")
    machine.run()
    assert machine.read(START + 8, 8) == b"abcdefgh"
    assert machine.read(FIRST, 1) == bytes([120])
    assert place(0).offset == 0
