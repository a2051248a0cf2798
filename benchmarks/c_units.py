"""Units in C beside the same C by gcc -O2, what compiling them takes, and what a call costs.

Each kernel (`benchmarks/c_kernels`) is compiled twice, by gcc -O2 for this machine and as a unit
for the controller; both run in turns, with equal results, and a figure is the smallest of all
rounds, as every disturbance of the machine only adds time. Then a unit of 100 lines is compiled,
without and with the caches, and an empty unit is scanned beside an empty program in Python, no
instructions being counted, as on the real clock.

    python benchmarks/c_units.py [--rounds 20] [--json FILE]
"""

from __future__ import annotations

import argparse
import ctypes
import shutil
import subprocess
import tempfile
from pathlib import Path
from time import perf_counter_ns
from typing import TYPE_CHECKING

from _outcome import (
    Target,
    console,
    figures_table,
    number_above_0,
    print_machine,
    print_targets,
    write_json,
)

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.module import CModule
from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.clock import VirtualClock
from plcsim.core.memory import PAGE, Memory
from plcsim.machine import CodeCache, Machine
from plcsim.machine.shared_module import read_shared
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

if TYPE_CHECKING:
    from collections.abc import Callable

FOLDER = Path(__file__).parent / "c_kernels"
CALLS = {"pid": 3_000, "strings": 3_000, "sort": 1}
BURSTS = 30
"""Of so many calls in a round: short ones find the moments in which a busy machine is quiet."""

LIMITS = {"pid": 1.25, "strings": 1.25, "sort": 1.6}
SCANS = 20_000
PLC = '[task_class.1]\ncycle = "1ms"\nprograms = ["main"]\n'
EMPTY = {
    "C": ("Main.c", "#include <bur/plctypes.h>\nvoid _CYCLIC run(void) {}\n"),
    "Python": (
        "main.py",
        "from plcsim import Program\nclass Main(Program):\n    def cyclic(self):\n        pass\n",
    ),
}


class Nothing:
    """Surroundings of kernels, which need none."""

    def variable(self, _name: str) -> None:
        """There is none."""

    def function(self, _name: str, _wanted: object = None) -> None:
        """There is none."""


class Uncounted(VirtualClock):
    """A clock that never waits, and is taken for the host's."""

    is_virtual = False


def kernels(name: str, folder: Path, machine: Machine) -> dict[str, Callable[[int], int]]:
    """Return a kernel by gcc, and as a unit."""
    source = FOLDER / f"{name}.c"
    native = folder / f"{name}.so"
    gcc = shutil.which("gcc")
    if gcc is None:
        raise SystemExit("gcc is not installed")
    command = [gcc, "-O2", "-fPIC", "-shared", "-o", str(native), str(source)]
    subprocess.run(command, check=True)  # a compiler
    built = build(BuildOrder(name, [source], [INCLUDE]), find_toolchain(), CodeCache(None))
    module = CModule(name, read_shared(built.wasm), machine, Nothing()).link()
    module.reset()
    return {"gcc -O2": ctypes.CDLL(str(native)).run, "unit": module.function("run")}


def measure(found: dict[str, Callable[[int], int]], calls: int, rounds: int) -> dict[str, float]:
    """Return ns of a call, the smallest of all rounds; results must be equal in each."""
    best = dict.fromkeys(found, float("inf"))
    for _ in range(rounds):
        results = set()
        for variant, run in found.items():
            start = perf_counter_ns()
            results.add(run(calls))
            best[variant] = min(best[variant], (perf_counter_ns() - start) / calls)
        if len(results) != 1:
            raise SystemExit(f"the kernels give {results}")
    return best


def unit_of_100_lines() -> str:
    """Return the text of a unit."""
    parts = [
        f"static DINT f{n}(DINT x)\n{{\n\tDINT y = x * {n} + 3;\n\tif (y > 100)\n"
        f"\t\ty -= x / 7;\n\tstate[{n}] = y;\n\treturn y;\n}}\n"
        for n in range(11)
    ]
    calls = "".join(f"\tx += f{n}(x);\n" for n in range(11))
    return (
        "#include <bur/plctypes.h>\n#include <AsDefault.h>\nstatic DINT state[11];\n"
        + "".join(parts)
        + f"void _CYCLIC run(void)\n{{\n\tDINT x = state[3];\n{calls}}}\n"
    )


def compile_ms(folder: Path, rounds: int) -> tuple[float, float]:
    """Return ms of compiling and linking a unit of 100 lines: without and with the caches."""
    file = folder / "unit.c"
    (folder / "AsDefault.h").write_text("")
    order = BuildOrder("unit", [file], [folder, INCLUDE])
    toolchain = find_toolchain()
    times: dict[bool, list[float]] = {True: [], False: []}
    for number in range(max(3, rounds // 4)):
        file.write_text(f"/* {folder} {number} */{unit_of_100_lines()}")  # zig has a cache as well
        cache = CodeCache(folder / f"cache{number}")
        for is_cached in (False, True):
            start = perf_counter_ns()
            build(order, toolchain, cache)
            times[is_cached].append((perf_counter_ns() - start) / 1e6)
    return min(times[False]), min(times[True])


def scan_us(folder: Path, rounds: int) -> dict[str, float]:
    """Return us of a cycle of a project with an empty program, by its language."""
    plcs = {}
    for language, (name, text) in EMPTY.items():
        project = folder / language
        (project / "main").mkdir(parents=True)
        (project / "plc.toml").write_text(PLC)
        (project / "main" / name).write_text(text)
        plcs[language] = assemble(load(read_project(project)), clock=Uncounted(), network=None)
        plcs[language].boot()
    best = dict.fromkeys(plcs, float("inf"))
    for _ in range(rounds):
        for language, plc in plcs.items():
            start = perf_counter_ns()
            plc.run(cycles=SCANS)
            best[language] = min(best[language], (perf_counter_ns() - start) / SCANS / 1000)
    return best


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=number_above_0, default=20)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    hosts = [print_machine("before")]
    targets: list[Target] = []
    figures: dict[str, object] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        memory = Memory(64 * PAGE)
        memory.open_stack(PAGE)
        machine = Machine(memory)
        table = figures_table("kernel", "gcc -O2 ns", "unit ns", "ratio")
        for kernel, calls in CALLS.items():
            found = kernels(kernel, folder, machine)
            best = measure(found, calls, BURSTS * options.rounds)
            ratio = best["unit"] / best["gcc -O2"]
            table.add_row(kernel, f"{best['gcc -O2']:.1f}", f"{best['unit']:.1f}", f"{ratio:.2f}")
            figures[kernel] = best
            targets.append(Target(f"{kernel} beside gcc -O2", ratio, LIMITS[kernel], "x"))
        console.print(table)
        cold, cached = compile_ms(folder, options.rounds)
        scans = scan_us(folder, options.rounds)
    targets.append(Target("a unit of 100 lines compiled", cold, 250, "ms"))
    targets.append(Target("the same, cached", cached, 5, "ms"))
    targets.append(Target("an empty unit above Python's", scans["C"] - scans["Python"], 2, "us"))
    figures |= {"compile_ms": [cold, cached], "scan_us": scans}
    print_targets(targets)
    hosts.append(print_machine("after"))
    write_json(options.json, hosts, targets, **figures)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
