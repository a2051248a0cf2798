"""A position-independent module, as the linker of C makes it, in the text format."""

from functools import cache

import wasmtime

TEXT = """
(module $linked
  (@dylink.0 (mem-info (memory 24 3) (table 2 0)))
  (import "env" "memory" (memory 0))
  (import "env" "__indirect_function_table" (table 0 funcref))
  (import "GOT.mem" "outside" (global $outside (mut i32)))
  (import "env" "__stack_pointer" (global $sp (mut i32)))
  (import "env" "__memory_base" (global $memory i32))
  (import "env" "__table_base" (global $table i32))
  (import "GOT.mem" "own" (global $own (mut i32)))
  (import "GOT.func" "seven" (global $seven_pointer (mut i32)))
  (import "env" "host" (func $host (param i32)))
  (global $state (mut i32) (i32.const 5))
  (global (export "own") i32 (i32.const 8))
  (elem (global.get $table) $six $nine)
  (data (offset (i32.add (global.get $memory) (i32.const 8))) "own!")
  (data (global.get $memory) "\\01\\02\\03\\04")
  (func $six (result i32) (i32.const 6))
  (func $nine (result i32) (i32.const 9))
  (func $seven (export "seven") (result i32) (i32.const 7))
  (func (export "addresses") (param i32) (result i32)
    (block $d (block $c (block $b (block $a
      (br_table $a $b $c $d (local.get 0)))
      (return (global.get $outside)))
      (return (global.get $own)))
      (return (global.get $memory)))
    (global.get $seven_pointer))
  (func (export "indirect") (param i32) (result i32)
    (call_indirect (result i32) (i32.add (global.get $table) (local.get 0))))
  (func (export "count") (param i32) (result i32)
    (loop $again
      (global.set $state (i32.add (global.get $state) (i32.const 1)))
      (br_if $again (local.tee 0 (i32.sub (local.get 0) (i32.const 1)))))
    (global.get $state))
  (func (export "push") (result i32)
    (global.set $sp (i32.sub (global.get $sp) (i32.const 16)))
    (global.get $sp))
  (func (export "floats") (result f64)
    (f64.add (f64.const 0.5) (f64.promote_f32 (f32.const 0.25))))
  (func (export "saturates") (param f64) (result i32) (i32.trunc_sat_f64_s (local.get 0)))
  (func (export "endless") (loop $again (br $again)))
  (func $recurse (export "recurse") (call $recurse))
  (func (export "calls_host") (call $host (i32.const 3)))
  (func (export "fails") (param i32)
    (loop $again
      (if (i32.eqz (local.get 0)) (then unreachable))
      (local.set 0 (i32.sub (local.get 0) (i32.const 1)))
      (br $again)))
)
"""


@cache
def linked() -> bytes:
    """Return the module as a binary."""
    return bytes(wasmtime.wat2wasm(TEXT))
