"""How long a large Automation Studio project takes to check: cold, and from the cache.

    python benchmarks/as_project.py [--lines 100000] [--keep FOLDER]

A project is generated: programs in packages, a quarter of them in C and the others in Structured
Text, with types and global variables, and libraries in both languages whose blocks they call. That
is near to public projects, which have 63 lines of Structured Text to 23 of C. `plcsim check` runs
on it in a process of its own with an empty cache, then with a full one; Python has its byte code,
as in an installed package. The targets are 15 s, 2 s and 1 GB on two processors. A loop of plain
Python and, where there is one, gcc checking C of the same size say how fast the machine was
meanwhile.
"""

from __future__ import annotations

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Final, NamedTuple

LINES: Final = 100_000
LINES_OF_PROGRAM: Final = 500
PARTS_IN_C: Final = 4
"""One program of so many is in C; real projects have a quarter of their lines in it."""

PROGRAMS_OF_PACKAGE: Final = 10

COLD_S: Final = 15.0
CACHED_S: Final = 2.0
LARGEST_BYTES: Final = 1 << 30

LIBRARIES: Final = 10
"""Libraries; every other one is in C."""

BLOCKS_OF_LIBRARY: Final = 20

YARDSTICK: Final = 2_000_000
"""Turns of the loop that says how fast the machine is."""


class Run(NamedTuple):
    """A run of the command: seconds of the wall and of the processor, bytes, yardstick in s."""

    wall_s: float
    cpu_s: float
    largest_bytes: int
    yardstick_s: float


def objects(entries: list[tuple[str, str]]) -> str:
    """Return a list of Automation Studio."""
    lines = "".join(f'    <Object Type="{kind}">{name}</Object>\n' for kind, name in entries)
    head = '<?xml version="1.0" encoding="utf-8"?>'
    return f"{head}\n<List>\n  <Objects>\n{lines}  </Objects>\n</List>\n"


def library(number: int) -> dict[str, str]:
    """Return a library of function blocks that filter."""
    names = [f"Filter{number}_{n}" for n in range(BLOCKS_OF_LIBRARY)]
    in_c = number % 2 == 1
    interface = "".join(
        f"""FUNCTION_BLOCK {name}
    VAR_INPUT
        In : REAL;
        Weight : REAL;
    END_VAR
    VAR_OUTPUT
        Out : REAL;
    END_VAR
    VAR
        last : ARRAY[0..3] OF REAL;
        at : UDINT;
    END_VAR
END_FUNCTION_BLOCK
"""
        for name in names
    )
    if in_c:
        bodies = "".join(
            f"""void {name}(struct {name} *inst)
{{
    UINT n;
    REAL sum = 0;
    inst->last[inst->at & 3] = inst->In;
    inst->at++;
    for (n = 0; n < 4; n++) {{
        sum += inst->last[n] * inst->Weight;
    }}
    if (sum > 1000.0) {{
        sum = 1000.0;
    }}
    inst->Out = sum;
}}

"""
            for name in names
        )
        bodies = f'#include "lib{number}.h"\n\n{bodies}'
    else:
        bodies = "".join(
            f"""FUNCTION_BLOCK {name}
    last[at MOD 4] := In;
    at := at + 1;
    Out := 0;
    Out := Out + last[0] * Weight;
    Out := Out + last[1] * Weight;
    Out := Out + last[2] * Weight;
    Out := Out + last[3] * Weight;
    IF Out > 1000.0 THEN
        Out := 1000.0;
    ELSIF Out < -1000.0 THEN
        Out := -1000.0;
    END_IF
END_FUNCTION_BLOCK

"""
            for name in names
        )
    source = "Blocks.c" if in_c else "Blocks.st"
    listed = objects([("File", f"lib{number}.fun"), ("File", source)])
    lists = "ANSIC.lby" if in_c else "IEC.lby"
    return {lists: listed, f"lib{number}.fun": interface, source: bodies}


def structured_text(number: int, lines: int) -> dict[str, str]:
    """Return a program: steps of a machine that set outputs, count, and calculate."""
    steps = max(1, lines // 12)
    body = "".join(
        f"""    {step}: (* step {step} *)
        IF start AND NOT machine[{step % 8}].isBusy THEN
            machine[{step % 8}].position := machine[{step % 8}].position + speed * 0.01;
            timer_{step % 4}(IN := TRUE, PT := T#{step % 50 + 1}s);
            IF timer_{step % 4}.Q OR (counter > {step * 7}) THEN
                timer_{step % 4}(IN := FALSE);
                step := {(step + 1) % steps};
            END_IF
        ELSE
            counter := counter + DINT_TO_UDINT(LIMIT(0, {step} - count, 100));
        END_IF
        gTotal{number % 10} := gTotal{number % 10} + 1;
"""
        for step in range(steps)
    )
    timers = "".join(f"    timer_{n} : TON;\n" for n in range(4))
    block = f"Filter{number % LIBRARIES}_{number % BLOCKS_OF_LIBRARY}"
    kind = f"Machine{number}_typ"
    init = "PROGRAM _INIT\n    speed := 1.5;\nEND_PROGRAM\n"
    return {
        "IEC.prg": objects([("File", "Main.st"), ("File", "Variables.var"), ("File", "Types.typ")]),
        "Main.st": f"{init}\nPROGRAM _CYCLIC\nCASE step OF\n{body}END_CASE\n"
        "filter(In := speed, Weight := 0.25);\nEND_PROGRAM\n",
        "Variables.var": f"""VAR
    step : UINT;
    count : DINT;
    counter : UDINT;
    start : BOOL := TRUE;
    speed : REAL;
    machine : ARRAY[0..7] OF {kind};
    filter : {block};
{timers}END_VAR
""",
        "Types.typ": f"""TYPE
    {kind} : STRUCT
        isBusy : BOOL;
        position : REAL;
    END_STRUCT;
END_TYPE
""",
    }


def ansi_c(number: int, lines: int) -> dict[str, str]:
    """Return a program in C with functions that calculate."""
    count = max(1, lines // 10)
    functions = "".join(
        f"""static DINT calculate_{n}(const Station{number}_typ *station, DINT value)
{{
    DINT sum = 0;
    UINT at;
    for (at = 0; at < 8; at++) {{
        sum += station->values[at] * {n + 1} + value;
    }}
    return sum > {n * 100} ? sum - {n} : sum + {n};
}}

"""
        for n in range(count)
    )
    calls = "".join(f"    result += calculate_{n}(&station, result);\n" for n in range(count))
    kind = f"Station{number}_typ"
    files = [("File", "Main.c"), ("File", "Variables.var"), ("File", "Types.typ")]
    return {
        "ANSIC.prg": objects(files),
        "Main.c": f"""#include <bur/plctypes.h>
#ifdef _DEFAULT_INCLUDES
#include <AsDefault.h>
#endif

{functions}void _INIT ProgramInit(void)
{{
    result = 1;
}}

void _CYCLIC ProgramCyclic(void)
{{
{calls}}}
""",
        "Variables.var": f"VAR\n    result : DINT;\n    station : {kind};\nEND_VAR\n",
        "Types.typ": f"""TYPE
    {kind} : STRUCT
        values : ARRAY[0..7] OF DINT;
    END_STRUCT;
END_TYPE
""",
    }


def write_project(folder: Path, lines: int) -> int:
    """Write a project; return the lines of its sources in Structured Text and C."""
    count = max(1, lines // LINES_OF_PROGRAM)
    files: dict[str, str] = {"Large.apj": "<Project/>\n"}
    packages: list[tuple[str, str]] = [("File", "Global.var")]
    tasks = []
    for start in range(0, count, PROGRAMS_OF_PACKAGE):
        package = f"Area{start // PROGRAMS_OF_PACKAGE}"
        names = []
        for number in range(start, min(start + PROGRAMS_OF_PACKAGE, count)):
            name = f"prog{number}"
            make = ansi_c if number % PARTS_IN_C == 0 else structured_text
            made = make(number, LINES_OF_PROGRAM)
            files |= {f"Logical/{package}/{name}/{file}": text for file, text in made.items()}
            names.append(("Program", name))
            tasks.append(f'<Task Name="{name}" Source="{package}.{name}.prg"/>\n')
        files[f"Logical/{package}/Package.pkg"] = objects(names)
        packages.append(("Package", package))
    for number in range(LIBRARIES):
        made = library(number)
        files |= {f"Logical/Libraries/lib{number}/{file}": text for file, text in made.items()}
    entries = [("Library", f"lib{number}") for number in range(LIBRARIES)]
    files["Logical/Libraries/Package.pkg"] = objects(entries)
    packages.append(("Package", "Libraries"))
    totals = "".join(f"    gTotal{n} : UDINT;\n" for n in range(10))
    files["Logical/Global.var"] = f"VAR\n{totals}END_VAR\n"
    files["Logical/Package.pkg"] = objects(packages)
    files["Physical/Physical.pkg"] = objects([("Configuration", "Config")])
    files["Physical/Config/Hardware.hw"] = '<Hardware><Module Name="PC" Type="PC_any"/></Hardware>'
    files["Physical/Config/Cpu.sw"] = (
        f'<Sw><TaskClass Name="Cyclic#4">{"".join(tasks)}</TaskClass></Sw>'
    )
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
    return sum(text.count("\n") for name, text in files.items() if name.endswith((".st", ".c")))


def check(folder: Path, cache: Path) -> Run:
    """Run the command on a project."""
    environment = _environment(cache)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    done = subprocess.run(
        [sys.executable, "-P", "-m", "plcsim", "check", str(folder)],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    wall = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise SystemExit(f"check failed:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Run(wall, cpu, after.ru_maxrss * 1024, yardstick())


def _environment(cache: Path) -> dict[str, str]:
    """Return the environment of the command: a cache of its own, and byte code that is kept."""
    kept = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    bytecode = str(cache.parent / "bytecode")
    return {**kept, "XDG_CACHE_HOME": str(cache), "PYTHONPYCACHEPREFIX": bytecode}


def compile_python(cache: Path) -> None:
    """Let Python keep the byte code of all that the command needs, by a project of few lines."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "project"
        write_project(folder, 2 * PARTS_IN_C * LINES_OF_PROGRAM)
        check(folder, cache.with_name("warm"))


def gcc(folder: Path, lines: int) -> float | None:
    """Return the seconds that gcc takes to check so many lines of C, None without gcc.

    Args:
        folder: for the sources.
        lines: of all of them.
    """
    if shutil.which("gcc") is None:
        return None
    text = ansi_c(0, LINES_OF_PROGRAM)["Main.c"]
    text = text.replace("#include <bur/plctypes.h>", "")
    text = text.replace("void _INIT", "void").replace("void _CYCLIC", "void")
    head = (
        "typedef long DINT; typedef unsigned short UINT; DINT result;\n"
        "typedef struct { DINT values[8]; } Station0_typ; Station0_typ station;\n"
    )
    source = folder / "yardstick.c"
    source.write_text(head + text)
    files = [str(source)] * max(1, lines // (text.count("\n") or 1))
    start = time.perf_counter()
    subprocess.run(["gcc", "-O1", "-fsyntax-only", *files], check=True)
    return time.perf_counter() - start


def yardstick() -> float:
    """Return the seconds of a loop of plain Python."""
    start = time.perf_counter()
    for _ in range(YARDSTICK):
        pass
    return time.perf_counter() - start


def measure(folder: Path, lines: int, cache: Path) -> bool:
    """Print the figures of a project; return whether the targets are met."""
    written = write_project(folder, lines)
    print(f"{written} lines of Structured Text and C")
    print(f"{'':8}{'wall':>9}{'processor':>11}{'memory':>10}{'loop':>9}")
    met = True
    compile_python(cache)
    for name, target in (("cold", COLD_S), ("cached", CACHED_S)):
        run = check(folder, cache)
        met = met and run.wall_s <= target and run.largest_bytes <= LARGEST_BYTES
        memory = f"{run.largest_bytes / (1 << 20):.0f} MB"
        loop = f"{run.yardstick_s * 1e3:.0f} ms"
        figures = f"{name:8}{run.wall_s:>7.2f} s{run.cpu_s:>9.2f} s{memory:>10}{loop:>9}"
        print(f"{figures}  (<= {target:g} s)", flush=True)
    compared = gcc(cache.parent, written)
    if compared is not None:
        print(f"gcc -O1 -fsyntax-only, as many lines of C, one processor: {compared:.2f} s")
    return met


def main() -> int:
    """Measure, and say whether the targets are met."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lines", type=int, default=LINES, metavar="N")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="where the project is written")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = options.keep or Path(place) / "project"
        return 0 if measure(folder, options.lines, Path(place) / "cache") else 1


if __name__ == "__main__":
    sys.exit(main())
