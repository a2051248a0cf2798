"""What the commands of ``plcsim st`` do; `plcsim.cli.st` declares them."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Final

from plcsim.cli.declaration_files import find_files, shown_progress
from plcsim.cli.exit_codes import ExitCode
from plcsim.cli.st_check import check_files
from plcsim.cli.st_format import format_files
from plcsim.cli.st_run import run
from plcsim.core.errors import PlcError
from plcsim.program.structured_text.check.program import QUIET
from plcsim.program.structured_text.code import StructuredTextCode
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.languages.readers import parse_units
from plcsim.program.structured_text.names import SUFFIXES
from plcsim.program.structured_text.syntax.tree import (
    ActionUnit,
    FunctionBlockUnit,
    FunctionUnit,
    ProgramUnit,
)
from plcsim.project.structured_text_file import load_file
from st_types.errors import SourceError
from st_types.syntax.source import Source

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from plcsim.program.structured_text.syntax.tree import StructuredTextFile

WARNINGS: Final = frozenset(str(code) for code in FindingCode if code.startswith("ST5"))
"""Codes that may be hidden."""

_NOUNS = {
    ProgramUnit: "program unit",
    ActionUnit: "action",
    FunctionUnit: "function",
    FunctionBlockUnit: "function block",
}


def check(options: argparse.Namespace) -> int:
    """Print what is wrong in the files, and how many they are."""
    paths = find_files(options.paths, SUFFIXES)
    if not paths:
        raise PlcError(f"{', '.join(map(str, options.paths))}: no .st file was found.")
    counts: Counter[str] = Counter()
    defines = _defines(options.defines)
    hidden = (QUIET | _warnings(options.hide)) - _warnings(options.show)
    files = [file for path in shown_progress(paths) if (file := _read(path, defines, counts))]
    told = [] if options.syntax else check_files(options.paths, files, hidden)
    for line in told:
        print(line)
    counts["error"] += len(told)
    for file in files:
        _report(file, counts)
    units = ", ".join(_count(counts[noun], noun) for noun in _NOUNS.values())
    print(
        f"{_count(len(paths), 'file')}, {_count(counts['line'], 'line')}: {units}; "
        f"{_count(counts['error'], 'error')}, {_count(counts['warning'], 'warning')}"
    )
    return 1 if counts["error"] else 0


def show_wat(options: argparse.Namespace) -> int:
    """Print the WebAssembly of the programs of a file."""
    application = load_file(options.file)
    codes = [each.code for group in application.setup.classes for each in group.programs]
    for code in dict.fromkeys(codes):
        if not isinstance(code, StructuredTextCode):
            raise PlcError(f"{options.file}: is not written in Structured Text.")
        for line in code.wat():
            print(line)
    return ExitCode.DONE


def _warnings(text: str) -> frozenset[FindingCode]:
    """Return the warnings of ``--hide`` and ``--show``.

    Raises:
        PlcError: a code is none of a warning.
    """
    found = set()
    for name in filter(None, map(str.strip, text.upper().split(","))):
        if name not in WARNINGS:
            raise PlcError(f"{name} is no warning; there are {', '.join(sorted(WARNINGS))}.")
        found.add(FindingCode(name))
    return frozenset(found)


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _defines(texts: Sequence[str]) -> dict[str, str]:
    """Return the macros of ``-D NAME`` (as 1) and ``-D NAME=VALUE``.

    Raises:
        PlcError: one of them has no name.
    """
    found = {}
    for text in texts:
        name, sign, value = text.partition("=")
        if not (name.isidentifier() and name.isascii()):
            raise PlcError(f"-D {text}: no name; NAME or NAME=VALUE was expected.")
        found[name] = value if sign else "1"
    return found


def _read(
    path: Path, defines: Mapping[str, str], counts: Counter[str]
) -> StructuredTextFile | None:
    """Parse a file; None where it cannot be read, which is told."""
    try:
        source = Source.read(path)
    except OSError as err:
        print(f"{path}: error: {err.strerror or err}")
    except SourceError as err:
        print(err)
    else:
        file = parse_units(source, defines)
        counts["line"] += source.line_count
        counts.update(_NOUNS[type(unit)] for unit in file.units if type(unit) in _NOUNS)
        return file
    counts["error"] += 1
    return None


def _report(file: StructuredTextFile, counts: Counter[str]) -> None:
    """Print what was found in a file."""
    log = file.diagnostics
    records = sorted(log.records, key=lambda record: (record.line, record.column))
    told = {record.render(): record.severity for record in records}  # what two programs share, once
    for text in told:
        print(text)
    if log.omitted:
        print(f"{file.path}: {log.omitted} more findings are not shown")
    if not log.omitted:
        counts.update(str(severity) for severity in told.values())
        return
    counts["error"] += log.error_count
    counts["warning"] += log.warning_count


COMMANDS: dict[str, Callable[[argparse.Namespace], int]] = {
    "check": check,
    "format": format_files,
    "run": run,
    "wat": show_wat,
}
"""What each command runs; the results are exit codes."""
