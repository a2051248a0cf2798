"""Compiled Structured Text beside the same in C by gcc, and what compiling it takes.

Each kernel exists twice, in Structured Text and in C (`benchmarks/st_kernels`), on the same
variables at the same offsets; before it is timed, both run and all variables are compared. Ours is
measured as it runs on a controller, budget included, with indices checked and unchecked; C with
-O1 and with -O2 of gcc, of which the faster one counts. Where clang is found, a column shows its
-O2: code of LLVM without any check, which what llvmlite compiles could at best be as fast as (no
front end makes Structured Text into its input, so that itself it is not run). They take turns; a
figure is the smallest of all rounds, as every disturbance of the machine only adds time, and the
ratio is that of the smallest.

Then programs of 1,000 and 20,000 lines are compiled, at first and from the caches: CPU time a
thousand lines, step by step. At last the virtual clock runs as fast as it can with the PID kernel.

    python benchmarks/st.py [--rounds 40] [--json FILE]
"""

from __future__ import annotations

import argparse
import gc
import shutil
import tempfile
from dataclasses import replace
from pathlib import Path
from statistics import median
from time import process_time
from typing import NamedTuple

from _outcome import (
    Target,
    console,
    figures_table,
    number_above_0,
    print_machine,
    print_targets,
    write_json,
)
from _st_kernels import InC, OnMachine, Text, check_equal, compile_text, read, start_of
from _st_machine import state_machine

from plcsim.core.clock import VirtualClock
from plcsim.core.system import State
from plcsim.machine import CodeCache, compile_wasm
from plcsim.machine.engine import engine_of
from plcsim.network import VirtualNetwork
from plcsim.program.structured_text.codegen.options import CodegenOptions
from plcsim.program.structured_text.codegen.storage import dump, load
from plcsim.program.structured_text.lower.semantics import AUTOMATION_STUDIO
from plcsim.project.assembly import VIRTUAL_IP, assemble
from plcsim.project.structured_text_file import load_file

FOLDER = Path(__file__).parent / "st_kernels"
CYCLES = {"pid": 100_000, "sort": 2, "strings": 40_000, "case": 200_000, "blocks": 20_000}
STATES = 1000, 50_000
"""Lines of the state machine among the kernels, and its cycles in one measurement."""

CHECKED = replace(AUTOMATION_STUDIO, checks_bounds=True)
VARIANTS = ("ours, checks", "ours", "gcc -O1", "gcc -O2")
LLVM = "clang -O2"
HAS_CLANG = shutil.which("clang") is not None
SIZES = (1_000, 20_000)
MS = 1_000_000
SCANS = 20_000


class Row(NamedTuple):
    """One kernel.

    Attributes:
        name: of the kernel.
        ns: smallest time of a cycle, in the order of `VARIANTS`, then of `LLVM` where it is found.
        medians_ns: the medians, likewise.
        instructions: of one cycle of ours, without checks, on average.
    """

    name: str
    ns: list[float]
    medians_ns: list[float]
    instructions: float

    @property
    def best_c_ns(self) -> float:
        """Smallest time of a cycle in C by gcc."""
        return min(self.ns[2 : len(VARIANTS)])


class Compiled(NamedTuple):
    """CPU milliseconds for a thousand lines.

    Attributes:
        lines: of the program.
        steps_ms: parse, check, lower, generate, and the machine code.
        cached_ms: all of it, from the caches.
    """

    lines: int
    steps_ms: list[float]
    cached_ms: float


def main() -> int:
    options = _options()
    before = print_machine("before")
    with tempfile.TemporaryDirectory() as folder:
        rows = [_kernel(text, options.rounds, Path(folder)) for text in _texts()]
        _print_kernels(rows)
        compiled = [_compiling(lines, Path(folder), options.rounds) for lines in SIZES]
    _print_compiling(compiled)
    scans_per_s = _virtual(options.rounds)
    console.print(f"\nthe virtual clock: {scans_per_s:,.0f} scans of the PID kernel in a second")
    after = print_machine("\nafter")
    targets = _targets(rows, compiled, scans_per_s)
    print_targets(targets)
    write_json(
        options.json,
        [before, after],
        targets,
        kernels=[row._asdict() for row in rows],
        compiling=[one._asdict() for one in compiled],
        virtual_scans_per_s=scans_per_s,
    )
    return 0 if all(target.met for target in targets) else 1


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Speed of compiled Structured Text.")
    parser.add_argument("--rounds", type=number_above_0, default=40, metavar="N")
    parser.add_argument("--json", type=Path, metavar="FILE")
    return parser.parse_args()


def _texts() -> list[Text]:
    kernels = [read(FOLDER / name, cycles) for name, cycles in CYCLES.items()]
    return [*kernels, state_machine(*STATES)]


# --- kernels ---


def _kernel(text: Text, rounds: int, folder: Path) -> Row:
    budget = CodegenOptions()
    checked, plain = (compile_text(text, one, budget) for one in (CHECKED, AUTOMATION_STUDIO))
    variables = plain.variables
    in_c = [InC(text, variables, level, folder) for level in ("-O1", "-O2")]
    if HAS_CLANG:
        in_c.append(InC(text, variables, "-O2", folder, "clang"))
    kernels = [OnMachine(checked), OnMachine(plain), *in_c]
    image = start_of(variables)
    check_equal(kernels, image, max(1, text.cycles // 20))
    seen: list[list[float]] = [[] for _ in kernels]
    for _ in range(rounds):
        for times, kernel in zip(seen, kernels, strict=True):
            kernel.set(image)
            times.append(kernel.ns_per_cycle(text.cycles))
    counted = OnMachine(plain, fuel=True)
    counted.set(image)
    left = counted.machine.fuel
    counted.ns_per_cycle(count := max(1, text.cycles // 20))
    per_cycle = (left - counted.machine.fuel) / count
    return Row(text.name, [min(t) for t in seen], [median(t) for t in seen], per_cycle)


def _print_kernels(rows: list[Row]) -> None:
    variants = (*VARIANTS, LLVM) if HAS_CLANG else VARIANTS
    table = figures_table("kernel", *variants, "to gcc", "checked", "cost")
    for row in rows:
        table.add_row(
            row.name,
            *(f"{ns:,.1f} ns" for ns in row.ns),
            f"{row.ns[1] / row.best_c_ns:.2f}",
            f"{row.ns[0] / row.best_c_ns:.2f}",
            f"{row.instructions:,.0f}",
        )
    console.print()
    console.print(table)
    if not HAS_CLANG:
        console.print(f"{LLVM}: left out, for no clang is found")


# --- compiling ---


def _compiling(lines: int, folder: Path, rounds: int) -> Compiled:
    """Compile a program several times; the smallest time of each step counts."""
    text = state_machine(lines)
    count = text.programs["Main.st"].count("\n")
    steps: list[list[float]] = []
    cached: list[float] = []
    for number in range(max(3, rounds * SIZES[0] // lines // 2)):
        gc.collect()
        compiled = compile_text(text, AUTOMATION_STUDIO, CodegenOptions())
        addresses = {
            one.name: 0x11_0000 + 0x10_0000 * n + 16 * number  # no code twice in one process
            for n, one in enumerate(compiled.code.segments)
        }
        cache = CodeCache(folder / f"{lines}-{number}")
        wasm = compiled.code.place(addresses)
        begin = process_time()
        compile_wasm(wasm, cache=cache)
        steps.append([*compiled.times, process_time() - begin])
        stored = dump(compiled.code)
        engine_of(fuel=False)._codes.clear()  # as in a new process
        begin = process_time()
        found = load(stored)
        assert found is not None
        compile_wasm(found.place(addresses), cache=cache)
        cached.append(process_time() - begin)
    per_thousand = 1e6 / count
    best = [min(times) * per_thousand for times in zip(*steps, strict=True)]
    return Compiled(count, best, min(cached) * per_thousand)


def _print_compiling(compiled: list[Compiled]) -> None:
    names = ("parse", "check", "lower", "generate", "machine code", "all", "cached")
    table = figures_table("CPU ms for 1,000 lines", *names)
    for one in compiled:
        times = (*one.steps_ms, sum(one.steps_ms), one.cached_ms)
        table.add_row(f"of {one.lines:,}", *(f"{ms:.1f}" for ms in times))
    console.print()
    console.print(table)


# --- the virtual clock ---


def _virtual(rounds: int) -> float:
    """Return how many cycles of a controller with the PID kernel run in a second of CPU time."""
    application = load_file(FOLDER / "pid" / "Main.st", MS)
    clock = VirtualClock()
    network = VirtualNetwork(clock.now_ns).host(VIRTUAL_IP)
    controller = assemble(application, clock=clock, network=network)
    controller.boot()
    controller.run(cycles=SCANS)
    best = 0.0
    for _ in range(max(3, rounds // 4)):
        begin = process_time()
        controller.run(cycles=SCANS)
        best = max(best, SCANS / (process_time() - begin))
    assert controller.state is State.RUN
    return best


def _targets(rows: list[Row], compiled: list[Compiled], scans_per_s: float) -> list[Target]:
    ratios = [
        Target(f"{row.name}, checks and budget on", row.ns[0] / row.best_c_ns, 1.6, "x gcc")
        for row in rows
    ]
    small, large = compiled
    growth = sum(large.steps_ms) / sum(small.steps_ms)
    return [
        *ratios,
        Target("parsing", 1e6 / small.steps_ms[0], 120_000, "lines/s", at_least=True),
        Target("check and compile", sum(small.steps_ms), 80, "ms/1,000 lines"),
        Target("from the caches", small.cached_ms, 5, "ms/1,000 lines"),
        Target(f"of {large.lines:,} lines to {small.lines:,}, a line", growth, 1.3, "x"),
        Target("virtual scans, PID kernel", scans_per_s, 100_000, "/s", at_least=True),
    ]


if __name__ == "__main__":
    raise SystemExit(main())
