"""Compiled code that tells of its stores."""

import pytest
import wasmtime

from plcsim.core.system_area import WATCH
from plcsim.machine import Frame, MachineError
from plcsim.machine.watch import instrument

from .units import FAULTS, Rig, assemble

STORES = """
(func $store (export "store") (param i32)
  (i32.store (local.get 0) (i32.const 7))
  (i64.store8 offset=4 (local.get 0) (i64.const 8)))
(func (export "both") (param i32) (result i32)
  (call $store (local.get 0))
  (i32.load (local.get 0)))
"""

ALL = """
(func $plain (result f64)
  (local i32 i64 f32 f64)
  (block $out
    (loop $again
      (br_if $again (i32.eqz (i32.const -70000)))
      (br_table $again $out $out (i32.const 3))))
  (drop (select (i64.const -5) (i64.const 0x123456789) (i32.const 1)))
  (drop (select (f32.const 1.5) (f32.const -2) (i32.const 0)))
  (i32.store16 (i32.const 1200000) (i32.const 4))
  (drop (i32.trunc_sat_f64_s (f64.const 2)))
  (drop (memory.size))
  (f64.const 3.25))
(func (export "run") (result f64) (call $plain))
"""


def watched(**settings: object) -> tuple[Rig, list[Frame]]:
    seen: list[Frame] = []
    return Rig(watch=seen.append, **settings), seen


@pytest.mark.parametrize("fuel", [False, True])
def test_each_store_and_call_is_told_with_its_offset(fuel: bool) -> None:
    rig, seen = watched(fuel=fuel)
    unit = rig.load(STORES)
    both = unit.function("both")
    both(rig.address)
    assert seen == []  # nobody asks

    rig.memory.system.cells[WATCH] = 1
    assert both(rig.address) == 7
    rig.memory.system.cells[WATCH] = 0
    both(rig.address)

    wasm = assemble(STORES)
    assert [each.module for each in seen] == ["unit"] * 3
    assert [wasm[each.offset] for each in seen] == [0x36, 0x3C, 0x10]


@pytest.mark.parametrize("text", [STORES, FAULTS, ALL])
def test_a_module_stays_valid(text: str) -> None:
    made = instrument(assemble(text), 5, 1)

    wasmtime.Module.validate(wasmtime.Engine(), made)
    assert len(made) > len(assemble(text))


def test_it_does_what_it_did() -> None:
    rig, seen = watched()
    rig.memory.allocate(0x20000)
    unit = rig.load(ALL)

    rig.memory.system.cells[WATCH] = 1
    assert unit.function("run")() == 3.25
    assert len(seen) == 2  # a store and a call


def test_an_exception_of_the_one_who_is_told_comes_out() -> None:
    def angry(_frame: Frame) -> None:
        raise ValueError("no")

    rig = Rig(watch=angry)
    unit = rig.load(STORES)
    rig.memory.system.cells[WATCH] = 1

    with pytest.raises(ValueError, match="no"):
        unit.function("store")(rig.address)


def test_an_unknown_instruction_is_told() -> None:
    wasm = bytearray(assemble('(func (export "f") (i32.store (i32.const 0) (i32.const 0)))'))
    wasm[wasm.rindex(0x36)] = 0xFF

    with pytest.raises(MachineError, match="unknown instruction 16#FF"):
        instrument(bytes(wasm), 0, 1)
