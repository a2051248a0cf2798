import gc
import weakref
from pathlib import Path

import pytest

from plcsim.core.errors import CycleTimeViolation
from plcsim.core.memory import FIRST, PAGE, SYSTEM_AREA, Memory
from plcsim.core.system_area import RELEASE
from plcsim.machine import CodeCache, Machine, MachineError, MachineFault
from plcsim.machine.cache import default_folder
from plcsim.machine.engine import compile_wasm
from st_types import INT, LREAL, Struct, var

from .units import NO_CACHE, Rig, assemble


class Drive(Struct):
    speed = var(LREAL, 2.5)
    count = var(INT, -3)


COUNT = """
(func (export "count") (param i32)
  (i32.store16 (local.get 0) (i32.add (i32.load16_s (local.get 0)) (i32.const 1))))
(func (export "speed") (param i32) (result f64) (f64.load (local.get 0)))
"""


def test_compiled_code_and_python_see_the_same_variables(any_rig):
    drive = any_rig.memory.new(Drive)
    address = any_rig.address + 1024
    unit = any_rig.load(COUNT)
    assert unit.function("speed")(address) == 2.5
    drive.speed = -0.5
    assert unit.function("speed")(address) == -0.5
    unit.function("count")(address + 8)
    assert drive.count == -2


def test_memory_allocated_later_is_valid_from_then_on(any_rig):
    unit = any_rig.load('(func (export "get") (param i32) (result i32) (i32.load (local.get 0)))')
    get = unit.function("get")
    with pytest.raises(MachineFault):
        get(FIRST + PAGE)
    address = any_rig.memory.allocate(PAGE)
    any_rig.memory.write(FIRST + PAGE, b"\1\2\3\4")
    assert get(FIRST + PAGE) == 0x04030201
    assert get(address) == 0
    with pytest.raises(MachineFault):
        get(FIRST + 2 * PAGE)


def test_compiled_code_reads_the_release_time(rig):
    unit = rig.load(
        f'(func (export "now") (result i64) (i64.load (i32.const {SYSTEM_AREA + 8 * RELEASE})))'
    )
    rig.memory.system.cells[RELEASE] = 2**40
    assert unit.function("now")() == 2**40


def test_an_opened_stack_is_valid_and_what_is_below_is_not(any_rig):
    any_rig.memory.open_stack(2 * PAGE)
    unit = any_rig.load(
        '(import "env" "__stack_pointer" (global $sp (mut i32)))'
        '(func (export "top") (result i32) (global.get $sp))'
        '(func (export "put") (param i32) (i32.store8 (local.get 0) (i32.const 7)))'
    )
    put = unit.function("put")
    assert unit.function("top")() == SYSTEM_AREA
    put(SYSTEM_AREA - 1)
    put(SYSTEM_AREA - 2 * PAGE)
    assert any_rig.memory.read(SYSTEM_AREA - 2 * PAGE, 1) == b"\7"
    with pytest.raises(MachineFault):
        put(SYSTEM_AREA - 2 * PAGE - 1)


# Linking


def test_instances_call_each_other(rig):
    library = rig.load(
        '(func (export "double") (param i32) (result i32) (i32.shl (local.get 0) (i32.const 1)))'
    )
    user = rig.load(
        '(import "lib" "double" (func $double (param i32) (result i32)))'
        '(import "lib" "offset" (global $offset i32))'
        '(func (export "run") (param i32) (result i32)'
        "  (i32.add (call $double (local.get 0)) (global.get $offset)))",
        {("lib", "double"): library.extern("double"), ("lib", "offset"): 0xFFFF_FFFF},
    )
    assert user.function("run")(21) == 41


def test_one_code_makes_several_instances(rig):
    code = rig.machine.compile(
        assemble(
            '(global $n (mut i32) (i32.const 0)) (export "n" (global $n))'
            '(func (export "run") (global.set $n (i32.add (global.get $n) (i32.const 1))))'
        )
    )
    one, two = rig.machine.instantiate(code, {}), rig.machine.instantiate(code, {})
    one.function("run")()
    one.function("run")()
    two.function("run")()
    assert (one.value("n"), two.value("n")) == (2, 1)


def test_functions_are_reached_through_the_common_table(rig):
    first = rig.machine.reserve_functions(2)
    provider = rig.load(
        '(import "env" "__indirect_function_table" (table 0 funcref))'
        '(import "env" "base" (global $base i32))'
        "(elem (global.get $base) $seven)"
        "(func $seven (result i32) (i32.const 7))",
        {("env", "base"): first},
    )
    assert "seven" not in provider
    nine = rig.machine.host_function(lambda: 9, "", "i")
    rig.machine.set_function(first + 1, nine)
    user = rig.load(
        '(import "env" "__indirect_function_table" (table 0 funcref))'
        '(func (export "call") (param i32) (result i32) (call_indirect (result i32) (local.get 0)))'
    )
    call = user.function("call")
    assert (first, call(first), call(first + 1)) == (1, 7, 9)
    with pytest.raises(MachineError, match="entry 3 of the table of functions"):
        rig.machine.set_function(3, nine)


def test_a_module_with_data_is_refused(rig):
    """wasmtime would copy it with no regard to what is valid."""
    with pytest.raises(MachineError, match="it has data, which its loader must take out"):
        rig.load('(data (i32.const 0x110010) "plc")')


def test_a_start_function_that_traps_is_a_fault(rig):
    with pytest.raises(MachineFault, match="unreachable") as caught:
        rig.load("(func $main unreachable) (start $main)")
    assert caught.value.frames[0].function == "main"


@pytest.mark.parametrize(
    ("text", "imports", "message"),
    [
        ('(import "lib" "F_TRIG" (func))', {}, "a module needs lib.F_TRIG, which is not there"),
        ('(import "env" "n" (func))', {("env", "n"): 7}, "a module cannot be linked: incompatible"),
        ('(import "env" "n" (global f64))', {("env", "n"): 7}, "a module cannot be linked"),
        ('(import "env" "memory2" (memory 1))', {}, "cannot be compiled: .*module: multiple mem"),
    ],
)
def test_what_cannot_be_linked_is_told(rig, text, imports, message):
    with pytest.raises(MachineError, match=message):
        rig.load(text, imports)


def test_a_function_in_python_has_the_type_it_was_given(rig):
    extern = rig.machine.host_function(lambda a: None, "I")
    with pytest.raises(MachineError, match="incompatible import type"):
        rig.load('(import "host" "f" (func (param i64)))', {("host", "f"): extern})


def test_global_variables_are_read_as_they_change(rig):
    unit = rig.load(
        """(global $n (export "n") (mut i64) (i64.const -2))
        (func (export "step") (global.set $n (i64.add (global.get $n) (i64.const 1))))"""
    )
    read, step = unit.variable("n"), unit.function("step")
    assert read() == 2**64 - 2
    for _ in range(3):
        step()
    assert read() == unit.value("n") == 1


def test_exports_are_asked_for_by_name_and_type(rig):
    unit = rig.load('(func (export "f") (param i32)) (global (export "g") i32 (i32.const -1))')
    assert "f" in unit
    assert "h" not in unit
    assert unit.value("g") == 0xFFFF_FFFF
    for ask, message in [
        (lambda: unit.extern("h"), "no export 'h'"),
        (lambda: unit.function("g"), "'g' is not a function"),
        (lambda: unit.value("f"), "'f' is not a global"),
        (lambda: unit.function("f", "q"), "'f' takes 'i' and gives '', not 'q' and ''"),
        (lambda: unit.function("f", "I", "i"), "'f' takes 'i' and gives '', not 'I' and 'i'"),
    ]:
        with pytest.raises(MachineError, match=message):
            ask()


def test_code_of_another_engine_is_refused(rig):
    code = Rig(fuel=True).machine.compile(assemble(""))
    with pytest.raises(MachineError, match="compiled with other settings"):
        rig.machine.instantiate(code, {})


@pytest.mark.parametrize(
    "text",
    [
        "(memory 1)",
        "(func (memory.fill (i32.const 0) (i32.const 0) (i32.const 1)))",
        "(func (result v128) (v128.const i32x4 0 0 0 0))",
        "(func (result externref) (ref.null extern))",
        "(func (result i32))",
    ],
)
def test_what_plc_programs_must_not_hold_is_refused(rig, text):
    import wasmtime

    wasm = bytes(wasmtime.wat2wasm(f'(module (import "env" "memory" (memory 0)) {text})'))
    with pytest.raises(MachineError, match="a module cannot be compiled"):
        rig.machine.compile(wasm)


def test_a_module_with_a_memory_of_its_own_is_refused(rig):
    import wasmtime

    code = rig.machine.compile(bytes(wasmtime.wat2wasm("(module (memory 1))")))
    with pytest.raises(MachineError, match="must import the memory of the PLC"):
        rig.machine.instantiate(code, {})


@pytest.mark.parametrize("wasm", [b"", b"\0asm", b"\0asm\1\0\0\0\xff", b"plain text", bytes(100)])
def test_bytes_that_are_no_module_are_refused(rig, wasm):
    with pytest.raises(MachineError, match="module"):
        rig.machine.compile(wasm)


def test_the_memory_does_not_grow(rig):
    grow = rig.load('(func (export "grow") (result i32) (memory.grow (i32.const 1)))')
    assert grow.function("grow")() == -1


# Fuel

LOOP = """
(func (export "run") (param i32)
  (loop $again (br_if $again (local.tee 0 (i32.sub (local.get 0) (i32.const 1))))))
"""


def test_instructions_are_counted_exactly():
    rig = Rig(fuel=True)
    run = rig.load(LOOP).function("run")

    def used(count):
        before = rig.machine.fuel
        run(count)
        return before - rig.machine.fuel

    assert [used(n) for n in (1, 2, 1001)] == [used(1), used(1) + 5, used(1) + 5000]
    assert used(1) == used(1) == 6


def test_instructions_are_counted_alike_however_addresses_are_checked():
    fuels = []
    for compare in False, True:
        rig = Rig(fuel=True, compare=compare)
        before = rig.machine.fuel
        rig.load(COUNT).function("count")(FIRST)
        fuels.append(before - rig.machine.fuel)
    assert fuels[0] == fuels[1] > 0


def test_units_are_metered_and_what_runs_outside_of_them_is_not(monkeypatch):
    monkeypatch.setattr("plcsim.machine.machine.UNIT_FUEL", 1000)
    rig = Rig(fuel=True)
    run = rig.load(LOOP).function("run")
    unit = rig.machine.unit(run)
    unit(3)
    run(10_000)
    unit(2)
    assert rig.machine.meter() == 16 + 11


def test_a_unit_that_does_not_end_leaves_instructions_for_others(monkeypatch):
    monkeypatch.setattr("plcsim.machine.machine.UNIT_FUEL", 1000)
    monkeypatch.setattr("plcsim.machine.machine.ENOUGH_FUEL", 500)
    rig = Rig(fuel=True)
    run = rig.load(LOOP).function("run")
    unit = rig.machine.unit(run)
    for _ in range(2):
        with pytest.raises(CycleTimeViolation, match="within its instructions"):
            unit(0)
        assert rig.machine.meter() >= 990
        run(100)
    unit(5)


def test_a_machine_without_fuel_says_so(rig):
    assert not rig.machine.counts_fuel
    with pytest.raises(MachineError, match="does not count"):
        rig.machine.fuel = 5
    with pytest.raises(MachineError, match="does not count"):
        assert rig.machine.fuel


# Compiled code is kept


def test_the_cache_of_the_user_is_the_default(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert default_folder() == tmp_path / "plcsim" / "code"


def test_a_second_process_would_find_the_code(tmp_path):
    memory = Memory(PAGE)
    wasm = assemble('(func (export "only_here") (result i32) (i32.const 12345))')
    machine = Machine(memory, cache=CodeCache(tmp_path))
    machine.compile(wasm)
    files = {file: file.stat().st_mtime_ns for file in tmp_path.iterdir()}
    assert files
    machine._engine._codes.clear()
    code = machine.compile(wasm)
    assert machine.instantiate(code, {}).function("only_here")() == 12345
    assert {file: file.read_bytes() for file in tmp_path.iterdir()}.keys() == files.keys()


def test_code_compiled_elsewhere_in_the_process_is_taken(rig):
    code = compile_wasm(assemble(LOOP), cache=NO_CACHE)
    assert rig.machine.compile(assemble(LOOP)) is code


# Everything is given back


def status(field):
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(field))


def files():
    return len(list(Path("/proc/self/fd").iterdir()))


def spaces():
    """Count the mappings of this process."""
    return len(Path("/proc/self/maps").read_text().splitlines())


def run_one(text, close):
    rig = Rig()
    heard = []
    extern = rig.machine.host_function(lambda address: heard.append((rig, address)), "I")
    run = rig.load(text, {("host", "hear"): extern}).function("run")
    run()
    assert heard == [(rig, 5)]
    if close:
        rig.machine.close()
    return weakref.ref(rig)


@pytest.mark.parametrize("close", [False, True])
def test_two_thousand_machines_in_one_process_leak_nothing(close):
    text = (
        '(import "host" "hear" (func $hear (param i32)))'
        '(func (export "run") (call $hear (i32.const 5)))'
    )
    run_one(text, close)
    gc.collect()
    before = spaces(), files(), status("VmSize"), status("VmRSS")
    for turn in range(2000):
        ref = run_one(text, close)
        if turn % 200 == 0:
            gc.collect()
            assert ref() is None
    gc.collect()
    after = spaces(), files(), status("VmSize"), status("VmRSS")
    assert after[0] <= before[0] + 100
    assert after[1] == before[1]
    assert after[2] <= before[2] + 64 * 1024
    assert after[3] <= before[3] + 16 * 1024


def test_a_closed_machine_lets_the_memory_go_on(rig):
    rig.machine.close()
    rig.machine.close()
    rig.memory.allocate(3 * PAGE)
    assert rig.memory.read(FIRST, 1) == b"\0"
