"""How long a large Automation Studio project takes to check: cold, and from the cache.

    python benchmarks/as_project.py [--lines 100000] [--keep FOLDER]

A project is generated: programs and libraries in Structured Text and C, in packages, with types
and global variables. `plcsim check` runs on it in a process of its own with an empty cache, then
with a full one. The targets are 15 s, 2 s and 1 GB on two processors; a loop of plain Python beside
each run says how fast the machine was meanwhile.
"""

from __future__ import annotations

import argparse
import os
import resource
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
    kind = f"Machine{number}_typ"
    init = "PROGRAM _INIT\n    speed := 1.5;\nEND_PROGRAM\n"
    return {
        "IEC.prg": objects([("File", "Main.st"), ("File", "Variables.var"), ("File", "Types.typ")]),
        "Main.st": f"{init}\nPROGRAM _CYCLIC\nCASE step OF\n{body}END_CASE\nEND_PROGRAM\n",
        "Variables.var": f"""VAR
    step : UINT;
    count : DINT;
    counter : UDINT;
    start : BOOL := TRUE;
    speed : REAL;
    machine : ARRAY[0..7] OF {kind};
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
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache)}
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
    for name, target in (("cold", COLD_S), ("cached", CACHED_S)):
        run = check(folder, cache)
        met = met and run.wall_s <= target and run.largest_bytes <= LARGEST_BYTES
        memory = f"{run.largest_bytes / (1 << 20):.0f} MB"
        loop = f"{run.yardstick_s * 1e3:.0f} ms"
        figures = f"{name:8}{run.wall_s:>7.2f} s{run.cpu_s:>9.2f} s{memory:>10}{loop:>9}"
        print(f"{figures}  (<= {target:g} s)")
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
