import operator
import random
import struct

import numpy as np
import pytest

from plcsim.core.memory import FIRST
from plcsim.machine.opcodes import F32_DEMOTE_F64, F64_PROMOTE_F32
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.single import single_calculation, single_comparison

from .build import load, program, store

CALCULATE = {"add": np.add, "sub": np.subtract, "mul": np.multiply, "div": np.divide}
COMPARE = {
    "eq": operator.eq,
    "ne": operator.ne,
    "lt": operator.lt,
    "gt": operator.gt,
    "le": operator.le,
    "ge": operator.ge,
}
SPECIAL = [0, 1, 2, 0x7FFFFF, 0x800000, 0x800001, 0x3F800000, 0x3F800001, 0x7F7FFFFF, 0x7F800000]


def promoted(offset):
    return ir.Convert("f64", "promote_f32", load(offset, "f32"))


def demoted(sign, left, right):
    return ir.Convert("f32", "demote_f64", ir.Binary("f64", sign, left, right))


def reals(count):
    """Pairs of REALs: borders, subnormal ones, neighbours, and any others."""
    draw = random.Random(1995)
    bits = [one | sign << 31 for one in SPECIAL for sign in (0, 1)]
    pairs = [(left, right) for left in bits for right in bits]
    for _ in range(count):
        left = draw.getrandbits(32)
        near = left + draw.randrange(-3, 4) ^ draw.randrange(2) << 31
        pairs.append((left, draw.choice([near & 0xFFFFFFFF, draw.getrandbits(32)])))
    return np.array(pairs, "<u4").view("<f4")


def test_one_rounding_is_as_good_as_two(compiled):
    body = [
        store(4 * n, demoted(one, promoted(64), promoted(68)), "f32")
        for n, one in enumerate(CALCULATE)
    ]
    machine = compiled(program(*body))
    assert F64_PROMOTE_F32 not in machine.code.wasm
    assert F32_DEMOTE_F64 not in machine.code.wasm
    with np.errstate(all="ignore"):
        for pair in reals(600):
            machine.write(FIRST + 64, pair.tobytes())
            machine.run()
            found = np.frombuffer(machine.read(FIRST, 16), "<f4")
            left, right = pair.astype("<f8")
            wide = np.array([one(left, right) for one in CALCULATE.values()])
            np.testing.assert_array_equal(found, wide.astype("<f4"), str(pair))


def test_reals_are_compared_as_they_are(compiled):
    body = [
        store(4 * n, ir.Compare("f64", one, promoted(64), promoted(68)))
        for n, one in enumerate(COMPARE)
    ]
    machine = compiled(program(*body))
    assert F64_PROMOTE_F32 not in machine.code.wasm
    for pair in reals(500):
        machine.write(FIRST + 64, pair.tobytes())
        machine.run()
        found = list(np.frombuffer(machine.read(FIRST, 24), "<u4"))
        left, right = map(float, pair)
        assert found == [one(left, right) for one in COMPARE.values()], pair


def test_a_constant_that_a_real_holds_is_one():
    node = single_comparison(ir.Compare("f64", "gt", promoted(0), ir.Const("f64", 100.5)))
    assert node.operands == "f32"
    assert (node.right.type, node.right.value) == ("f32", 100.5)
    zero = single_calculation(demoted("mul", ir.Const("f64", -0.0), promoted(0)))
    assert struct.pack("<f", zero.left.value) == struct.pack("<f", -0.0)


@pytest.mark.parametrize("value", [0.1, 1e300, 2.0**-150, 16777217.0, float("nan")])
def test_other_constants_are_not(value):
    node = ir.Compare("f64", "gt", promoted(0), ir.Const("f64", value))
    assert single_comparison(node) is node
    node = demoted("mul", promoted(0), ir.Const("f64", value))
    assert single_calculation(node) is node


def test_an_lreal_between_stays_one():
    inner = ir.Binary("f64", "add", promoted(0), promoted(4))
    node = demoted("sub", inner, promoted(8))
    assert single_calculation(node) is node
    node = demoted("min", promoted(0), promoted(4))
    assert single_calculation(node) is node
