import struct

import pytest

from plcsim.core.memory import FIRST
from plcsim.machine import FaultKind, MachineFault, frames_of
from plcsim.program.structured_text import ir

from .build import (
    PROGRAM,
    address,
    call,
    evaluate,
    function,
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


def u32(machine, offset):
    return struct.unpack("<I", machine.read(FIRST + offset, 4))[0]


def value_of(compiled, expression, *functions, start=b"", **more):
    """The i32 that an expression gives."""
    machine = compiled(module(unit(store(0, expression)), *functions, **more))
    machine.write(FIRST + 64, start)
    machine.run()
    return u32(machine, 0)


def counting(result, offset=32):
    """A function that counts its calls at an offset, and gives a number."""
    count = store(offset, op("add", load(offset, root=0), 1), root=0)
    return function("COUNT", (), "i32", count, ir.Return(1, number(result)))


@pytest.mark.parametrize(
    "value", [0, 63, 64, -1, -65, 0x7FFFFFFF, -0x80000000, 0xFFFFFFFF, 0x80000000]
)
def test_constants_may_be_signed_or_not(compiled, value):
    assert value_of(compiled, number(value)) == value & 0xFFFFFFFF


def test_long_chains_take_no_depth(compiled):
    chain = number(0)
    for one in range(20_000):
        chain = op("add", chain, one)
    assert value_of(compiled, chain) == sum(range(20_000)) & 0xFFFFFFFF


def test_both_sides_of_a_select_are_evaluated_and_one_of_an_if_expression(compiled):
    both = ir.Select("i32", number(1), number(5), call("COUNT", result="i32"))
    one = ir.IfExpression("i32", number(1), number(5), call("COUNT", result="i32"))
    for expression, calls in ((both, 1), (one, 0)):
        machine = compiled(module(unit(store(0, expression)), counting(9)))
        machine.run()
        assert (u32(machine, 0), u32(machine, 32)) == (5, calls)


def test_what_one_side_has_loaded_is_not_known_after_an_if_expression(compiled):
    maybe = ir.IfExpression("i32", load(64), load(68), number(0))
    expression = op("add", op("mul", maybe, 10), load(68))
    assert value_of(compiled, expression, start=struct.pack("<II", 0, 3)) == 3


def test_an_address_is_evaluated_before_the_value(compiled):
    base = op("add", address(4, 0), op("mul", op("and", load(32, root=0), 3), 4))
    target = ir.Place(base, 0, 0)
    machine = compiled(
        module(unit(ir.Store(1, "w32", target, call("COUNT", result="i32"))), counting(7))
    )
    machine.run()
    assert [u32(machine, offset) for offset in (4, 8, 32)] == [7, 0, 1]


def test_statements_inside_an_expression_come_first(compiled):
    expression = ir.StatementExpression("i32", [store(4, 3)], op("add", load(4), 1))
    assert value_of(compiled, expression) == 4


def test_a_call_makes_copies_wrong(compiled):
    calls = op("add", load(32, root=0), call("COUNT", result="i32"))
    assert value_of(compiled, op("add", calls, load(32, root=0)), counting(10)) == 11


def test_the_address_of_a_member_behind_a_pointer(compiled):
    pointer = ir.AddressOf(ir.Place(load(64), 12, 0))
    assert value_of(compiled, pointer, start=struct.pack("<I", 1000)) == 1012
    assert value_of(compiled, address(8)) == FIRST + 8


@pytest.mark.parametrize("index", [0, 9])
def test_a_checked_index_is_itself(compiled, index):
    assert value_of(compiled, ir.Checked(load(64), 10), start=bytes([index])) == index


@pytest.mark.parametrize("index", [10, -1, 2**31 - 1, -(2**31)])
def test_an_index_that_is_not_below_its_count_ends_the_program(compiled, index):
    machine = compiled(program(store(0, ir.Checked(load(64), 10), line=7)))
    machine.write(FIRST + 64, struct.pack("<i", index))
    with pytest.raises(MachineFault) as caught:
        machine.run()
    assert caught.value.kind is FaultKind.UNREACHABLE
    found = machine.code.lines.find(frames_of(caught.value)[0].offset)
    assert found == ("CYCLIC", "unit", "Main.st", 7, "index")


def element(index, width="u16"):
    base = op("add", ir.AddressOf(place(128, 9)), op("mul", index, 2))
    return ir.Load("i32", width, ir.Place(base, 0, 9))


@pytest.mark.parametrize(
    ("index", "expected"),
    [
        (load(64, "u8"), 2),
        (op("sub", load(64, "u8"), 2), 0),
        (op("add", load(64, "u8"), 1), 3),
        (load(64, "s8"), 2),
        (op("sub", load(64), 1), 1),
        (ir.Checked(load(64), 4), 2),
    ],
)
def test_elements(compiled, index, expected):
    machine = compiled(program(store(0, element(index))))
    machine.write(FIRST + 64, bytes([2]))
    machine.write(FIRST + 128, struct.pack("<4H", 0, 1, 2, 3))
    machine.run()
    assert u32(machine, 0) == expected


def test_an_index_below_zero_reaches_what_lies_before(compiled):
    machine = compiled(program(store(0, element(load(64, "s8")))))
    machine.write(FIRST + 64, b"\xff")
    machine.write(FIRST + 126, b"\x2a")
    machine.run()
    assert u32(machine, 0) == 42


def test_an_element_of_two_segments_has_two_addresses(compiled):
    other = ir.Segment("other")
    base = op("add", ir.AddressOf(ir.Place(other, 0, 0)), load(64, "u8"))
    module_ = module(
        unit(store(0, ir.Load("i32", "u8", ir.Place(base, 0, 0)))), segments=(PROGRAM, other)
    )
    machine = compiled(module_)
    machine.write(FIRST + 64, bytes([65, 99]))
    machine.run()
    assert u32(machine, 0) == 99


@pytest.mark.parametrize(
    ("value", "result"),
    [
        (2147483647.5, 2147483647),
        (2147483648.0, 0x80000000),
        (-2147483648.9, 0x80000000),
        (float("nan"), 0x80000000),
        (float("-inf"), 0x80000000),
        (-1.9, 0xFFFFFFFF),
    ],
)
def test_a_conversion_that_does_not_fit_is_the_integer_indefinite(compiled, value, result):
    converted = ir.Convert("i32", "trunc_f64_s", load(64, "f64"))
    assert value_of(compiled, converted, start=struct.pack("<d", value)) == result


def test_the_value_of_a_call_may_be_dropped(compiled):
    machine = compiled(module(unit(evaluate(call("COUNT", result="i32"))), counting(7)))
    machine.run()
    assert u32(machine, 32) == 1


def test_comparisons_count(compiled):
    both = op("add", is_(number(3), "gt_s", 2), is_(number(3), "lt_u", 2))
    assert value_of(compiled, both) == 1
