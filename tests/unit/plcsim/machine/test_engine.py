import itertools
import os
import subprocess
import sys

import pytest

from plcsim.machine.api import FUNCTION, GLOBAL
from plcsim.machine.cache import CodeCache
from plcsim.machine.engine import CODES_KEPT, Engine, Type, compile_wasm, engine_of
from plcsim.machine.errors import MachineError

from .units import NO_CACHE, assemble


@pytest.mark.parametrize(("fuel", "compare"), list(itertools.product([False, True], repeat=2)))
def test_all_settings_can_be_combined(fuel, compare):
    """A combination that wasmtime refuses would end the process."""
    engine = engine_of(fuel=fuel, compare=compare)
    assert engine is engine_of(fuel=fuel, compare=compare)
    assert engine.compile(b"", lambda: assemble(""), NO_CACHE).imports == [("env", "memory")]


def test_imports_and_exports_are_told():
    code = compile_wasm(
        assemble(
            '(import "lib" "TON" (func (param i32)))'
            '(func (export "f") (param i32 i64) (result f64) (f64.const 0))'
            '(global (export "Geschwindigkeit_ä") f32 (f32.const 0))'
        ),
        cache=NO_CACHE,
    )
    assert code.imports == [("env", "memory"), ("lib", "TON")]
    assert code.exports == {"f": Type(FUNCTION, "iq", "d"), "Geschwindigkeit_ä": Type(GLOBAL)}


def test_only_the_latest_modules_are_remembered():
    engine = engine_of(fuel=False)
    texts = [f"(func (result i32) (i32.const {n}))" for n in range(CODES_KEPT + 1)]
    codes = [compile_wasm(assemble(text), cache=NO_CACHE) for text in texts]
    assert len(engine._codes) == CODES_KEPT
    assert compile_wasm(assemble(texts[-1]), cache=NO_CACHE) is codes[-1]
    assert compile_wasm(assemble(texts[0]), cache=NO_CACHE) is not codes[0]


def test_a_process_with_real_time_rights_has_a_copy_compile(monkeypatch, tmp_path):
    pids = []
    compiled = Engine._compile

    def compiling(*arguments):
        pids.append(os.getpid())
        return compiled(*arguments)

    monkeypatch.setattr(Engine, "_compile", compiling)
    monkeypatch.setattr("plcsim.host.realtime.is_held", lambda: True)
    monkeypatch.setattr("plcsim.host.helper_process.is_alone", lambda: True)
    wasm = assemble("(func (result i32) (i32.const 27182))")
    code = compile_wasm(wasm, cache=CodeCache(tmp_path))
    assert code.imports == [("env", "memory")]
    assert pids == []
    with pytest.raises(MachineError, match="no WebAssembly module"):
        compile_wasm(b"", cache=CodeCache(tmp_path))
    assert pids == [os.getpid()]  # to tell what is wrong
    compile_wasm(assemble("(func (result i32) (i32.const 27183))"), cache=NO_CACHE)
    assert len(pids) == 2  # or it would be lost


FAULTHANDLER = """
import faulthandler
{before}
from plcsim.core.memory import Memory
from plcsim.machine import CodeCache, Machine, MachineFault
from plcsim.machine.encoder import ModuleWriter, Signature, memarg, uleb
from plcsim.machine.opcodes import I32, I32_LOAD, LOCAL_GET
machine = Machine(Memory(), cache=CodeCache(None))
{after}
writer = ModuleWriter("unit")
writer.import_memory("env", "memory")
load = writer.function(Signature(bytes([I32]), bytes([I32])), "load")
writer.body(load, LOCAL_GET + uleb(0) + I32_LOAD + memarg())
writer.export_function("load", load)
unit = machine.instantiate(machine.compile(writer.encode().wasm), {{}})
try:
    unit.function("load")(0)
except MachineFault as fault:
    print(fault, flush=True)
import ctypes
ctypes.string_at(1)
"""


@pytest.mark.parametrize(
    ("before", "after"),
    [("faulthandler.enable()", ""), ("", "faulthandler.enable()"), ("", "")],
)
def test_faulthandler_and_page_faults_live_together(before, after):
    """Whoever enables it and when: ours are exceptions, others still end with a Python stack."""
    done = subprocess.run(
        [sys.executable, "-c", FAULTHANDLER.format(before=before, after=after)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == "page fault: address 16#00000000\n"
    assert "Fatal Python error: Segmentation fault" in done.stderr
    assert "string_at" in done.stderr
    assert done.returncode == -11


def test_no_thread_is_left_behind():
    code = (
        "from plcsim.machine.engine import compile_wasm, CodeCache\n"
        "from plcsim.machine.encoder import ModuleWriter\n"
        "compile_wasm(ModuleWriter('x').encode().wasm, cache=CodeCache(None))\n"
        "import os; print(len(os.listdir('/proc/self/task')))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "1\n"
