import math
import struct

import pytest

from plcsim.core.memory import FIRST
from plcsim.machine import FaultKind, MachineFault
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.operators import (
    COMPARISONS,
    CONVERSIONS,
    LOAD,
    NARROW,
    OPERATORS,
    STORE,
)

from .build import function, load, module, place, program, store
from .interpreter import Interpreter, TrapError

INTEGERS = (0, 1, 2, 7, 31, 33, 0x7F, 0x80, 0xFF, 0x8000, 0xFFFF, 0x7FFFFFFF, 0x80000000, -1, -8)
REALS = (0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 1.5, 2.5, -2.5, 1e10, -3e9, 1e300, math.inf, -math.inf)
WIDTH = {"i32": "w32", "i64": "w64", "f32": "f32", "f64": "f64"}
FORM = {"i32": "<I", "i64": "<Q", "f32": "<f", "f64": "<d"}
SOURCES = {"8": "i32", "16": "i32", "i32": "i32", "i64": "i64", "f32": "f32", "f64": "f64"}


def values(kind):
    if kind in ("i32", "i64"):
        mask = (1 << int(kind[1:])) - 1
        return [value & mask for value in INTEGERS]
    return [*REALS, math.nan] if kind == "f64" else [single(v) for v in REALS] + [math.nan]


def single(value):
    try:
        return struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)


def outcomes(run, count, kind):
    """The result of each pair of operands, or why there is none."""
    found = []
    for number in range(count):
        try:
            found.append(bits(run("F", number), kind))
        except TrapError as trap:
            found.append(str(trap))
        except MachineFault as fault:
            found.append(fault.kind.value)
    return found


def bits(value, kind):
    if kind in ("f32", "f64"):
        return "NaN" if math.isnan(value) else struct.pack(FORM[kind], value)
    return value & ((1 << int(kind[1:])) - 1)


def compare(compiled, node_of, kinds, result):
    """All pairs of operands from memory, compiled and interpreted."""
    pairs = [(a, b) for a in values(kinds[0]) for b in values(kinds[-1])]
    data = b"".join(
        struct.pack(FORM[kinds[0]], a).ljust(8, b"\0")
        + struct.pack(FORM[kinds[-1]], b).ljust(8, b"\0")
        for a, b in pairs
    )
    operands = [
        ir.Load(kind, WIDTH[kind], ir.Place(row(), 8 * i, 0)) for i, kind in enumerate(kinds)
    ]
    tested = module(
        function("F", ("i32",), result, ir.Return(1, node_of(*operands))),
    )
    machine = compiled(tested)
    reference = Interpreter(tested, {"program": FIRST}, bytearray(len(data)))
    for side in (machine, reference):
        side.write(FIRST, data)
    expected = outcomes(reference.run, len(pairs), result)
    assert outcomes(machine.run, len(pairs), result) == expected


def row():
    scaled = ir.Binary("i32", "mul", ir.Local("i32", 0), ir.Const("i32", 16))
    return ir.Binary("i32", "add", ir.AddressOf(place(0, 0)), scaled)


UNARY = ("clz", "ctz", "popcnt", "neg", "abs", "sqrt", "floor", "ceil", "trunc", "nearest")


@pytest.mark.parametrize(("kind", "operator"), [key for key in OPERATORS if key[1] in UNARY])
def test_unary_operators_are_as_interpreted(compiled, kind, operator):
    compare(compiled, lambda a: ir.Unary(kind, operator, a), [kind], kind)


@pytest.mark.parametrize(("kind", "operator"), [key for key in OPERATORS if key[1] not in UNARY])
def test_binary_operators_are_as_interpreted(compiled, kind, operator):
    compare(compiled, lambda a, b: ir.Binary(kind, operator, a, b), [kind, kind], kind)


@pytest.mark.parametrize(("kind", "operator"), COMPARISONS)
def test_comparisons_are_as_interpreted(compiled, kind, operator):
    compare(compiled, lambda a, b: ir.Compare(kind, operator, a, b), [kind, kind], "i32")


@pytest.mark.parametrize(
    ("kind", "operator"),
    [key for key in CONVERSIONS if key[0] == "i32" or key[1][:6] != "extend" or "i32" in key[1]],
)
def test_conversions_are_as_interpreted(compiled, kind, operator):
    source = next(SOURCES[part] for part in SOURCES if part in operator.replace("reinterpret_", ""))
    compare(compiled, lambda a: ir.Convert(kind, operator, a), [source], kind)


def test_all_operators_of_the_representation_are_there():
    assert len(OPERATORS) == 2 * (15 + 3) + 2 * (7 + 7)
    assert len(COMPARISONS) == 2 * 10 + 2 * 6
    assert {operator for _, operator in CONVERSIONS} == set(ir.ConvertOperator.__args__)


@pytest.mark.parametrize("width", LOAD)
def test_what_a_narrowed_value_is_a_load_finds_after_a_store(compiled, width):
    kind = ir.VALUE_TYPE[width]
    value = ir.Const(kind, -2 if kind in ("i32", "i64") else -2.5)
    machine = compiled(program(store(0, value, width), store(16, load(0, width), WIDTH[kind])))
    machine.run()
    assert width in STORE
    size = ir.BYTES[width]
    expected = {"s8": -2, "u8": 254, "s16": -2, "u16": 65534}.get(width, value.value)
    expected = expected & (1 << 32) - 1 if width in NARROW or width == "w32" else expected
    if width == "w64":
        expected &= (1 << 64) - 1
    assert (
        struct.unpack(FORM[kind], machine.read(FIRST + 16, struct.calcsize(FORM[kind])))[0]
        == expected
    )
    assert machine.read(FIRST + size, 1) == b"\0"


def test_division_by_zero_is_a_fault(compiled):
    machine = compiled(program(store(0, ir.Binary("i32", "div_s", load(4), load(8)))))
    with pytest.raises(MachineFault) as caught:
        machine.run()
    assert caught.value.kind is FaultKind.DIVISION_BY_ZERO
