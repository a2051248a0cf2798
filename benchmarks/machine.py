"""What compiled code costs around itself: crossings, faults, compiling, instantiating.

    python benchmarks/machine.py [--repeat 7] [--json FILE]

Beside the crossings stand two through ``ctypes`` alone, measured in turn with them, as yardstick of
the machine: a foreign function with one argument, and one that calls a Python function back.
"""

from __future__ import annotations

import argparse
import contextlib
import ctypes
import gc
import sys
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

from _outcome import (
    Target,
    console,
    figures_table,
    number_above_0,
    print_machine,
    print_targets,
    write_json,
)

from plcsim.core.memory import Memory
from plcsim.machine import CodeCache, Machine, MachineFault
from plcsim.machine import opcodes as op
from plcsim.machine.encoder import (
    NO_ARGUMENTS,
    ONE_ADDRESS,
    ModuleWriter,
    Signature,
    memarg,
    sleb,
    uleb,
)
from plcsim.machine.engine import Engine, compile_wasm, engine_of

if TYPE_CHECKING:
    from collections.abc import Callable

CALLS = 2_000
LINES = 1000
"""Lines of the module that is compiled, as a compiler would make them of ``a := a + b * 3;``."""

STATEMENTS_PER_FUNCTION = 20


def unit() -> bytes:
    """Return a module with one function for each crossing."""
    writer = ModuleWriter("unit")
    plain = writer.import_function("host", "plain", NO_ARGUMENTS)
    block = writer.import_function("host", "block", ONE_ADDRESS)
    writer.import_memory("env", "memory")
    binary = Signature(bytes([op.I32, op.I32]), bytes([op.I32]))
    bodies = {
        "empty": (NO_ARGUMENTS, b""),
        "add": (binary, op.LOCAL_GET + uleb(0) + op.LOCAL_GET + uleb(1) + op.I32_ADD),
        "plain": (NO_ARGUMENTS, op.CALL + uleb(plain)),
        "block": (NO_ARGUMENTS, op.I32_CONST + sleb(0x120000) + op.CALL + uleb(block)),
        "fault": (NO_ARGUMENTS, op.I32_CONST + sleb(0) + op.I32_LOAD + memarg() + op.DROP),
    }
    for name, (signature, code) in bodies.items():
        index = writer.function(signature, name)
        writer.body(index, code)
        writer.export_function(name, index)
    return writer.encode().wasm


def program(lines: int, seed: int) -> bytes:
    """Return a module of ``lines`` assignments on variables in memory, cut into functions."""
    writer = ModuleWriter(f"program{seed}")
    writer.import_memory("env", "memory")
    main = writer.function(NO_ARGUMENTS, "main")
    calls = bytearray()
    for start in range(0, lines, STATEMENTS_PER_FUNCTION):
        part = writer.function(NO_ARGUMENTS, f"part{start}")
        code = bytearray()
        for line in range(start, min(lines, start + STATEMENTS_PER_FUNCTION)):
            target, other = 0x120000 + line * 4, 0x110000 + (line * 7 + seed) % lines * 4
            address = op.I32_CONST + sleb(target)
            code += address + address + op.I32_LOAD + memarg()
            code += op.I32_CONST + sleb(other) + op.I32_LOAD + memarg()
            code += op.I32_CONST + sleb(3) + op.I32_MUL + op.I32_ADD + op.I32_STORE + memarg()
        writer.body(part, code)
        calls += op.CALL + uleb(part)
    writer.body(main, calls)
    writer.export_function("main", main)
    return writer.encode().wasm


def ns_per_call(call: Callable[[], Any], calls: int) -> float:
    """Return the time of one call; the loop around it is part of it."""
    start = time.perf_counter_ns()
    for _ in range(calls):
        call()
    return (time.perf_counter_ns() - start) / calls


def crossings(machine: Machine) -> dict[str, tuple[Callable[[], Any], int]]:
    """Return what is called, and how often in a row."""
    instance = machine.instantiate(
        machine.compile(unit()),
        {
            ("host", "plain"): machine.host_function(lambda: None),
            ("host", "block"): machine.host_function(lambda _address: None, "I"),
        },
    )
    add, fault = instance.function("add"), instance.function("fault")
    library = ctypes.PyDLL(None)
    absolute, sort = library.abs, library.qsort
    sort.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_size_t, ctypes.c_void_p]
    two = (ctypes.c_int * 2)(1, 2)
    compare = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(lambda _a, _b: 0)

    def faulty() -> None:
        with contextlib.suppress(MachineFault):
            fault()

    return {
        "ctypes: abs(3)": (lambda: absolute(3), CALLS),
        "ctypes: qsort, which calls a Python function once": (
            lambda: sort(two, 2, 4, compare),
            CALLS,
        ),
        "call, no arguments": (instance.function("empty"), CALLS),
        "call, two arguments and a result": (lambda: add(1, 2), CALLS),
        "call that calls a Python function": (instance.function("plain"), CALLS),
        "call that calls a Python block": (instance.function("block"), CALLS),
        "page fault": (faulty, CALLS // 20),
    }


def measure_crossings(repeat: int) -> dict[str, float]:
    """Return the median time in ns by name."""
    calls = crossings(Machine(Memory(), cache=CodeCache(None)))
    seen: dict[str, list[float]] = {name: [] for name in calls}
    gc.disable()
    for _ in range(50 * repeat):
        for name, (call, count) in calls.items():
            seen[name].append(ns_per_call(call, count))
    gc.enable()
    return {name: median(times) for name, times in seen.items()}


def measure_loading(repeat: int) -> dict[str, float]:
    """Return the median time in ms by name, each of a program of its own."""
    seen: dict[str, list[float]] = {}

    def timed(name: str, act: Callable[[], Any]) -> Any:
        start = time.perf_counter_ns()
        result = act()
        seen.setdefault(name, []).append((time.perf_counter_ns() - start) / 1e6)
        return result

    with tempfile.TemporaryDirectory() as folder:
        cache, engine = CodeCache(Path(folder)), engine_of(fuel=False)
        for seed in range(repeat):
            wasm = program(LINES, seed)
            timed(f"compile {LINES} lines", lambda w=wasm: compile_wasm(w, cache=cache))
            _forget(engine)
            code = timed(
                f"load {LINES} lines from the cache", lambda w=wasm: compile_wasm(w, cache=cache)
            )
            machine = timed("a machine on a new memory", lambda: Machine(Memory(), cache=cache))
            timed("instantiate", lambda m=machine, c=code: m.instantiate(c, {}))
    return {name: median(times) for name, times in seen.items()}


def _forget(engine: Engine) -> None:
    """Let the engine look into the cache on disk again, as a new process would."""
    engine._codes.clear()


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--repeat", type=number_above_0, default=7)
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    hosts = [print_machine("before")]
    crossing, loading = measure_crossings(arguments.repeat), measure_loading(arguments.repeat)
    yardstick = crossing["ctypes: abs(3)"]
    table = figures_table("crossing, median", "ns", "x abs(3)")
    for name, ns in crossing.items():
        table.add_row(name, f"{ns:,.0f}", f"{ns / yardstick:.2f}")
    console.print(table)
    console.print()
    table = figures_table("loading, median", "ms")
    for name, ms in loading.items():
        table.add_row(name, f"{ms:.2f}")
    console.print(table)
    targets = [
        Target("call", crossing["call, no arguments"], 1000, "ns"),
        Target("call of a Python block", crossing["call that calls a Python block"], 2000, "ns"),
        Target("compile 1,000 lines", loading[f"compile {LINES} lines"], 60, "ms"),
        Target("load 1,000 lines", loading[f"load {LINES} lines from the cache"], 5, "ms"),
    ]
    print_targets(targets)
    hosts.append(print_machine("after"))
    write_json(arguments.json, hosts, targets, crossing_ns=crossing, loading_ms=loading)
    return not all(target.met for target in targets)


if __name__ == "__main__":
    sys.exit(main())
