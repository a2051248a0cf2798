import struct

import pytest

from plcsim.core.memory import FIRST
from plcsim.machine import MachineFault
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.options import CodegenOptions
from plcsim.program.structured_text.codegen.statements import fits

from .build import function, if_, is_, load, module, number, op, place, program, store, unit


def words(machine, *offsets):
    return [struct.unpack("<I", machine.read(FIRST + o, 4))[0] for o in offsets]


@pytest.mark.parametrize("width", ["s8", "u8", "s16", "u16"])
@pytest.mark.parametrize("value", [-1, 0x80, 0x18000, 300, 127])
def test_what_is_loaded_after_a_store_is_narrow(compiled, width, value):
    body = (store(0, op("add", load(64), value), width), store(4, load(0, width)))
    results = []
    for copies in (True, False):
        machine = compiled(program(*body), options=CodegenOptions(copies=copies))
        machine.run()
        results.append(words(machine, 4))
    assert results[0] == results[1]


@pytest.mark.parametrize(
    ("value", "width", "expected"),
    [
        (number(255), "u8", True),
        (number(256), "u8", False),
        (number(-1), "u8", False),
        (number(-128), "s8", True),
        (number(-129), "s8", False),
        (load(0, "u8"), "u8", True),
        (load(0, "u8"), "s8", False),
        (is_(load(0), "eq", 0), "u8", True),
        (op("and", load(0, "u8"), is_(load(0), "eq", 0)), "u8", True),
        (op("xor", load(0, "u8"), load(4)), "u8", False),
        (op("add", load(0, "u8"), 0), "u8", False),
        (ir.Convert("i32", "extend16_s", load(0)), "s16", True),
        (ir.Convert("i32", "extend16_s", load(0)), "u16", False),
        (ir.Local("i32", 0), "u8", False),
    ],
)
def test_what_surely_fits(value, width, expected):
    assert fits(value, width) == expected


def test_what_fits_is_told_for_long_chains():
    chain = load(0, "u8")
    for _ in range(20_000):
        chain = op("and", chain, load(0, "u8"))
    assert fits(chain, "u8")


def test_locals_begin_with_zero_and_can_be_set(compiled):
    local = ir.Local("i32", 0)
    machine = compiled(
        program(
            store(0, op("add", local, 1)),
            ir.SetLocal(1, 0, number(5)),
            store(4, local),
            locals_=("i32",),
        )
    )
    machine.run()
    machine.run()
    assert words(machine, 0, 4) == [1, 5]


def test_nothing_after_a_return_runs(compiled):
    machine = compiled(
        program(store(0, 1), if_(load(64), [ir.Return(2)]), store(4, 2), ir.Return(3), store(8, 3))
    )
    machine.run()
    assert words(machine, 0, 4, 8) == [1, 2, 0]
    machine.write(FIRST, bytes(16))
    machine.write(FIRST + 64, b"\1")
    machine.run()
    assert words(machine, 0, 4, 8) == [1, 0, 0]


def test_memory_is_current_at_a_fault(compiled):
    nil = ir.Store(3, "w32", ir.Place(load(64), 0, 0), number(1))
    machine = compiled(program(store(0, 1), store(0, op("add", load(0), 6)), nil, store(0, 9)))
    with pytest.raises(MachineFault):
        machine.run()
    assert words(machine, 0) == [7]


def test_a_copy_of_the_same_bytes_in_another_width_is_not_used(compiled):
    both = (store(0, 0x0102, "u16", root=5), store(1, 9, "u8", root=5), store(4, load(0, "u16", 5)))
    machine = compiled(program(*both))
    machine.run()
    assert words(machine, 4) == [0x0902]


def test_data_of_a_block_is_based_on_its_address(compiled):
    member = ir.Place(ir.Local("i32", 0), 4, 3)
    bump = ir.Store(1, "w32", member, op("add", ir.Load("i32", "w32", member), 1))
    block = function("FB", ("i32",), None, bump, bump, kind="block", exported=False)
    calls = [ir.Evaluate(1, ir.Call(None, "FB", [ir.AddressOf(place(o, o + 1))])) for o in (0, 8)]
    machine = compiled(module(unit(*calls, calls[1]), block))
    machine.run()
    assert words(machine, 4, 12) == [2, 4]
