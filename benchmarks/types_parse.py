"""Lines a second from the text of declarations to laid-out types, beside Python's own parser.

A project of generated .typ, .var and .fun files is parsed and resolved, as `plcsim types check`
does between reading and printing: every STRUCT, data block and variable gets its type, its offsets
and its initial value. In turn with it ``ast.parse`` parses Python source with as many lines in as
many files: classes with annotated members, values and comments. Both run with the cyclic garbage
collector held back, as the command runs. Figures are medians over the rounds, of CPU time, so that
other work on the machine counts less. At the end the command itself checks the same project: that
is elapsed time, start of the interpreter included.

    python benchmarks/types_parse.py [--rounds 5] [--files 300] [--json FILE]
"""

from __future__ import annotations

import argparse
import ast
import gc
import random
import subprocess
import sys
import tempfile
from itertools import groupby
from pathlib import Path
from statistics import median
from time import perf_counter, process_time
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

from st_types.resolve.scope import Scope
from st_types.syntax.collector import collector_paused
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source

LINES_PER_FILE = 300
SEED = 61131

TYPES = ["BOOL", "BOOL", "UINT", "INT", "UDINT", "REAL", "REAL", "LREAL", "TIME", "USINT", "DINT"]
TYPES += ["STRING[80]", "ARRAY[0..9]OF REAL", "ARRAY[0..MAX_{m}]OF INT", "REFERENCE TO REAL"]
VALUES = {"BOOL": "TRUE", "UINT": "16#FF", "INT": "-5", "REAL": "1.5", "TIME": "T#1s500ms"}
VALUES |= {"STRING[80]": "'idle'", "ARRAY[0..9]OF REAL": "[10(0.0)]"}
COMMENTS = ["", " (*Comment of this member*)", " (*Position of the axis [mm]*) (*#CMD*)"]


class Round(NamedTuple):
    """CPU seconds of one round."""

    declarations_s: float
    python_s: float


def main() -> int:
    options = _options()
    before = print_machine("before")
    sources = _declarations(options.files)
    modules = [_python(text.count("\n")) for _, text in sources]
    lines = sum(text.count("\n") for _, text in sources)
    rounds = [Round(_check(sources), _parse_python(modules)) for _ in range(options.rounds)]
    command_s = _command(sources)
    _print(rounds, lines, len(sources), command_s)
    after = print_machine("\nafter")
    speed = median(lines / r.declarations_s for r in rounds)
    targets = [Target("declarations parsed and laid out", speed, 150_000, "lines/s", at_least=True)]
    print_targets(targets)
    raw = [r._asdict() for r in rounds]
    write_json(options.json, [before, after], targets, lines=lines, rounds=raw, command_s=command_s)
    return 0 if all(target.met for target in targets) else 1


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Speed of the declaration parser.")
    parser.add_argument("--rounds", type=number_above_0, default=5)
    parser.add_argument("--files", type=number_above_0, default=300)
    parser.add_argument("--json", type=Path, metavar="FILE")
    return parser.parse_args()


def _check(sources: list[tuple[str, str]]) -> float:
    """Return the seconds from texts to types."""
    gc.collect()
    start = process_time()
    with collector_paused():
        files = [parse_declarations(Source(path, text)) for path, text in sources]
        programs = groupby(files, lambda file: file.path.partition("/")[0])
        scopes = [Scope(name, list(inside), strict=True) for name, inside in programs]
        for scope in scopes:
            scope.check()
    seconds = process_time() - start
    for file in files:
        file.diagnostics.raise_errors()
    assert sum(1 for scope in scopes for _ in scope.data_types()) > len(sources)
    return seconds


def _parse_python(modules: list[str]) -> float:
    gc.collect()
    start = process_time()
    with collector_paused():
        trees = [ast.parse(module) for module in modules]
    seconds = process_time() - start
    assert len(trees) == len(modules)
    return seconds


def _command(sources: list[tuple[str, str]]) -> float:
    """Return the seconds that ``plcsim types check`` takes for the same files on disk."""
    with tempfile.TemporaryDirectory(prefix="plcsim-types-") as folder:
        for path, text in sources:
            file = Path(folder, path)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(text.replace("\n", "\r\n").encode("latin-1"))
        command = [sys.executable, "-m", "plcsim.cli.main", "types", "check", "--strict", folder]
        start = perf_counter()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return perf_counter() - start


def _print(rounds: list[Round], lines: int, files: int, command_s: float) -> None:
    console.print(f"\n{lines:,} lines in {files} files, {len(rounds)} rounds, medians")
    ours = median(lines / r.declarations_s for r in rounds)
    python = median(lines / r.python_s for r in rounds)
    table = figures_table("", "lines/s", "us/line", "of ast.parse")
    table.add_row("ast.parse", f"{python:,.0f}", f"{1e6 / python:.2f}", "x1.00")
    ratio = median(r.python_s / r.declarations_s for r in rounds)
    table.add_row("parse and lay out", f"{ours:,.0f}", f"{1e6 / ours:.2f}", f"x{ratio:.2f}")
    whole = lines / command_s
    table.add_row("plcsim types check", f"{whole:,.0f}", f"{1e6 / whole:.2f}", "")
    console.print(table)


def _declarations(files: int) -> list[tuple[str, str]]:
    """Return paths and texts of a project: each program with its types, variables and blocks."""
    draw = random.Random(SEED)
    writers = (("Types.typ", _type_file), ("Variables.var", _variables), ("Blocks.fun", _blocks))
    made = []
    for number in range(files):
        name, write = writers[number % 3]
        text = "\n".join(write(draw, number // 3)) + "\n"
        made.append((f"Program{number // 3}/{name}", text))
    return made


def _member(draw: random.Random, name: str, module: int, types: list[str], pragma: str = "") -> str:
    kind = draw.choice(types)
    value = f" := {VALUES[kind]}" if kind in VALUES and draw.random() < 0.2 else ""
    return f"\t\t{name} : {pragma}{kind.format(m=module)}{value};{draw.choice(COMMENTS)}"


def _type_file(draw: random.Random, module: int) -> list[str]:
    lines = ["(*" + "*" * 60, f" * Types of program {module}", " *" + "*" * 59 + ")", "TYPE"]
    own: list[str] = []
    while len(lines) < LINES_PER_FILE:
        if draw.random() < 0.2:
            lines += _enumeration(draw, f"Mode{len(lines)}Enum")
            continue
        name = f"Part{len(lines)}Type"
        lines.append(f"\t{name} : STRUCT (*State of a part*)")
        types = TYPES + own[:6]
        lines += [_member(draw, f"Member{i}", module, types) for i in range(draw.randint(4, 16))]
        lines.append("\tEND_STRUCT;")
        own += [name] if not own[:6] or draw.random() < 0.3 else []
    return [*lines, "END_TYPE"]


def _enumeration(draw: random.Random, name: str) -> list[str]:
    count = draw.randint(3, 8)
    lines = [f"\t{name} :", "\t\t( (*modes*)"]
    for place in range(count):
        value = f" := {place * 10}" if draw.random() < 0.5 else ""
        comma = "," if place < count - 1 else ""
        lines.append(f"\t\t{name}_{place}{value}{comma}{draw.choice(COMMENTS)}")
    return [*lines, "\t\t);"]


def _variables(draw: random.Random, module: int) -> list[str]:
    lines = ["VAR CONSTANT", f"\tMAX_{module} : UINT := {draw.randint(3, 30)}; (*highest index*)"]
    lines += ["END_VAR", "VAR"]
    lines += [_member(draw, f"Variable{i}", module, TYPES) for i in range(LINES_PER_FILE - 5)]
    return [*lines, "END_VAR"]


def _blocks(draw: random.Random, module: int) -> list[str]:
    lines: list[str] = []
    while len(lines) < LINES_PER_FILE:
        name = f"Block{module}_{len(lines)}"
        lines.append(f"{{REDUND_UNREPLICABLE}} FUNCTION_BLOCK {name} (*A block*) (*$GROUP=User*)")
        for section in ("VAR_INPUT", "VAR_OUTPUT", "VAR"):
            lines.append(f"\t{section}")
            pragma = "{REDUND_UNREPLICABLE} " if draw.random() < 0.3 else ""
            names = [f"{section}_{i}" for i in range(draw.randint(2, 8))]
            lines += [_member(draw, each, module, TYPES, pragma) for each in names]
            lines.append("\tEND_VAR")
        lines += ["END_FUNCTION_BLOCK", ""]
    return lines


def _python(lines: int) -> str:
    """Return a module of as many lines: classes with annotated members, values and comments."""
    draw = random.Random(SEED)
    text = ['"""Types of a program."""', "import dataclasses"]
    while len(text) + 18 <= lines:
        text.append("@dataclasses.dataclass")
        text.append(f"class Part{len(text)}:  # State of a part")
        for place in range(draw.randint(4, 16)):
            kind = draw.choice(["bool", "int", "float", "str", "list[float]"])
            value = f" = {draw.choice(['True', '5', '1.5', 'None'])}" if draw.random() < 0.2 else ""
            text.append(f"    member{place}: {kind}{value}  # Comment of this member")
    text += [f"VALUE_{place}: int = 5  # Comment" for place in range(lines - len(text))]
    return "\n".join(text) + "\n"


if __name__ == "__main__":
    sys.exit(main())
