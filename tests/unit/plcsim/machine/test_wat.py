"""WebAssembly as text: wasmtime's assembler makes the same instructions of it."""

import pytest
import wasmtime

from plcsim.machine import reader
from plcsim.machine.errors import MachineError
from plcsim.machine.wat import wat

TEXT = """(module
  (import "env" "memory" (memory 0))
  (import "rt" "f" (func (param i32 f64) (result i64)))
  (import "env" "g" (global (mut i32)))
  (import "env" "t" (table 0 funcref))
  (func (export "run") (param i32) (result i32)
    (local i64 i64)
    (local f32)
    block (result i32)
      i32.const -5
      loop
        local.get 0
        br_if 0
        block
          local.get 0
          br_table 0 1 2
        end
      end
    end
    if (result i32)
      i32.const 2147483647
    else
      i32.const 16
      i32.load16_s offset=4660 align=2
    end
    f64.const 0.1
    call 0
    drop
    f32.const -inf
    drop
    f64.const -nan:0x8000000000001
    drop
    i64.const -9223372036854775808
    drop
    global.get 0
    i32.const 0
    call_indirect (type 2)
    i32.add)
  (func (;2;)))"""


def codes(wasm: bytes) -> bytes:
    """The section of code."""
    return next(wasm[s.start : s.end] for s in reader.sections(wasm) if s.number == reader.CODE)


def test_what_is_assembled_again_is_the_same():
    wasm = bytes(wasmtime.wat2wasm(TEXT.replace("(type 2)", "")))
    text = "\n".join(wat(wasm)).replace("(type 2)", "")
    assert codes(bytes(wasmtime.wat2wasm(text))) == codes(wasm)


def test_notes_stand_behind_their_instructions():
    wasm = bytes(wasmtime.wat2wasm("(module (func nop nop))"))
    start = wasm.index(b"\x01\x01\x0b")
    lines = list(wat(wasm, lambda offset: f"at {offset - start}"))
    assert lines == ["(module", "  (func (;0;)", "    nop  ;; at 0", "    nop  ;; at 1", "  )", ")"]


@pytest.mark.parametrize("wasm", [b"", b"\0asm\x01\0\0\0\x01\x7f", b"no module at all"])
def test_what_is_no_module_is_told(wasm):
    with pytest.raises(MachineError):
        list(wat(wasm))


def test_an_instruction_of_another_compiler_is_told():
    wasm = bytes(
        wasmtime.wat2wasm(
            "(module (memory 1) (func i32.const 0 i32.const 0 i32.const 0 memory.fill))"
        )
    )
    with pytest.raises(MachineError, match="an instruction fc"):
        list(wat(wasm))
