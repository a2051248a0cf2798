import math
import struct

import pytest
import wasmtime
from hypothesis import given
from hypothesis import strategies as st

from plcsim.machine import opcodes as op
from plcsim.machine.encoder import (
    NO_ARGUMENTS,
    ONE_ADDRESS,
    ModuleWriter,
    Signature,
    f32,
    f64,
    locals_of,
    memarg,
    sleb,
    uleb,
    vector,
)

I32_I32 = Signature(bytes([op.I32]), bytes([op.I32]))


def read_uleb(data):
    value = shift = 0
    for place, byte in enumerate(data):
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            assert place == len(data) - 1
            return value
    raise AssertionError("no end")


@pytest.mark.parametrize(
    ("value", "data"), [(0, "00"), (127, "7f"), (128, "8001"), (624485, "e58e26")]
)
def test_uleb_is_as_in_the_specification(value, data):
    assert uleb(value).hex() == data


@pytest.mark.parametrize(
    ("value", "data"),
    [
        (0, "00"),
        (63, "3f"),
        (64, "c000"),
        (-1, "7f"),
        (-64, "40"),
        (-65, "bf7f"),
        (-123456, "c0bb78"),
    ],
)
def test_sleb_is_as_in_the_specification(value, data):
    assert sleb(value).hex() == data


@given(st.integers(0, 2**64 - 1))
def test_uleb_reads_back(value):
    assert read_uleb(uleb(value)) == value


@given(st.integers(-(2**63), 2**63 - 1))
def test_sleb_reads_back_and_is_the_shortest(value):
    data = sleb(value)
    bits = 7 * len(data)
    assert (read_uleb(data) ^ (1 << (bits - 1))) - (1 << (bits - 1)) == value
    assert len(data) == 1 or not -(1 << (bits - 8)) <= value < 1 << (bits - 8)


def test_real_constants_beyond_the_range_are_infinite():
    assert f32(1e39) == struct.pack("<f", math.inf)
    assert f32(-1e39) == struct.pack("<f", -math.inf)
    assert f64(0.1) == struct.pack("<d", 0.1)


def test_locals_are_runs():
    assert locals_of(b"") == b"\0"
    assert locals_of(bytes([op.I32, op.I32, op.F64, op.I32])) == bytes(
        [3, 2, op.I32, 1, op.F64, 1, op.I32]
    )


class Wasmtime:
    """Runs what the encoder wrote."""

    def __init__(self):
        self.store = wasmtime.Store()

    def instance(self, wasm, *imports):
        module = wasmtime.Module(self.store.engine, wasm)
        return wasmtime.Instance(self.store, module, list(imports)).exports(self.store)


@pytest.fixture
def runtime():
    return Wasmtime()


def test_an_empty_module_is_a_module(runtime):
    module = ModuleWriter().encode()
    assert module.wasm == b"\0asm\1\0\0\0"
    assert module.starts == []
    assert len(runtime.instance(module.wasm)) == 0


def test_calls_may_be_written_before_their_targets(runtime):
    writer = ModuleWriter("demo")
    double = writer.function(I32_I32, "double")
    quadruple = writer.function(I32_I32, "quadruple")
    call = op.CALL + uleb(double)
    writer.body(quadruple, op.LOCAL_GET + uleb(0) + call + call)
    writer.body(double, op.LOCAL_GET + uleb(0) + op.I32_CONST + sleb(1) + op.I32_SHL)
    writer.export_function("quadruple", quadruple)
    assert runtime.instance(writer.encode().wasm)["quadruple"](runtime.store, -3) == -12


def test_imports_precede_and_every_kind_is_reached(runtime):
    provider = ModuleWriter("provider")
    provider.memory(1, 2)
    provider.export_memory("memory")
    provider.export_table("table", provider.table(4))
    provider.export_global("base", provider.global_(op.I32, op.I32_CONST + sleb(16), mutable=False))
    given_ = runtime.instance(provider.encode().wasm)

    writer = ModuleWriter("user")
    notify = writer.import_function("host", "notify", ONE_ADDRESS)
    writer.import_memory("env", "memory", 1)
    table = writer.import_table("env", "table", 2)
    base = writer.import_global("env", "base", op.I32)
    counter = writer.global_(op.I64, op.I64_CONST + sleb(5))
    add = writer.function(I32_I32, "add")
    run = writer.function(NO_ARGUMENTS, "run")
    bump = op.GLOBAL_GET + uleb(counter) + op.I64_CONST + sleb(1) + op.I64_ADD
    store = op.GLOBAL_GET + uleb(base) + op.GLOBAL_GET + uleb(counter) + op.I64_STORE + memarg(8, 3)
    writer.body(add, op.LOCAL_GET + uleb(0) + op.I32_CONST + sleb(1000) + op.I32_ADD)
    writer.body(
        run,
        bytearray(bump + op.GLOBAL_SET + uleb(counter) + store)
        + op.I32_CONST + sleb(41) + op.I32_CONST + sleb(1)
        + op.CALL_INDIRECT + uleb(writer.type_index(I32_I32)) + uleb(table)
        + op.LOCAL_SET + uleb(1) + op.LOCAL_GET + uleb(1) + op.CALL + uleb(notify),
        bytes([op.F64, op.I32]),
    )  # fmt: skip
    writer.elements(1, [add], table)
    writer.export_function("run", run)
    heard = []
    notify_type = wasmtime.FuncType([wasmtime.ValType.i32()], [])
    exports = runtime.instance(
        writer.encode().wasm,
        wasmtime.Func(runtime.store, notify_type, heard.append),
        given_["memory"],
        given_["table"],
        given_["base"],
    )
    exports["run"](runtime.store)
    memory = given_["memory"]
    assert heard == [1041]
    assert memory.read(runtime.store, 24, 32) == (6).to_bytes(8, "little")


def test_a_second_table_of_its_own_is_filled(runtime):
    writer = ModuleWriter()
    writer.table(1)
    second = writer.table(1, 1)
    seven = writer.function(Signature(b"", bytes([op.I32])))
    ask = writer.function(Signature(b"", bytes([op.I32])))
    kind = uleb(writer.type_index(Signature(b"", bytes([op.I32]))))
    writer.body(seven, op.I32_CONST + sleb(7))
    writer.body(ask, op.I32_CONST + sleb(0) + op.CALL_INDIRECT + kind + uleb(second))
    writer.elements(0, [seven], second)
    writer.export_function("ask", ask)
    assert runtime.instance(writer.encode().wasm)["ask"](runtime.store) == 7


@pytest.mark.parametrize("filler", [0, 1, 100, 20_000])
def test_a_frame_of_a_fault_lies_where_the_starts_say(runtime, filler):
    writer = ModuleWriter("unit")
    writer.import_function("host", "never", NO_ARGUMENTS)
    first = writer.function(NO_ARGUMENTS, "first")
    fails = writer.function(NO_ARGUMENTS, "fails")
    writer.body(first, op.NOP * filler)
    writer.body(fails, op.NOP * 3 + op.UNREACHABLE, bytes([op.I32] * 200))
    writer.export_function("fails", fails)
    encoded = writer.encode()
    never = wasmtime.Func(runtime.store, wasmtime.FuncType([], []), lambda: None)
    exports = runtime.instance(encoded.wasm, never)
    with pytest.raises(wasmtime.Trap) as trapped:
        exports["fails"](runtime.store)
    (frame,) = trapped.value.frames
    assert frame.module_offset == encoded.starts[fails - 1] + 3
    assert (frame.module_name, frame.func_name, frame.func_index) == ("unit", "fails", fails)


def test_custom_sections_and_no_names():
    writer = ModuleWriter()
    writer.custom("plcsim.lines", b"\1\2\3")
    wasm = writer.encode().wasm
    assert wasm.endswith(b"\x0cplcsim.lines\1\2\3")
    assert b"name" not in wasm


def test_misuse_is_told():
    writer = ModuleWriter("unit")
    writer.function(NO_ARGUMENTS, "run")
    with pytest.raises(ValueError, match=r"host\.late: imports come before"):
        writer.import_function("host", "late", NO_ARGUMENTS)
    with pytest.raises(ValueError, match="function 'run' of module 'unit' has no body"):
        writer.encode()


def test_vectors_count_their_items():
    assert vector([b"ab", b"c"]) == b"\2abc"


NUMBERS = ("i32", "i64", "f32", "f64")


def names_of_plain_instructions():
    """All instructions without immediates that take numbers and give one number."""
    for name in dir(op):
        kind = name.partition("_")[0].lower()
        known = name.isupper() and "_" in name and kind in NUMBERS
        if known and not any(word in name for word in ("LOAD", "STORE", "CONST")):
            yield name


@pytest.mark.parametrize("name", sorted(names_of_plain_instructions()))
def test_every_opcode_is_the_instruction_of_its_name(name):
    """The wat assembler of wasmtime is the second opinion."""
    kind, _, rest = name.lower().partition("_")
    wat = f"(module (func {kind}.{rest}))"
    encoded = getattr(op, name)
    assert _assembled(wat) == encoded


@pytest.mark.parametrize("name", [n for n in dir(op) if "LOAD" in n or "STORE" in n])
def test_every_access_is_the_instruction_of_its_name(name):
    wat = f"(module (memory 1) (func {name.lower().replace('_', '.', 1)} offset=300 align=1))"
    assert _assembled(wat) == getattr(op, name) + memarg(300)


def _assembled(wat):
    """Return the instructions of the only function; it need not be valid."""
    wasm = bytes(wasmtime.wat2wasm(wat))
    at = wasm.index(b"\x0a", 8)
    body = wasm[at + 5 :]
    return body[: wasm[at + 3] - 2]
